// How far each kernel is from the same formulae in long double: histograms for docs/extremes.md, printed by
// `test_kernels "[.ulps]"` for the device that is opened.
#include "kernels/oracle.h"
#include "kernels/random_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace spectrad;

namespace {

constexpr std::array<double, 9> bounds{0.5, 1, 2, 4, 16, 64, 1024, 65536, 1e30};

struct Histogram {
    std::array<size_t, bounds.size()> count{};
    size_t all = 0;
    double largest = 0;

    void add(long double value, long double right, long double size) {
        if (size == 0) return;
        const auto error = static_cast<double>(std::fabs(value - right) / size * 0x1p23L);
        const auto at = std::lower_bound(bounds.begin(), bounds.end(), error);
        ++count[static_cast<size_t>(std::min(at, bounds.end() - 1) - bounds.begin())];
        ++all;
        largest = std::max(largest, error);
    }
};

using Histograms = std::map<std::string, Histogram>;

/// Vertices: the twin, bit for bit the device's, against long double. Camera space relative to the largest
/// summand (what cancels is the scene's, not the kernel's), depth keys relative to themselves.
void measureVertices(const Plan& plan, const sd_frame& frame, const std::string& world, Histograms& out) {
    const twin::Vertices vertices = twin::transform(plan.world, frame);
    for (size_t v = 0; v < plan.world.vertexDraw.size(); ++v) {
        const sd_draw& draw = plan.world.draws[plan.world.vertexDraw[v]];
        const float* p = plan.world.position.data() + 3 * v;
        long double depth = 0;
        for (size_t row = 0; row < 3; ++row) {
            const double* m = draw.to_camera + 4 * row;
            long double sum = m[3], size = std::fabs(m[3]);
            for (size_t i = 0; i < 3; ++i) {
                sum += static_cast<long double>(m[i]) * p[i];
                size = std::max<long double>(size, std::fabs(static_cast<long double>(m[i]) * p[i]));
            }
            out["transform, place, " + world].add(vertices.camera[3 * v + row], sum, size);
            depth = -sum;
        }
        if (!vertices.screen[v].outside && !frame.orthographic && !frame.baked)
            out["transform, depth key, " + world].add(vertices.screen[v].depth_key, 1 / depth, 1 / depth);
    }
}

void measure(const Device& device, const Plan& plan, const std::string& world, Histograms& out) {
    measureVertices(plan, twin::frameOf(plan), world, out);
    const auto into = [](Histogram& histogram) {
        return
            [&histogram](float value, long double right) { histogram.add(value, right, std::fabs(right)); };
    };
    besideOracle<long double>(device, plan, into(out["light, factors, " + world]),
                              into(out["expand, bands, " + world]));
}

}  // namespace

TEST_CASE("ulps of every kernel against long double", "[.ulps]") {
    const Device device = Device::open(std::nullopt);
    Histograms all;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        measure(device, unbent(randomPlan(seed, 4, seed % 2 == 0, 150, 24)), "random", all);
        measure(device, adversarialPlan(seed, seed % 2 == 0), "adversarial", all);
    }
    fmt::print("{}, {}\n", device.info().name, device.info().platform);
    fmt::print(
        "| kernel | values | ≤ ½ | ≤ 1 | ≤ 2 | ≤ 4 | ≤ 16 | ≤ 64 | ≤ 1024 | ≤ 65536 | more | largest, ulps "
        "|\n");
    for (const auto& [name, histogram] : all) {
        fmt::print("| {} | {} |", name, histogram.all);
        for (size_t count : histogram.count)
            fmt::print(" {:.3g} % |",
                       100.0 * static_cast<double>(count) / static_cast<double>(histogram.all));
        fmt::print(" {:.3g} |\n", histogram.largest);
    }
    CHECK(all.size() >= 7);
}
