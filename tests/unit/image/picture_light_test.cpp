// What a picture's numbers are as colours: closed forms of the standards, and ICC profiles made here by
// Little CMS from the same primaries.
#include "image/picture_light.h"

#include "image/picture_colour.h"
#include "support/jpeg_bytes.h"
#include "support/png_bytes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <lcms2.h>

using namespace spectrad;
using namespace spectrad::test;
using Catch::Matchers::Contains;

namespace {

PictureLight lightOf(const PictureColour& colour, Notes& notes) {
    PictureValues picture{1, 1, 3, 255, {1, 2, 3}};
    picture.colour = colour;
    return {picture, "a.png", {"scene.xml", 3, 4}, notes};
}

PictureLight lightOf(const PictureColour& colour) {
    Notes notes;
    const PictureLight light = lightOf(colour, notes);
    CHECK(notes.lines().empty());
    return light;
}

double apart(const Triple& a, const Triple& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

double srgbCurve(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// An ICC profile (version 4) of primaries under a white, all with one curve; one channel: of the white
/// alone.
std::string profileOf(const Display& display, double gamma, int channels) {
    const auto xyY = [](double x, double y) { return cmsCIExyY{x, y, 1}; };
    const double sum = display.white[0] + display.white[1] + display.white[2];
    const cmsCIExyY white = xyY(display.white[0] / sum, display.white[1] / sum);
    std::array<cmsCIExyY, 3> of{};
    for (size_t k = 0; k < 3; ++k) {
        const double total = display.toXyz[0][k] + display.toXyz[1][k] + display.toXyz[2][k];
        of[k] = xyY(display.toXyz[0][k] / total, display.toXyz[1][k] / total);
    }
    const cmsCIExyYTRIPLE primaries{of[0], of[1], of[2]};
    cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
    cmsToneCurve* curves[]{curve, curve, curve};
    cmsHPROFILE profile =
        channels == 1 ? cmsCreateGrayProfile(&white, curve) : cmsCreateRGBProfile(&white, &primaries, curves);
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::string bytes(size, '\0');
    cmsSaveProfileToMem(profile, bytes.data(), &size);
    cmsCloseProfile(profile);
    cmsFreeToneCurve(curve);
    return bytes;
}

}  // namespace

TEST_CASE("a picture that says nothing, and one that says sRGB, are sRGB") {
    for (const PictureColour& colour :
         {PictureColour{}, {.srgb = true}, {.gamma = 1 / 0.45455}, {.codes = {{1, 13}}}}) {
        const PictureLight light = lightOf(colour);
        for (const double v : {0.0, 0.02, 0.2, 0.5, 1.0})
            CHECK(apart(light.linearSrgb({v, 1 - v, 0.3}), {srgbCurve(v), srgbCurve(1 - v), srgbCurve(0.3)}) <
                  1e-12);
    }
}

TEST_CASE("a gamma is the power of its file") {
    for (const double gamma : {1.0, 1.8, 2.6}) {
        const PictureLight light = lightOf({.gamma = gamma});
        for (const double v : {0.0, 0.02, 0.5, 1.0})
            CHECK(light.linearSrgb({v, v, v})[1] == Approx(std::pow(v, gamma)).margin(1e-15));
    }
    CHECK(lightOf({.codes = {{1, 8}}}).linearSrgb({0.25, 0.5, 0.75}) == Triple{0.25, 0.5, 0.75});
    CHECK(lightOf({.codes = {{1, 4}}}).linearSrgb({0.5, 0, 1})[0] == Approx(std::pow(0.5, 2.2)));
}

TEST_CASE("Display P3's primaries are the colours beyond sRGB that they are, by codes as by chromaticities") {
    // The matrix between the two from their chromaticities (as in CSS Color 4, "linear-light P3 to sRGB").
    const std::array<Triple, 3> published{
        {{1.2249402, -0.0420570, -0.0196376}, {-0.2249402, 1.0420570, -0.0786361}, {0, 0, 1.0982737}}};
    const PictureLight codes = lightOf({.codes = {{12, 13}}}),
                       points =
                           lightOf({.chromaticities = {{0.3127, 0.329, 0.68, 0.32, 0.265, 0.69, 0.15, 0.06}},
                                    .gamma = 1 / 0.45455});
    for (size_t k = 0; k < 3; ++k) {
        Triple primary{};
        primary[k] = 1;
        CHECK(apart(codes.linearSrgb(primary), published[k]) < 2e-6);
        CHECK(apart(points.linearSrgb(primary), codes.linearSrgb(primary)) < 1e-12);
    }
    CHECK(codes.linearSrgb({0.5, 0.5, 0.5})[2] == Approx(srgbCurve(0.5)).epsilon(1e-12));
}

TEST_CASE("a white other than D65 is adapted to: white stays white") {
    // ProPhoto's primaries and D50.
    const PictureLight light = lightOf(
        {.chromaticities = {{0.3457, 0.3585, 0.7347, 0.2653, 0.1596, 0.8404, 0.0366, 0.0001}}, .gamma = 1.8});
    CHECK(apart(light.linearSrgb({1, 1, 1}), {1, 1, 1}) < 1e-12);
    CHECK(light.linearSrgb({0, 1, 0})[0] < -0.4);
}

TEST_CASE("what observe writes into a picture is what is read from it") {
    const Display own = displayFromPrimaries({{{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}}}, {0.3127, 0.3290},
                                             Display::Transfer::gamma, 2.4);
    for (const Display& display : {srgbDisplay(), p3Display(), rec2020Display(), own}) {
        const Display read = displayOf(pictureColour(display));
        for (size_t row = 0; row < 3; ++row)
            CHECK(apart(read.toXyz[row], display.toXyz[row]) < 1e-12);
        for (const double v : {0.01, 0.3, 0.9})
            CHECK(decode(read, v) == Approx(decode(display, v)).epsilon(1e-12));
    }
}

TEST_CASE("an ICC profile's colours are those of its primaries, white and curve, in PNG and JPEG") {
    const Display wide = displayFromPrimaries({{{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}}}, {0.3127, 0.3290},
                                              Display::Transfer::gamma, 2.2);
    const std::string colours = profileOf(wide, 2.2, 3), greys = profileOf(wide, 2.2, 1);
    const Display srgb = srgbDisplay();
    Notes notes;
    const auto value = [](int, int, int) { return 100; };
    for (const bool jpeg : {false, true}) {
        PngForm form{16, 3};
        form.profile = colours;
        const PictureValues picture = decodeValues(
            jpeg ? jpegOf(2, 2, 3, value, colours, 100) : pngOf(2, 2, form, value), jpeg ? "a.jpg" : "a.png");
        REQUIRE(picture.profile == colours);
        const PictureLight light(picture, "a.png", {}, notes);
        for (const Triple& signals :
             {Triple{1, 1, 1}, {0.5, 0.5, 0.5}, {0, 1, 0}, {0.9, 0.2, 0.1}, {0, 0, 0}}) {
            Triple linear{};
            for (size_t k = 0; k < 3; ++k)
                linear[k] = std::pow(signals[k], 2.2);
            // Profiles keep 16 binary places of their primaries.
            CHECK(apart(light.linearSrgb(signals), srgb.fromXyz * (wide.toXyz * linear)) < 2e-4);
        }
    }
    PngForm form{8, 1};
    form.profile = greys;
    const PictureLight grey(decodeValues(pngOf(2, 2, form, value), "a.png"), "a.png", {}, notes);
    CHECK(apart(grey.linearSrgb({0.5, 0.5, 0.5}), {1, 1, 1}) == Approx(1 - std::pow(0.5, 2.2)).margin(2e-4));
    CHECK(notes.lines().empty());
}

TEST_CASE("what a file says and nobody understands is warned of, and sRGB taken") {
    const auto warned = [](const PictureValues& picture) {
        Notes notes;
        const PictureLight light(picture, "a.png", {"scene.xml", 3, 4}, notes);
        CHECK(light.linearSrgb({0.5, 0, 1})[0] == Approx(srgbCurve(0.5)));
        REQUIRE(notes.lines().size() == 1);
        CHECK_THAT(notes.lines()[0], Contains("scene.xml:3:4") && Contains("taken as sRGB"));
        return notes.lines()[0];
    };
    PictureValues picture{1, 1, 3, 255, {1, 2, 3}};
    picture.colour.codes = {{9, 16}};  // PQ
    CHECK_THAT(warned(picture), Contains("transfer characteristics 16"));
    picture.colour.codes = {{22, 13}};
    CHECK_THAT(warned(picture), Contains("primaries 22"));
    picture.colour = {.chromaticities = {{0.3127, 0.329, 0.3, 0.3, 0.4, 0.4, 0.5, 0.5}}};
    CHECK_THAT(warned(picture), Contains("triangle"));
    picture.colour = {};
    picture.misread = "iCCP: too short";
    CHECK_THAT(warned(picture), Contains("too short"));
    picture.misread = "";
    picture.profile = "no profile";
    CHECK_THAT(warned(picture), Contains("damaged"));
    picture.profile = profileOf(srgbDisplay(), 2, 1);
    CHECK_THAT(warned(picture), Contains("not for pictures in red, green and blue"));
    picture.channels = 1;
    picture.profile = profileOf(srgbDisplay(), 2, 3);
    CHECK_THAT(warned(picture), Contains("not for grey pictures"));
}
