// Band values: exact averages of products, whatever the grid, the number of bands and the narrowness of
// lines.
#include "spectrum/projection.h"

#include "base/error.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

using namespace spectrad;

namespace {

std::vector<double> projected(const Wavelengths& grid, const Curve& a) {
    const Curve* factors[] = {&a};
    return project(grid, factors);
}
std::vector<double> projected(const Wavelengths& grid, const Curve& a, const Curve& b) {
    const Curve* factors[] = {&a, &b};
    return project(grid, factors);
}

Wavelengths regular(double from, double to, double step, Projection projection = Projection::slit) {
    Wavelengths grid = regularWavelengths(from, to, step, {});
    grid.projection = projection;
    return grid;
}

Curve randomTable(std::mt19937& random, double from, double to, size_t samples) {
    std::uniform_real_distribution<double> place(from, to), value(0, 1);
    std::vector<double> nm(samples), values(samples);
    for (double& x : nm)
        x = place(random);
    for (double& x : values)
        x = value(random);
    std::sort(nm.begin(), nm.end());
    return Curve::table(nm, values);
}

/// Σ band × area: what the bands together hold.
double total(const Wavelengths& grid, const std::vector<double>& values) {
    double sum = 0;
    for (size_t j = 0; j < values.size(); ++j)
        sum += values[j] * band(grid, j).area();
    return sum;
}

/// The average of a · b under a band by Simpson's rule, exact for cubics, on every segment between the
/// samples: another rule and another order of summation than the code under test.
double averageBySimpson(const Curve& a, const Curve& b, const Band& band) {
    std::vector<double> knots{band.from, band.nm, band.to};
    for (const Curve* curve : {&a, &b})
        for (double nm : curve->sampleWavelengths())
            if (nm > band.from && nm < band.to) knots.push_back(nm);
    std::sort(knots.begin(), knots.end());
    long double sum = 0;
    for (size_t i = 0; i + 1 < knots.size(); ++i) {
        const double u = knots[i], v = knots[i + 1], width = v - u;
        if (width <= 0) continue;
        // Values at the ends are those inside the segment, so that jumps at a table's ends do not count;
        // lines through two inner points give them.
        const auto inner = [&](const Curve& c, double t) {
            const long double p = c.at(u + 0.25 * width), q = c.at(u + 0.75 * width);
            return p + (q - p) * 2 * (static_cast<long double>(t) - 0.25L);
        };
        const auto f = [&](double t) { return inner(a, t) * inner(b, t) * band.weight(u + t * width); };
        sum += width / 6.0L * (f(0) + 4 * f(0.5) + f(1));
    }
    return static_cast<double>(sum) / band.area();
}

}  // namespace

TEST_CASE("Hat and box averages of products of tables are exact") {
    std::mt19937 random(7);
    const Curve lamp = randomTable(random, 385, 790, 300), paint = randomTable(random, 370, 700, 37);
    const Wavelengths uneven{{380, 381.5, 400, 420, 422, 500.25, 640, 780}, Projection::slit, 5};
    for (Projection projection : {Projection::slit, Projection::box})
        for (Wavelengths grid : {regular(380, 780, 5), regular(400, 700, 0.5), uneven}) {
            grid.projection = projection;
            const auto values = projected(grid, lamp, paint);
            for (size_t j = 0; j < grid.size(); ++j)
                REQUIRE(values[j] ==
                        Approx(averageBySimpson(lamp, paint, band(grid, j))).epsilon(1e-12).margin(1e-15));
        }
}

TEST_CASE("A single band is averaged under its own hat or box") {
    std::mt19937 random(11);
    const Curve lamp = randomTable(random, 300, 800, 200), paint = randomTable(random, 300, 800, 20);
    for (Projection projection : {Projection::slit, Projection::box}) {
        const Wavelengths grid{{550}, projection, 12};
        CHECK(projected(grid, lamp, paint)[0] ==
              Approx(averageBySimpson(lamp, paint, band(grid, 0))).epsilon(1e-12));
    }
    CHECK(projected({{550}, Projection::point, 5}, lamp, paint)[0] == lamp.at(550) * paint.at(550));
}

TEST_CASE("A constant averages to itself in every kind of band") {
    const Curve half = Curve::constant(0.5);
    for (Projection projection : {Projection::slit, Projection::box, Projection::point})
        for (const Wavelengths& grid : {regular(380, 780, 5, projection), regular(550, 550, 5, projection),
                                        Wavelengths{{1, 380, 1e6}, projection, 5}})
            for (double value : projected(grid, half))
                CHECK(value == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("A laser line of 0.01 nm keeps its power wherever it lies among the bands") {
    for (Projection projection : {Projection::slit, Projection::box})
        for (double step : {0.5, 5.0, 50.0})
            for (double nm : {400.006, 405.0, 407.5, 546.1, 632.8}) {
                const Wavelengths grid = regular(400, 700, step, projection);
                CHECK(total(grid, projected(grid, Curve::rectangle(nm, 0.01))) == Approx(1).epsilon(1e-12));
            }
}

TEST_CASE("A line of no width keeps its power, on nodes, borders and the grid's ends too") {
    const Curve grey = Curve::constant(0.25);
    for (Projection projection : {Projection::slit, Projection::box})
        for (double nm : {400.0, 402.5, 405.0, 632.8, 700.0}) {
            const Wavelengths grid = regular(400, 700, 5, projection);
            CHECK(total(grid, projected(grid, Curve::line(nm, 8), grey)) == Approx(2).epsilon(1e-14));
        }
    const Wavelengths grid = regular(400, 700, 5);
    CHECK(projected(grid, Curve::line(405))[1] == Approx(0.2).epsilon(1e-15));
    CHECK(total(grid, projected(grid, Curve::line(399.9))) == 0);
    CHECK(total(grid, projected(grid, Curve::line(700.1))) == 0);
    CHECK(projected({{632.8}, Projection::slit, 5}, Curve::line(632.8))[0] == Approx(0.2).epsilon(1e-15));
    // Where the other factor jumps, it counts with the mean of both sides.
    CHECK(total(grid, projected(grid, Curve::line(500), Curve::table({400, 500, 500, 700}, {1, 1, 3, 3}))) ==
          Approx(2));
}

TEST_CASE("Lines that no number can stand for are refused") {
    CHECK_THROWS_WITH(projected(regular(400, 700, 5, Projection::point), Curve::line(500)),
                      "the spectral line at 500 nm lies on a wavelength of a point projection, where a line "
                      "of no width is infinite; "
                      "use projection slit or box, or give it a width, as in line:500,0.01");
    CHECK(total(regular(400, 700, 5), projected(regular(400, 700, 5, Projection::point), Curve::line(501))) ==
          0);
    CHECK_THROWS_WITH(projected(regular(400, 700, 5), Curve::line(500), Curve::line(501)),
                      "the spectral lines at 500 nm and 501 nm are multiplied, but have no width; give one "
                      "of them a width, as in "
                      "line:632.8,0.01");
}

TEST_CASE(
    "Bands hold their curve's integral over the grid, from 1 nm to 1 mm, with one band or ten thousand") {
    std::mt19937 random(3);
    const Curve lamp = randomTable(random, 1, 1e6, 10'000);
    std::uniform_real_distribution<double> place(1, 1e6);
    Wavelengths grid;
    for (int i = 0; i < 10'000; ++i)
        grid.nm.push_back(place(random));
    std::sort(grid.nm.begin(), grid.nm.end());
    const Curve* factor = &lamp;
    const double expected = integrate({&factor, 1}, grid.nm.front(), grid.nm.back());
    for (Projection projection : {Projection::slit, Projection::box}) {
        grid.projection = projection;
        const auto start = std::chrono::steady_clock::now();
        const auto values = projected(grid, lamp);
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        INFO("10 000 bands of 10 000 samples in " << spent.count() << " ms");
        CHECK(total(grid, values) == Approx(expected).epsilon(1e-12));
        CHECK(spent.count() <
              1000);  // linear in both; every band against every sample would take many seconds
    }
}

TEST_CASE("Formulae average as exactly as tables") {
    // ∫ exp under a hat: second difference of the exponential
    const double rate = 0.01;
    const auto none = [](double, double, std::vector<double>&) {};
    const Curve exponential = Curve::formula([=](double nm) { return std::exp(-rate * (nm - 400)); }, none);
    const Wavelengths grid = regular(400, 700, 5);
    const auto values = projected(grid, exponential);
    const auto second = [&](double nm) { return std::exp(-rate * (nm - 400)) / (rate * rate); };
    for (size_t j = 1; j + 1 < grid.size(); ++j)
        CHECK(values[j] ==
              Approx((second(grid.nm[j - 1]) - 2 * second(grid.nm[j]) + second(grid.nm[j + 1])) / 25)
                  .epsilon(1e-11));
}

TEST_CASE("Radiances from 1e-30 to 1e30 project without loss") {
    std::mt19937 random(5);
    const Curve lamp = randomTable(random, 390, 710, 50);
    const Wavelengths grid = regular(400, 700, 10);
    const auto plain = projected(grid, lamp);
    for (double scale : {1e-30, 1e30}) {
        const auto scaled = projected(grid, lamp.scaled(scale));
        for (size_t j = 0; j < grid.size(); ++j)
            CHECK(scaled[j] == Approx(plain[j] * scale).epsilon(1e-13));
    }
}

TEST_CASE("A product is integrated over the range that all its factors share") {
    const Curve a = Curve::table({400, 600}, {1, 1}), b = Curve::table({500, 700}, {2, 2}),
                grey = Curve::constant(0.5);
    const Curve* product[] = {&a, &b, &grey};
    CHECK(integrate(product) == Approx(100).epsilon(1e-14));
    const Curve apart = Curve::table({800, 900}, {1, 1});
    const Curve* nothing[] = {&a, &apart};
    CHECK(integrate(nothing) == 0);
    CHECK(integrate(product, 600, 500) == 0);
    const Curve line = Curve::line(550, 4);
    const Curve* lit[] = {&b, &line};
    CHECK(integrate(lit) == 8);
}

TEST_CASE("Moments are band integrals, and under points trapezoids") {
    const Curve one = Curve::constant(1);
    const Wavelengths uneven{{400, 410, 440}, Projection::slit, 5};
    const auto hats = moments(uneven, one);
    CHECK(hats[0] == Approx(5));
    CHECK(hats[1] == Approx(20));
    CHECK(hats[2] == Approx(15));
    CHECK(moments({{400, 410, 440}, Projection::point, 5}, one) == std::vector<double>{5, 20, 15});
    CHECK(moments({{400}, Projection::point, 5}, one) == std::vector<double>{5});
    const auto boxes = moments({{400, 410, 440}, Projection::box, 5}, one);
    CHECK(boxes[0] == Approx(5));
    CHECK(boxes[1] == Approx(20));
    CHECK(boxes[2] == Approx(15));
}
