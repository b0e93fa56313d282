// CIE Lab and colour differences.
#include "colour/colour.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;

namespace {

struct Pair {
    Triple a, b;
    double deltaE;
};

// Sharma, Wu & Dalal, Color Res. Appl. 30 (2005), 21–30, table 1: chosen to find wrong hue means and signs.
constexpr Pair sharmaPairs[] = {
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.02}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
    {{50, 2.49, -0.001}, {50, -2.49, 0.001}, 7.1792},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0012}, 7.2195},
    {{50, -0.001, 2.49}, {50, 0.0009, -2.49}, 4.8045},
    {{50, -0.001, 2.49}, {50, 0.001, -2.49}, 4.8045},
    {{50, -0.001, 2.49}, {50, 0.0011, -2.49}, 4.7461},
    {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {56, -27, -3}, 31.903},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1},
    {{50, 2.5, 0}, {50, 3.2972, 0}, 1},
    {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1},
    {{50, 2.5, 0}, {50, 3.2592, 0.335}, 1},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.263},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.248, -4.962}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.694}, {23.0331, 14.973, -42.5619}, 2.0373},
    {{36.4612, 47.858, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.441}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.135}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

}  // namespace

TEST_CASE("CIEDE2000 reproduces all 34 published pairs to the digits they are given with") {
    static_assert(std::size(sharmaPairs) == 34);
    for (const Pair& pair : sharmaPairs) {
        CHECK(deltaE00(pair.a, pair.b) == Approx(pair.deltaE).margin(0.5e-4 + 1e-9));
        CHECK(deltaE00(pair.b, pair.a) == Approx(deltaE00(pair.a, pair.b)).margin(1e-12));
    }
}

TEST_CASE("Equal colours differ by exactly nothing, greys and black included") {
    for (const Triple& colour :
         {Triple{50, 20, -30}, Triple{0, 0, 0}, Triple{100, 0, 0}, Triple{1e-9, 1e-12, 0}}) {
        CHECK(deltaE00(colour, colour) == 0);
        CHECK(deltaE76(colour, colour) == 0);
    }
}

TEST_CASE("Colours far beyond any surface still have a finite difference") {
    CHECK(std::isfinite(deltaE00({1e30, 1e60, -1e60}, {0, 0, 0})));
    CHECK(std::isfinite(deltaE00({1e30, 1e60, -1e60}, {1e30, -1e60, 1e60})));
}

TEST_CASE("Two greys differ by their weighted lightness alone") {
    // S_L at mean lightness 50 is 1.
    CHECK(deltaE00({49, 0, 0}, {51, 0, 0}) == Approx(2).epsilon(1e-12));
    CHECK(deltaE76({49, 0, 0}, {51, 0, 0}) == Approx(2));
    CHECK(deltaE76({50, 3, 0}, {50, 0, 4}) == Approx(5));
}

TEST_CASE("Lab of the white is 100, 0, 0, of black 0, 0, 0, at any luminance") {
    const Triple white{95.047, 100, 108.883};
    CHECK(lab(white, white)[0] == Approx(100).epsilon(1e-14));
    CHECK(lab(white, white)[1] == Approx(0).margin(1e-12));
    CHECK(lab({0, 0, 0}, white)[0] == Approx(0).margin(1e-12));
    const Triple bright{95.047e20, 100e20, 108.883e20},
        grey{0.2 * bright[0], 0.2 * bright[1], 0.2 * bright[2]};
    CHECK(lab(grey, bright)[0] == Approx(51.8372115265385).epsilon(1e-12));  // 116 · 0.2^(1/3) − 16
}

TEST_CASE("Lab has one value and one slope where its cube root meets its line") {
    const Triple white{1, 1, 1};
    const double knee = 216.0 / 24389.0;
    const double below = lab({knee * (1 - 1e-9), knee * (1 - 1e-9), knee * (1 - 1e-9)}, white)[0];
    const double above = lab({knee * (1 + 1e-9), knee * (1 + 1e-9), knee * (1 + 1e-9)}, white)[0];
    CHECK(below == Approx(8).epsilon(1e-8));
    CHECK(above == Approx(8).epsilon(1e-8));
    // In the line, L* = 903.3 Y/Yn.
    CHECK(lab({0.001, 0.001, 0.001}, white)[0] == Approx(24389.0 / 27.0 * 0.001).epsilon(1e-12));
}

TEST_CASE("Chromaticities are undefined for black, and for anything without a sum") {
    CHECK_FALSE(chromaticity({0, 0, 0}));
    CHECK_FALSE(uvPrime({0, 0, 0}));
    CHECK_FALSE(chromaticity({-1, -1, -1}));
    CHECK_FALSE(chromaticity({1e308, 1e308, 1e308}));
}

TEST_CASE("Chromaticities of the equal-energy white are thirds, at every luminance") {
    for (double y : {1e-300, 1.0, 1e300}) {
        const auto xy = chromaticity({y, y, y});
        REQUIRE(xy);
        CHECK((*xy)[0] == Approx(1.0 / 3));
        CHECK((*xy)[1] == Approx(1.0 / 3));
        const auto uv = uvPrime({y, y, y});
        REQUIRE(uv);
        CHECK((*uv)[0] == Approx(4.0 / 19));
        CHECK((*uv)[1] == Approx(9.0 / 19));
    }
}

TEST_CASE("XYZ from a chromaticity and luminance go back to them") {
    const Triple xyz = xyzFromChromaticity({0.3127, 0.3290}, 250);
    CHECK(xyz[1] == 250);
    CHECK((*chromaticity(xyz))[0] == Approx(0.3127).epsilon(1e-14));
    CHECK((*chromaticity(xyz))[1] == Approx(0.3290).epsilon(1e-14));
}
