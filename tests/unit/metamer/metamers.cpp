// Metamers of the ColorChecker, the solver behind them, and the CIE's indices.
#include "metamer/metamers.h"

#include "metamer/box_quadratic.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace spectrad;
using Catch::Contains;

namespace {

const Library& library() {
    static const Library shared = Library::open();
    return shared;
}

Curve curveOf(const std::string& name) {
    return library().find(name).value().curve();
}

Viewing viewing(const std::string& light, const std::string& observer = "observers/cie1931-2") {
    return {light, curveOf("illuminants/" + light), detectorFrom(library().find(observer).value()),
            standardObserver(library())};
}

MetamerSettings defaults() {
    MetamerSettings settings;
    for (double nm = 380; nm <= 780; nm += 5)
        settings.nm.push_back(nm);
    return settings;
}

}  // namespace

TEST_CASE("A quadratic programme stops at the box where its minimum lies outside, and stays on its plane") {
    // Minimise (x − 2)² + (y − 0.5)² + (z − 0.2)² in [0, 1]³ on x + y + z = 1.2: x runs into its bound, the
    // others share the rest.
    BoxQuadratic problem{{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {-4, -1, -0.4}, {{1, 1, 1}}, {1.2}, 0, 1};
    const BoxSolution solution = minimise(problem);
    CHECK(solution.x[0] == Approx(1).margin(1e-7));
    CHECK(solution.x[1] == Approx(0.2).margin(1e-7));
    CHECK(solution.x[2] == Approx(0).margin(1e-7));
    CHECK(solution.largestMiss < 1e-8);
}

TEST_CASE("Weights on nodes are the exact signals of reflectances that are linear between them") {
    const Viewing under = viewing("FL11");
    const std::vector<double> nm{380, 450, 500, 590, 780}, value{0.1, 0.9, 0.3, 0.6, 0.2};
    const std::vector<double> exact = under.signals(Curve::table(nm, value, Outside::hold));
    const auto weights = under.weights(nm);
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (size_t j = 0; j < nm.size(); ++j)
            sum += weights[c][j] * value[j];
        CHECK(sum == Approx(exact[c]).epsilon(1e-10));
    }
    CHECK(under.xyz(Curve::constant(1))[1] == Approx(1).epsilon(1e-12));
}

TEST_CASE("A lamp of lines gives its weight once, wherever its lines lie on the wavelengths") {
    const std::vector<double> nm{450, 500, 550, 600}, value{0.2, 0.9, 0.3, 0.6};
    for (const double at : {440.0, 450.0, 470.0, 500.0, 600.0, 630.0}) {
        const Viewing under("line", Curve::line(at),
                            detectorFrom(library().find("observers/cie1931-2").value()),
                            standardObserver(library()));
        const std::vector<double> exact = under.signals(Curve::table(nm, value, Outside::hold));
        const auto weights = under.weights(nm);
        INFO(at << " nm");
        for (size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (size_t j = 0; j < nm.size(); ++j)
                sum += weights[c][j] * value[j];
            CHECK(sum == Approx(exact[c]).epsilon(1e-12));
        }
    }
}

TEST_CASE("Every patch of the ColorChecker gets five metamers within 0 and 1 that match under D65") {
    const Spectrum chart = library().find("charts/colorchecker").value();
    const std::vector<Viewing> match{viewing("D65")}, differ{viewing("A")};
    const MetamerSettings settings = defaults();
    double largest = 0, least = 1e9;
    std::string report;
    for (size_t p = 0; p < chart.curves.size(); ++p) {
        const std::vector<Metamer> metamers =
            makeMetamers(chart.curves[p].withOutside(Outside::hold), match, differ, settings);
        REQUIRE(metamers.size() == 5);
        double most = 0;
        for (const Metamer& metamer : metamers) {
            CHECK(*std::min_element(metamer.value.begin(), metamer.value.end()) >= 0);
            CHECK(*std::max_element(metamer.value.begin(), metamer.value.end()) <= 1);
            CHECK(metamer.matched[0] < 0.01);
            most = std::max(most, metamer.differing[0]);
        }
        report += chart.channels[p] + " " + std::to_string(most) + "\n";
        largest = std::max(largest, most);
        least = std::min(least, most);
    }
    WARN("largest difference under A by patch (CIEDE2000):\n" << report);
    CHECK(largest > 8);
    CHECK(least > 1);  // even of black, whose reflectance is near a bound
}

TEST_CASE("Smoothness is obeyed: rougher spectra differ more") {
    const Curve patch = curveOf("charts/colorchecker/foliage").withOutside(Outside::hold);
    const std::vector<Viewing> match{viewing("D65")}, differ{viewing("A")};
    MetamerSettings rough = defaults(), smooth = defaults();
    rough.smoothness = 0.1;
    smooth.smoothness = 100;
    rough.count = smooth.count = 1;
    const auto bend = [](const Metamer& m) {
        double sum = 0;
        for (size_t j = 1; j + 1 < m.value.size(); ++j)
            sum += std::pow(m.value[j - 1] - 2 * m.value[j] + m.value[j + 1], 2);
        return sum;
    };
    const Metamer a = makeMetamers(patch, match, differ, rough)[0],
                  b = makeMetamers(patch, match, differ, smooth)[0];
    CHECK(bend(a) > 4 * bend(b));
    CHECK(a.differing[0] > b.differing[0]);
}

TEST_CASE("Two lights and two observers can be matched at once, and a camera set apart") {
    const Curve patch = curveOf("charts/colorchecker/moderate-red").withOutside(Outside::hold);
    const std::vector<Viewing> match{viewing("D65"), viewing("A"), viewing("D65", "observers/cie1964-10")};
    const std::vector<Viewing> differ{viewing("D65", "cameras/nikon-5100")};
    MetamerSettings settings = defaults();
    settings.smoothness = 0.05;
    for (const Metamer& metamer : makeMetamers(patch, match, differ, settings)) {
        for (const double e : metamer.matched)
            CHECK(e < 0.01);
        CHECK(metamer.differing[0] > 0.3);
    }
}

TEST_CASE("Bounds that leave no match are refused") {
    MetamerSettings settings = defaults();
    settings.high = 0.1;
    CHECK_THROWS_WITH(
        makeMetamers(curveOf("charts/colorchecker/white"), {viewing("D65")}, {viewing("A")}, settings),
        Contains("no reflectance from 0 to 0.1"));
}

TEST_CASE("The special metamerism index is zero for equals and takes proportional differences out") {
    const Viewing reference = viewing("D65"), test = viewing("A");
    const Curve patch = curveOf("charts/colorchecker/foliage").withOutside(Outside::hold);
    CHECK(specialMetamerismIndex(reference, test, patch, patch).deltaE76 == 0);
    // A lighter copy differs by one factor everywhere: all of it is there under the reference already.
    const MetamerismIndex scaled = specialMetamerismIndex(reference, test, patch, patch.scaled(1.3));
    CHECK(scaled.deltaE76 < 1e-9);
    // A true pair has as its index the difference itself.
    const MetamerSettings settings = defaults();
    const Metamer metamer = makeMetamers(patch, {reference}, {test}, settings)[0];
    const Curve other = metamer.curve(settings.nm);
    CHECK(specialMetamerismIndex(reference, test, patch, other).deltaE00 ==
          Approx(metamer.differing[0]).margin(0.01));
}
