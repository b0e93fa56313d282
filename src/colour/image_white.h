// A white that an image gives itself: one of its pixels, or the mean of all.
#pragma once

#include "colour/white.h"

#include <string>

namespace spectrad {

/// "at:X,Y": a pixel, with its luminance.
[[nodiscard]] bool isPlace(const std::string& white);
/// "at:X,Y", or "image": the mean, as if the world were grey.
[[nodiscard]] bool isOfImage(const std::string& white);
/// Throws UsageError for a place that is none, InputError for one outside, and where there is no light.
[[nodiscard]] White whiteOfImage(const std::string& white, const ChannelImage& xyz);

}  // namespace spectrad
