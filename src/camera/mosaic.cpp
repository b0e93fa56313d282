#include "camera/mosaic.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

Mosaic::Mosaic(const std::string& pattern, const std::vector<std::string>& names) : channels(names.size()) {
    side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(pattern.size()))));
    if (pattern.empty() || static_cast<size_t>(side) * static_cast<size_t>(side) != pattern.size())
        throw UsageError("the mosaic '" + pattern + "' is no square of letters (as RGGB: R G over G B)");
    std::vector<bool> there(names.size());
    for (const char letter : pattern) {
        const auto found = std::find(names.begin(), names.end(), std::string(1, letter));
        if (found == names.end())
            throw UsageError("the mosaic '" + pattern + "' has '" + letter +
                             "', which is no channel of the detector");
        tile.push_back(static_cast<size_t>(found - names.begin()));
        there[tile.back()] = true;
    }
    for (size_t c = 0; c < names.size(); ++c)
        if (!there[c])
            throw UsageError("the mosaic '" + pattern + "' lacks the detector's channel '" + names[c] + "'");
}

size_t Mosaic::channelAt(int x, int y) const {
    return tile[static_cast<size_t>((y % side) * side + x % side)];
}

ChannelImage sampled(const ChannelImage& full, const Mosaic& mosaic) {
    ChannelImage raw(full.width, full.height, 1);
    for (int y = 0; y < full.height; ++y)
        for (int x = 0; x < full.width; ++x) {
            const size_t i =
                static_cast<size_t>(y) * static_cast<size_t>(full.width) + static_cast<size_t>(x);
            raw.plane[0][i] = full.plane[mosaic.channelAt(x, y)][i];
        }
    return raw;
}

ChannelImage demosaiced(const ChannelImage& raw, const Mosaic& mosaic) {
    ChannelImage full(raw.width, raw.height, mosaic.channels);
    const int reach = std::max(1, mosaic.side - 1);
    for (int y = 0; y < raw.height; ++y)
        for (int x = 0; x < raw.width; ++x) {
            const size_t pixel =
                static_cast<size_t>(y) * static_cast<size_t>(raw.width) + static_cast<size_t>(x);
            std::vector<double> sum(mosaic.channels), weight(mosaic.channels);
            for (int dy = -reach; dy <= reach; ++dy)
                for (int dx = -reach; dx <= reach; ++dx) {
                    const int u = x + dx, v = y + dy;
                    if (u < 0 || v < 0 || u >= raw.width || v >= raw.height) continue;
                    const size_t c = mosaic.channelAt(u, v);
                    const double w = (reach + 1 - std::abs(dx)) * (reach + 1 - std::abs(dy));
                    sum[c] += w * raw.plane[0][static_cast<size_t>(v) * static_cast<size_t>(raw.width) +
                                               static_cast<size_t>(u)];
                    weight[c] += w;
                }
            for (size_t c = 0; c < mosaic.channels; ++c)
                full.plane[c][pixel] = weight[c] > 0 ? sum[c] / weight[c] : 0;
            full.plane[mosaic.channelAt(x, y)][pixel] = raw.plane[0][pixel];
        }
    return full;
}

}  // namespace spectrad
