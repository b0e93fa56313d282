#include "study/palette.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace spectrad {

double hatArea(size_t band, size_t bands) {
    return band == 0 || band + 1 == bands ? 0.5 : 1.0;
}

namespace {

/// Alike: the same shape in eight parts of the spectrum, to a 25th of the whole, and the same brightness to a
/// factor of two.
std::array<int, 9> kindOf(const std::vector<double>& moments) {
    std::array<double, 8> part{};
    double total = 0;
    for (size_t n = 0; n < moments.size(); ++n) {
        part[n * 8 / moments.size()] += moments[n];
        total += moments[n];
    }
    std::array<int, 9> kind{};
    for (size_t k = 0; k < 8; ++k)
        kind[k] = static_cast<int>(std::lround(25 * part[k] / total));
    kind[8] = static_cast<int>(std::lround(std::log2(total)));
    return kind;
}

}  // namespace

Palette paletteOf(const std::vector<std::vector<float>>& planes, const HatDetector& detector) {
    const size_t bands = planes.size(), count = planes[0].size();
    struct Kind {
        size_t first = 0, count = 0;
    };
    std::map<std::array<int, 9>, Kind> kinds;
    const auto momentsAt = [&](size_t i) {
        std::vector<double> m(bands);
        for (size_t b = 0; b < bands; ++b)
            m[b] = planes[b][i] * hatArea(b, bands);
        return m;
    };
    for (size_t i = 0; i < count; ++i) {
        const std::vector<double> m = momentsAt(i);
        if (!std::any_of(m.begin(), m.end(), [](double v) { return v > 0; })) continue;
        Kind& kind = kinds[kindOf(m)];
        if (kind.count++ == 0) kind.first = i;
    }
    std::vector<Kind> common;
    for (const auto& [kind, seen] : kinds)
        common.push_back(seen);
    std::stable_sort(common.begin(), common.end(),
                     [](const Kind& a, const Kind& b) { return a.count > b.count; });
    constexpr size_t most = 150;
    if (common.size() > most) common.resize(most);
    Palette out;
    std::vector<size_t> every(bands);
    for (size_t b = 0; b < bands; ++b)
        every[b] = b;
    const auto weights = detector.weights(every);
    double total = 0;
    for (const Kind& kind : common)
        total += static_cast<double>(kind.count);
    for (const Kind& kind : common) {
        out.moments.push_back(momentsAt(kind.first));
        out.share.push_back(static_cast<double>(kind.count) / total);
        Triple xyz{};
        for (size_t b = 0; b < bands; ++b)
            for (size_t c = 0; c < 3; ++c)
                xyz[c] += weights[b][c] * out.moments.back()[b];
        out.xyz.push_back(xyz);
    }
    if (out.moments.empty()) throw InputError("the image is black: there is no colour to keep");
    return out;
}

}  // namespace spectrad
