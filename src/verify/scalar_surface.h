// What kernels/surface.h computes, scalar, in float (the kernels' twin) or double (the reference): vectors,
// and the place on a triangle that a sample sees.
#pragma once

#include "verify/scalar_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spectrad::scalar {

template <typename Real>
struct VectorOf {
    Real x, y, z;
};
template <typename Real>
Real dot(VectorOf<Real> a, VectorOf<Real> b) {
    return std::fma(a.z, b.z, std::fma(a.y, b.y, a.x * b.x));
}
template <typename Real>
VectorOf<Real> scaled(VectorOf<Real> a, Real s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <typename Real>
VectorOf<Real> crossed(VectorOf<Real> a, VectorOf<Real> b) {
    return {std::fma(a.y, b.z, -(a.z * b.y)), std::fma(a.z, b.x, -(a.x * b.z)),
            std::fma(a.x, b.y, -(a.y * b.x))};
}
template <typename Real>
VectorOf<Real> unit(VectorOf<Real> a) {
    const Real square = dot(a, a);
    return scaled(a, Real(1.0) / std::sqrt(square == Real(0.0) ? Real(1.0) : square));
}

template <typename Real>
Real largestOf(VectorOf<Real> a) {
    return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
}

template <typename Real>
struct SurfaceOf {
    VectorOf<Real> position, normal, view;
    Real cosView;
    Real u, v;
    Real ux, vx, uy, vy;  // change from pixel to pixel
    Real x, y;            // the sample, SD_SUBPIXEL-ths of a pixel from the image's centre
    Real side;            // 1 where the outside is seen
    VectorOf<Real> horizon;
    VectorOf<Real> lifted;  // where rays to lights start
    VectorOf<Real> tangent, bitangent;
};

template <typename Real>
Real mixed(Real b0, Real v0, Real b1, Real v1, Real b2, Real v2) {
    return std::fma(b2, v2, std::fma(b1, v1, b0 * v0));
}

/// Tangents in the surface that has the normal, as near as may be to a vector.
template <typename Real>
void orient(SurfaceOf<Real>& s, VectorOf<Real> along) {
    const VectorOf<Real> back = scaled(s.normal, -dot(s.normal, along));
    s.tangent = unit<Real>({along.x + back.x, along.y + back.y, along.z + back.z});
    s.bitangent = crossed(s.normal, s.tangent);
}

template <typename Real>
VectorOf<Real> sumOf(VectorOf<Real> a, VectorOf<Real> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/// The plane of a triangle from its two shorter edges and the corner between them.
template <typename Real>
struct FacetOf {
    VectorOf<Real> normal;
    Real edges;  ///< product of both edges' largest coordinates
    size_t corner;

    /// The largest coordinate of the normal; 1 for none.
    [[nodiscard]] Real steepness() const {
        const Real largest = largestOf(normal);
        return largest > 0 ? largest : Real(1.0);
    }
};
template <typename Real>
FacetOf<Real> facetOf(const std::array<VectorOf<Real>, 3>& p) {
    std::array<VectorOf<Real>, 3> edge{};
    std::array<Real, 3> square{};
    for (size_t k = 0; k < 3; ++k) {
        const auto &from = p[k], &to = p[(k + 1) % 3];
        edge[k] = {to.x - from.x, to.y - from.y, to.z - from.z};
        square[k] = dot(edge[k], edge[k]);
    }
    const size_t first = square[0] > square[2] && square[0] > square[1] ? 1 : square[1] > square[2] ? 2 : 0;
    const auto &a = edge[first], &b = edge[(first + 1) % 3];
    return {crossed(a, b), largestOf(a) * largestOf(b), (first + 1) % 3};
}

/// Off the triangle, and onto what its corners' normals make of it where that is above; `share`:
/// barycentrics.
template <typename Real>
VectorOf<Real> liftedFrom(const SurfaceOf<Real>& s, bool baked, VectorOf<Real> interpolated,
                          const std::array<std::array<Real, 3>, 3>& corner,
                          const std::array<std::array<Real, 3>, 3>& normal,
                          const std::array<Real, 3>& share) {
    std::array<VectorOf<Real>, 3> p{}, lift{};
    Real size = 0;
    for (size_t k = 0; k < 3; ++k) {
        p[k] = {corner[k][0], corner[k][1], corner[k][2]};
        size = std::max(size, largestOf(p[k]));
    }
    const FacetOf<Real> own = facetOf(p);
    const Real largest = own.steepness();
    VectorOf<Real> up = unit<Real>({own.normal.x / largest, own.normal.y / largest, own.normal.z / largest});
    up = scaled(up, std::copysign(Real(1.0), dot(up, baked ? interpolated : s.view)));
    for (size_t k = 0; k < 3; ++k) {
        const VectorOf<Real> n = scaled(unit<Real>({normal[k][0], normal[k][1], normal[k][2]}), s.side);
        const VectorOf<Real> off{s.position.x - p[k].x, s.position.y - p[k].y, s.position.z - p[k].z};
        const Real round = std::clamp(std::fma(dot(n, up), Real(4.0), -Real(2.4f)), Real(0.0), Real(1.0));
        lift[k] = scaled(n, share[k] * round * std::max(-dot(off, n), Real(0.0)));
    }
    const Real rounding = size * (std::numeric_limits<Real>::epsilon() * Real(16.0));
    return sumOf(s.position, sumOf(sumOf(sumOf(lift[0], lift[1]), lift[2]), scaled(up, rounding)));
}

/// Stored: what the vertices are kept in.
template <typename Real, typename Stored>
SurfaceOf<Real> surfaceAt(const World& world, const VerticesOf<Stored>& vertices, const sd_frame& frame,
                          std::uint32_t triangle, Real x, Real y) {
    const auto corners = [&](const auto& of, size_t each) {
        std::array<std::array<Real, 3>, 3> all{};
        for (size_t k = 0; k < 3; ++k)
            for (size_t i = 0; i < each; ++i)
                all[k][i] = static_cast<Real>(of[each * size_t{world.index[3 * size_t{triangle} + k]} + i]);
        return all;
    };
    const auto p = corners(vertices.camera, 3), n = corners(vertices.normal, 3);
    const Real rx = x * frame.slope_per_subpixel, ry = -(y * frame.slope_per_subpixel);
    std::array<Real, 3> u{}, v{};
    for (size_t k = 0; k < 3; ++k) {
        u[k] = frame.orthographic ? p[k][0] - rx : std::fma(rx, p[k][2], p[k][0]);
        v[k] = frame.orthographic ? p[k][1] - ry : std::fma(ry, p[k][2], p[k][1]);
        if (!frame.baked) continue;
        const float* c = world.uv.data() + 2 * size_t{world.index[3 * size_t{triangle} + k]};
        u[k] = (c[0] - Real(0.5)) * static_cast<Real>(frame.width * SD_SUBPIXEL) - x;
        v[k] = (Real(0.5) - c[1]) * static_cast<Real>(frame.height * SD_SUBPIXEL) - y;
    }
    Real b0 = std::fma(u[1], v[2], -(u[2] * v[1])), b1 = std::fma(u[2], v[0], -(u[0] * v[2])),
         b2 = std::fma(u[0], v[1], -(u[1] * v[0]));
    const Real turn = std::copysign(Real(1.0), b0 + b1 + b2);
    b0 = std::fmax(b0 * turn, Real(0.0)), b1 = std::fmax(b1 * turn, Real(0.0)),
    b2 = std::fmax(b2 * turn, Real(0.0));
    const Real sum = b0 + b1 + b2;
    const Real inv = Real(1.0) / (sum > 0 ? sum : Real(1.0));
    if (sum > 0) {
        b0 *= inv, b1 *= inv, b2 *= inv;
    } else {
        b0 = b1 = b2 = Real(1.0) / 3;
    }
    SurfaceOf<Real> s{};
    s.x = x, s.y = y;
    s.position = {mixed(b0, p[0][0], b1, p[1][0], b2, p[2][0]), mixed(b0, p[0][1], b1, p[1][1], b2, p[2][1]),
                  mixed(b0, p[0][2], b1, p[1][2], b2, p[2][2])};
    const auto fromFirst = [&](size_t i) {
        return std::fma(b2, n[2][i] - n[0][i], std::fma(b1, n[1][i] - n[0][i], n[0][i]));
    };
    const VectorOf<Real> normal{fromFirst(0), fromFirst(1), fromFirst(2)};
    s.view = frame.orthographic ? VectorOf<Real>{0, 0, 1}
                                : unit<Real>({-s.position.x, -s.position.y, -s.position.z});
    const VectorOf<Real> e1{p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]},
        e2{p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]};
    const VectorOf<Real> face = crossed(e1, e2);
    const Real seen = dot(face, s.view), outward = dot(face, normal);
    const VectorOf<Real> interpolated = unit(normal);
    s.side = frame.baked ? Real(1.0) : std::copysign(Real(1.0), seen) * std::copysign(Real(1.0), outward);
    s.normal = scaled(interpolated, s.side);
    s.lifted = liftedFrom<Real>(s, frame.baked != 0, interpolated, p, n, {b0, b1, b2});
    s.horizon = s.normal;
    s.cosView = std::fmax(dot(s.normal, s.view), Real(1e-6f));
    if (!world.uv.empty()) {
        const auto t = corners(world.uv, 2);
        s.u = mixed(b0, t[0][0], b1, t[1][0], b2, t[2][0]);
        s.v = mixed(b0, t[0][1], b1, t[1][1], b2, t[2][1]);
        // Along the screen's rows and columns: slopes of the undivided barycentrics and of their sum.
        std::array<Real, 3> alongX{0, e2.y, -e1.y}, alongY{0, -e2.x, e1.x};
        if (!frame.orthographic) {
            const auto& o = p[0];
            alongX = {std::fma(e1.z, e2.y, -(e2.z * e1.y)), std::fma(e2.z, o[1], -(o[2] * e2.y)),
                      std::fma(o[2], e1.y, -(e1.z * o[1]))};
            alongY = {std::fma(e1.x, e2.z, -(e2.x * e1.z)), std::fma(o[2], e2.x, -(e2.z * o[0])),
                      std::fma(e1.z, o[0], -(o[2] * e1.x))};
        }
        const auto change = [&](const std::array<Real, 3>& slope, Real value, size_t axis) {
            const Real own =
                std::fma(slope[2], t[2][axis] - t[0][axis], slope[1] * (t[1][axis] - t[0][axis]));
            return std::fma(-(value - t[0][axis]), slope[0], own) * (inv * (256 * frame.slope_per_subpixel));
        };
        s.ux = change(alongX, s.u, 0), s.vx = change(alongX, s.v, 1);
        s.uy = change(alongY, s.u, 0), s.vy = change(alongY, s.v, 1);
        if (frame.baked) {
            s.ux = Real(1.0) / static_cast<Real>(frame.width),
            s.vy = Real(1.0) / static_cast<Real>(frame.height);
            s.vx = s.uy = 0;
        }
    }
    if (!world.tangent.empty()) {
        const auto t = corners(vertices.tangent, 3);
        orient<Real>(
            s, {mixed(b0, t[0][0], b1, t[1][0], b2, t[2][0]), mixed(b0, t[0][1], b1, t[1][1], b2, t[2][1]),
                mixed(b0, t[0][2], b1, t[1][2], b2, t[2][2])});
    }
    return s;
}

}  // namespace spectrad::scalar
