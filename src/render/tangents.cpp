#include "render/tangents.h"

#include <cmath>

namespace spectrad {

namespace {

Vec3 vec(const std::array<float, 3>& v) {
    return {double{v[0]}, double{v[1]}, double{v[2]}};
}

/// Of a triangle where v does not change, weighted by its area; on the side that u grows to.
Vec3 alongU(const Mesh& mesh, size_t triangle) {
    const std::uint32_t* corner = mesh.index.data() + 3 * triangle;
    const Vec3 p = vec(mesh.position[corner[0]]);
    const Vec3 e1 = vec(mesh.position[corner[1]]) - p, e2 = vec(mesh.position[corner[2]]) - p;
    const auto step = [&](size_t to, size_t axis) {
        return double{mesh.uv[corner[to]][axis]} - double{mesh.uv[corner[0]][axis]};
    };
    const double du1 = step(1, 0), dv1 = step(1, 1), du2 = step(2, 0), dv2 = step(2, 1);
    const double area = du1 * dv2 - du2 * dv1;
    if (area == 0) return {0, 0, 0};
    return (e1 * dv2 - e2 * dv1) * std::copysign(1, area);
}

}  // namespace

std::vector<std::array<float, 3>> tangentsOf(const Mesh& mesh) {
    std::vector<Vec3> sums(mesh.position.size(), Vec3{0, 0, 0});
    if (!mesh.uv.empty()) {
        for (size_t t = 0; t < mesh.triangles(); ++t) {
            const Vec3 tangent = alongU(mesh, t);
            for (size_t k = 0; k < 3; ++k)
                sums[mesh.index[3 * t + k]] = sums[mesh.index[3 * t + k]] + tangent;
        }
    }
    std::vector<std::array<float, 3>> tangents;
    for (size_t v = 0; v < sums.size(); ++v) {
        const Vec3 normal = vec(mesh.normal[v]);
        const double square = dot(normal, normal);
        const auto inSurface = [&](Vec3 t) {
            return square > 0 ? t - normal * (dot(normal, t) / square) : t;
        };
        Vec3 tangent = inSurface(sums[v]);
        if (!(length(tangent) > 1e-9 * length(sums[v]))) tangent = inSurface(cross({0, 1, 0}, normal));
        if (!(length(tangent) > 1e-9)) tangent = inSurface({1, 0, 0});
        tangent = normalized(tangent);
        tangents.push_back(
            {static_cast<float>(tangent.x), static_cast<float>(tangent.y), static_cast<float>(tangent.z)});
    }
    return tangents;
}

}  // namespace spectrad
