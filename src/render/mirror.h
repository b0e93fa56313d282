// What a planar mirror shows: the scene before it, seen by the camera's mirror image.
#pragma once

#include "base/vec.h"
#include "scene/mesh.h"

#include <optional>

namespace spectrad {

/// A plane in the world: points with dot(normal, p) = offset, m. The normal is a unit vector.
struct Plane {
    Vec3 normal{0, 0, 1};
    double offset = 0;
    [[nodiscard]] double distance(const Vec3& point) const { return dot(normal, point) - offset; }
};

/// The x–y plane of a node, its positive side where `eye` is; nothing if the eye lies in it.
[[nodiscard]] std::optional<Plane> mirrorPlane(const Affine& toWorld, const Vec3& eye);
/// Takes each point to its mirror image.
[[nodiscard]] Affine reflection(const Plane& plane);
/// What of the mesh, placed by `toWorld`, lies on the plane's positive side: triangles that cross it are cut,
/// those in it (the mirror's own) are left out.
[[nodiscard]] Mesh before(const Mesh& mesh, const Affine& toWorld, const Plane& plane);

}  // namespace spectrad
