// What kernels/texels.h computes, scalar: taps, filters and pyramids in the kernels' arithmetic.
#pragma once

#include "render/world.h"

#include <algorithm>
#include <cmath>

namespace spectrad::scalar {

/// One band of one level of a texture at the surface's coordinates.
template <typename Real, typename Surface>
Real levelTexel(const World& world, const sd_texture& t, const Surface& s, int level, int band) {
    Real u = std::fma(t.place[0], s.u, std::fma(t.place[1], s.v, Real(t.place[2]))),
         v = std::fma(t.place[3], s.u, std::fma(t.place[4], s.v, Real(t.place[5])));
    const bool repeat = t.wrap == SD_REPEAT;
    if (repeat) u -= std::floor(u), v -= std::floor(v);
    size_t first = t.first;
    int width = t.width, height = t.height;
    for (int l = 0; l < level; ++l) {
        first += static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(t.bands);
        width = std::max(width / 2, 1);
        height = std::max(height / 2, 1);
    }
    const Real x = std::clamp(u, Real(0.0), Real(1.0)) * static_cast<Real>(width),
               y = (Real(1.0) - std::clamp(v, Real(0.0), Real(1.0))) * static_cast<Real>(height);
    const auto within = [repeat](int i, int count) {
        if (repeat) return i < 0 ? count - 1 : i >= count ? 0 : i;
        return std::clamp(i, 0, count - 1);
    };
    const auto at = [&](int column, int row) -> Real {
        return world
            .texels[first +
                    (static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column)) *
                        static_cast<size_t>(t.bands) +
                    static_cast<size_t>(band)];
    };
    if (t.filter == SD_NEAREST)
        return at(std::clamp(static_cast<int>(x), 0, width - 1),
                  std::clamp(static_cast<int>(y), 0, height - 1));
    const Real left = std::floor(x - Real(0.5)), top = std::floor(y - Real(0.5)),
               right = (x - Real(0.5)) - left, down = (y - Real(0.5)) - top;
    const int column0 = within(static_cast<int>(left), width),
              column1 = within(static_cast<int>(left) + 1, width),
              row0 = within(static_cast<int>(top), height), row1 = within(static_cast<int>(top) + 1, height);
    const Real a = std::fma(right, at(column1, row0) - at(column0, row0), at(column0, row0));
    const Real b = std::fma(right, at(column1, row1) - at(column0, row1), at(column0, row1));
    return std::fma(down, b - a, a);
}

/// One band of a texture at the surface's coordinates.
template <typename Real, typename Surface>
Real texel(const World& world, const sd_texture& t, const Surface& s, Real samples, int band) {
    if (t.levels <= 1) return levelTexel<Real>(world, t, s, 0, band);
    const Real w = static_cast<Real>(t.width), h = static_cast<Real>(t.height);
    const Real ax = std::fma(t.place[0], s.ux, t.place[1] * s.vx) * w,
               ay = std::fma(t.place[3], s.ux, t.place[4] * s.vx) * h,
               bx = std::fma(t.place[0], s.uy, t.place[1] * s.vy) * w,
               by = std::fma(t.place[3], s.uy, t.place[4] * s.vy) * h;
    const Real square = std::fmax(std::fma(ax, ax, ay * ay), std::fma(bx, bx, by * by)) / samples;
    const Real size = std::fmin(std::fmax(std::sqrt(square), Real(1.0)), Real(1048576.0));
    int exponent = 0;
    const Real mantissa = std::frexp(size, &exponent);  // 0.5 … 1
    int level = exponent - 1;
    Real fraction = 2 * mantissa - Real(1.0);
    if (level >= t.levels - 1) level = t.levels - 1, fraction = 0;
    const Real value = levelTexel<Real>(world, t, s, level, band);
    return std::fma(fraction, levelTexel<Real>(world, t, s, std::min(level + 1, t.levels - 1), band) - value,
                    value);
}

}  // namespace spectrad::scalar
