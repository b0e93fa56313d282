// A sweep of 8 lights and 5 detectors at 720p beside one render of the same scene: from the loaded scene to
// the last strip, files left out of both.
#include "render/sweep.h"

#include "colour/detector.h"
#include "measure.h"
#include "render/renderer.h"
#include "scene/load.h"
#include "spectrum/library.h"

#include <array>
#include <cstdio>
#include <filesystem>

using namespace spectrad;

namespace {

constexpr std::array<const char*, 8> lamps{"D65", "A", "FL2", "FL7", "FL11", "D50", "HP1", "E"};
constexpr std::array<const char*, 5> eyes{"cie1931-2", "cie1964-10", "cie2015-2", "nikon-5100",
                                          "sigma-sd-merrill"};

void run(const std::filesystem::path& file, int rounds) {
    const Device device = Device::open(std::nullopt);
    const Library library = Library::open();
    Notes notes;
    const SpectrumResolver resolver(library, ".", false, notes);
    RenderSettings settings;
    settings.size = {1280, 720};
    const Scene scene = loadScene(file, library, {}, notes);
    std::vector<Detector> detectors;
    for (const char* eye : eyes)
        detectors.push_back(detectorFor(eye, resolver, {}));

    size_t columns = 0;
    const auto once = [&] {
        const Plan plan = makePlan(scene, settings, library, notes);
        Renderer renderer(device, plan);
        renderer.render([](int, int, const float*, const float*) {});
    };
    const auto sweep = [&] {
        std::vector<Plan> plans;
        std::vector<std::string> names;
        for (const char* lamp : lamps) {
            Scene variant = scene;
            const Spectrum spectrum = resolver.resolve(std::string("illuminants/") + lamp, Role::light, {});
            for (Light& light : variant.lights)
                light.emitter.spectrum = spectrum;
            separateLights(variant);
            plans.push_back(makePlan(variant, settings, library, notes));
            names.emplace_back(lamp);
        }
        std::vector<DetectorWeights> weights;
        for (const Detector& detector : detectors)
            weights.push_back(weightsOn(plans.front().wavelengths, detector));
        const SweepPlan swept = sweepPlan(std::move(plans), names, weights);
        columns = swept.plan.terms.bands;
        Renderer renderer(device, swept.plan);
        renderer.render([](int, int, const float*, const float*) {});
    };
    const std::vector<bench::Times> times = bench::inTurn({once, sweep}, rounds);
    const bench::Ratio r = bench::ratio(times[0], times[1]);
    fmt::print(
        "device: {}; {}: 1280 x 720\none render {:.3f} s, sweep of {} lights x {} detectors ({} columns) "
        "{:.3f} s: {:.2f} renders (best "
        "rounds {:.2f}, work {:.2f})\n",
        device.info().name, file.filename().string(), times[0].typical(), lamps.size(), eyes.size(), columns,
        times[1].typical(), r.typical, r.best, r.work);
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported([&] {
        run(bench::valueOf("--scene", SPECTRAD_SOURCE "/scenes/colorchecker.xml", argc, argv),
            bench::roundsFrom(argc, argv));
    });
}
