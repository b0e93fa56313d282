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
#include <optional>

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

namespace {

class ExrReader : public CubeReader {
  public:
    ExrReader(const std::filesystem::path& path, Notes& notes)
        : path_(path), part_(findPart(path, notes)), file_(checkedSize(), exrThreads(), false) {
        // A file without its table of chunks is incomplete: no reconstruction from what can be found.
        if (!file_.partComplete(part_.index))
            throw InputError({path_.string()}, "incomplete: its writing was interrupted");
        input_.emplace(file_, part_.index);
    }

    [[nodiscard]] const CubeInfo& info() const override { return part_.info; }

    void read(int firstRow, int rows, float* values) override {
        readingExr(path_, [&] {
            Imath::Box2i window = input_->header().dataWindow();
            window.min.y += firstRow;
            window.max.y = window.min.y + rows - 1;
            const size_t width = static_cast<size_t>(info().width);
            const size_t rowBytes = sizeof(float) * part_.bands.names.size() * width;
            Imf::FrameBuffer frame;
            for (size_t b = 0; b < part_.bands.names.size(); ++b)
                frame.insert(
                    part_.bands.names[b],  // OpenEXR turns half and uint into float
                    Imf::Slice::Make(Imf::FLOAT, values + b * width, window, sizeof(float), rowBytes));
            input_->setFrameBuffer(frame);
            input_->readPixels(window.min.y, window.max.y);
            checkFinite(info(), firstRow, rows, values, path_);
        });
    }

  private:
    /// No compression of EXR makes more than some 1000 bytes of one; a damaged header claims more.
    [[nodiscard]] const char* checkedSize() const {
        constexpr std::uintmax_t largestRatio = 4096;
        const CubeInfo& cube = part_.info;
        const std::uintmax_t count = std::uintmax_t{cube.wavelengths.size()} *
                                     static_cast<unsigned>(cube.width) * static_cast<unsigned>(cube.height);
        if (const auto size = std::filesystem::file_size(path_); count * 2 > size * largestRatio)
            throw InputError({path_.string()},
                             fmt::format("damaged: {} values cannot be in {} bytes", count, size));
        return path_.c_str();
    }

    std::filesystem::path path_;
    SpectralPart part_;
    Imf::MultiPartInputFile file_;
    std::optional<Imf::InputPart> input_;
};

}  // namespace

std::unique_ptr<CubeReader> openExr(const std::filesystem::path& path, Notes& notes) {
    return readingExr(path, [&] { return std::make_unique<ExrReader>(path, notes); });
}

Cube readExr(const std::filesystem::path& path, Notes& notes) {
    return readingExr(path, [&] {
        ExrReader reader(path, notes);
        Cube cube{reader.info(), std::vector<float>(checkedValueCount(reader.info(), path))};
        reader.read(0, cube.info.height, cube.values.data());
        return cube;
    });
}

}  // namespace spectrad
