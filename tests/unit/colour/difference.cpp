// How far two images are apart.
#include "colour/difference.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace spectrad;

namespace {

/// Two rows of `width` pixels, [band][x].
BandDifference differ(size_t bands, int width, const std::vector<float>& a, const std::vector<float>& b) {
    BandDifferenceMeter meter(bands, width);
    const size_t row = bands * static_cast<size_t>(width);
    for (size_t from = 0; from < a.size(); from += row)
        meter.add(a.data() + from, b.data() + from);
    return meter.result();
}

}  // namespace

TEST_CASE("Equal cubes differ by exactly nothing") {
    const std::vector<float> cube{1, 2, 3, 0.1f, 1e-30f, 1e30f, 5, 6};
    const auto result = differ(2, 2, cube, cube);
    CHECK(result.rmse == 0);
    CHECK(result.relativeMax == 0);
    CHECK(result.gfcMin == Approx(1).epsilon(1e-15));
    CHECK(result.spectralAngleMax == 0);
    CHECK(result.compared == 4);
}

TEST_CASE("Band statistics are those worked out by hand") {
    // Two pixels, two bands: spectra (3, 4) and (1, 0) against (4, 3) and (1, 1).
    const std::vector<float> a{3, 1, 4, 0}, b{4, 1, 3, 1};
    const auto result = differ(2, 2, a, b);
    CHECK(result.rmse == Approx(std::sqrt(3.0 / 4)));
    CHECK(result.relativeMax == Approx(1.0 / 3));  // band 0: 1 of 3; band 1: 1 of 4
    CHECK(result.relativeMaxBand == 0);
    CHECK(result.gfcMin == Approx(1 / std::sqrt(2.0)));        // the second pixel; the first has 24/25
    CHECK(result.spectralAngleMax == Approx(std::atan(1.0)));  // 45 degrees
}

TEST_CASE("Rows add up: two rows of one pixel are one row of two") {
    const auto rows = differ(2, 1, {3, 4, 1, 0}, {4, 3, 1, 1});
    const auto row = differ(2, 2, {3, 1, 4, 0}, {4, 1, 3, 1});
    CHECK(rows.rmse == row.rmse);
    CHECK(rows.relativeMax == row.relativeMax);
    CHECK(rows.gfcMin == row.gfcMin);
    CHECK(rows.spectralAngleMax == row.spectralAngleMax);
}

TEST_CASE("Only the shape counts for fit and angle, and small angles keep their digits") {
    const auto scaled = differ(3, 1, {1, 2, 3}, {1e6f, 2e6f, 3e6f});
    CHECK(scaled.gfcMin == Approx(1).epsilon(1e-15));
    CHECK(scaled.spectralAngleMax < 1e-15);
    // Against (1, 0), (1, 1e-10) is 1e-10 rad away, where the cosine is 1 to the last digit.
    CHECK(differ(2, 1, {1, 0}, {1, 1e-10f}).spectralAngleMax == Approx(1e-10).epsilon(1e-6));
    CHECK(differ(2, 1, {1, 0}, {-1, 0}).spectralAngleMax == Approx(std::acos(-1.0)));
}

TEST_CASE("Black spectra have no shape: left out and counted") {
    // Pixels: black in both, black in the first, equal.
    const auto result = differ(2, 3, {0, 0, 1, 0, 0, 1}, {0, 1, 1, 0, 1, 1});
    CHECK(result.blackInBoth == 1);
    CHECK(result.blackInOne == 1);
    CHECK(result.compared == 1);
    CHECK(result.gfcMin == Approx(1));
    CHECK(result.spectralAngleMax == 0);
    CHECK(result.rmse == Approx(std::sqrt(2.0 / 6)));
    CHECK(differ(2, 1, {0, 0}, {0, 0}).compared == 0);
}

TEST_CASE("A band that is black in A alone is infinitely far, one black in both is no difference") {
    CHECK(differ(2, 1, {0, 1}, {0, 1}).relativeMax == 0);
    const auto result = differ(2, 1, {0, 1}, {1e-9f, 1});
    CHECK(std::isinf(result.relativeMax));
    CHECK(result.relativeMaxBand == 0);
}

TEST_CASE("Rows wider than a block lose no pixel") {
    const int width = 131;
    std::vector<float> a(2 * width, 1), b(2 * width, 1);
    b[130] = 2;
    const auto result = differ(2, width, a, b);
    CHECK(result.compared == 131);
    CHECK(result.gfcMin == Approx(3 / std::sqrt(10.0)));
    CHECK(result.rmse == Approx(std::sqrt(1.0 / 262)));
}

TEST_CASE("The largest and smallest floats neither overflow nor vanish, and what is no number is refused") {
    const float large = std::numeric_limits<float>::max(), tiny = std::numeric_limits<float>::denorm_min();
    CHECK(differ(2, 1, {large, large}, {large, -large}).spectralAngleMax == Approx(std::acos(0.0)));
    CHECK(differ(2, 1, {tiny, 0}, {tiny, tiny}).spectralAngleMax == Approx(std::atan(1.0)));
    CHECK_THROWS_AS(differ(1, 1, {1}, {std::nanf("")}), InputError);
    CHECK_THROWS_AS(differ(1, 1, {INFINITY}, {1}), InputError);
}

TEST_CASE("Colour differences have the mean, percentile, maximum and place worked out by hand") {
    // Greys against a white of 100 cd/m²: L* 50 against 50, 51, 52 … and one more colour.
    const Triple white{95.047, 100, 108.883};
    const auto grey = [&](double l) {
        const double f = (l + 16) / 116, y = f * f * f;
        return Triple{y * white[0], y * white[1], y * white[2]};
    };
    ChannelImage a(3, 2, 3), b(3, 2, 3);
    const double lightness[2][6] = {{50, 49.5, 49, 48.5, 50, 50}, {50, 50.5, 51, 51.5, 50, 50}};
    for (size_t i = 0; i < 6; ++i)
        for (size_t c = 0; c < 3; ++c) {
            a.plane[c][i] = grey(lightness[0][i])[c];
            b.plane[c][i] = grey(lightness[1][i])[c];
        }
    const auto result = colourDifference(a, b, white);  // 0, 1, 2, 3, 0, 0: S_L is 1 at a mean L* of 50
    CHECK(result.max76 == Approx(3).margin(1e-6));
    CHECK(result.mean76 == Approx(1).margin(1e-6));
    CHECK(result.mean == Approx(1).epsilon(1e-10));
    CHECK(result.max == Approx(3).epsilon(1e-10));
    CHECK(result.maxX == 0);
    CHECK(result.maxY == 1);
    CHECK(result.p95 == Approx(2.75).epsilon(1e-10));  // rank 4.75 of 0 0 0 1 2 3
    REQUIRE(result.map.size() == 6);
    CHECK(result.map[2] == Approx(2).epsilon(1e-6));
}

TEST_CASE("Images of other sizes, without pixels, or under an impossible white are not compared") {
    const ChannelImage a(2, 2, 3), b(2, 1, 3), none(0, 0, 3);
    CHECK_THROWS_AS((void)colourDifference(a, b, {1, 1, 1}), InputError);
    CHECK_THROWS_AS((void)colourDifference(none, none, {1, 1, 1}), InputError);
    CHECK_THROWS_AS((void)colourDifference(a, a, {1, 1, 0}), InputError);
    CHECK(colourDifference(a, a, {1, 1, 1}).max == 0);  // black against black
}

TEST_CASE("False colours run from the first to the last and stop there") {
    const auto pixels = falseColours({0, 5, 10, 99, -1}, 10);
    const std::vector<std::uint8_t> expected{68, 1, 84, 33, 144, 141, 253, 231, 37, 253, 231, 37, 68, 1, 84};
    CHECK(pixels == expected);
    CHECK(falseColours({1}, 0) == std::vector<std::uint8_t>{68, 1, 84});
}
