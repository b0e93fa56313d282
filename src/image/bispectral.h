// The bispectral part of an EXR in the spectral layout 1.0: what comes out at one wavelength of what went in
// at another.
#pragma once

#include "base/error.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace spectrad {

/// One channel: T.<in>nm.<out>nm, or T.<in>nm, which is the diagonal (in = out, what is reflected).
struct BispectralCell {
    double inNm = 0, outNm = 0;
    double value = 0;  ///< radiance factor, without unit; mean over the image's pixels
};

/// All spectral T channels of an image, in no order. A measured patch of many pixels is its mean, which keeps
/// signed noise from adding up. Throws InputError for a file without channels T.<in>nm.<out>nm.
[[nodiscard]] std::vector<BispectralCell> readBispectral(const std::filesystem::path& path);

/// Writes cells as an image of one pixel in that layout, whole or not at all. Throws InputError (two cells of
/// the same wavelengths, values that are not finite), MachineError.
void writeBispectral(const std::filesystem::path& target, const std::vector<BispectralCell>& cells,
                     const std::map<std::string, std::string>& attributes);

}  // namespace spectrad
