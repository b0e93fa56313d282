// Spectral rows to channels, channels to XYZ, and whites.
#include "colour/observe.h"

#include "colour/white.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace spectrad;

namespace {

const Library& library() {
    static const Library shared = Library::open();
    return shared;
}

Detector fromLibrary(const char* name) {
    return detectorFrom(library().find(name).value());
}

Triple throughMatrix(const Detector& detector, const Curve& light) {
    const std::array<const Curve*, 1> product{&light};
    return toXyz(towardsXyz(detector, standardObserver(library())), respond(detector, product));
}

}  // namespace

TEST_CASE("A row of bands becomes the weighted sums of its pixels, however wide") {
    const int width = 600;  // more than two blocks
    DetectorWeights weights{{{1, 10, 100}, {0.5, 0, -0.5}}};
    std::vector<float> bands(3 * width);
    for (size_t j = 0; j < 3; ++j)
        for (size_t x = 0; x < width; ++x)
            bands[j * width + x] = static_cast<float>(x + j);
    ChannelImage image(width, 2, 2);
    observeRow(weights, bands.data(), 1, image);
    for (size_t x = 0; x < width; ++x) {
        const auto v = static_cast<double>(x);
        REQUIRE(image.plane[0][width + x] == v + 10 * (v + 1) + 100 * (v + 2));
        REQUIRE(image.plane[1][width + x] == -1);
        REQUIRE(image.plane[0][x] == 0);
    }
}

TEST_CASE("A cube's value that is no number is refused with its pixel") {
    ChannelImage image(3, 5, 1);
    const std::vector<float> bands{1, 2, std::nanf(""), 4, 5, 6};
    CHECK_THROWS_WITH(observeRow({{{1, 1}}}, bands.data(), 4, image), Catch::Contains("pixel (2, 4)"));
}

TEST_CASE("Planes that float cannot hold are refused with channel and pixel") {
    ChannelImage image(2, 2, 2);
    image.plane[1][3] = 1e39;
    CHECK_THROWS_WITH(floatPlanes(image, {"X", "Y"}), Catch::Contains("channel Y of pixel (1, 1) is 1e+39"));
    image.plane[1][3] = 1e38;
    CHECK(floatPlanes(image, {"X", "Y"})[1][3] == 1e38f);
}

TEST_CASE("XYZ go to XYZ by the identity") {
    const Detector observer = standardObserver(library());
    const XyzMatrix matrix = towardsXyz(observer, observer);
    CHECK(toXyz(matrix, std::vector<double>{3, 4, 5}) == Triple{3, 4, 5});
    CHECK_THROWS_AS(towardsXyz(observer, fromLibrary("cameras/nikon-5100")), InputError);
}

TEST_CASE("Cone fundamentals find the XYZ of their own observer") {
    // The CIE 2015 functions are a linear transform of these cones, but for the rounding of the tables.
    const Detector cones = fromLibrary("observers/stockman-sharpe-2"),
                   observer = fromLibrary("observers/cie2015-2");
    const Curve light = library().find("illuminants/D65").value().curve();
    const std::array<const Curve*, 1> product{&light};
    const Triple xyz = toXyz(towardsXyz(cones, observer), respond(cones, product));
    const Triple exact = respondXyz(observer, product);
    for (size_t c = 0; c < 3; ++c)
        CHECK(xyz[c] == Approx(exact[c]).epsilon(2e-4));
}

TEST_CASE(
    "A camera finds broad lights to a few hundredths, and a detector of one channel sees their brightness") {
    const Curve light = library().find("illuminants/D65").value().curve();
    const std::array<const Curve*, 1> product{&light};
    const Triple exact = respondXyz(standardObserver(library()), product);
    const Triple seen = throughMatrix(fromLibrary("cameras/nikon-5100"), light);
    const auto xy = chromaticity(seen), exactXy = chromaticity(exact);
    REQUIRE(xy);
    CHECK((*xy)[0] == Approx((*exactXy)[0]).margin(0.03));
    CHECK((*xy)[1] == Approx((*exactXy)[1]).margin(0.03));
    CHECK(seen[1] == Approx(exact[1]).epsilon(0.05));

    const Triple photopic = throughMatrix(fromLibrary("observers/cie1924-photopic"), light);
    // V(λ) is ȳ, scaled to 683 lm/W at 540 THz: 683.002 to its last digit.
    CHECK(photopic[1] == Approx(exact[1]).epsilon(1e-6));
    CHECK(photopic[0] > 0);
}

TEST_CASE("Channels that repeat each other do not upset the way to XYZ") {
    Detector twice = fromLibrary("cameras/nikon-5100");
    twice.channels.push_back("G2");
    twice.response.push_back(twice.response[1]);
    const Curve light = library().find("illuminants/A").value().curve();
    const Triple once = throughMatrix(fromLibrary("cameras/nikon-5100"), light),
                 doubled = throughMatrix(twice, light);
    for (size_t c = 0; c < 3; ++c)
        CHECK(doubled[c] == Approx(once[c]).epsilon(1e-6));
    Detector blind;
    blind.name = "blind";
    blind.channels = {"A"};
    blind.response = {Curve()};
    CHECK_THROWS_AS(towardsXyz(blind, standardObserver(library())), InputError);
}

TEST_CASE("An image of channels goes through the matrix pixel by pixel") {
    ChannelImage channels(2, 1, 2);
    channels.plane[0] = {1, 2};
    channels.plane[1] = {10, 20};
    const XyzMatrix matrix{std::vector<double>{1, 0}, {0, 1}, {1, 1}};
    const ChannelImage xyz = toXyz(matrix, channels);
    CHECK(xyz.triple(0) == Triple{1, 10, 11});
    CHECK(xyz.triple(1) == Triple{2, 20, 22});
}

TEST_CASE("A lamp is a white of its chromaticity, whatever its amount") {
    const Detector observer = standardObserver(library());
    const XyzMatrix matrix = towardsXyz(observer, observer);
    const Curve lamp = library().find("illuminants/A").value().curve();
    const White white = whiteOf("A", lamp, observer, matrix, {}),
                bright = whiteOf("A", lamp.scaled(1e9), observer, matrix, {});
    CHECK_FALSE(white.hasLuminance);
    CHECK(white.xyz[1] == 1);
    CHECK(white.xyz[0] == Approx(1.0984852438043309).epsilon(1e-10));  // as in the detectors' test
    CHECK(white.xyz[2] == Approx(0.35591430325826817).epsilon(1e-10));
    CHECK(bright.xyz[0] == Approx(white.xyz[0]).epsilon(1e-12));
    CHECK(whiteOf("A", lamp, observer, {}, {}).xyz == white.xyz);  // X, Y, Z need no matrix
    CHECK_THROWS_AS(whiteOf("infrared", Curve::line(1064), observer, matrix, {}), InputError);
}

TEST_CASE("A camera's white is where its matrix takes the lamp") {
    const Detector camera = fromLibrary("cameras/nikon-5100");
    const XyzMatrix matrix = towardsXyz(camera, standardObserver(library()));
    const Curve lamp = library().find("illuminants/A").value().curve();
    const Triple seen = throughMatrix(camera, lamp), white = whiteOf("A", lamp, camera, matrix, {}).xyz;
    for (size_t c = 0; c < 3; ++c)
        CHECK(white[c] == Approx(seen[c] / seen[1]).epsilon(1e-12));
}

TEST_CASE("Whites as text: numbers are absolute, names are chromaticities, the rest is refused") {
    Notes notes;
    const SpectrumResolver resolver(library(), SPECTRAD_SOURCE, false, notes);
    const Detector observer = standardObserver(library());
    const XyzMatrix matrix = towardsXyz(observer, observer);
    const auto white = [&](const char* text) { return whiteFor(text, observer, matrix, resolver, {}); };
    CHECK(white("95.05,100,108.9").xyz == Triple{95.05, 100, 108.9});
    CHECK(white(" 95.05, 100 ,108.9").hasLuminance);
    CHECK(white("illuminants/D65").xyz[0] == Approx(0.9504684424739925).epsilon(1e-10));
    CHECK_FALSE(white("blackbody:2856").hasLuminance);
    for (const char* wrong : {"95,100", "0,0,0", "1,-1,1", "1,2,3,4", "95,nan,100", "nosuchlamp"}) {
        CAPTURE(wrong);
        CHECK_THROWS_AS(white(wrong), InputError);
    }
}

TEST_CASE("A pixel can be the white, unless it is black or outside") {
    ChannelImage xyz(2, 2, 3);
    for (size_t c = 0; c < 3; ++c)
        xyz.plane[c][3] = 7;
    CHECK(whiteAt(xyz, 1, 1).xyz == Triple{7, 7, 7});
    CHECK(whiteAt(xyz, 1, 1).hasLuminance);
    CHECK(whiteAt(xyz, 1, 1).name == "at:1,1");
    CHECK_THROWS_AS(whiteAt(xyz, 0, 0), InputError);
    CHECK_THROWS_AS(whiteAt(xyz, 2, 0), InputError);
    CHECK_THROWS_AS(whiteAt(xyz, 0, -1), InputError);
}

TEST_CASE("A luminance is given to a white that has none, and left to one that has") {
    CHECK(withLuminance({"w", {0.9, 1, 1.1}, false}, 50).xyz == Triple{45, 50, 1.1 * 50});
    CHECK(withLuminance({"w", {90, 100, 110}, true}, 50).xyz[1] == 100);
}
