// Baked surfaces: what arrives at each texel of a plane and a sphere, in closed form.
#include "render/bake.h"

#include "image/cube.h"
#include "render/passes.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

Cube baked(const std::string& text, const std::string& node, PassKind as, int width, int height,
           int samples = 1, int gutter = 0) {
    const Scene scene = sceneFrom(text);
    RenderSettings settings;
    settings.bake = Bake{node, as, gutter};
    settings.size = {width, height};
    settings.samples = samples;
    Notes notes;
    return PassTextures(scene, library(), device(), settings, notes).render();
}

/// Two lamps, 3 and 2 W·sr⁻¹·nm⁻¹ at 500 nm, the second fading to zero at 600 nm.
const char* const lamps = R"(<spectrum name="flat" quantity="intensity">400:3 700:3</spectrum>
<spectrum name="steep" quantity="intensity">400:4 600:0 700:0</spectrum>
<light type="point" position="2 1.5 3" spectrum="flat"/><light type="point" position="-1.5 2.5 1" spectrum="steep"/>
<camera look-from="0 0 9"/>)";

/// Irradiance of both at 500 nm.
double arriving(const Vec3& place, const Vec3& normal) {
    double sum = 0;
    for (const auto& [lamp, intensity] :
         {std::pair{Vec3{2, 1.5, 3}, 3.0}, std::pair{Vec3{-1.5, 2.5, 1}, 2.0}}) {
        const Vec3 to = lamp - place;
        const double distance = length(to);
        sum += intensity * std::max(0.0, dot(to, normal)) / (distance * distance * distance);
    }
    return sum;
}

constexpr const char* one500 = "<wavelengths projection=\"point\">500 600</wavelengths>";

}  // namespace

TEST_CASE("a plane's baked irradiance is the lamps' by cosine and distance, texel by texel") {
    if (!haveDevice()) return;
    const std::string text = fmt::format(
        "<scene version=\"1\">{}{}<node name=\"wall\" translate=\"0.3 0 -1\" "
        "rotate=\"1 0 0 -30\"><plane size=\"3 2\"/></node></scene>",
        one500, lamps);
    const Cube cube = baked(text, "wall", PassKind::irradiance, 60, 40);
    CHECK(cube.info.kind == CubeKind::irradiance);
    const Affine place = Affine::translation({0.3, 0, -1}) * Affine::rotation({1, 0, 0}, -30);
    Worst worst;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x) {
            const double u = (x + 0.5) / 60, v = 1 - (y + 0.5) / 40;
            const double expected =
                arriving(place.point({3 * (u - 0.5), 2 * (v - 0.5), 0}), place.direction({0, 0, 1}));
            worst.add(cube.row(y, 0)[x], expected, expected, x, y);
        }
    INFO(worst.str());
    CHECK(worst.error < 2e-6);
}

TEST_CASE("a sphere's baked irradiance is the lamps' all around, on its far side too") {
    if (!haveDevice()) return;
    const std::string text = fmt::format(
        "<scene version=\"1\">{}{}<node name=\"ball\"><sphere radius=\"1\"/></node></scene>", one500, lamps);
    constexpr int width = 512, height = 256;
    const Cube cube = baked(text, "ball", PassKind::irradiance, width, height);
    Worst worst;
    double brightest = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double around = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5),
                         down = std::numbers::pi * (y + 0.5) / height;
            const Vec3 p{std::sin(down) * std::sin(around), std::cos(down),
                         std::sin(down) * std::cos(around)};
            const double expected = arriving(p, p);
            brightest = std::max(brightest, expected);
            // At the poles a shape's last triangles leave gaps in the square.
            const bool pole = y < height / 32 || y >= height - height / 32;
            if (pole && cube.row(y, 0)[x] == 0) continue;
            worst.add(cube.row(y, 0)[x], expected, 1, x, y);
        }
    INFO(worst.str() << " of " << brightest);
    CHECK(worst.error < 1e-3 * brightest);
}

TEST_CASE(
    "baked radiance and reflectance of a matt plane are its paint's; the gutter goes on beyond its edge") {
    if (!haveDevice()) return;
    const std::string text = fmt::format(
        "<scene version=\"1\">{}{}<material name=\"m\"><diffuse reflectance=\"400:0.2 700:0.8\"/>"
        "</material><node name=\"disc\"><disc radius=\"1\" material=\"m\"/></node></scene>",
        one500, lamps);
    for (int gutter : {0, 3}) {
        const Cube reflectance = baked(text, "disc", PassKind::reflectance, 64, 64, 4, gutter);
        const Cube radiance = baked(text, "disc", PassKind::radiance, 64, 64, 4, gutter);
        const Cube irradiance = baked(text, "disc", PassKind::irradiance, 64, 64, 4, gutter);
        Worst paint, light;
        double filled = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                if (reflectance.row(y, 0)[x] == 0) continue;
                filled += 1;
                paint.add(reflectance.row(y, 0)[x], 0.4, 0.4, x, y, 0);
                paint.add(reflectance.row(y, 1)[x], 0.6, 0.6, x, y, 1);
                const double sent = 0.4 * irradiance.row(y, 0)[x] / std::numbers::pi;
                light.add(radiance.row(y, 0)[x], sent, sent, x, y, 0);
            }
        INFO("gutter " << gutter << ": " << paint.str() << "; " << light.str());
        CHECK(paint.error < 2e-6);
        CHECK(light.error < 2e-6);
        // π 32² texels and those that the edge crosses; three rings more are 2π 36 long at most.
        const double inside = std::numbers::pi * 32 * 32;
        CHECK(filled > inside - 40);
        CHECK(filled < inside + 240 + (gutter == 0 ? 0 : 3 * 2 * std::numbers::pi * 36));
        if (gutter == 3) CHECK(filled > inside + 400);  // the square cuts the rings off
    }
}

TEST_CASE("what lies behind a baked surface does not shine through where it covers a texel in part") {
    if (!haveDevice()) return;
    const auto disc = [](const std::string& behind) {
        return fmt::format(
            "<scene version=\"1\">{}{}<material name=\"m\"><diffuse reflectance=\"constant:0.5\"/>"
            "</material><node name=\"disc\"><disc radius=\"1\" material=\"m\"/></node>"
            "<node name=\"cloud\"><sphere radius=\"9\"/></node>{}</scene>",
            one500, lamps, behind);
    };
    const std::string plain = R"(<background spectrum="constant:1" scale="1000"/>)",
                      picture = R"(<background texture="pass:sky"/><pass name="sky" of="cloud"/>)";
    for (const PassKind as : {PassKind::radiance, PassKind::irradiance, PassKind::reflectance})
        for (const int gutter : {0, 2}) {
            const Cube alone = baked(disc(""), "disc", as, 24, 24, 16, gutter);
            CHECK(baked(disc(plain), "disc", as, 24, 24, 16, gutter).values == alone.values);
            CHECK(baked(disc(picture), "disc", as, 24, 24, 16, gutter).values == alone.values);
            // Edge texels hold the mean of what is covered: no darker than the disc beside them.
            float least = 1e9f, largest = 0;
            for (const float value : alone.values)
                if (value > 0) least = std::min(least, value), largest = std::max(largest, value);
            CHECK(least > (as == PassKind::reflectance ? 0.999f : 0.02f) * largest);
        }
}

TEST_CASE(
    "a bake renders the passes that its node wears and that light it, not what is elsewhere or behind it") {
    if (!haveDevice()) return;
    const auto rendered = [](const std::string& node, const std::string& more) {
        const Scene scene = sceneFrom(R"(<scene version="1"><wavelengths>500 600</wavelengths>
<material name="print"><diffuse texture="pass:worn"/></material>
<material name="other"><emission texture="pass:elsewhere"/></material>
<node name="wall"><plane material="print"/></node><node name="screen"><plane material="other"/></node>
<node name="things"><sphere radius="1"/></node>
<light name="lamp" type="ambient" spectrum="constant:1" scale="1"/><camera size="8x8" look-from="0 0 5"/>
<pass name="worn" of="things" lights="lamp" as="reflectance"/><pass name="elsewhere" of="things" lights="lamp"/>
<pass name="sun" of="things" lights="lamp" as="irradiance"/><pass name="sky" of="things" lights="lamp"/>)" +
                                      more + "</scene>");
        RenderSettings settings;
        settings.bake = Bake{node, PassKind::radiance, 0};
        settings.size = {8, 8};
        Notes notes;
        std::string names;
        const std::vector<GraphNode> graph = renderGraph(scene, settings, notes);
        for (size_t i = 0; i + 1 < graph.size(); ++i)
            names += graph[i].shot.pass->name + " ";
        return names;
    };
    CHECK(rendered("wall", "") == "worn ");
    CHECK(rendered("wall", R"(<light type="directional" spectrum="pass:sun" direction="0 0 -1"/>)") ==
          "sun worn ");
    CHECK(rendered("things", R"(<background texture="pass:sky"/>)").empty());
}

TEST_CASE("the gutter repeats what is next to it and stops at its width") {
    Cube cube;
    cube.info.width = 7;
    cube.info.height = 1;
    cube.info.wavelengths.nm = {500};
    cube.values = {0, 0, 0, 2, 0, 0, 0};
    std::vector<float> coverage{0, 0, 0, 0.5f, 0, 0, 0};
    divideByCoverage(cube, coverage);
    CHECK(addGutter(cube, coverage, 2) == 1);
    CHECK(cube.values == std::vector<float>{0, 4, 4, 4, 4, 4, 0});
}

TEST_CASE("what cannot be baked is refused by name") {
    if (!haveDevice()) return;
    const auto refusal = [](const std::string& node) {
        try {
            static_cast<void>(
                baked("<scene version=\"1\"><camera/><node name=\"lamps\"><light type=\"ambient\" "
                      "spectrum=\"constant:1\" scale=\"1\"/></node></scene>",
                      node, PassKind::radiance, 8, 8));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refusal("lamps").find("node 'lamps' has no surface to bake") != std::string::npos);
    CHECK(refusal("lamp").find("the scene has no node 'lamp' (did you mean 'lamps'?)") != std::string::npos);
}
