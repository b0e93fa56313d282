// Tables: linear between samples, jumps, what lies outside, and the bookkeeping of breaks, ranges and scales.
#include "spectrum/curve.h"

#include "base/error.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;

namespace {

std::vector<double> breaks(const Curve& curve, double from, double to) {
    std::vector<double> out;
    curve.appendBreaks(from, to, out);
    return out;
}

}  // namespace

TEST_CASE("A table is linear between its samples and zero or held outside") {
    const Curve lamp = Curve::table({400, 500, 600}, {1, 3, 2});
    CHECK(lamp.at(400) == 1);
    CHECK(lamp.at(450) == 2);
    CHECK(lamp.at(600) == 2);
    CHECK(lamp.at(399.999) == 0);
    CHECK(lamp.at(600.001) == 0);
    const Curve paint = lamp.withOutside(Outside::hold);
    CHECK(paint.at(100) == 1);
    CHECK(paint.at(1e6) == 2);
    CHECK(lamp.at(100) == 0);
}

TEST_CASE("Two values at one wavelength are a jump, and its value the mean") {
    const Curve step = Curve::table({400, 500, 500, 600}, {0, 0, 4, 4});
    CHECK(step.at(std::nextafter(500, 0)) == 0);
    CHECK(step.at(500) == 2);
    CHECK(step.at(std::nextafter(500, 1000)) == 4);
    CHECK(breaks(step, 300, 700) == std::vector<double>{400, 500, 600});
    const Curve* factor = &step;
    CHECK(integrate({&factor, 1}) == Approx(400).epsilon(1e-14));
}

TEST_CASE("values() is at() for many wavelengths") {
    const Curve curve = Curve::table({400, 500, 500, 600}, {1, 2, 4, 8}, Outside::hold);
    std::vector<double> nm{300, 400, 400, 450, 500, 550, 600, 601}, out(nm.size());
    for (const Curve& c :
         {curve, curve.withOutside(Outside::zero), curve.scaled(3), Curve::gaussian(500, 30).scaled(2)}) {
        c.values(nm, out);
        for (size_t i = 0; i < nm.size(); ++i)
            CHECK(out[i] == c.at(nm[i]));
    }
}

TEST_CASE("One sample is a value on a range of no width") {
    CHECK(Curve::table({500}, {7}, Outside::hold).at(1000) == 7);
    CHECK(Curve::table({500}, {7}).at(500) == 7);
    CHECK(Curve::table({500}, {7}).at(501) == 0);
}

TEST_CASE("Samples that are no curve are refused") {
    CHECK_THROWS_WITH(Curve::table({}, {}), "a spectrum of 0 wavelengths and 0 values");
    CHECK_THROWS_WITH(Curve::table({400, 500}, {1}), "a spectrum of 2 wavelengths and 1 values");
    CHECK_THROWS_WITH(Curve::table({500, 400}, {1, 2}), "wavelengths must ascend, but 400 nm follows 500 nm");
    CHECK_THROWS_WITH(Curve::table({400, 400, 400}, {1, 2, 3}), "more than two values at 400 nm");
    CHECK_THROWS_WITH(Curve::table({400, 500}, {1, NAN}), "a spectrum's sample 2 is not finite");
}

TEST_CASE("A line is a delta: no value anywhere, all of its integral") {
    const Curve line = Curve::line(632.8, 3);
    CHECK(line.at(632.8) == 0);
    REQUIRE(line.lines().size() == 1);
    CHECK(line.scaled(2).lines()[0].integral == 6);
    const Curve* factor = &line;
    CHECK(integrate({&factor, 1}) == 3);
    CHECK(integrate({&factor, 1}, 400, 632) == 0);
}

TEST_CASE("A rectangle has unit integral however narrow") {
    for (double width : {100.0, 1.0, 0.01, 1e-6, 1e-9, 1e-15}) {
        const Curve rectangle = Curve::rectangle(632.8, width);
        const Curve* factor = &rectangle;
        CHECK(integrate({&factor, 1}, 380, 780) == Approx(1).epsilon(1e-13));
    }
}

TEST_CASE("Scaling reaches samples, formulae, lines and combinations alike") {
    CHECK(Curve::table({400, 500}, {1, 2}).scaled(3).sampleValues()[1] == 6);
    CHECK(Curve::constant(2).scaled(3).at(555) == 6);
    CHECK(Curve::constant(2).scaled(3).isConstant());
    CHECK(Curve::gaussian(500, 20).scaled(3).scaled(2).at(500) == 6);
    const Curve sum = Curve::combined({Curve::constant(1), Curve::table({400, 500}, {1, 2}, Outside::hold)},
                                      [](std::span<const double> v) { return v[0] + v[1]; });
    CHECK(sum.scaled(10).at(450) == 25);
}

TEST_CASE("A constant is the same everywhere and has no range") {
    CHECK(Curve::constant(0.5).isConstant());
    CHECK_FALSE(Curve::constant(0.5).range());
    CHECK(Curve().at(500) == 0);
    CHECK(Curve().isConstant());
    CHECK(Curve::table({400, 500}, {2, 2}, Outside::hold).isConstant());
    CHECK_FALSE(Curve::table({400, 500}, {2, 2}).isConstant());
    const Curve one = Curve::constant(1);
    const Curve* factor = &one;
    CHECK_THROWS_WITH(
        integrate({&factor, 1}),
        "the spectrum goes on at all wavelengths and has no integral; say a range, as in 'over 400:700'");
}

TEST_CASE("Bounds are those of the samples, or of a formula over its range") {
    CHECK(Curve::table({400, 500, 600}, {1, -3, 2}).bounds() == std::pair{-3.0, 2.0});
    CHECK(Curve::gaussian(500, 20).bounds().second == 1);
    CHECK(Curve::gaussian(50, 20).bounds().second == 1);
    CHECK(Curve::constant(0.3).bounds() == std::pair{0.3, 0.3});
    const double kelvin = 5000, peakNm = 2.897771955e6 / kelvin;  // Wien's displacement, CODATA 2018
    CHECK(Curve::blackbody(kelvin).bounds().second ==
          Approx(Curve::blackbody(kelvin).at(peakNm)).epsilon(1e-12));
}

TEST_CASE("A combined curve follows its inputs, with breaks where f bends between them") {
    const Curve n = Curve::table({400, 800}, {1, 9}, Outside::hold);
    const Curve inverse = Curve::combined({n}, [](std::span<const double> v) { return 1 / v[0]; });
    CHECK(inverse.at(600) == 0.2);
    CHECK(inverse.at(1000) == Approx(1 / 9.0));
    CHECK_FALSE(breaks(inverse, 400, 800).empty());
    const Curve* factor = &inverse;
    // ∫ dλ / (1 + (λ − 400) / 50) = 50 ln 9
    CHECK(integrate({&factor, 1}, 400, 800) == Approx(50 * std::log(9.0)).epsilon(1e-11));
    CHECK_THROWS_WITH(Curve::combined({Curve::line(500)}, [](std::span<const double> v) { return v[0]; }),
                      "a spectral line of no width has no values to compute with; give it a width");
}

TEST_CASE("A combination that vanishes with its inputs can be integrated over all wavelengths") {
    const Curve lamp = Curve::table({400, 500}, {1, 1});
    const Curve square = Curve::combined({lamp}, [](std::span<const double> v) { return v[0] * v[0]; });
    const Curve* factor = &square;
    CHECK(integrate({&factor, 1}) == Approx(100).epsilon(1e-13));
}
