// Passes: what it costs to make a texture of a picture instead of only rendering it, and a chain of ten
// passes at 1024 × 1024 pixels and 81 bands with the memory that it takes.
#include "render/passes.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "measure.h"
#include "render/renderer.h"
#include "scene/load.h"
#include "spectrum/library.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

using namespace spectrad;

namespace {

constexpr int side = 1024, passes = 10;

/// A still life as the first pass; each next one shows the one before on a screen beside two spheres.
std::string chain() {
    std::string text = R"(<scene version="1"><wavelengths from="380" to="780" step="5"/>
<material name="a"><diffuse reflectance="charts/colorchecker/red"/><gloss ior="1.5" roughness="0.3"/></material>
<material name="b"><diffuse reflectance="charts/colorchecker/foliage"/></material>
<node name="n0"><node translate="-1 0 0"><sphere radius="0.9" material="a"/></node><node translate="1 0 0"><torus radius="0.6" tube="0.3" material="b"/></node>
  <node translate="0 0 -1"><plane size="8 8"/></node></node>
)";
    for (int i = 1; i < passes; ++i)
        text += fmt::format(
            "<material name=\"m{0}\"><emission texture=\"pass:p{1}\" scale=\"0.9\"/></material>\n"
            "<node name=\"n{0}\"><plane size=\"3.6 3.6\" material=\"m{0}\"/><node translate=\"1.2 -1.2 "
            "0.5\"><sphere radius=\"0.5\" material=\"a\"/></node></node>\n",
            i, i - 1);
    text += fmt::format(
        "<light name=\"lamp\" type=\"point\" position=\"2 3 4\" spectrum=\"illuminants/D65\" "
        "intensity=\"500 cd\"/>\n<camera look-from=\"0 0 6\" look-at=\"0 0 0\" fov=\"38\" "
        "size=\"{0}x{0}\"/>\n",
        side);
    for (int i = 0; i < passes; ++i)
        text += fmt::format("<pass name=\"p{0}\" of=\"n{0}\" lights=\"lamp\"/>\n", i);
    return text + "</scene>";
}

double megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

RenderSettings target(int pass) {
    RenderSettings settings;
    settings.pass = fmt::format("p{}", pass);
    return settings;
}

void run(const Scene& scene, int rounds) {
    const Device device = Device::open(std::nullopt);
    const Library library = Library::open();
    const double cubeMegabytes = 4.0 * side * side * 81 / (1 << 20);
    fmt::print("device {}; {} x {} pixels, 81 bands: {:.0f} MiB a cube\n", device.info().name, side, side,
               cubeMegabytes);

    // The second pass's own pixels, its texture at hand; the first one's; and both as a chain.
    std::optional<SpectralTexture> kept;
    struct Kept : TextureLoader {
        Kept(const Scene& s, const Library& l, Notes& n, const SpectralTexture& t)
            : TextureLoader(s, l, n), texture(t) {}
        SpectralTexture loadPass(const Pass&, const TextureUse&) override { return texture; }
        const SpectralTexture& texture;
    };
    std::vector<float> picture(static_cast<size_t>(side) * side * 81);
    const auto render = [&](const Plan& plan) {
        Renderer renderer(device, plan);
        renderer.render([&](int first, int rows, const float* bands, const float*) {
            std::copy_n(bands, static_cast<size_t>(rows) * 81 * side,
                        picture.data() + static_cast<size_t>(first) * 81 * side);
        });
    };
    Notes notes;
    const auto first = [&] {
        PassTextures textures(scene, library, device, target(0), notes);
        render(makePlan(scene, target(0), library, textures, notes));
    };
    {
        PassTextures textures(scene, library, device, target(0), notes);
        const Cube cube = textures.render();
        TextureUse use;
        use.role = TextureRole::radiance;
        kept = textureFrom(cube, use, notes);
    }
    const auto second = [&] {
        Kept textures(scene, library, notes, *kept);
        render(makePlan(scene, target(1), library, textures, notes));
    };
    const auto both = [&] {
        PassTextures textures(scene, library, device, target(1), notes);
        render(makePlan(scene, target(1), library, textures, notes));
    };
    const std::vector<bench::Times> times = bench::inTurn({first, second, both}, rounds);
    const double plain = times[0].best() + times[1].best(),
                 work = bench::median(times[0].work) + bench::median(times[1].work);
    fmt::print(
        "first pass {:.3f} s, second with its texture at hand {:.3f} s, both as a chain {:.3f} s: the pass "
        "costs {:+.1f} % (work of all cores {:+.1f} %)\n",
        times[0].best(), times[1].best(), times[2].best(), 100 * (times[2].best() / plain - 1),
        100 * (bench::median(times[2].work) / work - 1));

    kept.reset();
    const Stopwatch clock;
    PassTextures textures(scene, library, device, target(passes - 1), notes);
    render(makePlan(scene, target(passes - 1), library, textures, notes));
    const double seconds = clock.seconds();
    fmt::print(
        "chain of {} passes: {:.2f} s; peak memory of the process {:.0f} MiB, {:.1f} cubes of {:.0f} MiB "
        "(device memory {:.0f} MiB)\n",
        passes, seconds, megabytes(), megabytes() / cubeMegabytes, cubeMegabytes,
        static_cast<double>(device.info().globalMemoryBytes) / (1 << 20));
}

}  // namespace

int main(int argc, char** argv) {
    namespace fs = std::filesystem;
    const fs::path file = fs::temp_directory_path() / fmt::format("spectrad-bench-passes-{}.xml", getpid());
    try {
        std::ofstream(file) << chain();
        const Library library = Library::open();
        Notes notes;
        const Scene scene = loadScene(file, library, {}, notes);
        fs::remove(file);
        run(scene, bench::roundsFrom(argc, argv));
        return 0;
    } catch (const Error& error) {
        std::error_code ignored;
        fs::remove(file, ignored);
        std::fprintf(stderr, "bench_passes: %s\n", error.what());
        return static_cast<int>(error.code());
    }
}
