// Settings chosen for a tolerance: kept or not when judged by another way (the real bands of the real image
// against every nanometre with 64 samples), and what they cost beside the cheapest of an exhaustive search
// over regular grids, projections, samples and halves.
//
//   bench_tolerance [--kept] [SCENE…]    scenes below scenes/, without the extension; default: ten of them
//
// --kept leaves the search out, which takes most of the time.
#include "colour/develop.h"
#include "colour/difference.h"
#include "render/passes.h"
#include "scene/load.h"
#include "spectrum/library.h"
#include "spectrum/resolver.h"
#include "study/chooser.h"
#include "study/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <unistd.h>

using namespace spectrad;

namespace {

struct Setting {
    Wavelengths grid;
    int samples = 1;
    bool half = false;
    double cost = 0;  ///< estimated, to try the cheapest first
};

struct Case {
    Scene scene;
    const Library& library;
    const Device& device;
    Detector observer;
    ChannelImage right{};
    Triple white{};

    [[nodiscard]] Plan planned(const Scene& of, RenderSettings settings) const {
        Notes unheard;
        if (!settings.size) settings.size = size;
        PassTextures passes(of, library, device, settings, unheard);
        return makePlan(of, settings, library, passes, unheard);
    }
    [[nodiscard]] Trial trial(const Wavelengths& grid, int samples, bool half, bool schlick) const {
        RenderSettings settings;
        settings.wavelengths = grid;
        settings.samples = samples;
        Entry entry{planned(schlick ? withSchlick(scene) : scene, settings), {}};
        entry.weights = weightsOn(grid, observer);
        return tryOut(device, entry, {half, 24}, {1, false, {}});
    }
    /// ΔE00 that 99 % of the pixels are within.
    [[nodiscard]] double error(const ChannelImage& image) const {
        return colourDifference(right, image, white).p99;
    }
    [[nodiscard]] Entry entryFor(const Wavelengths& grid, int samples, bool schlick) const {
        RenderSettings settings;
        settings.wavelengths = grid;
        settings.samples = samples;
        settings.size = {4 * size.first, 4 * size.second};  // long enough to be timed
        Entry entry{planned(schlick ? withSchlick(scene) : scene, settings), {}};
        entry.weights = weightsOn(grid, observer);
        return entry;
    }
    /// What rendering and writing with one setting takes ÷ with another: in turns, so that other programs
    /// disturb both, and the best of five of each.
    [[nodiscard]] double ratio(const Chosen& a, const Setting& b) const {
        const auto file =
            std::filesystem::temp_directory_path() / fmt::format("spectrad-bench-{}.exr", getpid());
        const Entry first = entryFor(a.wavelengths, a.samples, a.schlick),
                    second = entryFor(b.grid, b.samples, false);
        const auto seconds = [&](const Entry& entry, bool half) {
            const Trial trial = tryOut(device, entry, {half, 24}, {2, false, file});
            return trial.renderSeconds + trial.writeSeconds;
        };
        double of = 1e9, by = 1e9;
        for (int round = 0; round < 5; ++round) {
            of = std::min(of, seconds(first, a.half));
            by = std::min(by, seconds(second, b.half));
        }
        return of / by;
    }
    std::pair<int, int> size{150, 100};
};

std::vector<Setting> everySetting() {
    std::vector<Setting> all;
    for (const auto& [from, to] : {std::pair{380.0, 730.0}, std::pair{400.0, 700.0}})
        for (double step : {5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0})
            for (Projection projection : {Projection::slit, Projection::point})
                for (int samples : {1, 2, 4, 8, 16, 32, 64})
                    for (bool half : {false, true}) {
                        Setting s{regularWavelengths(from, to, step, {}), samples, half};
                        s.grid.projection = projection;
                        // Nanoseconds a pixel: a sample about 5, a value to be written about 30.
                        s.cost = 5.0 * samples + 30.0 * static_cast<double>(s.grid.size()) * (half ? 0.7 : 1);
                        all.push_back(std::move(s));
                    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Setting& a, const Setting& b) { return a.cost < b.cost; });
    return all;
}

void run(std::vector<std::string> scenes) {
    const bool search = scenes.empty() || scenes.front() != "--kept";
    if (!search) scenes.erase(scenes.begin());
    if (scenes.empty())
        scenes = {"colorchecker", "still-life",    "gloss-ladder",  "metal-ladder",  "fluorescence",
                  "pavilion",     "paper/figure2", "paper/figure3", "paper/figure4", "models/chess.dae"};
    const Device device = Device::open(std::nullopt);
    const Library library = Library::open();
    const std::vector<Setting> every = everySetting();
    int kept = 0, cheap = 0, compared = 0, all = 0;
    double worstRatio = 0;
    std::printf(
        "scene, lamp, tolerance: bands samples half | 99 %% within | cost / cheapest (bands samples)\n");
    for (const std::string& name : scenes)
        for (const char* lamp : {"A", "D65", "FL11", "LED-B3", "HP1", "FL3.15"}) {
            Notes unheard;
            const bool model = std::filesystem::path(name).has_extension();
            Case c{loadScene(SPECTRAD_SOURCE "/scenes/" + name + (model ? "" : ".xml"), library, {}, unheard),
                   library, device, standardObserver(library)};
            const SpectrumResolver resolver(library, {}, false, unheard);
            const Spectrum spectrum = resolver.resolve(std::string("illuminants/") + lamp, Role::light, {});
            for (Light& light : c.scene.lights) {
                light.emitter.spectrum = spectrum;
                light.emitter.texture.reset();
            }
            c.right = c.trial(referenceGrid(), 64, false, false).xyz;
            const std::array<const Curve*, 1> curve{&spectrum.curve()};
            const Triple xyz = respondXyz(c.observer, curve);
            const double brightest = *std::max_element(c.right.plane[1].begin(), c.right.plane[1].end());
            for (const char* tolerance : {"1.0", "0.2"}) {
                for (size_t k = 0; k < 3; ++k)
                    c.white[k] = xyz[k] / xyz[1] * brightest;
                ChooserSettings settings;
                settings.tolerance = parseTolerance(tolerance);
                settings.render.size = c.size;
                const Chosen chosen = choose(
                    c.scene, settings, c.observer, library, device,
                    [&](const Scene& of, const RenderSettings& wanted) { return c.planned(of, wanted); },
                    [](double) {});
                const double error =
                    c.error(c.trial(chosen.wavelengths, chosen.samples, chosen.half, chosen.schlick).xyz);
                const double bound = settings.tolerance.bound;
                // `kept` is judged with compare's white, the brightest pixel; the search with the chooser's
                // own, that what is sought is the same.
                c.white = chosen.white.xyz;
                // What fails with 64 samples, or with bands every 5 nm, need not be tried with fewer of both.
                std::map<int, bool> samplesMayDo;
                std::map<std::pair<Projection, std::vector<double>>, bool> gridMayDo;
                const auto mayDo = [&](const Setting& s) {
                    const auto few = samplesMayDo.try_emplace(s.samples, false);
                    if (few.second)
                        few.first->second =
                            c.error(
                                c.trial(regularWavelengths(380, 780, 5, {}), s.samples, false, false).xyz) <=
                            1.1 * bound;
                    if (!few.first->second) return false;
                    const auto grid = gridMayDo.try_emplace({s.grid.projection, s.grid.nm}, false);
                    if (grid.second)
                        grid.first->second = c.error(c.trial(s.grid, 64, false, false).xyz) <= 1.1 * bound;
                    return grid.first->second;
                };
                const Setting* cheapest = nullptr;
                for (const Setting& s : every) {
                    if (!search) break;
                    if (!mayDo(s) || c.error(c.trial(s.grid, s.samples, s.half, false).xyz) > bound) continue;
                    cheapest = &s;
                    break;
                }
                ++all;
                kept += error <= bound;
                double ratio = 0;
                if (cheapest) ratio = c.ratio(chosen, *cheapest);
                compared += cheapest != nullptr;
                cheap += cheapest && ratio <= 1.5;
                worstRatio = std::max(worstRatio, ratio);
                std::printf(
                    "%s, %s, %s: %zu %d %s | %.3g | %.2f (%zu %d %s)%s\n", name.c_str(), lamp, tolerance,
                    chosen.wavelengths.size(), chosen.samples, chosen.half ? "half" : "float", error, ratio,
                    cheapest ? cheapest->grid.size() : 0, cheapest ? cheapest->samples : 0,
                    cheapest && cheapest->half ? "half" : "float", error <= bound ? "" : "  NOT KEPT");
                std::fflush(stdout);
            }
        }
    std::printf("kept in %d of %d, at most 1.5 times the cheapest in %d of %d (worst %.2f)\n", kept, all,
                cheap, compared, worstRatio);
}

}  // namespace

int main(int count, char** arguments) {
    try {
        run({arguments + 1, arguments + count});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_tolerance: %s\n", error.what());
        return 1;
    }
    return 0;
}
