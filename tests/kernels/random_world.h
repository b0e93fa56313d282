// Plans made by hand for the kernels' tests: random worlds, and worlds made of everything that rasterizers
// get wrong.
#pragma once

#include "render/plan.h"

namespace spectrad {

/// `triangles` of all sizes, nine materials (Lambert, coated, mirror-coated, glowing, rough, metal, three
/// textured), lights of every type in two groups.
[[nodiscard]] Plan randomPlan(unsigned seed, int samples, bool orthographic, int triangles, int height);

/// Without bent normals: the random world's lean so far that they lose more digits than lobes do.
[[nodiscard]] Plan unbent(Plan plan);

/// Slivers, points, triangles behind and through the eye, far outside, larger than the image by 1e6, sharing
/// edges and corners, duplicated, depths from 1e-9 to 1e9.
[[nodiscard]] Plan adversarialPlan(unsigned seed, bool orthographic);

/// One rectangle, wider than a block, of two triangles: number 0 alone in many blocks.
[[nodiscard]] Plan wallPlan(int samples);

}  // namespace spectrad
