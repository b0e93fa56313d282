// What kernels/shadow.h computes, scalar: whether a triangle stands between a surface and a light.
#pragma once

#include "render/casters.h"
#include "verify/scalar_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace spectrad::scalar {

template <typename Real>
class OccludersOf {
    using V = VectorOf<Real>;
    struct Box {
        std::array<Real, 3> low, high;
    };
    struct Ray {
        V from, along, inverse;
        Real size, end, lightSize;
    };

  public:
    OccludersOf() = default;
    template <typename Stored>
    OccludersOf(const World& world, const VerticesOf<Stored>& vertices)
        : leaves_(leavesOf(world.casters.size())) {
        if (!throwShadows(world.lights)) leaves_ = 0;
        if (leaves_ == 0) return;
        for (const std::uint32_t t : world.casters) {
            std::array<V, 3> corners{};
            for (size_t k = 0; k < 3; ++k) {
                const Stored* p = vertices.camera.data() + 3 * size_t{world.index[3 * size_t{t} + k]};
                corners[k] = {static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2])};
            }
            triangle_.push_back(corners);
        }
        const Real far = std::numeric_limits<Real>::max();
        const Box none{{far, far, far}, {-far, -far, -far}};
        bounds_.assign(2 * size_t{leaves_}, none);
        for (size_t leaf = 0; leaf < leaves_; ++leaf)
            for (size_t i = firstOf(leaf); i < firstOf(leaf + 1); ++i)
                widen(bounds_[leaves_ + leaf], boxOf(triangle_[i]));
        for (size_t node = leaves_ - 1; node > 0; --node)
            bounds_[node] = bounds_[2 * node], widen(bounds_[node], bounds_[2 * node + 1]);
    }

    [[nodiscard]] bool hides(const sd_light& light, V from) const {
        if (leaves_ == 0) return false;
        const Ray ray = rayTo(light, from);
        for (size_t node = 1; node != 0;) {
            if (meets(ray, bounds_[node])) {
                if (node < leaves_) {
                    node *= 2;
                    continue;
                }
                for (size_t i = firstOf(node - leaves_); i < firstOf(node - leaves_ + 1); ++i)
                    if (meets(ray, triangle_[i])) return true;
            }
            while (node & 1)
                node /= 2;
            node += node == 0 ? 0 : 1;
        }
        return false;
    }
    /// The same, every triangle asked.
    [[nodiscard]] bool hidesByAll(const sd_light& light, V from) const {
        const Ray ray = rayTo(light, from);
        return std::any_of(triangle_.begin(), triangle_.end(),
                           [&](const auto& corners) { return meets(ray, corners); });
    }

  private:
    [[nodiscard]] size_t firstOf(size_t leaf) const { return leaf * triangle_.size() / leaves_; }

    static Real least(Real a, Real b) { return a < b ? a : b; }
    static Real greatest(Real a, Real b) { return a > b ? a : b; }

    static Box boxOf(const std::array<V, 3>& corners) {
        Box box{};
        const auto axis = [&](size_t i, Real V::*of) {
            box.low[i] = least(corners[2].*of, least(corners[1].*of, corners[0].*of));
            box.high[i] = greatest(corners[2].*of, greatest(corners[1].*of, corners[0].*of));
        };
        axis(0, &V::x), axis(1, &V::y), axis(2, &V::z);
        return box;
    }
    static void widen(Box& box, const Box& by) {
        for (size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = least(by.low[axis], box.low[axis]);
            box.high[axis] = greatest(by.high[axis], box.high[axis]);
        }
    }

    static Ray rayTo(const sd_light& light, V from) {
        Ray ray{from, {light.x, light.y, light.z}, {}, largestOf(from), Real(1e30f), 0};
        if (light.type != SD_LIGHT_DIRECTIONAL) {
            ray.end = 1;
            ray.lightSize = largestOf(ray.along);
            ray.along = {ray.along.x - from.x, ray.along.y - from.y, ray.along.z - from.z};
        }
        const auto inverse = [](Real a) {
            constexpr Real smallest = Real(1e-30f);
            return Real(1.0) / (std::fabs(a) < smallest ? std::copysign(smallest, a) : a);
        };
        ray.inverse = {inverse(ray.along.x), inverse(ray.along.y), inverse(ray.along.z)};
        return ray;
    }

    static bool meets(const Ray& ray, const Box& box) {
        const std::array<Real, 3> from{ray.from.x, ray.from.y, ray.from.z},
            inverse{ray.inverse.x, ray.inverse.y, ray.inverse.z};
        Real size = 0;
        for (size_t axis = 0; axis < 3; ++axis)
            size = greatest(greatest(std::fabs(box.low[axis]), std::fabs(box.high[axis])), size);
        const Real wider = (ray.size + size) * Real(0x1p-20f);
        Real enter = 0, leave = ray.end;
        for (size_t axis = 0; axis < 3; ++axis) {
            const Real a = (box.low[axis] - from[axis] - wider) * inverse[axis],
                       b = (box.high[axis] - from[axis] + wider) * inverse[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter <= leave;
    }

    static Real moment(V a, V b, V along) {
        return dot(crossed<Real>({b.x - a.x, b.y - a.y, b.z - a.z}, {a.x + b.x, a.y + b.y, a.z + b.z}),
                   along);
    }

    static bool meets(const Ray& ray, const std::array<V, 3>& corners) {
        if (!meets(ray, boxOf(corners))) return false;
        std::array<V, 3> p{};
        for (size_t k = 0; k < 3; ++k)
            p[k] = {corners[k].x - ray.from.x, corners[k].y - ray.from.y, corners[k].z - ray.from.z};
        const Real u = moment(p[0], p[1], ray.along), v = moment(p[1], p[2], ray.along),
                   w = moment(p[2], p[0], ray.along);
        if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) return false;
        const FacetOf<Real> plane = facetOf(corners);
        const V& to = p[plane.corner];
        const Real speed = dot(plane.normal, ray.along);
        const Real ahead = dot(plane.normal, to) * std::copysign(Real(1.0), speed);
        constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
        const Real here =
            (std::fabs(to.x) + std::fabs(to.y) + std::fabs(to.z)) * (plane.edges * (4 * epsilon));
        const Real size =
            std::max({largestOf(corners[0]), largestOf(corners[1]), largestOf(corners[2]), ray.lightSize});
        const Real there = plane.steepness() * (size * (16 * epsilon));
        return ahead > here && ahead < std::fma(std::fabs(speed), ray.end, -there);
    }

    std::uint32_t leaves_ = 0;
    std::vector<std::array<V, 3>> triangle_;  ///< that throw shadows, by leaves
    std::vector<Box> bounds_;                 ///< of nodes; 0 is none
};

}  // namespace spectrad::scalar
