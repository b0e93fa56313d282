// Where samples lie in a pixel.
#pragma once

#include "base/limits.h"
#include "types.h"

#include <cstdint>
#include <vector>

namespace spectrad {

/// Offsets in SD_SUBPIXEL-ths of a pixel, 0…255: a rank-1 lattice whose points are as far apart as such a
/// lattice allows (seen as tiling the plane); one sample is the pixel's centre. Images have 1…maxSamples.
struct SamplePattern {
    std::vector<std::int32_t> x, y;
};
[[nodiscard]] SamplePattern samplePattern(int samples);

/// The pattern as kernels want it: samples padded with the first one to `slots` (a power of two), then
/// repeated over lanes [pixel][slot] up to max(slots, vectorWidth) entries.
struct LanePattern {
    int slots = 1;
    std::vector<std::int32_t> slotX, slotY;  ///< `slots` entries
    std::vector<std::int32_t> laneX, laneY;  ///< offsets from the first lane's pixel
    std::vector<std::int32_t> used;  ///< −1 where the lane is a sample, 0 where it only fills a slot
};
[[nodiscard]] LanePattern lanePattern(int samples, int vectorWidth);

}  // namespace spectrad
