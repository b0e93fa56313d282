// What hides lights: the triangles that throw shadows, ordered for a balanced binary tree of boxes. The order
// is all that the host decides; boxes are made on the device for each place of the camera
// (kernels/bounds.cl). A triangle is asked only if its own box is met, and boxes of nodes hold those of their
// triangles, so the answer is the same as if every triangle were asked, whatever the order.
#pragma once

#include "render/world.h"

#include <cstdint>
#include <vector>

namespace spectrad {

[[nodiscard]] bool throwShadows(const std::vector<sd_light>& lights);

/// Leaves of the tree over so many casters: the least power of two with at most SD_LEAF_CASTERS in each; 0
/// for none.
[[nodiscard]] std::uint32_t leavesOf(size_t casters);

/// Sorts world.casters by leaves: halved along the longest side of their middles' box, again and again.
void orderCasters(World& world);

}  // namespace spectrad
