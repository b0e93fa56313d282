// What the header of an ENVI raster says about its data.
#pragma once

#include "image/cube.h"
#include "image/envi_header.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace spectrad::envi {

enum class Interleave { bsq, bil, bip };

struct Raster {
    CubeInfo info;                  ///< wavelengths ascending
    std::vector<size_t> bandOrder;  ///< index in info.wavelengths of each band of the file
    Interleave interleave = Interleave::bsq;
    int dataType = 4;  ///< ENVI's code
    bool bigEndian = false;
    std::uint64_t offset = 0;  ///< bytes before the first value
    /// value = (stored · gain + offset) · scale, band by band in the file's order.
    std::vector<double> gains, offsets;
    double scale = 1;
    std::optional<double> ignored;  ///< stored value that means "no data"; may be NaN
};

/// Bytes of one value of an ENVI data type, or nothing for those that are no real numbers.
[[nodiscard]] std::optional<int> bytesOfType(long long dataType);

/// Throws InputError naming file and line; what is taken for granted is said in `notes`.
[[nodiscard]] Raster rasterFrom(const Header& header, const std::filesystem::path& file, Notes& notes);

}  // namespace spectrad::envi
