// What has been published of spectral sampling, on the 24 patches of the ColorChecker and the library's
// lamps. Colours are seen against the same method's own white.
#include "colour/colour.h"
#include "colour/detector.h"
#include "spectrum/library.h"
#include "spectrum/projection.h"
#include "study/three_channels.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <functional>

using namespace spectrad;

namespace {

struct Errors {
    double mean = 0, max = 0;
};

struct Chart {
    Library library = Library::open();
    Detector observer = standardObserver(library);
    std::vector<Curve> patch;
    Chart() {
        for (const std::string& name : library.names())
            if (name.starts_with("charts/colorchecker/"))
                patch.push_back(library.find(name)->curve().withOutside(Outside::hold));
    }
    [[nodiscard]] Curve lamp(const std::string& name) const {
        return library.find("illuminants/" + name)->curve();
    }
    [[nodiscard]] Triple exact(const Curve& light, const Curve& paint) const {
        const std::array<const Curve*, 2> product{&light, &paint};
        return respondXyz(observer, product);
    }
    /// ΔE00 of a method's XYZ of (light, paint) over the patches.
    [[nodiscard]] Errors errors(const Curve& light,
                                const std::function<Triple(const Curve&, const Curve&)>& method) const {
        const auto against = [](Triple xyz, const Triple& white) {
            for (double& v : xyz)
                v *= 100 / white[1];
            return lab(xyz, {white[0] * 100 / white[1], 100, white[2] * 100 / white[1]});
        };
        const Curve one = Curve::constant(1);
        const Triple right = exact(light, one), own = method(light, one);
        Errors e;
        for (const Curve& paint : patch) {
            const double d =
                deltaE00(against(exact(light, paint), right), against(method(light, paint), own));
            e.mean += d / static_cast<double>(patch.size());
            e.max = std::max(e.max, d);
        }
        return e;
    }
};

Wavelengths grid(double from, double to, double step, Projection projection) {
    Wavelengths w = regularWavelengths(from, to, step, {});
    w.projection = projection;
    return w;
}

/// Bands of light × paint, then a weight for each band and channel.
std::function<Triple(const Curve&, const Curve&)> byBands(const Wavelengths& on,
                                                          const DetectorWeights& weights) {
    return [on, weights](const Curve& light, const Curve& paint) {
        const std::array<const Curve*, 2> product{&light, &paint};
        const std::vector<double> bands = project(on, product);
        Triple xyz{};
        for (size_t c = 0; c < 3; ++c)
            for (size_t b = 0; b < bands.size(); ++b)
                xyz[c] += weights.weights[c][b] * bands[b];
        return xyz;
    };
}

}  // namespace

TEST_CASE(
    "41 bands under FL11: points are off by about 4, slits with point weights 0.2 to 0.3, with projected "
    "ones 0.03") {
    const Chart chart;
    REQUIRE(chart.patch.size() == 24);
    const Wavelengths slit = grid(380, 780, 10, Projection::slit),
                      point = grid(380, 780, 10, Projection::point);
    const Curve light = chart.lamp("FL11");
    const Errors points = chart.errors(light, byBands(point, weightsOn(point, chart.observer)));
    const Errors sampled = chart.errors(light, byBands(slit, weightsOn(point, chart.observer)));
    const Errors projected = chart.errors(light, byBands(slit, weightsOn(slit, chart.observer)));
    CHECK(points.max == Approx(4).margin(1));
    CHECK(sampled.max > 0.15);
    CHECK(sampled.max < 0.35);
    CHECK(projected.max < 0.05);
}

TEST_CASE("smooth lamps need about ten points for a mean below 0.5") {
    const Chart chart;
    for (const char* lamp : {"A", "D65"}) {
        CAPTURE(lamp);
        const auto points = [&](int count) {
            const Wavelengths on = grid(400, 700, 300.0 / (count - 1), Projection::point);
            return chart.errors(chart.lamp(lamp), byBands(on, weightsOn(on, chart.observer))).mean;
        };
        CHECK(points(11) < 0.5);
        CHECK(points(6) > 0.5);
    }
}

TEST_CASE("RGB under A is off by a mean of about 4 and up to 12") {
    const Chart chart;
    const auto rgb = [&](const Curve& light, const Curve& paint) {
        Scene scene;
        scene.materials.resize(1);
        scene.materials[0].diffuse.emplace();
        scene.materials[0].diffuse->reflectance.emplace();
        scene.materials[0].diffuse->reflectance->curves = {paint};
        scene.lights.resize(1);
        scene.lights[0].emitter.spectrum.curves = {light};
        const auto told = inThreeChannels(scene, ThreeChannels::rgb, chart.observer, chart.library).value();
        Triple xyz{};
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < 3; ++k)
                xyz[c] += told.weights.weights[c][k] *
                          told.scene.lights[0].emitter.spectrum.curve().at(told.channels.nm[k]) *
                          told.scene.materials[0].diffuse->reflectance->curve().at(told.channels.nm[k]);
        return xyz;
    };
    const Errors e = chart.errors(chart.lamp("A"), rgb);
    CHECK(e.mean == Approx(4).margin(1));
    CHECK(e.max == Approx(12).margin(2));
    CHECK(chart.errors(chart.lamp("D65"), rgb).mean < 0.5);
}
