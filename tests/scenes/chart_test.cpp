// A ColorChecker seen head-on under a directional lamp: reflectance × irradiance / π, band by band.
#include "scenes/measured.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

constexpr int columns = 6, rows = 4, patchPixels = 10;
constexpr double irradiance = 100;  // W/m²

std::string chartScene(const Table& chart, const std::string& lamp) {
    std::string text = "<scene version=\"1\">\n";
    for (const std::string& patch : chart.columns)
        text += fmt::format(
            "<material name=\"{0}\"><diffuse reflectance=\"charts/colorchecker/{0}\"/></material>\n", patch);
    for (int i = 0; i < columns * rows; ++i)
        text += fmt::format("<node translate=\"{} {} 0\"><plane size=\"1 1\" material=\"{}\"/></node>\n",
                            i % columns - 2.5, 1.5 - i / columns, chart.columns[static_cast<size_t>(i)]);
    return text +
           fmt::format(
               "<light type=\"directional\" direction=\"0 0 -1\" spectrum=\"{}\" irradiance=\"{} W/m2\"/>\n"
               "<camera type=\"orthographic\" height=\"4\" look-from=\"0 0 5\" look-at=\"0 0 0\" "
               "size=\"{}x{}\"/>\n</scene>",
               lamp, irradiance, columns * patchPixels, rows * patchPixels);
}

Polyline lampCurve(const std::string& lamp) {
    if (lamp == "line:546.1,0.01") return {{546.1 - 0.005, 546.1 + 0.005}, {100, 100}};
    return measuredTable(lamp).curves.front();
}

/// Every pixel of a patch against the closed form. A value below 1e-6 of the patch's peak is held to 1e-6 ×
/// 1e-5 of that peak at least, since floats of a sum cannot do better: the scale of its error never falls
/// below 1e-6 of the peak.
Worst compare(const Image& image, const Table& chart, const Polyline& lamp) {
    const double factor = irradiance / static_cast<double>(integral(lamp)) / std::numbers::pi;
    Worst worst;
    std::vector<double> expected(image.wavelengths.size());
    for (int patch = 0; patch < columns * rows; ++patch) {
        Polyline reflectance = chart.curves[static_cast<size_t>(patch)];
        reflectance.held = true;
        for (size_t band = 0; band < expected.size(); ++band)
            expected[band] = factor * bandValue(lamp, reflectance, image.wavelengths, band);
        const double least = 1e-6 * *std::max_element(expected.begin(), expected.end());
        const int left = patch % columns * patchPixels, top = patch / columns * patchPixels;
        for (int y = top; y < top + patchPixels; ++y)
            for (size_t band = 0; band < expected.size(); ++band)
                for (int x = left; x < left + patchPixels; ++x)
                    worst.add(image.at(x, y, band), expected[band], std::max(expected[band], least), x, y,
                              band);
    }
    return worst;
}

}  // namespace

TEST_CASE("every band of 24 patches under any lamp, on any grid, is the closed form to 1e-5") {
    if (!haveDevice()) return;
    const Table chart = measuredTable("charts/colorchecker");
    REQUIRE(chart.columns.size() == columns * rows);
    const std::pair<const char*, const char*> grids[] = {
        {"5 nm", "380:780:5"},
        {"10 nm", "380:780:10"},
        {"irregular",
         "381.5 390 397.2 404.66 420 435.83 436 460 480.1 500 540 546.07 546.1 546.13 550 577 579.1 600 611 "
         "640 700.5 772"},
        {"one band", "546"},
        {"1 nm", "380:780:1"}};
    double largest = 0;
    for (const std::string lamp : {"illuminants/A", "illuminants/D65", "illuminants/FL2", "illuminants/FL11",
                                   "illuminants/FL12", "illuminants/LED-B3", "line:546.1,0.01"}) {
        const Scene scene = sceneFrom(chartScene(chart, lamp));
        const Polyline curve = lampCurve(lamp);
        for (const auto& [gridName, grid] : grids) {
            for (const Projection projection : {Projection::slit, Projection::box, Projection::point}) {
                RenderSettings settings;
                settings.wavelengths = parseWavelengths(grid, {});
                settings.projection = projection;
                settings.samples = 1;
                const Worst worst = compare(imageOf(scene, settings), chart, curve);
                INFO(lamp << ", " << gridName << ", " << name(projection) << ": " << worst.str());
                CHECK(worst.error <= 1e-5);
                largest = std::max(largest, worst.error);
            }
        }
    }
    WARN(fmt::format("105 charts: largest relative error of a band {:.2g}", largest));
}
