// Vertices before the camera and on the screen, scalar: what kernels/transform.cl computes.
#pragma once

#include "render/plan.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace spectrad::scalar {

inline constexpr std::uint32_t noTriangle = 0xffffffff;

template <typename Real>
struct VerticesOf {
    std::vector<Real> camera, normal, tangent;  ///< three a vertex
    std::vector<sd_vertex> screen;
};

/// The frame that the renderer makes for a plan, whole image as one strip.
inline sd_frame frameOf(const Plan& plan) {
    sd_frame frame{};
    frame.pixels_per_slope = plan.view.pixelsPerSlope;
    frame.slope_per_subpixel = static_cast<float>(1 / (SD_SUBPIXEL * plan.view.pixelsPerSlope));
    frame.orthographic = plan.view.orthographic;
    frame.baked = plan.view.baked;
    const Affine toWorld = inverse(plan.view.worldToCamera);
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column)
            frame.to_world[3 * row + column] = static_cast<float>(toWorld.m[4 * row + column]);
    frame.width = plan.view.width;
    frame.height = plan.view.height;
    frame.pitch = (frame.width + SD_BLOCK - 1) / SD_BLOCK * SD_BLOCK;
    frame.rows = frame.height;
    frame.samples = plan.samples;
    return frame;
}

/// As kernels/transform.cl, kept as Real: positions and places on the screen are computed in double there
/// too.
template <typename Real>
VerticesOf<Real> transform(const World& world, const sd_frame& frame) {
    VerticesOf<Real> out;
    for (size_t v = 0; v < world.vertexDraw.size(); ++v) {
        const sd_draw& d = world.draws[world.vertexDraw[v]];
        const double px = world.position[3 * v], py = world.position[3 * v + 1],
                     pz = world.position[3 * v + 2];
        std::array<double, 3> p{};
        for (size_t row = 0; row < 3; ++row) {
            const double* m = d.to_camera + 4 * row;
            p[row] = std::fma(m[0], px, std::fma(m[1], py, std::fma(m[2], pz, m[3])));
            out.camera.push_back(static_cast<Real>(p[row]));
            const float* n = d.normal + 3 * row;
            out.normal.push_back(std::fma(Real(n[0]), Real(world.normal[3 * v]),
                                          std::fma(Real(n[1]), Real(world.normal[3 * v + 1]),
                                                   Real(n[2]) * Real(world.normal[3 * v + 2]))));
        }
        if (!world.tangent.empty()) {
            const double tx = world.tangent[3 * v], ty = world.tangent[3 * v + 1],
                         tz = world.tangent[3 * v + 2];
            for (size_t row = 0; row < 3; ++row) {
                const double* m = d.to_camera + 4 * row;
                out.tangent.push_back(static_cast<Real>(std::fma(m[0], tx, std::fma(m[1], ty, m[2] * tz))));
            }
        }
        const bool flat = frame.orthographic || frame.baked;
        const double depth = frame.baked ? 1.0 : -p[2], reach = flat ? 1.0 : depth;
        const double sx = frame.baked ? (double{world.uv[2 * v]} - 0.5) * frame.width
                                      : p[0] * frame.pixels_per_slope,
                     sy = frame.baked ? (0.5 - double{world.uv[2 * v + 1]}) * frame.height
                                      : -p[1] * frame.pixels_per_slope,
                     guard = SD_GUARD * reach;
        sd_vertex s{};
        s.outside = (depth < static_cast<double>(SD_NEAR) ? SD_OUT_NEAR : 0) |
                    (sx < -guard ? SD_OUT_LEFT : 0) | (sx > guard ? SD_OUT_RIGHT : 0) |
                    (sy < -guard ? SD_OUT_TOP : 0) | (sy > guard ? SD_OUT_BOTTOM : 0);
        if (!s.outside) {
            s.x = static_cast<int>(std::nearbyint(sx / reach * SD_SUBPIXEL));
            s.y = static_cast<int>(std::nearbyint(sy / reach * SD_SUBPIXEL));
            s.depth_key = frame.orthographic ? static_cast<float>(depth) : static_cast<float>(1.0 / depth);
        }
        out.screen.push_back(s);
    }
    return out;
}

}  // namespace spectrad::scalar
