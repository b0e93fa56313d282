// Built-in shapes as meshes. Plane, disc and torus lie in x–y and face +z; sphere, box, torus are centred;
// cylinder, cone and teapot stand on the x–z plane along y. Texture coordinate (0,0) is bottom left. Outward
// normals, counter-clockwise.
#pragma once

#include "scene/mesh.h"

namespace spectrad {

enum class ShapeKind { sphere, box, plane, disc, cylinder, cone, torus, teapot };

struct Shape {
    ShapeKind kind = ShapeKind::sphere;
    Vec3 size{1, 1, 1};  ///< box: x y z; plane: x y; teapot: x = overall height, lid included
    double radius = 1;   ///< sphere, disc, cylinder, cone, torus (centre line)
    double height = 2;   ///< cylinder, cone
    double tube = 0.25;  ///< torus
};

/// No point of the shape is further from its origin (for the teapot a little more than the furthest point).
[[nodiscard]] double boundingRadius(const Shape& shape);
/// `tolerance`: the largest distance between the mesh and the true surface, in the shape's own units. The
/// mesh is cut no finer than `maxSegments` around a full turn. Normals are the true surface's.
[[nodiscard]] Mesh tessellate(const Shape& shape, double tolerance, int maxSegments = 1024);

}  // namespace spectrad
