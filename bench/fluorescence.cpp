// What fluorescence costs per pixel: a chart of 24 paints rendered plain, with one fluorescent paint, and
// with all of them fluorescent, measured in turn. Light factors, so that nothing is to be paid.
#include "base/files.h"
#include "measure.h"
#include "renders.h"
#include "scene/load.h"
#include "spectrum/library.h"

#include <cstdio>
#include <filesystem>
#include <unistd.h>

using namespace spectrad;

namespace {

constexpr int columns = 6, patches = 24;

/// The first `glowing` of the patches are fluorescent.
std::string chart(int glowing) {
    std::string text = "<scene version=\"1\"><wavelengths from=\"380\" to=\"780\" step=\"5\"/>\n";
    for (int i = 0; i < patches; ++i) {
        text += fmt::format("<material name=\"m{}\"><diffuse reflectance=\"400:{} 700:{}\"/>", i, 0.03 * i,
                            0.9 - 0.03 * i);
        if (i < glowing)
            text +=
                R"(<fluorescence excitation="fluorophores/yellow" emission="fluorophores/yellow" yield="0.8"/>)";
        text += fmt::format("</material><node translate=\"{} {} 0\"><plane material=\"m{}\"/></node>\n",
                            i % columns - 2.5, i / columns - 1.5, i);
    }
    return text + R"(<light type="point" position="0 0 5" spectrum="illuminants/D65" intensity="800 cd"/>
<light type="directional" direction="0.2 0 -1" spectrum="lamps/uv-365" irradiance="1 W/m2"/>
<camera type="orthographic" height="3.9" look-from="0 0 5" look-at="0 0 0" size="960x624"/></scene>)";
}

void run(int rounds) {
    const Device device = Device::open(std::nullopt);
    const Library library = Library::open();
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / fmt::format("spectrad-bench-{}.xml", getpid());
    std::vector<Plan> plans;
    for (int glowing : {0, 1, patches}) {
        writeFile(file, chart(glowing));
        Notes notes;
        plans.push_back(makePlan(loadScene(file, library, {}, notes), {}, library, notes));
    }
    std::filesystem::remove(file);
    const std::vector<bench::Times> times = bench::inTurn(bench::rendersOf(device, plans), rounds);
    fmt::print("device: {}; {} x {} pixels, {} bands, {} samples a pixel, {} patches\n", device.info().name,
               plans[0].view.width, plans[0].view.height, plans[0].terms.bands, plans[0].samples, patches);
    fmt::print("{:>11} |{:>6} {:>11} | {}\n", "fluorescent", "terms", "render ms",
               "in times of the plain chart's (median of rounds, best, work)");
    for (size_t i = 0; i < plans.size(); ++i) {
        const bench::Ratio r = bench::ratio(times[0], times[i]);
        fmt::print("{:11} |{:6} {:11.1f} | {:.3f} {:.3f} {:.3f}\n",
                   i == 0   ? 0
                   : i == 1 ? 1
                            : patches,
                   plans[i].terms.count(), times[i].typical() * 1e3, r.typical, r.best, r.work);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported([&] { run(bench::roundsFrom(argc, argv)); });
}
