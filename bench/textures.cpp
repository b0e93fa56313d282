// Spectral textures: a square filled with one, texel to pixel, of 31 and of 81 bands, by each filter; beside
// the same square in one paint, and beside copying the texture into the picture, the least that memory has to
// do. All in turn.
#include "image/cube.h"
#include "measure.h"
#include "renders.h"
#include "scene/load.h"
#include "spectrum/library.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>
#include <unistd.h>

using namespace spectrad;

namespace {

constexpr int side = 1024;

struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / fmt::format("spectrad-bench-{}", getpid());
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
};

/// Reflectances that differ from texel to texel and from band to band, as point values.
void writeTexture(const std::filesystem::path& file, const Wavelengths& grid) {
    CubeInfo info;
    info.width = info.height = side;
    info.kind = CubeKind::reflectance;
    info.wavelengths = grid;
    info.wavelengths.projection = Projection::point;
    info.projectionStated = true;
    const auto writer = createExr(file, info, {Compression::none, false});
    std::vector<float> row(static_cast<size_t>(side) * grid.size());
    const std::vector<float> preview(3 * static_cast<size_t>(side), 0.0f);
    for (int y = 0; y < side; ++y) {
        for (size_t band = 0; band < grid.size(); ++band)
            for (int x = 0; x < side; ++x)
                row[band * side + static_cast<size_t>(x)] =
                    0.5f + 0.4f * std::sin(0.05f * static_cast<float>(x) + 0.03f * static_cast<float>(y) +
                                           0.2f * static_cast<float>(band));
        writer->write(1, row.data(), preview.data());
    }
    (void)writer->finish();
}

std::string square(const std::string& diffuse, const std::string& bands) {
    return fmt::format(
        R"(<scene version="1"><wavelengths {}/><material name="m"><diffuse {}/></material><plane size="2 2" material="m"/>
<light type="directional" direction="0.2 0.1 -1" spectrum="illuminants/D65" illuminance="1000 lx"/>
<camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="{}x{}"/></scene>)",
        bands, diffuse, side, side);
}

/// The texels of a picture, copied on as many threads as there are cores.
class Copying {
  public:
    explicit Copying(size_t values) : from_(values, 0.5f), to_(values) {}
    void operator()() {
        const size_t threads = std::max(1u, std::thread::hardware_concurrency());
        std::vector<std::thread> running;
        for (size_t t = 0; t < threads; ++t)
            running.emplace_back([this, t, threads] {
                const size_t first = from_.size() * t / threads, last = from_.size() * (t + 1) / threads;
                std::copy(from_.data() + first, from_.data() + last, to_.data() + first);
            });
        for (std::thread& thread : running)
            thread.join();
    }

  private:
    std::vector<float> from_, to_;
};

void compare(const Device& device, const Library& library, const std::string& attributes,
             const Wavelengths& grid, int samples, int rounds) {
    const Folder folder;
    writeTexture(folder.path / "texture.exr", grid);
    const std::vector<std::pair<std::string, std::string>> looks{
        {"one paint", R"(reflectance="charts/colorchecker/foliage")"},
        {"nearest", R"(texture="texture.exr" filter="nearest")"},
        {"bilinear", R"(texture="texture.exr" filter="bilinear")"},
        {"mip", R"(texture="texture.exr" filter="mip")"}};
    std::vector<Plan> plans;
    RenderSettings settings;
    settings.samples = samples;
    for (const auto& [name, diffuse] : looks) {
        const std::filesystem::path file = folder.path / "scene.xml";
        std::ofstream(file) << square(diffuse, attributes);
        Notes notes;
        plans.push_back(makePlan(loadScene(file, library, {}, notes), settings, library, notes));
    }
    std::vector<std::function<void()>> contestants = bench::rendersOf(device, plans);
    const auto copying = std::make_shared<Copying>(static_cast<size_t>(side) * side * grid.size());
    contestants.emplace_back([copying] { (*copying)(); });
    const std::vector<bench::Times> times = bench::inTurn(contestants, rounds);
    const bench::Times& copied = times.back();
    const double gigabytes = 2.0 * sizeof(float) * side * side * static_cast<double>(grid.size()) * 1e-9;
    for (size_t i = 0; i < plans.size(); ++i) {
        const bench::Ratio paint = bench::ratio(times[0], times[i]), copy = bench::ratio(copied, times[i]);
        fmt::print("{:5} {:7} | {:9} |{:6} {:9.1f} | {:6.2f} {:6.2f} {:6.2f} | {:6.2f} {:6.2f}\n",
                   grid.size(), samples, looks[i].first, plans[i].terms.count(), times[i].typical() * 1e3,
                   paint.typical, paint.best, paint.work, copy.typical, copy.best);
    }
    fmt::print("{:5} {:7} | {:9} |{:6} {:9.1f} | {:.1f} GB/s read and written\n", grid.size(), "", "copying",
               "", copied.typical() * 1e3, gigabytes / copied.typical());
}

void run(int rounds) {
    const Device device = Device::open(std::nullopt);
    const Library library = Library::open();
    fmt::print("device: {}; {} x {} pixels, a texel each\n", device.info().name, side, side);
    fmt::print("{:>5} {:>7} | {:9} |{:>6} {:>9} | {:20} | {}\n", "bands", "samples", "texture", "terms",
               "render ms", "in times of one paint", "of copying the texels into the picture");
    fmt::print("{:>5} {:>7} | {:9} |{:>6} {:>9} | {:>6} {:>6} {:>6} | {:>6} {:>6}\n", "", "", "", "", "",
               "median", "best", "work", "median", "best");
    for (const int samples : {1, 4}) {
        compare(device, library, R"(from="400" to="700" step="10")", regularWavelengths(400, 700, 10, {}),
                samples, rounds);
        compare(device, library, R"(from="380" to="780" step="5")", regularWavelengths(380, 780, 5, {}),
                samples, rounds);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported([&] { run(bench::roundsFrom(argc, argv)); });
}
