// A picture for a display from absolute XYZ: exposure, adaptation to the display's white, its primaries and
// encoding.
#pragma once

#include "colour/colour.h"
#include "colour/display.h"
#include "colour/observe.h"
#include "colour/white.h"

#include <cstdint>
#include <vector>

namespace spectrad {

/// Of an image without a stated luminance, this quantile of Y is shown as display white.
inline constexpr double exposedQuantile = 0.99;
inline constexpr double mostStops = 1000;  ///< of exposure, either way
/// By how much a display signal may exceed 0…1 and not count as outside: a thirtieth of an 8-bit code at
/// mid-grey, what rounding alone may do.
inline constexpr double signalTolerance = 1e-4;

/// FORMAT, "observe": which luminance is shown as display white.
struct Exposure {
    double ev = 0;           ///< stops; each halves the luminance that is shown as white
    bool automatic = false;  ///< from the image even if the white has a luminance
};

struct DevelopSettings {
    Adaptation adaptation = Adaptation::cat16;
    White white;  ///< in the scene; its chromaticity is adapted, its luminance, if any, is the measure of
                  ///< exposure
    Exposure exposure;
    Display display = srgbDisplay();
};

struct DevelopedPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  ///< interleaved, row 0 on top
    double whiteLuminance = 0;      ///< cd/m² that is shown as display white
    std::uint64_t clipped = 0;      ///< pixels with a channel below 0 or above 1 by more than signalTolerance
    [[nodiscard]] double clippedShare() const;
};

/// The luminance, cd/m², that becomes display white: the white's own, or the exposedQuantile of Y; × 2^−EV.
/// An image where that is black counts by its brightest pixel, an all-black one as 1 cd/m². Within
/// 1e-300…1e300, so that its reciprocal exists.
[[nodiscard]] double displayWhiteLuminance(const ChannelImage& xyz, const DevelopSettings& settings);

/// Takes XYZ, absolute, to linear display signals, 0…1 in gamut: one matrix, for the viewer too.
[[nodiscard]] Matrix3 developMatrix(const DevelopSettings& settings, double whiteLuminance);

/// Clips each channel to the display's range: exact inside the gamut, and counted outside.
[[nodiscard]] DevelopedPicture develop(const ChannelImage& xyz, const DevelopSettings& settings);

/// The p-quantile (0…1) of the values, linear between the two ranks about p·(n−1); values must not be empty.
/// Reorders them.
[[nodiscard]] double quantile(std::vector<double>& values, double p);

}  // namespace spectrad
