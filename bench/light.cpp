// Lighting: g of every sample of a wall that fills a 1920x1080 image, Lambert and coated, under 1, 4 and 16
// lights of one spectrum.
#include "base/files.h"
#include "measure.h"
#include "render/stages.h"
#include "scene/load.h"
#include "spectrum/library.h"

#include <cstdio>
#include <filesystem>
#include <unistd.h>

using namespace spectrad;

namespace {

constexpr int width = 1920, height = 1080, samples = 4;

std::string wall(bool coated, int lights) {
    std::string text = fmt::format(R"(<scene version="1" unit="m">
<wavelengths from="380" to="780" step="5"/>
<material name="paint"><diffuse reflectance="constant:0.5"/>{}</material>
<node name="wall"><plane size="20 20" material="paint"/></node>
<camera name="eye" type="perspective" fov="40" look-from="0 0 4" look-at="0 0 0" size="{}x{}"/>
)",
                                   coated ? R"(<gloss ior="1.5" roughness="0.3"/>)" : "", width, height);
    for (int i = 0; i < lights; ++i)
        text += fmt::format(
            "<light name=\"l{}\" type=\"point\" position=\"{} {} 3\" spectrum=\"illuminants/D65\" "
            "intensity=\"100 cd\"/>\n",
            i, i % 4 - 1.5, i / 4 - 1.5);
    return text + "</scene>\n";
}

void run(int rounds) {
    const Device device = Device::open(std::nullopt);
    const Library library = Library::open();
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / fmt::format("spectrad-bench-{}.xml", getpid());
    fmt::print("device: {}; {} x {} pixels, {} samples each\n", device.info().name, width, height, samples);
    fmt::print("{:8} {:>6} |{:>12} {:>9} | M samples/s | M (sample, light)/s | in times of one light's\n",
               "material", "lights", "lighting ms", "cover ms");
    for (bool coated : {false, true}) {
        double one = 0;
        for (int lights : {1, 4, 16}) {
            writeFile(file, wall(coated, lights));
            Notes notes;
            RenderSettings settings;
            settings.size = {width, height};
            settings.samples = samples;
            const Plan plan = makePlan(loadScene(file, library, {}, notes), settings, library, notes);
            std::filesystem::remove(file);
            Stages stages(device, plan, lanePattern(plan.samples, device.body().vectorWidth()));
            stages.transform();
            const auto cover = [&] { stages.cover(0, height), device.body().queue.finish(); };
            const auto all = [&] { stages.light(0, height), device.body().queue.finish(); };
            const std::vector<bench::Times> times = bench::inTurn({cover, all}, rounds);
            const double seconds = times[1].typical() - times[0].typical();
            if (lights == 1) one = seconds;
            const double lit = static_cast<double>(width) * height * samples;
            fmt::print("{:8} {:6} |{:12.1f} {:9.1f} |{:12.0f} |{:20.0f} | {:.2f}\n",
                       coated ? "coated" : "Lambert", lights, seconds * 1e3, times[0].typical() * 1e3,
                       lit / seconds * 1e-6, lit * lights / seconds * 1e-6, seconds / one);
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported([&] { run(bench::roundsFrom(argc, argv)); });
}
