// Colours of few bands: 24 patches under every lamp of the library, by projected detectors, against
// integration between all samples of lamp, patch and observer.
#include "colour/colour.h"
#include "colour/detector.h"
#include "scenes/measured.h"
#include "scenes/scene_image.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

using namespace spectrad;
using namespace spectrad::test;

namespace {

constexpr std::array<std::pair<double, double>, 3> bounds{{{5, 0.02}, {10, 0.05}, {20, 0.15}}};  // nm, ΔE00
constexpr double fromNm = 380, toNm = 780;  // what lies beyond is the range's matter, not the bands'

/// Narrow lines where the observer's functions bend most (violet LEDs at 410 nm, sodium at 590 nm, mercury at
/// 436 nm): four lamps in bands as wide as that need more. nm of the grid, name, ΔE00.
struct Exception {
    double step;
    const char* lamp;
    double bound;
};
constexpr std::array<Exception, 4> exceptions{{{10, "illuminants/FL3.2", 0.055},
                                               {20, "illuminants/HP1", 0.16},
                                               {20, "illuminants/LED-V1", 0.34},
                                               {20, "illuminants/LED-V2", 0.25}}};

double boundFor(const std::string& lamp, double step, double bound) {
    for (const Exception& e : exceptions)
        if (e.step == step && lamp == e.lamp) return e.bound;
    return bound;
}

/// Lab of every patch against the lamp's own white.
using Colours = std::vector<Triple>;
Colours coloursOf(const std::vector<Triple>& xyz) {  // the white last
    Colours colours;
    for (size_t i = 0; i + 1 < xyz.size(); ++i)
        colours.push_back(lab(xyz[i], xyz.back()));
    return colours;
}

Colours exactColours(const Polyline& lamp, const std::vector<Polyline>& patches, const Table& observer) {
    std::vector<Triple> xyz;
    for (const Polyline& patch : patches) {
        Triple t{};
        for (size_t c = 0; c < 3; ++c)
            t[c] = static_cast<double>(integral({&lamp, &patch, &observer.curves[c]}, fromNm, toNm));
        xyz.push_back(t);
    }
    return coloursOf(xyz);
}

Colours bandColours(const Curve& lamp, const std::vector<Curve>& patches, const Wavelengths& grid,
                    const DetectorWeights& weights) {
    std::vector<Triple> xyz;
    for (const Curve& patch : patches) {
        const std::array<const Curve*, 2> product{&lamp, &patch};
        const std::vector<double> bands = project(grid, product);
        Triple t{};
        for (size_t c = 0; c < 3; ++c)
            for (size_t j = 0; j < bands.size(); ++j)
                t[c] += weights.weights[c][j] * bands[j];
        xyz.push_back(t);
    }
    return coloursOf(xyz);
}

double largestDifference(const Colours& a, const Colours& b) {
    double largest = 0;
    for (size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, deltaE00(a[i], b[i]));
    return largest;
}

struct Chart {
    std::vector<Polyline> measured;
    std::vector<Curve> curves;
};
/// The 24 patches, and white.
Chart chartAndWhite() {
    Chart chart;
    const Table table = measuredTable("charts/colorchecker");
    for (size_t i = 0; i < table.columns.size(); ++i) {
        chart.measured.push_back(table.curves[i]);
        chart.measured.back().held = true;
        chart.curves.push_back(library()
                                   .find("charts/colorchecker/" + table.columns[i])
                                   .value()
                                   .curve()
                                   .withOutside(Outside::hold));
    }
    chart.measured.push_back({{fromNm, toNm}, {1, 1}, true});
    chart.curves.push_back(Curve::constant(1));
    return chart;
}

}  // namespace

TEST_CASE(
    "slit cubes give the colours of 24 patches within 0.02, 0.05 and 0.15 ΔE00 at 5, 10 and 20 nm under all "
    "lamps but four") {
    const Chart chart = chartAndWhite();
    const Table observer = measuredTable("observers/cie1931-2");
    const Detector detector = standardObserver(library());
    std::map<std::pair<Projection, double>, std::pair<double, std::string>> largest;
    double pointUnderFl11 = 0;
    for (const std::string& lampName : measuredNames("illuminants")) {
        const Colours exact = exactColours(measuredTable(lampName).curves.front(), chart.measured, observer);
        const Curve lamp = library().find(lampName).value().curve().withOutside(Outside::zero);
        for (const auto& [step, bound] : bounds) {
            for (const Projection projection : {Projection::slit, Projection::point}) {
                Wavelengths grid = regularWavelengths(380, 780, step, {});
                grid.projection = projection;
                const double difference = largestDifference(
                    exact, bandColours(lamp, chart.curves, grid, weightsOn(grid, detector)));
                auto& record = largest[{projection, step}];
                if (difference > record.first) record = {difference, lampName};
                if (projection == Projection::point && step == 10 && lampName == "illuminants/FL11")
                    pointUnderFl11 = difference;
                if (projection != Projection::slit) continue;
                INFO(lampName << " at " << step << " nm: " << difference);
                CHECK(difference <= boundFor(lampName, step, bound));
            }
        }
    }
    for (const auto& [key, record] : largest)
        WARN(fmt::format("{:5} {:2} nm: largest ΔE00 {:.3f} under {}", name(key.first), key.second,
                         record.first, record.second));
    // What the projection is there for.
    CHECK(pointUnderFl11 > 1);
}

TEST_CASE("the colours of a rendered chart are those of its bands") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(R"(<scene version="1">
  <wavelengths from="380" to="780" step="10"/>
  <material name="red"><diffuse reflectance="charts/colorchecker/red"/></material>
  <plane size="2 2" material="red"/>
  <light type="directional" direction="0 0 -1" spectrum="illuminants/FL11" irradiance="10 W/m2"/>
  <camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="4x4"/>
</scene>)");
    const Image image = imageOf(scene);
    const Polyline lamp = measuredTable("illuminants/FL11").curves.front();
    const Table chart = measuredTable("charts/colorchecker"), observer = measuredTable("observers/cie1931-2");
    Polyline red = chart.curves[static_cast<size_t>(
        std::find(chart.columns.begin(), chart.columns.end(), "red") - chart.columns.begin())];
    red.held = true;
    const DetectorWeights weights = weightsOn(image.wavelengths, standardObserver(library()));
    Triple rendered{}, exact{}, white{};
    const double factor = 10 / static_cast<double>(integral(lamp)) * luminousEfficacy;
    for (size_t c = 0; c < 3; ++c) {
        for (size_t j = 0; j < image.wavelengths.size(); ++j)
            rendered[c] += weights.weights[c][j] * image.at(2, 1, j) * 3.14159265358979;
        exact[c] = factor * static_cast<double>(integral({&lamp, &red, &observer.curves[c]}, fromNm, toNm));
        white[c] = factor * static_cast<double>(integral({&lamp, &observer.curves[c]}, fromNm, toNm));
    }
    CHECK(deltaE00(lab(rendered, white), lab(exact, white)) < 0.05);
}
