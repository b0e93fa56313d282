// Render to a file: scene to spectral EXR, beside writing the same EXR from memory. What remains of the
// difference is what rendering costs where the file is the bottleneck.
#include "image/cube.h"
#include "measure.h"
#include "render/renderer.h"
#include "scene/load.h"
#include "spectrum/library.h"

#include <cstdio>
#include <filesystem>
#include <unistd.h>

using namespace spectrad;

namespace {

namespace fs = std::filesystem;

struct Scratch {
    Scratch() : folder(fs::temp_directory_path() / fmt::format("spectrad-bench-{}", getpid())) {
        fs::create_directory(folder);
    }
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    fs::path folder;
};

/// As the command does: strips go to a thread that writes while the next ones are rendered.
std::unique_ptr<CubeWriter> writerFor(const fs::path& file, const CubeInfo& info, Compression compression) {
    constexpr size_t queuedBytes = size_t{256} << 20;
    WriteOptions options;
    options.compression = compression;
    return onOwnThread(createExr(file, info, options), queuedBytes, info);
}

void run(const fs::path& scene, int rounds) {
    const Device device = Device::open(std::nullopt);
    const Library library = Library::open();
    Notes notes;
    RenderSettings settings;
    settings.size = {1920, 1080};
    const Plan plan = makePlan(loadScene(scene, library, {{"scene.shadows=false"}, false}, notes), settings,
                               library, notes);
    Renderer renderer(device, plan);
    CubeInfo info;
    info.width = plan.view.width;
    info.height = plan.view.height;
    info.wavelengths = plan.wavelengths;
    const size_t pixels = static_cast<size_t>(info.width) * static_cast<size_t>(info.height),
                 bands = plan.wavelengths.size();

    // The finished image in memory, for the peer.
    std::vector<float> cube(pixels * bands), preview(pixels * 3);
    const auto width = static_cast<size_t>(info.width);
    renderer.render([&](int firstRow, int rows, const float* values, const float* rgb) {
        const size_t from = static_cast<size_t>(firstRow) * width, count = static_cast<size_t>(rows) * width;
        std::copy_n(values, count * bands, cube.data() + from * bands);
        std::copy_n(rgb, count * 3, preview.data() + from * 3);
    });

    fmt::print("device: {}; {}: {} x {} x {} bands, {} samples a pixel, {:.0f} MB\n", device.info().name,
               scene.filename().string(), info.width, info.height, bands, plan.samples,
               static_cast<double>(pixels * (bands + 3) * sizeof(float)) * 1e-6);
    fmt::print("{:>11} |{:>15} {:>17} {:>14} | {}\n", "compression", "render only s", "render + write s",
               "write only s", "render + write in times of write only");
    const Scratch scratch;
    for (Compression compression : {Compression::none, Compression::piz}) {
        const auto renderOnly = [&] { renderer.render([](int, int, const float*, const float*) {}); };
        const auto both = [&] {
            const auto writer = writerFor(scratch.folder / "rendered.exr", info, compression);
            renderer.render([&](int, int rows, const float* values, const float* rgb) {
                writer->write(rows, values, rgb);
            });
            writer->finish();
        };
        const auto writeOnly = [&] {
            const auto writer = writerFor(scratch.folder / "written.exr", info, compression);
            const int strip = renderer.stripRows();
            for (int row = 0; row < info.height; row += strip)
                writer->write(std::min(strip, info.height - row),
                              cube.data() + static_cast<size_t>(row) * width * bands,
                              preview.data() + static_cast<size_t>(row) * width * 3);
            writer->finish();
        };
        const std::vector<bench::Times> times = bench::inTurn({renderOnly, both, writeOnly}, rounds);
        const bench::Ratio r = bench::ratio(times[2], times[1]);
        fmt::print("{:>11} |{:15.3f} {:17.3f} {:14.3f} | {:.2f} (best rounds {:.2f}, work {:.2f})\n",
                   name(compression), times[0].typical(), times[1].typical(), times[2].typical(), r.typical,
                   r.best, r.work);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported([&] {
        run(bench::valueOf("--scene", SPECTRAD_SOURCE "/scenes/still-life.xml", argc, argv),
            bench::roundsFrom(argc, argv));
    });
}
