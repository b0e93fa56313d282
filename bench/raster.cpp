// Visibility: transform and cover, beside llvmpipe (OSMesa) drawing the same triangles with a depth test and
// a flat colour.
#include "hand_plan.h"
#include "measure.h"
#include "render/memory_plan.h"
#include "render/stages.h"
#include "scene/import.h"
#include "scene/shapes.h"
#ifdef SPECTRAD_OSMESA
#include "llvmpipe.h"
#endif

#include <cstdio>
#include <filesystem>

using namespace spectrad;

namespace {

constexpr int width = 1920, height = 1080;

class Visibility {
  public:
    Visibility(const Device& device, const Plan& plan)
        : device_(device),
          plan_(plan),
          lanes_(lanePattern(plan.samples, device.body().vectorWidth())),
          stages_(device, plan, lanes_),
          rows_(planMemory(plan, device.info(), lanes_.slots).visibilityRows) {}

    /// All strips of an image, as the renderer takes them.
    void run() {
        stages_.transform();
        for (int row = 0; row < height; row += rows_)
            stages_.cover(row, std::min(rows_, height - row));
        device_.body().queue.finish();
    }

    /// Pixels of which triangles cover at least one sample.
    size_t coveredPixels() {
        stages_.cover(0, height);
        const size_t slots = static_cast<size_t>(lanes_.slots), pitch = static_cast<size_t>(stages_.pitch());
        std::vector<std::uint64_t> keys(height * pitch * slots);
        device_.body().queue.enqueueReadBuffer(stages_.keys().buffer(), CL_TRUE, 0,
                                               keys.size() * sizeof keys[0], keys.data());
        size_t covered = 0;
        for (size_t row = 0; row < height; ++row)
            for (size_t x = 0; x < width; ++x) {
                const auto pixel = keys.begin() + static_cast<std::ptrdiff_t>((row * pitch + x) * slots);
                covered += std::any_of(pixel, pixel + lanes_.slots,
                                       [](std::uint64_t key) { return key != ~std::uint64_t{0}; });
            }
        return covered;
    }

  private:
    Device device_;
    const Plan& plan_;
    LanePattern lanes_;
    Stages stages_;
    int rows_;
};

void compare(const Device& device, const std::string& name, const Plan& plan, double samplesDrawn,
             int rounds) {
    Visibility ours(device, plan);
    const auto triangles = static_cast<double>(plan.triangles());
    std::vector<std::function<void()>> contestants{[&] { ours.run(); }};
#ifdef SPECTRAD_OSMESA
    bench::Llvmpipe theirs(plan, plan.samples);
    contestants.emplace_back([&] { theirs.draw(); });
#endif
    const std::vector<bench::Times> times = bench::inTurn(contestants, rounds);
    const auto figures = [&](const bench::Times& t) {
        const std::string samples = samplesDrawn > 0
                                        ? fmt::format("{:7.2f}", samplesDrawn / t.typical() * 1e-9)
                                        : std::string("      -");
        return fmt::format("{:9.3f} {:9.2f} {}", t.typical() * 1e3, triangles / t.typical() * 1e-6, samples);
    };
    std::string line =
        fmt::format("{:24} {:2} {:9} |{}", name, plan.samples, plan.triangles(), figures(times[0]));
#ifdef SPECTRAD_OSMESA
    const bench::Ratio r = bench::ratio(times[0], times[1]);
    line += fmt::format(" |{} | {:6.2f} {:6.2f} {:6.2f}", figures(times[1]), r.typical, r.best, r.work);
    // Both drew the same picture, up to their rounding of corners and depths.
    const auto a = static_cast<double>(ours.coveredPixels()), b = static_cast<double>(theirs.coveredPixels());
    if (std::abs(a - b) > 0.02 * std::max(a, b))
        line += fmt::format("  pictures differ: {:.0f} and {:.0f} pixels covered", a, b);
#endif
    fmt::print("{}\n", line);
    std::fflush(stdout);
}

Plan rightTriangles(size_t count, double leg, int samples) {
    Plan plan = bench::emptyPlan(width, height, samples, 81);
    bench::addRightTriangles(plan, count, leg, bench::addMaterial(plan, {bench::emission()}, 1));
    return plan;
}

Plan meshed(const Mesh& mesh, double share, int samples) {
    Plan plan = bench::emptyPlan(width, height, samples, 81);
    bench::addMesh(plan, mesh, share, bench::addMaterial(plan, {bench::emission()}, 1));
    return plan;
}

struct Soup {
    size_t count;
    double leg;
};

void run(int rounds, const std::string& only) {
    const Device device = Device::open(std::nullopt);
    fmt::print("device: {}\n", device.info().name);
    fmt::print("{:38}|{:>27} |{:>27} | times faster\n", "", "ours", "llvmpipe");
    fmt::print("{:24} {:>2} {:>10}|{:>9} {:>9} {:>7} |{:>9} {:>9} {:>7} | {:>6} {:>6} {:>6}\n", "triangles",
               "S", "count", "ms", "M tri/s", "G sa/s", "ms", "M tri/s", "G sa/s", "median", "best", "work");
    const auto wanted = [&](const std::string& name) {
        return only.empty() || name.find(only) != std::string::npos;
    };
    for (int samples : {1, 4}) {
        for (const Soup& soup :
             {Soup{2000000, 1.4}, {2000000, 4}, {1000000, 10}, {400000, 25}, {100000, 100}, {8000, 500}}) {
            const std::string name = fmt::format("right, legs {} px", soup.leg);
            if (!wanted(name)) continue;
            compare(device, name, rightTriangles(soup.count, soup.leg, samples),
                    0.5 * soup.leg * soup.leg * static_cast<double>(soup.count) * samples, rounds);
        }
        Shape ball;
        if (wanted("sphere"))
            compare(device, "sphere", meshed(tessellate(ball, 1e-9, 2000), 0.9, samples), 0, rounds);
        const std::filesystem::path bunny = SPECTRAD_SHARED "/models/stanford-bunny.obj";
        if (wanted("bunny") && std::filesystem::exists(bunny))
            compare(device, "stanford-bunny.obj",
                    meshed(*importModel(bunny, false).meshes.at(0), 0.9, samples), 0, rounds);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported(
        [&] { run(bench::roundsFrom(argc, argv), bench::valueOf("--only", "", argc, argv)); });
}
