// What kernels/relief.h computes, scalar: normals bent by a texture.
#pragma once

#include "verify/scalar_surface.h"
#include "verify/scalar_texels.h"

namespace spectrad::scalar {

template <typename Real>
VectorOf<Real> mixed3(VectorOf<Real> a, Real x, VectorOf<Real> b, Real y) {
    return {std::fma(b.x, y, a.x * x), std::fma(b.y, y, a.y * x), std::fma(b.z, y, a.z * x)};
}

/// A normal map or a bump map on the surface.
template <typename Real, typename Stored>
void bend(SurfaceOf<Real>& s, const World& world, const VerticesOf<Stored>& vertices, std::uint32_t triangle,
          const sd_texture& t, Real samples, bool baked) {
    const auto corner = [&](const auto& of, size_t each, size_t k, size_t i) {
        return Real(of[each * size_t{world.index[3 * size_t{triangle} + k]} + i]);
    };
    const auto edge = [&](size_t k) {
        const auto along = [&](size_t i) {
            return corner(vertices.camera, 3, k, i) - corner(vertices.camera, 3, 0, i);
        };
        return VectorOf<Real>{along(0), along(1), along(2)};
    };
    const VectorOf<Real> e1 = edge(1), e2 = edge(2);
    std::array<Real, 3> u{}, v{};
    for (size_t k = 1; k < 3; ++k) {
        const Real a = corner(world.uv, 2, k, 0) - corner(world.uv, 2, 0, 0),
                   b = corner(world.uv, 2, k, 1) - corner(world.uv, 2, 0, 1);
        u[k] = std::fma(Real(t.place[0]), a, t.place[1] * b);
        v[k] = std::fma(Real(t.place[3]), a, t.place[4] * b);
    }
    const Real area = std::fma(u[1], v[2], -(u[2] * v[1])), turn = std::copysign(Real(1.0), area);
    const auto alongU = mixed3(e1, v[2] * turn, e2, -v[1] * turn),
               alongV = mixed3(e2, u[1] * turn, e1, -u[2] * turn);
    const auto band = [&](int i) { return texel(world, t, s, samples, i); };
    const VectorOf<Real> outward = scaled(s.normal, s.side);
    VectorOf<Real> bent{};
    if (t.bands == 3) {
        const auto right = unit(mixed3(alongU, Real(1.0), outward, -dot(outward, alongU)));
        auto up = crossed(outward, right);
        up = scaled(up, std::copysign(Real(1.0), dot(up, alongV)));
        bent = mixed3(mixed3(right, band(0), up, band(1)), Real(1.0), outward, band(2));
    } else {
        const auto slope = mixed3(crossed(alongV, outward), band(0), crossed(outward, alongU), band(1));
        const Real volume = dot(outward, crossed(alongU, alongV));
        const Real per = std::fabs(area) / (volume == 0 ? Real(1.0) : volume);
        bent = mixed3(outward, Real(1.0), slope, volume == 0 ? -Real(0.0) : -per);
    }
    if (dot(bent, bent) == 0) bent = outward;
    bent = scaled(unit(bent), s.side);
    if (!baked) bent = unit(mixed3(bent, Real(1.0), s.view, -std::fmin(dot(bent, s.view), Real(0.0))));
    s.normal = bent;
    s.cosView = std::fmax(dot(bent, s.view), Real(1e-6f));
    if (!world.tangent.empty()) orient(s, s.tangent);
}

}  // namespace spectrad::scalar
