// Martin Newell's teapot (University of Utah, 1975), as its bicubic Bézier patches.
#pragma once

#include "scene/mesh.h"

namespace spectrad {

/// Height of Newell's teapot in his units, from the bottom to the knob's top.
inline constexpr double teapotHeight = 3.15;

/// Stands on the x–z plane, `height` high with its lid, spout towards +x, handle towards −x. `tolerance` and
/// `maxSegments` as in tessellate().
[[nodiscard]] Mesh tessellateTeapot(double height, double tolerance, int maxSegments);

/// No point of a teapot of that height is further from its origin (the middle of its bottom).
[[nodiscard]] double teapotBoundingRadius(double height);

}  // namespace spectrad
