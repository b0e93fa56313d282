// Directions in a mesh's surface: along which a brushed material was brushed.
#pragma once

#include "scene/mesh.h"

#include <array>
#include <vector>

namespace spectrad {

/// One unit vector a vertex, at right angles to the normal, along the texture coordinates' u; where there are
/// no coordinates, or they do not say, around the mesh's own y axis.
[[nodiscard]] std::vector<std::array<float, 3>> tangentsOf(const Mesh& mesh);

}  // namespace spectrad
