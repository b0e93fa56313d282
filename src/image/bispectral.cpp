#include "image/bispectral.h"

#include "base/text.h"
#include "image/channel_names.h"
#include "image/exr_guard.h"
#include "image/exr_headers.h"
#include "image/exr_sink.h"
#include "image/picture.h"
#include "image/printable.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

struct Channel {
    std::string name;
    BispectralCell cell;
};

/// The T channels of a part, if there are any of two wavelengths.
std::vector<Channel> channelsOf(const Imf::Header& header, const std::filesystem::path& path) {
    std::vector<Channel> found;
    bool bispectral = false;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        const auto channel = parseChannelName(it.name());
        if (!channel || channel->kind == SpectralChannel::Kind::emissive) continue;
        const bool two = channel->kind == SpectralChannel::Kind::reradiation;
        const BispectralCell cell{channel->nm, two ? channel->emittedNm : channel->nm, 0};
        for (double nm : {cell.inNm, cell.outNm})
            if (!std::isfinite(nm) || nm <= 0)
                throw InputError({path.string()},
                                 "channel '" + printable(it.name()) + "' has no wavelength above 0");
        if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
            throw InputError({path.string()},
                             "channel '" + printable(it.name()) + "' is subsampled (allowed: 1x1)");
        bispectral = bispectral || two;
        found.push_back({it.name(), cell});
    }
    if (!bispectral) found.clear();
    return found;
}

void checkTwins(const std::vector<Channel>& channels, const std::filesystem::path& path) {
    std::vector<const Channel*> order;
    for (const Channel& channel : channels)
        order.push_back(&channel);
    const auto key = [](const Channel* c) { return std::pair(c->cell.inNm, c->cell.outNm); };
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    for (size_t i = 0; i + 1 < order.size(); ++i)
        if (key(order[i]) == key(order[i + 1]))
            throw InputError({path.string()}, "channels '" + printable(order[i]->name) + "' and '" +
                                                  printable(order[i + 1]->name) +
                                                  "' are of the same two wavelengths");
}

/// Sums in double, row by row: the memory of one row, whatever the image.
void addMeans(Imf::InputPart& input, std::vector<Channel>& channels, const std::filesystem::path& path) {
    const Imath::Box2i window = input.header().dataWindow();
    const auto width = static_cast<size_t>(window.max.x - window.min.x + 1);
    std::vector<float> row(width * channels.size());
    for (int y = window.min.y; y <= window.max.y; ++y) {
        Imf::FrameBuffer frame;
        const Imath::Box2i line({window.min.x, y}, {window.max.x, y});
        for (size_t c = 0; c < channels.size(); ++c)
            frame.insert(channels[c].name, Imf::Slice::Make(Imf::FLOAT, row.data() + c * width, line,
                                                            sizeof(float), width * sizeof(float)));
        input.setFrameBuffer(frame);
        input.readPixels(y);
        for (size_t i = 0; i < row.size(); ++i) {
            if (!std::isfinite(row[i]))
                throw InputError({path.string()}, "channel '" + printable(channels[i / width].name) +
                                                      "' holds a value that is not a finite number");
            channels[i / width].cell.value += double{row[i]};
        }
    }
    const double pixels = static_cast<double>(width) * (static_cast<double>(window.max.y) - window.min.y + 1);
    for (Channel& channel : channels)
        channel.cell.value /= pixels;
}

}  // namespace

std::vector<BispectralCell> readBispectral(const std::filesystem::path& path) {
    return readingExr(path, [&] {
        const std::vector<Imf::Header> headers = readExrHeaders(path);
        for (size_t p = 0; p < headers.size(); ++p) {
            if (headers[p].hasType() && !Imf::isImage(headers[p].type())) continue;
            std::vector<Channel> channels = channelsOf(headers[p], path);
            if (channels.empty()) continue;
            checkTwins(channels, path);
            Imf::MultiPartInputFile file(path.c_str(), exrThreads(), false);
            if (!file.partComplete(static_cast<int>(p)))
                throw InputError({path.string()}, "incomplete: its writing was interrupted");
            Imf::InputPart input(file, static_cast<int>(p));
            addMeans(input, channels, path);
            std::vector<BispectralCell> cells;
            for (const Channel& channel : channels)
                cells.push_back(channel.cell);
            return cells;
        }
        throw InputError({path.string()},
                         "has no bispectral channels (T.<in>nm.<out>nm: radiance factor at <out> of light "
                         "at <in>)");
    });
}

void writeBispectral(const std::filesystem::path& target, const std::vector<BispectralCell>& cells,
                     const std::map<std::string, std::string>& attributes) {
    // The layout's decimal sign is a comma, since dots part the layers of a name.
    const auto wave = [](double nm) {
        std::string text = fmt::format("{:.6f}nm", nm);
        std::replace(text.begin(), text.end(), '.', ',');
        return text;
    };
    std::vector<std::string> names;
    std::vector<std::vector<float>> planes;
    for (const BispectralCell& cell : cells) {
        names.push_back("T." + wave(cell.inNm) + (cell.inNm == cell.outNm ? "" : "." + wave(cell.outNm)));
        planes.push_back({static_cast<float>(cell.value)});
    }
    std::map<std::string, std::string> all = attributes;
    all["spectralLayoutVersion"] = "1.0";
    writeChannelsExr(target, 1, 1, names, planes, all);
}

}  // namespace spectrad
