// Expansion: L(x, wavelength) = sum of g c, 81 bands of a 1920x1080 image by strips, beside a plain fill of
// the same buffers.
#include "hand_plan.h"
#include "measure.h"
#include "render/memory_plan.h"
#include "render/stages.h"

#include <cstdio>

using namespace spectrad;

namespace {

constexpr int width = 1920, height = 1080;
constexpr size_t bands = 81;

/// What memory gives: `out` filled with a number, a run of whole lines of the cache a work-item, past the
/// caches where the device can.
constexpr const char* fillSource = R"(
#if VW == 16
#if defined(__has_builtin)
#if __has_builtin(__builtin_nontemporal_store)
#define PUT(v, p) __builtin_nontemporal_store(v, (global float16*)(p))
#endif
#endif
#ifndef PUT
#define PUT(v, p) vstore16(v, 0, p)
#endif
kernel void fill(global float* out, float value) {
    global float* run = out + get_global_id(0) * RUN;
    for (int i = 0; i < RUN; i += 16) PUT((float16)value, run + i);
}
#else
kernel void fill(global float* out, float value) {
    out[get_global_id(0)] = value;
}
#endif
)";

class Fill {
  public:
    Fill(const Device& device, size_t run)
        : device_(device), run_(device.body().vectorWidth() == 1 ? 1 : run) {
        cl::Program program(device.body().context, std::string(fillSource));
        program.build({device.body().device},
                      fmt::format("-DVW={} -DRUN={}", device.body().vectorWidth(), run_).c_str());
        kernel_ = cl::Kernel(program, "fill");
    }
    /// `floats`: a multiple of the run.
    void operator()(const cl::Buffer& buffer, size_t floats) {
        kernel_.setArg(0, buffer);
        kernel_.setArg(1, 1.0f);
        const size_t group = run_ == 1 ? 64 : 1;
        device_.body().queue.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(floats / run_),
                                                  cl::NDRange(group));
    }

  private:
    Device device_;
    size_t run_;
    cl::Kernel kernel_;
};

/// A wall across the image whose material has `terms` terms.
Plan wall(std::uint32_t terms) {
    Plan plan = bench::emptyPlan(width, height, 1, bands);
    bench::addWall(plan, bench::addMaterial(plan, std::vector<sd_lobe>(terms, bench::emission()), 1));
    return plan;
}

void run(int rounds) {
    const Device device = Device::open(std::nullopt);
    fmt::print("device: {}; {} x {} x ({} + 3) floats\n", device.info().name, width, height, bands);
    fmt::print("{:>5} |{:>9} {:>7} |{:>9} {:>7} | share of the fill's speed\n", "terms", "expand ms", "GB/s",
               "fill ms", "GB/s");
    for (std::uint32_t terms : {1u, 2u, 4u, 8u, 16u}) {
        const Plan plan = wall(terms);
        const LanePattern lanes = lanePattern(1, device.body().vectorWidth());
        const MemoryPlan memory = planMemory(plan, device.info(), lanes.slots);
        Stages stages(device, plan, lanes);
        stages.transform();
        stages.light(0, height);
        DeviceArray<float> cube, preview;
        const auto strips = [&](const auto& strip) {
            for (int row = 0; row < height; row += memory.cubeRows)
                strip(row, std::min(memory.cubeRows, height - row));
            device.body().queue.finish();
        };
        const auto expand = [&] {
            strips([&](int row, int rows) { stages.expand(row, rows, cube, preview); });
        };
        std::vector<std::function<void()>> contestants{expand};
        // The best of some shapes: a row of the image, a few pages, a piece for each core.
        std::vector<Fill> fills;
        for (size_t pixels : {64, 1024, 16384})
            fills.emplace_back(device, pixels);
        for (Fill& fill : fills) {
            contestants.emplace_back([&] {
                strips([&](int, int rows) {
                    const size_t line = static_cast<size_t>(stages.pitch()) * static_cast<size_t>(rows);
                    fill(cube.buffer(), line * bands / 16384 * 16384);
                    fill(preview.buffer(), line * 3 / 16384 * 16384);
                });
            });
        }
        const std::vector<bench::Times> times = bench::inTurn(contestants, rounds);
        const auto fastest =
            std::min_element(times.begin() + 1, times.end(),
                             [](const auto& a, const auto& b) { return a.typical() < b.typical(); });
        const double bytes = static_cast<double>(width) * height * (bands + 3) * sizeof(float);
        const bench::Ratio r = bench::ratio(times[0], *fastest);
        fmt::print("{:5} |{:9.2f} {:7.2f} |{:9.2f} {:7.2f} | {:.2f} (best rounds {:.2f})\n", terms,
                   times[0].typical() * 1e3, bytes / times[0].typical() * 1e-9, fastest->typical() * 1e3,
                   bytes / fastest->typical() * 1e-9, r.typical, r.best);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported([&] { run(bench::roundsFrom(argc, argv)); });
}
