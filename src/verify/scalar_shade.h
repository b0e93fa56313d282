// What kernels/light.cl computes, scalar: the geometry factors of one sample, in float (the kernels' twin) or
// in double (the reference).
#pragma once

#include "render/plan.h"
#include "verify/scalar_relief.h"
#include "verify/scalar_shadow.h"
#include "verify/scalar_surface.h"
#include "verify/scalar_texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace spectrad::scalar {

template <typename Real>
constexpr Real inversePi = Real(0.31830988618379067);

template <typename Real>
struct CellOf {
    int cell;
    Real t;
};
template <typename Real>
CellOf<Real> cellOf(Real cosine) {
    const Real at = std::sqrt(std::clamp(cosine, Real(0.0), Real(1.0))) * static_cast<Real>(SD_CELLS);
    const int cell = std::min(static_cast<int>(at), SD_CELLS - 1);
    return {cell, at - static_cast<Real>(cell)};
}
template <typename Real>
Real lookUp(const sd_piece* table, CellOf<Real> at) {
    const float* c = table[at.cell].c;
    return std::fma(at.t, std::fma(at.t, std::fma(at.t, c[3], c[2]), c[1]), c[0]);
}

template <typename Real>
VectorOf<Real> localOf(const SurfaceOf<Real>& s, VectorOf<Real> d) {
    return {dot(s.tangent, d), dot(s.bitangent, d), dot(s.normal, d)};
}
template <typename Real>
Real azimuthOf(const sd_lobe& lobe, VectorOf<Real> d) {
    const Real u = lobe.alpha, v = lobe.alpha_v, low = std::fmin(u, v), high = std::fmax(u, v);
    const Real shift = Real(0.15f) * high, most = Real(1.0) / (low + shift),
               least = Real(1.0) / (high + shift);
    const Real u2 = d.x * d.x, v2 = d.y * d.y, across = u2 + v2;
    const Real square = std::fma(v2, v * v, u2 * (u * u));
    const Real width = std::sqrt(square / (across == Real(0.0) ? Real(1.0) : across));
    const Real x = (Real(2.0) / (width + shift) - (most + least)) / (most - least);
    return std::fmin(std::fmax(x, -Real(1.0)), Real(1.0));
}
/// A function of a direction: a table, or where the lobe is not the same all round a polynomial of tables.
template <typename Real>
Real lookUp(const sd_lobe& lobe, const sd_piece* table, CellOf<Real> at, Real azimuth) {
    if (lobe.alpha_v == 0) return lookUp(table, at);
    Real sum = lookUp(table + (SD_AZIMUTHS - 1) * SD_CELLS, at);
    for (int k = SD_AZIMUTHS - 2; k >= 0; --k)
        sum = std::fma(sum, azimuth, lookUp(table + k * SD_CELLS, at));
    return sum;
}
/// The lobe's first function.
template <typename Real>
Real firstAt(const sd_lobe& lobe, const sd_piece* table, const SurfaceOf<Real>& s, VectorOf<Real> direction,
             Real cosine) {
    if (lobe.alpha_v == 0) return lookUp(table, cellOf(cosine));
    return std::fmax(lookUp(lobe, table, cellOf(cosine), azimuthOf(lobe, localOf(s, direction))), Real(0.0));
}

/// A direction below a coat, and its tables.
template <typename Real>
struct BelowOf {
    Real cosine, missing, back;
};
template <typename Real>
BelowOf<Real> belowCoat(const sd_lobe& lobe, const sd_piece* table, Real cosine) {
    const sd_piece* own = table + (lobe.alpha_v == 0 ? 1 : SD_AZIMUTHS) * SD_CELLS;
    return {std::sqrt(std::fma(Real(lobe.inv_n2), std::fma(cosine, cosine, -Real(1.0)), Real(1.0))),
            lookUp(own, cellOf(cosine)), lookUp(own + SD_CELLS, cellOf(cosine))};
}

template <typename Real>
Real arriving(const sd_light& light, VectorOf<Real> position, VectorOf<Real>& toLight) {
    if (light.type == SD_LIGHT_DIRECTIONAL) {
        toLight = {light.x, light.y, light.z};
        return light.scale;
    }
    const VectorOf<Real> d{light.x - position.x, light.y - position.y, light.z - position.z};
    const Real square = dot(d, d);
    const Real inv = Real(1.0) / (square == Real(0.0) ? Real(1.0) : square);
    toLight = scaled(d, std::sqrt(inv));
    Real strength = light.scale * inv;
    if (light.type == SD_LIGHT_SPOT) {
        const VectorOf<Real> apart{light.axis_x + toLight.x, light.axis_y + toLight.y,
                                   light.axis_z + toLight.z};
        const Real t =
            std::clamp((light.chord_outer - dot(apart, apart)) * light.inv_chord_range, Real(0.0), Real(1.0));
        strength = strength * (t * t * std::fma(-Real(2.0), t, Real(3.0)));
    }
    return square == Real(0.0) ? Real(0.0) : strength;
}

template <typename Real>
SurfaceOf<Real> byPixel(SurfaceOf<Real> s, const sd_frame& frame) {
    s.u = s.x / static_cast<Real>(frame.width * SD_SUBPIXEL) + Real(0.5);
    s.v = Real(0.5) - s.y / static_cast<Real>(frame.height * SD_SUBPIXEL);
    return s;
}

template <typename Real>
SurfaceOf<Real> byDirection(SurfaceOf<Real> s, VectorOf<Real> d, const sd_frame& frame, int side) {
    std::array<Real, 3> w{};
    for (size_t row = 0; row < 3; ++row)
        w[row] = std::fma(d.z, Real(frame.to_world[3 * row + 2]),
                          std::fma(d.y, Real(frame.to_world[3 * row + 1]), d.x * frame.to_world[3 * row]));
    const Real ax = std::fabs(w[0]), ay = std::fabs(w[1]), az = std::fabs(w[2]);
    const size_t axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    const bool below = w[axis] < 0;
    const Real right = axis == 0 ? (below ? -w[2] : w[2]) : axis == 1 ? w[0] : below ? w[0] : -w[0];
    const Real up = axis != 1 ? w[1] : below ? -w[2] : w[2];
    const Real size = std::fabs(w[axis]);
    const Real halfBySize = Real(0.5) / (size == 0 ? Real(1.0) : size);
    const Real border = Real(0.5) / static_cast<Real>(side);
    const Real face = static_cast<Real>(2 * axis) + (below ? Real(1.0) : Real(0.0));
    const Real down = std::clamp(Real(0.5) - up * halfBySize, border, Real(1.0) - border);
    s.u = std::clamp(std::fma(right, halfBySize, Real(0.5)), border, Real(1.0) - border);
    s.v = Real(1.0) - (face + down) * Real(1.0f / 6.0f);
    return s;
}

/// Where the image behind everything is looked up.
template <typename Real>
SurfaceOf<Real> backdropAt(const World& world, const sd_lobe& lobe, const sd_frame& frame, Real x, Real y) {
    SurfaceOf<Real> s{};
    s.x = x, s.y = y;
    if (lobe.mapping != SD_MAP_CUBE) return byPixel(s, frame);
    VectorOf<Real> ray{0, 0, -1};
    if (!frame.orthographic) ray.x = x * frame.slope_per_subpixel, ray.y = -(y * frame.slope_per_subpixel);
    return byDirection(s, ray, frame, world.textures[lobe.texture - 1].width);
}

template <typename Real>
SurfaceOf<Real> mirroredAt(const World& world, const sd_lobe& lobe, const sd_frame& frame,
                           const SurfaceOf<Real>& s) {
    if (lobe.mapping != SD_MAP_CUBE) return byPixel(s, frame);
    const Real twice = Real(2.0) * dot(s.normal, s.view);
    const VectorOf<Real> d{std::fma(twice, s.normal.x, -s.view.x), std::fma(twice, s.normal.y, -s.view.y),
                           std::fma(twice, s.normal.z, -s.view.z)};
    return byDirection(s, d, frame, world.textures[lobe.texture - 1].width);
}

/// Textures of more bands are read by vectors of bands, which adds a pixel's samples up one after another
/// instead of pairwise (kernels/texture.h).
inline bool isWide(const sd_texture& t) {
    return t.bands > 16;
}

/// Of each light whether something stands between it and the surface; none where no light throws shadows.
template <typename Real>
std::vector<bool> hiddenLights(const World& world, const OccludersOf<Real>& occluders,
                               const SurfaceOf<Real>& s) {
    std::vector<bool> hidden;
    if (!throwShadows(world.lights)) return hidden;
    for (const sd_light& light : world.lights) {
        VectorOf<Real> toLight{};
        hidden.push_back(light.shadows && arriving(light, s.position, toLight) > 0 &&
                         dot(s.normal, toLight) > 0 && occluders.hides(light, s.lifted));
    }
    return hidden;
}

/// Calls add(call, term, g, wide) for everything that lobes and lights add to one sample; `call` orders the
/// additions, `wide` says that a texture wider than vectors is one of the factors.
template <typename Real, typename Add>
void shade(const Plan& plan, const OccludersOf<Real>& occluders, const sd_frame& frame,
           const sd_material& material, const SurfaceOf<Real>& s, const Add& add) {
    const World& world = plan.world;
    const std::vector<bool> hidden = hiddenLights(world, occluders, s);
    const std::uint32_t groups = plan.groups;
    size_t call = 0;
    for (std::uint32_t l = 0; l < material.lobes; ++l) {
        const sd_lobe& lobe = world.lobes[material.first_lobe + l];
        constexpr size_t callsALight = 1 << 20;
        const auto samples = static_cast<Real>(plan.samples);
        const auto leftBy = [](Real inside, Real rho) {
            return rho * (Real(1.0) - inside) / std::fma(-rho, inside, Real(1.0));
        };
        /// Terms of a painted lobe from `term` on; returns how many blocks of light groups they are.
        const auto paintedAt = [&](const SurfaceOf<Real>& at, size_t base, std::uint32_t term, Real g,
                                   int steps, Real inside, Real second, std::uint32_t stride) {
            const sd_texture& t = world.textures[lobe.texture - 1];
            std::uint32_t block = 0;
            for (int band = 0; band < t.bands; ++band) {
                const Real here = texel(world, t, at, samples, band),
                           next = band + 1 < t.bands ? texel(world, t, at, samples, band + 1) : here;
                for (int k = 0; k < (band + 1 < t.bands ? steps : 1); ++k, ++block) {
                    const Real rho =
                        k == 0 ? here
                               : std::fma(static_cast<Real>(k) / static_cast<Real>(steps), next - here, here);
                    Real left = rho;
                    if (inside != 0) left = leftBy(inside, rho);
                    if (inside != 0 && second >= 0) left *= leftBy(second, rho);
                    add(base + block, term + block * stride, g * left, isWide(t));
                }
            }
            return block;
        };
        const auto paint = [&](size_t base, std::uint32_t term, Real g, std::uint32_t stride) {
            if (lobe.strength != 0) g = g * texel(world, world.textures[lobe.strength - 1], s, samples, 0);
            if (lobe.texture == 0)
                add(base, term, g, false);
            else
                paintedAt(s, base, term, g, lobe.steps, lobe.inside, Real(-1.0), stride);
        };
        /// One part of a rough lobe; moves on to the next part's terms.
        const auto paintPart = [&](size_t& at, std::uint32_t& term, Real g, int steps, Real inside,
                                   Real second) {
            std::uint32_t blocks = 1;
            if (lobe.texture == 0)
                add(at, term, g, false);
            else
                blocks = paintedAt(s, at, term, g, steps, inside, second, groups);
            at += blocks;
            term += blocks * groups;
        };
        const auto paintRough = [&](size_t at, std::uint32_t term, Real single, Real multiple,
                                    std::optional<Real> rest) {
            paintPart(at, term, single, 1, 0, 0);
            paintPart(at, term, multiple, lobe.steps, lobe.inside, 0);
            if (rest) paintPart(at, term, *rest, lobe.steps, lobe.inside_rest, lobe.second_rest);
        };
        if (lobe.type == SD_LOBE_REFLECTION) {
            const auto bands = static_cast<std::uint32_t>(world.textures[lobe.texture - 1].bands);
            for (std::uint32_t f = 0; f < lobe.functions; ++f)
                paintedAt(mirroredAt(world, lobe, frame, s), call + f * bands, lobe.term + f * bands,
                          lookUp(world.tables.data() + lobe.table + f * SD_CELLS, cellOf(s.cosView)), 1, 0,
                          Real(-1.0), 1);
            call += callsALight;
            continue;
        }
        if (lobe.type == SD_LOBE_EMISSION) {
            paint(call, lobe.term, Real(1.0), 1);
            call += callsALight;
            continue;
        }
        const sd_piece* table = world.tables.data() + lobe.table;
        const CellOf<Real> viewCell = cellOf(s.cosView);
        const Real first =
            lobe.type == SD_LOBE_DIFFUSE ? Real(0.0) : firstAt(lobe, table, s, s.view, s.cosView);
        const Real azimuth = lobe.alpha_v == 0 ? Real(0.0) : azimuthOf(lobe, localOf(s, s.view));
        const std::uint32_t each = lobe.alpha_v == 0 ? 1 : SD_AZIMUTHS;  // tables of a function
        for (size_t k = 0; k < world.lights.size(); ++k) {
            const sd_light& light = world.lights[k];
            const size_t base = call;
            call += callsALight;
            if (!hidden.empty() && hidden[k]) continue;
            const std::uint32_t term = lobe.term + light.group;
            if (light.type == SD_LIGHT_AMBIENT || light.type == SD_LIGHT_SURROUNDINGS) {
                if (light.type == SD_LIGHT_SURROUNDINGS && !(lobe.type == SD_LOBE_FACETS && lobe.alpha == 0))
                    continue;
                if (lobe.type == SD_LOBE_DIFFUSE) paint(base, term, light.scale, groups);
                if (lobe.type == SD_LOBE_ROUGH)
                    paintRough(base, term, light.scale * (Real(1.0) - first), light.scale * first, {});
                if (lobe.type == SD_LOBE_ROUGH_COATED) {
                    const BelowOf<Real> view = belowCoat(lobe, table, s.cosView);
                    const Real through = light.scale * first, multiple = view.missing * lobe.escape;
                    paintRough(base, term, through * std::fmax(Real(1.0) - view.back - multiple, Real(0.0)),
                               through * multiple, through * view.back);
                }
                if (lobe.type == SD_LOBE_COATED)
                    paint(base, term, light.scale * first * lobe.mean_through, groups);
                if (lobe.type == SD_LOBE_FACETS) {
                    for (std::uint32_t f = 0; f < lobe.functions; ++f)
                        add(base + f, term + f * groups,
                            light.scale * inversePi<Real> *
                                lookUp(lobe, table + (1 + f) * each * SD_CELLS, viewCell, azimuth),
                            false);
                    if (lobe.multiple_to == lobe.functions)
                        add(base + lobe.functions, term + lobe.functions * groups,
                            light.scale * inversePi<Real> * first, false);
                }
                continue;
            }
            VectorOf<Real> toLight{};
            const Real strength = arriving(light, s.position, toLight);
            const Real cosLight = dot(s.normal, toLight);
            if (!(cosLight > 0) || !(dot(s.horizon, toLight) > 0)) continue;
            const Real irradiance = strength * cosLight;
            if (lobe.type == SD_LOBE_DIFFUSE) paint(base, term, irradiance, groups);
            if (lobe.type == SD_LOBE_COATED)
                paint(base, term,
                      irradiance * (first * firstAt(lobe, world.tables.data() + lobe.table_light, s, toLight,
                                                    cosLight)),
                      groups);
            if (lobe.type == SD_LOBE_ROUGH) {
                const Real beyond = std::fma(-cosLight, s.cosView, dot(toLight, s.view));
                const Real divisor = beyond > 0 ? std::fmax(cosLight, s.cosView) : Real(1.0);
                const Real single = lobe.mean_through * std::fma(lobe.alpha, beyond / divisor, Real(1.0));
                paintRough(base, term, irradiance * single,
                           irradiance * (first * lookUp(table, cellOf(cosLight)) * lobe.multiple), {});
            }
            if (lobe.type == SD_LOBE_ROUGH_COATED) {
                const BelowOf<Real> view = belowCoat(lobe, table, s.cosView),
                                    below = belowCoat(lobe, table, cosLight);
                const Real beyond = std::fma(-cosLight, s.cosView, dot(toLight, s.view)) * lobe.inv_n2;
                const Real divisor = beyond > 0 ? std::fmax(below.cosine, view.cosine) : Real(1.0);
                const Real through =
                    irradiance * (first * firstAt(lobe, table, s, toLight, cosLight)) * lobe.inv_n2;
                const Real single = lobe.mean_through * std::fma(lobe.ratio, beyond / divisor, Real(1.0));
                paintRough(base, term, through * single,
                           through * (view.missing * below.missing * lobe.multiple),
                           through * (view.back * below.back * lobe.rest));
            }
            if (lobe.type == SD_LOBE_FACETS && lobe.alpha != 0) {
                const VectorOf<Real> h =
                    unit<Real>({toLight.x + s.view.x, toLight.y + s.view.y, toLight.z + s.view.z});
                const Real cosHalf = dot(s.normal, h),
                           cosDiff = std::clamp(dot(s.view, h), Real(0.0), Real(1.0));
                const VectorOf<Real> across = crossed(s.normal, h);
                Real a2 = Real(lobe.alpha) * lobe.alpha;
                Real width = std::fma(cosHalf * cosHalf, a2, dot(across, across));
                Real shadowView = cosLight * std::sqrt(std::fma(s.cosView * s.cosView, Real(1.0) - a2, a2));
                Real shadowLight = s.cosView * std::sqrt(std::fma(cosLight * cosLight, Real(1.0) - a2, a2));
                if (lobe.alpha_v != 0) {
                    const VectorOf<Real> l3 = localOf(s, toLight), v3 = localOf(s, s.view), m = localOf(s, h);
                    const Real u2 = a2, v2 = Real(lobe.alpha_v) * lobe.alpha_v,
                               flat = Real(lobe.alpha_v) / lobe.alpha;
                    a2 = Real(lobe.alpha) * lobe.alpha_v;
                    width = std::fma(m.x * m.x, flat,
                                     std::fma(m.y * m.y, Real(1.0) / flat, cosHalf * cosHalf * a2));
                    shadowView =
                        cosLight * std::sqrt(std::fma(v3.x * v3.x, u2,
                                                      std::fma(v3.y * v3.y, v2, s.cosView * s.cosView)));
                    shadowLight =
                        s.cosView *
                        std::sqrt(std::fma(l3.x * l3.x, u2, std::fma(l3.y * l3.y, v2, cosLight * cosLight)));
                }
                const Real shape = (a2 / width) * (inversePi<Real> / width) * Real(0.5) /
                                   (shadowView + shadowLight) * irradiance;
                const Real multiple =
                    first * firstAt(lobe, table, s, toLight, cosLight) * lobe.multiple * irradiance;
                const CellOf<Real> facing = cellOf(cosDiff);
                for (std::uint32_t f = 0; f < lobe.functions; ++f) {
                    Real g = shape * lookUp(table + ((1 + lobe.functions) * each + f) * SD_CELLS, facing);
                    if (f == lobe.multiple_to) g += multiple;
                    add(base + f, term + f * groups, g, false);
                }
                if (lobe.multiple_to == lobe.functions)
                    add(base + lobe.functions, term + lobe.functions * groups, multiple, false);
            }
        }
    }
}

/// The same where a sample sees no surface: the background, plain or a picture.
template <typename Real, typename Add>
void shadeBackdrop(const Plan& plan, const sd_frame& frame, const sd_material& material, Real x, Real y,
                   const Add& add) {
    if (material.terms == 0) return;
    const sd_lobe& behind = plan.world.lobes[material.first_lobe];
    if (behind.texture == 0) {
        add(0, 0, Real(1.0), false);
        return;
    }
    const sd_texture& t = plan.world.textures[behind.texture - 1];
    const auto at = backdropAt<Real>(plan.world, behind, frame, x, y);
    for (int band = 0; band < t.bands; ++band)
        add(static_cast<size_t>(band), static_cast<std::uint32_t>(band),
            texel(plan.world, t, at, static_cast<Real>(plan.samples), band), isWide(t));
}

/// All that a sample adds which sees this triangle, or none. x, y: SD_SUBPIXEL-ths of a pixel from the
/// image's centre.
template <typename Real, typename Stored, typename Add>
void shadeSample(const Plan& plan, const VerticesOf<Stored>& vertices, const OccludersOf<Real>& occluders,
                 const sd_frame& frame, const sd_material& material, std::uint32_t triangle, Real x, Real y,
                 const Add& add) {
    if (triangle == noTriangle) {
        shadeBackdrop<Real>(plan, frame, material, x, y, add);
        return;
    }
    auto surface = surfaceAt<Real>(plan.world, vertices, frame, triangle, x, y);
    if (material.relief != 0)
        bend<Real>(surface, plan.world, vertices, triangle, plan.world.textures[material.relief - 1],
                   static_cast<Real>(plan.samples), frame.baked != 0);
    shade<Real>(plan, occluders, frame, material, surface, add);
}

}  // namespace spectrad::scalar
