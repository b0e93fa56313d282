// Settings chosen for a tolerance, judged without the chooser: rendered and held against every nanometre with
// 64 samples.
#include "study/chooser.h"

#include "colour/develop.h"
#include "colour/difference.h"
#include "scene/load.h"
#include "spectrum/library.h"
#include "spectrum/resolver.h"
#include "study/trial.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

using namespace spectrad;

namespace {

/// Curved edges, paints and a metal: %s is the lamp.
std::string sceneUnder(const std::string& lamp) {
    return R"(<scene version="1">
      <material name="red"><diffuse reflectance="charts/colorchecker/red"/></material>
      <material name="blue"><diffuse reflectance="charts/colorchecker/blue"/><gloss ior="1.5" roughness="0.4"/></material>
      <material name="white"><diffuse reflectance="charts/colorchecker/white"/></material>
      <material name="gold"><conductor ior="metals/Au" roughness="0.4"/></material>
      <node translate="0 0 -1"><plane size="6 4" material="white"/></node>
      <node translate="-1 0 0"><sphere radius="0.5" material="red"/></node>
      <node><box size="0.7" material="blue"/></node>
      <node translate="1 0 0"><sphere radius="0.4" material="gold"/></node>
      <light name="lamp" type="directional" direction="-1 -1 -2" spectrum=")" +
           lamp + R"(" illuminance="500 lx"/>
      <camera name="c" fov="30" look-from="0 0 6" look-at="0 0 0" size="120x80"/></scene>)";
}

struct Bench {
    explicit Bench(const std::string& lamp)
        : scene(loadScene(folder.write("scene.xml", sceneUnder(lamp)), library, {}, notes)),
          observer(standardObserver(library)) {}

    Plan plan(const Scene& of, const RenderSettings& settings) {
        return makePlan(of, settings, library, notes);
    }
    Chosen chosen(const std::string& tolerance) {
        ChooserSettings settings;
        settings.tolerance = parseTolerance(tolerance);
        return choose(
            scene, settings, observer, library, device,
            [&](const Scene& of, const RenderSettings& wanted) { return plan(of, wanted); }, [](double) {});
    }
    ChannelImage xyz(const Wavelengths& grid, int samples, bool half, bool schlick) {
        RenderSettings settings;
        settings.wavelengths = grid;
        settings.samples = samples;
        Entry entry{plan(schlick ? withSchlick(scene) : scene, settings), {}};
        entry.weights = weightsOn(grid, observer);
        TrialSettings once;
        once.rounds = 1;
        return tryOut(device, entry, {half, 24}, once).xyz;
    }
    /// ΔE00 that 99 % of the pixels are within, against the brightest pixel's luminance.
    double error(const ChannelImage& of) {
        if (right.plane.empty()) right = xyz(referenceGrid(), 64, false, false);
        const double brightest = *std::max_element(right.plane[1].begin(), right.plane[1].end());
        const std::array<const Curve*, 1> lamp{&scene.lights.front().emitter.spectrum.curve()};
        const Triple light = respondXyz(observer, lamp);
        Triple white{};
        for (size_t c = 0; c < 3; ++c)
            white[c] = light[c] / light[1] * brightest;
        const ColourDifference d = colourDifference(right, of, white);
        std::vector<double> map(d.map.begin(), d.map.end());
        return quantile(map, 0.99);
    }

    TemporaryFolder folder;
    Notes notes;
    Library library = Library::open();
    Scene scene;
    Detector observer;
    Device device = Device::open(std::nullopt);
    ChannelImage right;
};

}  // namespace

TEST_CASE(
    "chosen settings keep the tolerance under lamps of every kind, with no more than 1.5 times the bands of "
    "the "
    "best regular grid") {
    for (const char* lamp : {"illuminants/D65", "illuminants/A", "illuminants/FL11", "illuminants/LED-B3",
                             "illuminants/HP1", "line:560,2"}) {
        Bench bench(lamp);
        for (const char* tolerance : {"1.0", "0.2"}) {
            CAPTURE(lamp, tolerance);
            const double bound = parseTolerance(tolerance).bound;
            const Chosen c = bench.chosen(tolerance);
            REQUIRE(c.met);
            CHECK(bench.error(bench.xyz(c.wavelengths, c.samples, c.half, c.schlick)) <= bound);
            CHECK(c.choices.size() >= 3);
            // Fewer bands of any regular grid, or fewer samples, may be cheaper by a third at most.
            for (int step : {40, 30, 25, 20, 15, 10}) {
                const Wavelengths grid = regularWavelengths(400, 700, step, {});
                if (3 * grid.size() > 2 * c.wavelengths.size()) break;
                CHECK(bench.error(bench.xyz(grid, 64, false, false)) > bound);
            }
        }
    }
}

TEST_CASE("fewer samples than chosen would not do") {
    Bench bench("illuminants/D65");
    const Chosen c = bench.chosen("0.5");
    REQUIRE(c.samples > 1);
    CHECK(bench.error(bench.xyz(referenceGrid(), c.samples / 2, false, false)) > 0.95 * 0.5);
}

TEST_CASE("a tolerance for all pixels is kept in each of them; 1%rad keeps the grid") {
    Bench bench("illuminants/LED-B3");
    const Chosen all = bench.chosen("max:0.5");
    if (all.met) CHECK(all.reached <= 0.5);
    const Chosen bands = bench.chosen("1%rad");
    CHECK(bands.met);
    CHECK(bands.wavelengths == bench.scene.wavelengths);
    CHECK(bands.reached <= 0.01);
}

TEST_CASE("what nothing keeps is said with what was reached") {
    Bench bench("illuminants/FL11");
    const Chosen c = bench.chosen("1e-9");
    CHECK_FALSE(c.met);
    CHECK(c.reached > 1e-9);
    CHECK(c.reached < 0.05);
}
