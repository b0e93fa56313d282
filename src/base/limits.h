// The largest that may be asked for, whoever asks: a scene, a file, the command line (docs/format.md,
// "Limits").
#pragma once

#include <cstddef>

namespace spectrad {

inline constexpr int largestSide = 65'536;  ///< of an image, in pixels
inline constexpr int maxSamples = 64;       ///< a pixel
inline constexpr std::size_t maxBands = 10'000;

}  // namespace spectrad
