// The bispectral part of an EXR in the spectral layout 1.0: what comes out at one wavelength of what went in
// at another.
#pragma once

#include "base/error.h"

#include <filesystem>
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

}  // namespace spectrad
