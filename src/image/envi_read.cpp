#include "image/envi_read.h"

#include "base/files.h"
#include "base/text.h"
#include "image/cube_check.h"
#include "image/envi_header.h"
#include "image/envi_raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largestHeader = 64u << 20;  // bytes

bool startsLikeEnvi(const fs::path& path) {
    std::array<char, 7> start{};  // after a byte order mark, perhaps
    std::ifstream file(path, std::ios::binary);
    file.read(start.data(), start.size());
    std::string_view text(start.data(), static_cast<size_t>(file.gcount()));
    if (startsWith(text, "\xef\xbb\xbf")) text.remove_prefix(3);
    return startsWith(text, "ENVI");
}

fs::path findEnviData(const fs::path& path, const fs::path& header) {
    if (path != header) return path;
    fs::path stem = fs::path(header).replace_extension();  // of x.img.hdr: x.img
    if (isFile(stem)) return stem;
    for (const char* extension :
         {".img", ".dat", ".raw", ".bsq", ".bil", ".bip", ".IMG", ".DAT", ".RAW", ".BSQ", ".BIL", ".BIP"})
        if (fs::path data = stem.string() + extension; isFile(data)) return data;
    throw InputError(
        {header.string()},
        "has no data file beside it (allowed: no extension, .img, .dat, .raw, .bsq, .bil, .bip)");
}

/// One stored value as double. Every ENVI type but the 64-bit integers is exact in it.
template <typename Stored>
double stored(const char* bytes, bool swap) {
    std::array<char, sizeof(Stored)> raw;
    std::memcpy(raw.data(), bytes, raw.size());
    if (swap) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<Stored>(raw));
}

using Decoder = double (*)(const char*, bool);

Decoder decoderOf(int dataType) {
    switch (dataType) {
        case 1:
            return stored<std::uint8_t>;
        case 2:
            return stored<std::int16_t>;
        case 3:
            return stored<std::int32_t>;
        case 5:
            return stored<double>;
        case 12:
            return stored<std::uint16_t>;
        case 13:
            return stored<std::uint32_t>;
        case 14:
            return stored<std::int64_t>;
        case 15:
            return stored<std::uint64_t>;
        default:
            return stored<float>;
    }
}

struct Opened {
    fs::path header;
    envi::Raster raster;
};

Opened openHeader(const fs::path& path, Notes& notes) {
    const auto header = findEnviHeader(path);
    if (!header) throw InputError({path.string()}, "has no ENVI header beside it");
    return {*header,
            envi::rasterFrom(envi::Header::parse(readFile(*header, largestHeader), *header), *header, notes)};
}

/// Without its offset.
std::uintmax_t dataBytes(const envi::Raster& raster) {
    return std::uintmax_t{raster.bandOrder.size()} * static_cast<unsigned>(raster.info.width) *
           static_cast<unsigned>(raster.info.height) * *envi::bytesOfType(raster.dataType);
}

/// Reads the values line by line in the file's own order and puts each in its place.
class EnviReader : public CubeReader {
  public:
    EnviReader(const fs::path& path, Notes& notes)
        : opened_(openHeader(path, notes)),
          path_(findEnviData(path, opened_.header)),
          bands_(raster_.bandOrder.size()),
          decode_(decoderOf(raster_.dataType)),
          size_(static_cast<size_t>(*envi::bytesOfType(raster_.dataType))),
          swap_(raster_.bigEndian != (std::endian::native == std::endian::big)),
          file_(path_, std::ios::binary) {
        checkFileSize();
        if (!file_) throw InputError({path_.string()}, "cannot be read");
    }

    [[nodiscard]] const CubeInfo& info() const override { return raster_.info; }

    void read(int firstRow, int rows, float* values) override {
        values_ = values;
        firstRow_ = firstRow;
        const size_t width = static_cast<size_t>(info().width), height = static_cast<size_t>(info().height),
                     from = static_cast<size_t>(firstRow);
        switch (raster_.interleave) {
            case envi::Interleave::bsq:
                for (size_t b = 0; b < bands_; ++b) {
                    seek((b * height + from) * width);
                    for (int y = firstRow; y < firstRow + rows; ++y)
                        takeBandLine(y, b);
                }
                break;
            case envi::Interleave::bil:
                seek(from * bands_ * width);
                for (int y = firstRow; y < firstRow + rows; ++y)
                    for (size_t b = 0; b < bands_; ++b)
                        takeBandLine(y, b);
                break;
            case envi::Interleave::bip:
                seek(from * bands_ * width);
                for (int y = firstRow; y < firstRow + rows; ++y) {
                    takeBytes(width * bands_);
                    for (size_t x = 0; x < width; ++x)
                        for (size_t b = 0; b < bands_; ++b)
                            put(line_.data() + (x * bands_ + b) * size_, x, y, b);
                }
                break;
        }
    }

    /// How many values so far were marked as no data.
    [[nodiscard]] std::uint64_t ignored() const { return ignoredCount_; }
    [[nodiscard]] const fs::path& data() const { return path_; }

  private:
    void checkFileSize() const {
        std::error_code error;
        const std::uintmax_t size = fs::file_size(path_, error), needed = dataBytes(raster_);
        if (error) throw InputError({path_.string()}, "cannot be read: " + error.message());
        if (size < raster_.offset || size - raster_.offset < needed)
            throw InputError({path_.string()}, fmt::format("{} bytes, where its header calls for {} + {}",
                                                           size, raster_.offset, needed));
    }

    /// To a value of the file, by its number.
    void seek(size_t value) {
        file_.clear();
        file_.seekg(static_cast<std::streamoff>(raster_.offset + value * size_));
    }

    void takeBytes(size_t values) {
        line_.resize(values * size_);
        if (!file_.read(line_.data(), static_cast<std::streamsize>(line_.size())))
            throw InputError({path_.string()}, "cannot be read to its end");
    }

    void takeBandLine(int y, size_t fileBand) {
        const size_t width = static_cast<size_t>(info().width);
        takeBytes(width);
        for (size_t x = 0; x < width; ++x)
            put(line_.data() + x * size_, x, y, fileBand);
    }

    void put(const char* bytes, size_t x, int y, size_t fileBand) {
        double value = decode_(bytes, swap_);
        const size_t band = raster_.bandOrder[fileBand];
        if (raster_.ignored &&
            (value == *raster_.ignored || (std::isnan(value) && std::isnan(*raster_.ignored)))) {
            ++ignoredCount_;
            value = 0;
        } else {
            value = (value * raster_.gains[fileBand] + raster_.offsets[fileBand]) * raster_.scale;
        }
        if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
            throw InputError({path_.string()},
                             fmt::format("{} is {} (allowed: values within the range of float)",
                                         placeInCube(info(), static_cast<int>(x), y, band), value));
        const size_t width = static_cast<size_t>(info().width);
        values_[(static_cast<size_t>(y - firstRow_) * bands_ + band) * width + x] = static_cast<float>(value);
    }

    Opened opened_;
    const envi::Raster& raster_ = opened_.raster;
    fs::path path_;
    size_t bands_;
    Decoder decode_;
    size_t size_;  ///< bytes a value
    bool swap_;
    std::ifstream file_;
    float* values_ = nullptr;  ///< where read() puts them
    int firstRow_ = 0;
    std::vector<char> line_;
    std::uint64_t ignoredCount_ = 0;
};

}  // namespace

std::optional<fs::path> findEnviHeader(const fs::path& path) {
    if (isFile(path) && startsLikeEnvi(path)) return path;
    for (const fs::path& candidate :
         {fs::path(path.string() + ".hdr"), fs::path(path).replace_extension(".hdr"),
          fs::path(path).replace_extension(".HDR")})
        if (isFile(candidate) && startsLikeEnvi(candidate)) return candidate;
    return std::nullopt;
}

CubeInfo readEnviInfo(const fs::path& path, Notes& notes) {
    return openHeader(path, notes).raster.info;
}

bool isAsLargeAsItsEnviHeaderSays(const fs::path& path) {
    try {
        Notes unheard;
        const envi::Raster raster = openHeader(path, unheard).raster;
        std::error_code error;
        return fs::file_size(path, error) == raster.offset + dataBytes(raster) && !error;
    } catch (const InputError&) {
        return false;
    }
}

std::unique_ptr<CubeReader> openEnvi(const fs::path& path, Notes& notes) {
    return std::make_unique<EnviReader>(path, notes);
}

Cube readEnvi(const fs::path& path, Notes& notes) {
    EnviReader reader(path, notes);
    Cube cube{reader.info(), std::vector<float>(checkedValueCount(reader.info(), reader.data()))};
    reader.read(0, cube.info.height, cube.values.data());
    if (reader.ignored() > 0)
        notes.warn({reader.data().string()},
                   fmt::format("{} values are marked as no data; read as 0", reader.ignored()));
    return cube;
}

}  // namespace spectrad
