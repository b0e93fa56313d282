#include "image/exr_read.h"

#include "image/cube_check.h"
#include "image/exr_bands.h"
#include "image/exr_guard.h"
#include "image/exr_headers.h"
#include "image/exr_layout.h"
#include "image/exr_sink.h"
#include "image/printable.h"

#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace spectrad {

namespace {

/// A part with bands, opened for reading.
struct SpectralPart {
    int index = 0;
    ExrBands bands;
    CubeInfo info;
};

std::string someChannels(const Imf::ChannelList& channels) {
    std::string list;
    int count = 0;
    constexpr int most = 8;
    for (auto it = channels.begin(); it != channels.end(); ++it)
        if (count++ < most) list += (list.empty() ? "" : ", ") + printable(it.name());
    return count > most ? fmt::format("{}, … ({} in all)", list, count) : list;
}

/// The first part that has bands.
SpectralPart findPart(const std::filesystem::path& path, Notes& notes) {
    const std::vector<Imf::Header> headers = readExrHeaders(path);
    for (size_t p = 0; p < headers.size(); ++p) {
        const Imf::Header& header = headers[p];
        if (header.hasType() && !Imf::isImage(header.type())) continue;  // deep parts hold no image
        SpectralPart part{static_cast<int>(p), findBands(header.channels(), path, notes), {}};
        if (part.bands.names.empty()) continue;
        part.info = cubeInfoFrom(header, part.bands.emissive, part.bands.nm, path, notes);
        checkCubeInfo(part.info, path);
        return part;
    }
    throw InputError({path.string()},
                     "has no spectral channels (S0.<wavelength>nm or T.<wavelength>nm); its channels are " +
                         someChannels(headers[0].channels()));
}

}  // namespace

bool startsLikeExr(const std::filesystem::path& path) {
    static constexpr std::array<char, 4> magic{0x76, 0x2f, 0x31, 0x01};
    std::array<char, 4> start{};
    std::ifstream file(path, std::ios::binary);
    return file.read(start.data(), start.size()) && start == magic;
}

CubeInfo readExrInfo(const std::filesystem::path& path, Notes& notes) {
    return readingExr(path, [&] { return findPart(path, notes).info; });
}

Cube readExr(const std::filesystem::path& path, Notes& notes) {
    return readingExr(path, [&] {
        const SpectralPart part = findPart(path, notes);
        const size_t count = checkedValueCount(part.info, path);
        // No compression of EXR makes more than some 1000 bytes of one; a damaged header claims more.
        constexpr std::uintmax_t largestRatio = 4096;
        if (const auto size = std::filesystem::file_size(path); count * 2 > size * largestRatio)
            throw InputError({path.string()},
                             fmt::format("damaged: {} values cannot be in {} bytes", count, size));

        // A file without its table of chunks is incomplete: no reconstruction from what can be found.
        Imf::MultiPartInputFile file(path.c_str(), exrThreads(), false);
        if (!file.partComplete(part.index))
            throw InputError({path.string()}, "incomplete: its writing was interrupted");
        Cube cube{part.info, std::vector<float>(count)};
        Imf::InputPart input(file, part.index);
        const Imath::Box2i window = input.header().dataWindow();
        const size_t rowBytes =
            sizeof(float) * part.bands.names.size() * static_cast<size_t>(cube.info.width);
        Imf::FrameBuffer frame;
        for (size_t b = 0; b < part.bands.names.size(); ++b)
            frame.insert(part.bands.names[b],  // OpenEXR turns half and uint into float
                         Imf::Slice::Make(Imf::FLOAT, cube.row(0, b), window, sizeof(float), rowBytes));
        input.setFrameBuffer(frame);
        input.readPixels(window.min.y, window.max.y);
        checkFinite(cube.info, 0, cube.info.height, cube.values.data(), path);
        return cube;
    });
}

}  // namespace spectrad
