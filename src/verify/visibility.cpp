#include "verify/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spectrad {

namespace {

using Place = std::array<double, 3>;

Place difference(const Place& a, const Place& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Place crossed(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dotted(const Place& a, const Place& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A triangle before the camera: what its plane's depth is along a ray.
class Triangle {
  public:
    Triangle(const World& world, const scalar::VerticesOf<double>& vertices, const sd_frame& frame,
             std::uint32_t id)
        : orthographic_(frame.orthographic), slope_(1 / (SD_SUBPIXEL * frame.pixels_per_slope)) {
        for (size_t k = 0; k < 3; ++k) {
            const size_t v = world.index[3 * size_t{id} + k];
            std::copy_n(vertices.camera.data() + 3 * v, 3, corner_[k].data());
            screen_[k] = vertices.screen[v];
            nearness_[k] = orthographic_ ? corner_[k][2] : -1 / corner_[k][2];
        }
        normal_ = crossed(difference(corner_[1], corner_[0]), difference(corner_[2], corner_[0]));
        offset_ = dotted(normal_, corner_[0]);
        whole_ = !(screen_[0].outside | screen_[1].outside | screen_[2].outside);
        unseen_ = (screen_[0].outside & screen_[1].outside & screen_[2].outside) != 0;
        if (!whole_) return;
        const std::int64_t area = std::int64_t{screen_[1].x - screen_[0].x} * (screen_[2].y - screen_[0].y) -
                                  std::int64_t{screen_[2].x - screen_[0].x} * (screen_[1].y - screen_[0].y);
        unseen_ = area == 0;
        if (area < 0) std::swap(screen_[1], screen_[2]);
        least_ = std::min({nearness_[0], nearness_[1], nearness_[2]});
        most_ = std::max({nearness_[0], nearness_[1], nearness_[2]});
    }

    [[nodiscard]] bool unseen() const { return unseen_; }
    [[nodiscard]] bool whole() const { return whole_; }
    /// Rows and columns of pixels that it may touch: left, right, top, bottom.
    [[nodiscard]] std::array<int, 4> reach(const sd_frame& frame) const {
        if (!whole_) return {0, frame.width - 1, 0, frame.height - 1};
        const auto [left, right] = std::minmax({screen_[0].x, screen_[1].x, screen_[2].x});
        const auto [top, bottom] = std::minmax({screen_[0].y, screen_[1].y, screen_[2].y});
        const int halfW = frame.width * (SD_SUBPIXEL / 2), halfH = frame.height * (SD_SUBPIXEL / 2);
        return {(left + halfW) >> 8, (right + halfW) >> 8, (top + halfH) >> 8, (bottom + halfH) >> 8};
    }

    /// Larger is nearer: 1/depth (perspective) or −depth (orthographic); NaN where the sample misses it.
    /// x, y: SD_SUBPIXEL-ths of a pixel from the image's centre.
    [[nodiscard]] double nearnessAt(int x, int y) const {
        constexpr double missed = std::numeric_limits<double>::quiet_NaN();
        if (whole_ && !insideOnScreen(x, y)) return missed;
        const Place ray{x * slope_, -y * slope_, orthographic_ ? 0.0 : -1.0};
        if (!whole_ && !insideInSpace(ray)) return missed;
        double nearness = 0;
        if (orthographic_)
            nearness =
                corner_[0][2] -
                (normal_[0] * (ray[0] - corner_[0][0]) + normal_[1] * (ray[1] - corner_[0][1])) / normal_[2];
        else
            nearness = dotted(normal_, ray) / offset_;
        // Only what is in front of the eye is seen.
        if (!whole_) return (orthographic_ ? nearness < 0 : nearness > 0) ? nearness : missed;
        // A plane seen edge-on has any depth: never beyond the corners'.
        return std::isfinite(nearness) ? std::clamp(nearness, least_, most_) : most_;
    }

  private:
    [[nodiscard]] bool insideOnScreen(int x, int y) const {
        for (size_t k = 0; k < 3; ++k) {
            const sd_vertex &from = screen_[k], &to = screen_[(k + 1) % 3];
            const int a = from.y - to.y, b = to.x - from.x;
            const std::int64_t e = std::int64_t{a} * (x - from.x) + std::int64_t{b} * (y - from.y);
            const bool ownsEdge = a > 0 || (a == 0 && b > 0);  // top-left rule
            if (e < 0 || (e == 0 && !ownsEdge)) return false;
        }
        return true;
    }
    /// For triangles that reach behind the eye: signs of the ray's homogeneous barycentrics.
    [[nodiscard]] bool insideInSpace(const Place& ray) const {
        std::array<double, 3> b{};
        for (size_t k = 0; k < 3; ++k) {
            Place p = corner_[(k + 1) % 3], q = corner_[(k + 2) % 3];
            if (orthographic_) {
                p = difference(p, ray), q = difference(q, ray);
                b[k] = p[0] * q[1] - p[1] * q[0];
            } else {
                b[k] = dotted(ray, crossed(p, q));
            }
        }
        return (b[0] >= 0 && b[1] >= 0 && b[2] >= 0) || (b[0] <= 0 && b[1] <= 0 && b[2] <= 0);
    }

    bool orthographic_, whole_ = false, unseen_ = false;
    double slope_;
    std::array<Place, 3> corner_{};
    std::array<sd_vertex, 3> screen_{};
    std::array<double, 3> nearness_{};
    Place normal_{};
    double offset_ = 0, least_ = 0, most_ = 0;
};

}  // namespace

std::vector<std::uint32_t> trianglesSeen(const World& world, const scalar::VerticesOf<double>& vertices,
                                         const sd_frame& frame, const SamplePattern& pattern,
                                         std::span<const PixelPlace> pixels) {
    const size_t samples = pattern.x.size();
    std::vector<std::uint32_t> seen(pixels.size() * samples, scalar::noTriangle);
    std::vector<double> nearest(seen.size(), -std::numeric_limits<double>::infinity());
    const auto before = [](const PixelPlace& a, const PixelPlace& b) {
        return a.y != b.y ? a.y < b.y : a.x < b.x;
    };
    const auto triangles = static_cast<std::uint32_t>(world.drawnTriangles());
    for (std::uint32_t id = 0; id < triangles; ++id) {
        const Triangle triangle(world, vertices, frame, id);
        if (triangle.unseen()) continue;
        const auto [left, right, top, bottom] = triangle.reach(frame);
        auto at = std::lower_bound(pixels.begin(), pixels.end(), PixelPlace{left, top}, before);
        while (at != pixels.end() && at->y <= bottom) {
            if (at->x < left || at->x > right) {
                // On to the next row, or to where this one is reached.
                const PixelPlace next = at->x < left ? PixelPlace{left, at->y} : PixelPlace{left, at->y + 1};
                at = std::lower_bound(at, pixels.end(), next, before);
                continue;
            }
            const size_t first = static_cast<size_t>(at - pixels.begin()) * samples;
            for (size_t k = 0; k < samples; ++k) {
                const int x = at->x * SD_SUBPIXEL - frame.width * (SD_SUBPIXEL / 2) + pattern.x[k],
                          y = at->y * SD_SUBPIXEL - frame.height * (SD_SUBPIXEL / 2) + pattern.y[k];
                const double nearness = triangle.nearnessAt(x, y);
                if (!(nearness > nearest[first + k])) continue;
                nearest[first + k] = nearness;
                seen[first + k] = id;
            }
            ++at;
        }
    }
    return seen;
}

}  // namespace spectrad
