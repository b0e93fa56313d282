// Cubes against detectors and back: least-squares projection on the hats (docs/design.md, "What a band value
// means").
#include "spectrum/library.h"
#include "spectrum/mass_matrix.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace spectrad;

namespace {

std::vector<double> projected(const Wavelengths& grid, const Curve& curve) {
    const Curve* factor = &curve;
    return project(grid, {&factor, 1});
}

double seen(const std::vector<double>& weights, const std::vector<double>& values) {
    double sum = 0;
    for (size_t j = 0; j < values.size(); ++j)
        sum += weights[j] * values[j];
    return sum;
}

double exact(const Curve& a, const Curve& b, double from, double to) {
    const Curve* factors[] = {&a, &b};
    return integrate(factors, from, to);
}

std::vector<double> randomValues(size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0, 1);
    std::vector<double> result(count);
    for (double& v : result)
        v = value(random);
    return result;
}

const std::vector<Wavelengths>& grids() {
    static const std::vector<Wavelengths> all{
        regularWavelengths(380, 780, 5, {}), regularWavelengths(380, 780, 20, {}),
        Wavelengths{{400, 700}, Projection::slit, 5},
        Wavelengths{{380, 381.5, 400, 420, 422, 500.25, 640, 780}, Projection::slit, 5},
        regularWavelengths(100, 10'099, 1, {})};
    return all;
}

}  // namespace

TEST_CASE("What is linear between the wavelengths comes back exactly from its bands") {
    for (const Wavelengths& grid : grids()) {
        const auto nodal = randomValues(grid.size(), 17);
        const auto back = nodalValues(grid, projected(grid, Curve::table(grid.nm, nodal)));
        // A double near 10 000 nm tells 1e-12 nm apart: so well is a place inside a 1 nm band known there.
        const double tolerance = grid.nm.back() > 5000 ? 1e-11 : 1e-12;
        double worst = 0;
        for (size_t j = 0; j < grid.size(); ++j)
            worst = std::max(worst, std::abs(back[j] - nodal[j]));
        CHECK(worst <= tolerance);
    }
}

TEST_CASE("Box and point values and a single band's come back as they are") {
    const auto values = randomValues(3, 1);
    CHECK(nodalValues({{400, 410, 440}, Projection::box, 5}, values) == values);
    CHECK(nodalValues({{400, 410, 440}, Projection::point, 5}, values) == values);
    CHECK(nodalValues({{400}, Projection::slit, 5}, std::vector{0.7}) == std::vector{0.7});
}

TEST_CASE("A spectrum that is linear between the bands is seen exactly by any detector") {
    const Curve detector = Curve::gaussian(550, 33);
    for (const Wavelengths& grid : grids()) {
        const Curve light = Curve::table(grid.nm, randomValues(grid.size(), 23));
        CHECK(seen(detectorWeights(grid, detector), projected(grid, light)) ==
              Approx(exact(light, detector, grid.nm.front(), grid.nm.back())).epsilon(1e-12));
    }
}

TEST_CASE("A detector that is linear between the bands sees any spectrum exactly, lines included") {
    for (const Wavelengths& grid : grids()) {
        const Curve detector = Curve::table(grid.nm, randomValues(grid.size(), 29));
        const auto weights = detectorWeights(grid, detector);
        for (const Curve& light :
             {Curve::gaussian(546, 3), Curve::blackbody(2856), Curve::rectangle(632.8, 0.01)})
            CHECK(seen(weights, projected(grid, light)) ==
                  Approx(exact(light, detector, grid.nm.front(), grid.nm.back())).epsilon(1e-11));
        CHECK(seen(weights, projected(grid, Curve::line(632.8))) ==
              Approx(detector.at(632.8)).epsilon(1e-11));
    }
}

TEST_CASE("A flat detector measures all the light on the grid, in every projection") {
    const Curve flat = Curve::constant(1), light = Curve::gaussian(550, 80);
    for (Projection projection : {Projection::slit, Projection::box}) {
        Wavelengths grid = regularWavelengths(380, 780, 10, {});
        grid.projection = projection;
        CHECK(seen(detectorWeights(grid, flat), projected(grid, light)) ==
              Approx(exact(light, flat, 380, 780)).epsilon(1e-12));
    }
    Wavelengths points = regularWavelengths(380, 780, 10, {});
    points.projection = Projection::point;
    const auto weights = detectorWeights(points, flat);
    CHECK(weights.front() == 5);
    CHECK(weights[1] == 10);
    CHECK(weights.back() == 5);
}

TEST_CASE("A detector's range beyond the grid is cut") {
    const Wavelengths grid = regularWavelengths(500, 600, 10, {});
    const Curve wide = Curve::table({300, 500, 600, 900}, {9, 1, 1, 9});
    CHECK(seen(detectorWeights(grid, wide), projected(grid, Curve::constant(1))) ==
          Approx(100).epsilon(1e-12));
}

TEST_CASE("A single band weighs a laser line at its wavelength as the detector does") {
    const Curve detector = Curve::table({500, 700}, {0.2, 0.6});
    const Wavelengths hat{{632.8}, Projection::slit, 5};
    CHECK(seen(detectorWeights(hat, detector), projected(hat, Curve::line(632.8, 3))) ==
          Approx(3 * detector.at(632.8)).epsilon(1e-12));
    const Wavelengths box{{632.8}, Projection::box, 5};
    CHECK(seen(detectorWeights(box, detector), projected(box, Curve::line(632.8, 3))) ==
          Approx(3 * detector.at(632.8)).epsilon(1e-12));
    CHECK(detectorWeights({{632.8}, Projection::point, 5}, detector)[0] == Approx(5 * detector.at(632.8)));
}

TEST_CASE("The mass matrix is that of hats") {
    // Two hats over one interval of width d: d/6 · [2 1; 1 2], so moments (d/2, d/2) mean 1 at both nodes.
    std::vector<double> moments{5, 5};
    MassMatrix(std::vector<double>{400, 410}).solve(moments);
    CHECK(moments[0] == Approx(1));
    CHECK(moments[1] == Approx(1));
}

TEST_CASE("Bands of 5 and 10 nm see a lamp with lines within two thousandths") {
    const Library library(std::filesystem::path(SPECTRAD_SOURCE) / "spectra");
    const auto lamp = library.find("illuminants/FL11"), observer = library.find("observers/cie1931-2");
    REQUIRE(lamp);
    REQUIRE(observer);
    for (double step : {5.0, 10.0}) {
        const Wavelengths grid = regularWavelengths(380, 780, step, {});
        const auto values = projected(grid, lamp->curve());
        for (size_t channel = 0; channel < 3; ++channel) {
            const Curve& matching = observer->curves[channel];
            const double truth = exact(lamp->curve(), matching, 380, 780);
            CHECK(seen(detectorWeights(grid, matching), values) ==
                  Approx(truth).epsilon(step == 5 ? 5e-4 : 2e-3));
        }
    }
}
