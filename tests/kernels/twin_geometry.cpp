#include "kernels/twin.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>

namespace spectrad::twin {

namespace {

struct Corner {
    double x, y, reach, depth;
    const sd_vertex* vertex = nullptr;  // whose corner it is; none where an edge was cut
};

double insideOf(int p, const Corner& c) {
    switch (p) {
        case 0:
            return c.depth - static_cast<double>(SD_NEAR);
        case 1:
            return std::fma(double{SD_GUARD}, c.reach, c.x);
        case 2:
            return std::fma(double{SD_GUARD}, c.reach, -c.x);
        case 3:
            return std::fma(double{SD_GUARD}, c.reach, c.y);
        default:
            return std::fma(double{SD_GUARD}, c.reach, -c.y);
    }
}

Corner cut(const Corner& in, double dIn, const Corner& out, double dOut) {
    const double t = dIn / (dIn - dOut);
    return {std::fma(t, out.x - in.x, in.x), std::fma(t, out.y - in.y, in.y),
            std::fma(t, out.reach - in.reach, in.reach), std::fma(t, out.depth - in.depth, in.depth),
            nullptr};
}

std::vector<Corner> clipped(std::vector<Corner> polygon) {
    for (int plane = 0; plane < 5; ++plane) {
        std::vector<Corner> kept;
        for (size_t k = 0; k < polygon.size(); ++k) {
            const Corner &here = polygon[k], &there = polygon[(k + 1) % polygon.size()];
            const double a = insideOf(plane, here), b = insideOf(plane, there);
            if (a >= 0) kept.push_back(here);
            if (a >= 0 && b < 0) kept.push_back(cut(here, a, there, b));
            if (a < 0 && b >= 0) kept.push_back(cut(there, b, here, a));
        }
        polygon = kept;
    }
    return polygon;
}

int bias(int a, int b) {
    return (a > 0 || (a == 0 && b > 0)) ? 0 : -1;
}

struct Painter {
    const sd_frame& frame;
    const LanePattern& lanes;
    std::vector<std::uint64_t>& keys;

    void put(int row, int col, size_t slot, float key, std::uint32_t id) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(key);
        const std::uint64_t word = (std::uint64_t{frame.orthographic ? bits : ~bits} << 32) | id;
        std::uint64_t& cell =
            keys[(static_cast<size_t>(row) * static_cast<size_t>(frame.pitch) + static_cast<size_t>(col)) *
                     lanes.slotX.size() +
                 slot];
        cell = std::min(cell, word);
    }

    template <typename Test>
    void samples(int left, int right, int top, int bottom, Test test) {
        const int halfW = frame.width * 128, halfH = frame.height * 128;
        for (int row = std::max(0, (top + halfH) >> 8);
             row <= std::min(frame.height - 1, (bottom + halfH) >> 8); ++row)
            for (int col = std::max(0, (left + halfW) >> 8);
                 col <= std::min(frame.width - 1, (right + halfW) >> 8); ++col)
                for (size_t slot = 0; slot < lanes.slotX.size(); ++slot)
                    test(row, col, slot, col * 256 - halfW + lanes.slotX[slot],
                         row * 256 - halfH + lanes.slotY[slot]);
    }

    void paint(std::array<int, 3> x, std::array<int, 3> y, std::array<float, 3> q, std::uint32_t id,
               bool alwaysLarge) {
        const std::int64_t area =
            std::int64_t{x[1] - x[0]} * (y[2] - y[0]) - std::int64_t{x[2] - x[0]} * (y[1] - y[0]);
        if (area == 0) return;
        if (area < 0) {
            std::swap(x[1], x[2]);
            std::swap(y[1], y[2]);
            std::swap(q[1], q[2]);
        }
        const auto [left, right] = std::minmax({x[0], x[1], x[2]});
        const auto [top, bottom] = std::minmax({y[0], y[1], y[2]});
        const auto [low, high] = std::minmax({q[0], q[1], q[2]});
        const bool large = alwaysLarge || right - left >= SD_SMALL * 256 || bottom - top >= SD_SMALL * 256;
        const double invArea = 1.0 / static_cast<double>(area < 0 ? -area : area);
        const double d1 = double{q[1]} - q[0], d2 = double{q[2]} - q[0];
        const double qx = (d1 * (y[2] - y[0]) - d2 * (y[1] - y[0])) * invArea;
        const double qy = (d2 * (x[1] - x[0]) - d1 * (x[2] - x[0])) * invArea;
        const float invAreaFloat = 1.0f / static_cast<float>(area < 0 ? -area : area);
        samples(left, right, top, bottom,
                [&, lo = low, hi = high](int row, int col, size_t slot, int sx, int sy) {
                    std::array<std::int64_t, 3> e{};
                    for (size_t k = 0; k < 3; ++k) {
                        const size_t n = (k + 1) % 3;
                        const int a = y[k] - y[n], b = x[n] - x[k];
                        e[k] = std::int64_t{a} * (sx - x[k]) + std::int64_t{b} * (sy - y[k]);
                        if (e[k] + bias(a, b) < 0) return;
                    }
                    float key = 0;
                    if (large) {
                        key = static_cast<float>(
                            std::fma(qx, static_cast<double>(sx - x[0]),
                                     std::fma(qy, static_cast<double>(sy - y[0]), double{q[0]})));
                    } else {
                        // Edge 1 -> 2 is opposite corner 0, and so on.
                        key = std::fma(
                                  static_cast<float>(e[0]), q[2],
                                  std::fma(static_cast<float>(e[2]), q[1], static_cast<float>(e[1]) * q[0])) *
                              invAreaFloat;
                    }
                    put(row, col, slot, std::clamp(key, lo, hi), id);
                });
    }
};

}  // namespace

std::vector<std::uint64_t> cover(const World& world, const Vertices& vertices, const sd_frame& frame,
                                 const LanePattern& lanes) {
    std::vector<std::uint64_t> keys(
        static_cast<size_t>(frame.rows) * static_cast<size_t>(frame.pitch) * lanes.slotX.size(),
        ~std::uint64_t{0});
    Painter painter{frame, lanes, keys};
    for (std::uint32_t id = 0; id < world.index.size() / 3; ++id) {
        std::array<sd_vertex, 3> v{};
        for (size_t k = 0; k < 3; ++k)
            v[k] = vertices.screen[world.index[3 * id + k]];
        if (v[0].outside & v[1].outside & v[2].outside) continue;
        if (!(v[0].outside | v[1].outside | v[2].outside)) {
            painter.paint({v[0].x, v[1].x, v[2].x}, {v[0].y, v[1].y, v[2].y},
                          {v[0].depth_key, v[1].depth_key, v[2].depth_key}, id, false);
            continue;
        }
        std::vector<Corner> polygon;
        for (size_t k = 0; k < 3; ++k) {
            const float* p = vertices.camera.data() + 3 * size_t{world.index[3 * id + k]};
            const double depth = -static_cast<double>(p[2]);
            polygon.push_back({p[0] * frame.pixels_per_slope, -p[1] * frame.pixels_per_slope,
                               frame.orthographic ? 1.0 : depth, depth,
                               &vertices.screen[world.index[3 * id + k]]});
        }
        polygon = clipped(polygon);
        std::vector<int> x, y;
        std::vector<float> q;
        for (const Corner& c : polygon) {
            if (c.vertex && !c.vertex->outside) {
                x.push_back(c.vertex->x);
                y.push_back(c.vertex->y);
                q.push_back(c.vertex->depth_key);
                continue;
            }
            const double depth = std::max(c.depth, static_cast<double>(SD_NEAR)),
                         reach = frame.orthographic ? 1.0 : depth;
            constexpr double bound = SD_GUARD * SD_SUBPIXEL;
            x.push_back(
                static_cast<int>(std::clamp(std::nearbyint(c.x / reach * SD_SUBPIXEL), -bound, bound)));
            y.push_back(
                static_cast<int>(std::clamp(std::nearbyint(c.y / reach * SD_SUBPIXEL), -bound, bound)));
            q.push_back(frame.orthographic ? static_cast<float>(depth) : static_cast<float>(1.0 / depth));
        }
        for (size_t k = 2; k < x.size(); ++k)
            painter.paint({x[0], x[k - 1], x[k]}, {y[0], y[k - 1], y[k]}, {q[0], q[k - 1], q[k]}, id, true);
    }
    return keys;
}

}  // namespace spectrad::twin
