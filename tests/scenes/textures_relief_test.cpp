// Normal and bump maps against closed forms; nothing from below the horizon.
#include "image/picture.h"
#include "image/png16.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

constexpr double pi = std::numbers::pi;
const std::string camera =
    R"(<camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="64x32"/>)";

std::string sceneOf(const std::string& lobes, const std::string& placed, const std::string& light,
                    const std::string& eye = camera, const std::string& unit = "m") {
    return "<scene version=\"1\" unit=\"" + unit +
           "\"><wavelengths projection=\"point\">550</wavelengths><material name=\"m\">" + lobes +
           "</material>" + placed + light + eye + "</scene>";
}
std::string sun(Vec3 towards) {
    return fmt::format(R"(<light type="directional" direction="{} {} {}" spectrum="constant:1" scale="1"/>)",
                       -towards.x, -towards.y, -towards.z);
}
Image rendered(const TemporaryFolder& folder, const std::string& text) {
    Notes notes;
    RenderSettings settings;
    settings.samples = 1;
    return imageOf(loadScene(folder.write("scene.xml", text), library(), {}, notes), settings);
}
void writeColour(const TemporaryFolder& folder, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    writePng(folder.path() / "normal.png", {1, 1, 3, {r, g, b}}, {}, {});
}
double worstOf(const Image& image, double want) {
    double worst = 0;
    for (float value : image.values)
        worst = std::max<double>(worst, std::abs(value - want));
    return worst;
}

const std::string white = "<diffuse reflectance=\"constant:1\"/>";
const std::string plane = R"(<plane size="2 1" material="m"/>)";

}  // namespace

TEST_CASE(
    "a normal map's colour is a direction in the frame of u, v and the outside: front, behind, mirrored, "
    "turned") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    writeColour(folder, 200, 90, 220);
    const double x = 200 / 127.5 - 1, y = 90 / 127.5 - 1, z = 220 / 127.5 - 1,
                 l = std::sqrt(x * x + y * y + z * z);
    const Vec3 light = normalized({0.4, 0.3, 0.8});
    const auto lambert = [&](Vec3 n) { return std::max(0.0, dot(n, light)) / pi; };
    const std::string lobes = white + "<normal map=\"normal.png\"/>";
    CHECK(worstOf(rendered(folder, sceneOf(lobes, plane, sun(light))), lambert(Vec3{x, y, z} * (1 / l))) <
          1e-6);
    // Mirrored in x: u goes to the left, the outside stays in front.
    const std::string mirrored = "<node scale=\"-1 1 1\">" + plane + "</node>";
    CHECK(worstOf(rendered(folder, sceneOf(lobes, mirrored, sun(light))), lambert(Vec3{-x, y, z} * (1 / l))) <
          1e-6);
    // Turned about its normal by a quarter: u goes up, v to the left.
    const std::string turned = "<node rotate=\"0 0 1 90\" scale=\"2\">" + plane + "</node>";
    CHECK(
        worstOf(
            rendered(
                folder,
                sceneOf(
                    lobes, turned, sun(light),
                    R"(<camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="32x32"/>)")),
            lambert(Vec3{-y, x, z} * (1 / l))) < 1e-6);
    // The image turned on the surface by a quarter: its own u goes down, its v to the right.
    CHECK(worstOf(rendered(folder,
                           sceneOf(white + "<normal map=\"normal.png\" rotate=\"90\"/>", plane, sun(light))),
                  lambert(Vec3{y, -x, z} * (1 / l))) < 1e-6);
    // From behind the same surface is seen from inside: hills are hollows.
    const std::string behind = "<node rotate=\"0 1 0 180\">" + plane + "</node>";
    CHECK(worstOf(rendered(folder, sceneOf(lobes, behind, sun(light))), lambert(Vec3{x, -y, z} * (1 / l))) <
          1e-6);
    // Half the tilt.
    const double h = std::sqrt(x * x / 4 + y * y / 4 + z * z);
    CHECK(worstOf(rendered(folder, sceneOf(white + "<normal map=\"normal.png\" strength=\"0.5\"/>", plane,
                                           sun(light))),
                  lambert(Vec3{x / 2, y / 2, z} * (1 / h))) < 1e-6);
}

TEST_CASE("a ramp of heights is a tilted plane, in any unit of length") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    // Each column of 64 is 3 grey values higher than the one before.
    std::vector<std::uint8_t> ramp;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 64; ++column)
            ramp.push_back(static_cast<std::uint8_t>(column * 3));
    writePng(folder.path() / "ramp.png", {64, 4, 1, ramp}, {}, {});
    const Vec3 light = normalized({0.3, 0.2, 0.9});
    for (const double depth : {0.4, -1.5}) {
        const double slope = 3 / 255.0 * 64 / 2 * depth;  // over the plane's width of 2
        const Vec3 n = normalized({-slope, 0, 1});
        const double want = std::max(0.0, dot(n, light)) / pi;
        CAPTURE(depth);
        CHECK(worstOf(rendered(folder,
                               sceneOf(white + fmt::format("<bump height=\"ramp.png\" depth=\"{}\"/>", depth),
                                       plane, sun(light))),
                      want) < 2e-6);
        // The same in millimetres, and twice as wide and high with twice the depth.
        const std::string large = R"(<plane size="4 2" material="m"/>)";
        CHECK(
            worstOf(
                rendered(
                    folder,
                    sceneOf(
                        white + fmt::format("<bump height=\"ramp.png\" depth=\"{}\"/>", 2 * depth), large,
                        sun(light),
                        R"(<camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="64x32"/>)",
                        "mm")),
                want) < 2e-6);
    }
}

TEST_CASE("relief of 16 bits keeps them: slopes that 8 bits do not know, and directions as they stand") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    Picture16 ramp{64, 4, 1, {}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 64; ++column)
            ramp.pixels.push_back(static_cast<std::uint16_t>(20000 + 3 * column));  // all the same of 8 bits
    writePng16(folder.path() / "ramp.png", ramp);
    const Vec3 light = normalized({0.3, 0.2, 0.9});
    const double depth = 100, slope = 3 / 65535.0 * 64 / 2 * depth;
    CHECK(worstOf(rendered(folder,
                           sceneOf(white + "<bump height=\"ramp.png\" depth=\"100\"/>", plane, sun(light))),
                  dot(normalized({-slope, 0, 1}), light) / pi) < 2e-6);
    // writePng16 marks its files as linear, which is no matter of a direction.
    const std::string bent = white + "<normal map=\"normal.png\"/>";
    writePng16(folder.path() / "normal.png", {1, 1, 3, {200 * 257, 90 * 257, 220 * 257}});
    const Vec3 n = normalized({200 / 127.5 - 1, 90 / 127.5 - 1, 220 / 127.5 - 1});
    CHECK(worstOf(rendered(folder, sceneOf(bent, plane, sun(light))), dot(n, light) / pi) < 1e-6);
}

TEST_CASE(
    "no light comes from below the surface's own horizon, and a bent surface never sends back more than "
    "arrives") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    writeColour(folder, 250, 128, 140);  // leans far towards +x
    for (const std::string& lobes : {white, white + R"(<gloss ior="1.5" roughness="0.4"/>)",
                                     std::string(R"(<conductor ior="metals/Ag" roughness="0.5"/>)"),
                                     std::string(R"(<diffuse reflectance="constant:1" roughness="40"/>)")}) {
        CAPTURE(lobes);
        const std::string bent = lobes + "<normal map=\"normal.png\"/>";
        // A degree below the horizon on the side that the normals lean to, and a degree above.
        const double a = pi / 180;
        CHECK(worstOf(rendered(folder, sceneOf(bent, plane, sun({std::cos(a), 0, -std::sin(a)}))), 0) == 0);
        CHECK(rendered(folder, sceneOf(bent, plane, sun({std::cos(a), 0, std::sin(a)}))).at(20, 16) > 0);
        // In a white furnace, seen from where the normals lean and from where they are turned away.
        for (const std::string from : {"4 0 2", "-4 0 2"}) {
            const Image image = rendered(
                folder, sceneOf(bent, plane, R"(<light type="ambient" spectrum="constant:1" scale="1"/>)",
                                "<camera type=\"orthographic\" height=\"0.5\" look-from=\"" + from +
                                    "\" look-at=\"0 0 0\" size=\"8x8\"/>"));
            CHECK(image.at(4, 4) > 0);
            CHECK(image.at(4, 4) <= 1.001);
        }
    }
}

TEST_CASE("only scenes with bent normals compile them; wrong pictures are refused") {
    const TemporaryFolder folder;
    writeColour(folder, 128, 128, 255);
    writePng(folder.path() / "grey.png", {1, 1, 1, {7}}, {}, {});
    const auto planFrom = [&](const std::string& lobes) {
        Notes notes;
        return planOf(loadScene(folder.write("scene.xml", sceneOf(lobes, plane, sun({0, 0, 1}))), library(),
                                {}, notes));
    };
    const auto has = [](const Plan& plan) {
        return std::find(plan.defines.begin(), plan.defines.end(), "HAS_RELIEF") != plan.defines.end();
    };
    CHECK_FALSE(has(planFrom(white)));
    CHECK(has(planFrom(white + "<normal map=\"normal.png\"/>")));
    CHECK(has(planFrom(white + "<bump height=\"grey.png\" depth=\"0.1\"/>")));
    CHECK_THROWS_WITH(planFrom(white + "<normal map=\"grey.png\"/>"), Catch::Contains("is grey"));
    CHECK_THROWS_WITH(planFrom(white + "<bump height=\"normal.png\" depth=\"1\"/>"),
                      Catch::Contains("pixel 0,0 is coloured"));
    CHECK_THROWS_WITH(planFrom(white + "<normal map=\"normal.png\"/><bump height=\"grey.png\" depth=\"1\"/>"),
                      Catch::Contains("one fine shape"));
}
