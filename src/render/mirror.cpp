#include "render/mirror.h"

#include <algorithm>

namespace spectrad {

std::optional<Plane> mirrorPlane(const Affine& toWorld, const Vec3& eye) {
    Plane plane;
    plane.normal = normalized(cross(toWorld.direction({1, 0, 0}), toWorld.direction({0, 1, 0})));
    plane.offset = dot(plane.normal, toWorld.point({0, 0, 0}));
    const double distance = plane.distance(eye);
    if (distance == 0) return std::nullopt;
    if (distance < 0) {
        plane.normal = plane.normal * -1;
        plane.offset = -plane.offset;
    }
    return plane;
}

Affine reflection(const Plane& plane) {
    const Vec3 n = plane.normal;
    const double d = 2 * plane.offset;
    return {{1 - 2 * n.x * n.x, -2 * n.x * n.y, -2 * n.x * n.z, d * n.x, -2 * n.y * n.x, 1 - 2 * n.y * n.y,
             -2 * n.y * n.z, d * n.y, -2 * n.z * n.x, -2 * n.z * n.y, 1 - 2 * n.z * n.z, d * n.z}};
}

namespace {

template <size_t N>
std::array<float, N> between(const std::array<float, N>& a, const std::array<float, N>& b, double t) {
    std::array<float, N> result;
    for (size_t i = 0; i < N; ++i)
        result[i] = static_cast<float>(a[i] + t * (static_cast<double>(b[i]) - a[i]));
    return result;
}

/// The vertex on the edge from a to b where the distance is zero.
std::uint32_t addBetween(Mesh& mesh, std::uint32_t a, std::uint32_t b, double t) {
    mesh.position.push_back(between(mesh.position[a], mesh.position[b], t));
    if (!mesh.normal.empty()) mesh.normal.push_back(between(mesh.normal[a], mesh.normal[b], t));
    if (!mesh.uv.empty()) mesh.uv.push_back(between(mesh.uv[a], mesh.uv[b], t));
    return static_cast<std::uint32_t>(mesh.position.size() - 1);
}

}  // namespace

Mesh before(const Mesh& mesh, const Affine& toWorld, const Plane& plane) {
    Mesh kept = mesh;
    kept.index.clear();
    std::vector<double> distance;
    double farthest = 0;
    for (const auto& p : mesh.position) {
        const Vec3 world = toWorld.point(mesh.origin + Vec3{p[0], p[1], p[2]});
        distance.push_back(plane.distance(world));
        farthest = std::max({farthest, std::abs(distance.back()), length(world)});
    }
    // Positions are float: what is nearer than their grain lies in the plane.
    const double inPlane = 1e-6 * farthest;
    for (double& d : distance)
        if (std::abs(d) <= inPlane) d = 0;
    for (size_t t = 0; t < mesh.index.size(); t += 3) {
        std::vector<std::uint32_t> polygon;
        for (size_t k = 0; k < 3; ++k) {
            // Always from the same end, so that neighbours cut their common edge in the same point.
            const std::uint32_t a = mesh.index[t + k], b = mesh.index[t + (k + 1) % 3];
            if (distance[a] > 0 || (distance[a] == 0 && distance[b] > 0))
                polygon.push_back(a);
            else if (distance[a] == 0 && distance[mesh.index[t + (k + 2) % 3]] > 0)
                polygon.push_back(a);
            if ((distance[a] > 0 && distance[b] < 0) || (distance[a] < 0 && distance[b] > 0)) {
                const bool inward = distance[a] > 0;
                const std::uint32_t in = inward ? a : b, out = inward ? b : a;
                polygon.push_back(addBetween(kept, in, out, distance[in] / (distance[in] - distance[out])));
            }
        }
        for (size_t k = 2; k < polygon.size(); ++k)
            for (const std::uint32_t corner : {polygon[0], polygon[k - 1], polygon[k]})
                kept.index.push_back(corner);
    }
    return kept;
}

}  // namespace spectrad
