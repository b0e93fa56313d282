// Shadows against closed forms: where they begin, that nothing leaks in and nothing hides itself.
#include "base/text.h"
#include "scenes/lit_plane.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

using namespace spectrad;
using namespace spectrad::test;

namespace {

RenderSettings samples(int count) {
    RenderSettings settings;
    settings.samples = count;
    return settings;
}

/// How far a line from `from` to `to` passes by a place; nothing where it ends before it is nearest.
std::optional<double> missOf(Vec3 from, Vec3 to, Vec3 place) {
    const Vec3 along = to - from;
    const double at = dot(place - from, along) / dot(along, along);
    if (at <= 0 || at >= 1) return std::nullopt;
    return length(from + along * at - place);
}

std::string withShadows(std::string scene, bool shadows) {
    const std::string mark = "SHADOWS";
    for (size_t at; (at = scene.find(mark)) != std::string::npos;)
        scene.replace(at, mark.size(), shadows ? "shadows=\"true\"" : "");
    return scene;
}

/// A scene of one band: bodies in one paint, seen from (3, 3.5, 8).
std::string bodies(const std::string& content,
                   const std::string& paint = "<diffuse reflectance=\"constant:0.5\"/>") {
    return R"(<scene version="1"><wavelengths>550</wavelengths><material name="m">)" + paint + "</material>" +
           content + R"(<camera fov="35" look-from="3 3.5 8" look-at="0 0.6 0" size="96x64"/></scene>)";
}

constexpr const char* lamps =
    R"(<light type="point" position="3 5 4" spectrum="constant:1" scale="100" SHADOWS/>
       <light type="spot" position="-3 5 4" target="0 0 0" angle="80" spectrum="constant:1" scale="90" SHADOWS/>
       <light type="directional" direction="1 -1 -0.3" spectrum="constant:1" scale="10" SHADOWS/>)";

double largest(const Image& image) {
    double most = 0;
    for (const float value : image.values)
        most = std::max<double>(most, value);
    return most;
}

}  // namespace

TEST_CASE("a ball's shadow on a plane ends where lines to the light touch the ball") {
    if (!haveDevice()) return;
    const Vec3 ball{0.2, 0.5, 1.2}, light{0.7, 1.9, 3.4}, far = normalized(Vec3{0.3, 0.5, 1});
    constexpr double radius = 0.35, intensity = 7;
    for (const bool orthographic : {false, true})
        for (const bool directional : {false, true}) {
            LitPlane plane;
            plane.orthographic = orthographic;
            const std::string lamp =
                directional ? fmt::format("type=\"directional\" direction=\"{}\"", text(far * -1))
                            : fmt::format("type=\"point\" position=\"{}\"", text(light));
            const Image image =
                imageOf(plane.scene(fmt::format(
                            "<node translate=\"{}\"><sphere radius=\"{}\" material=\"paint\"/></node>"
                            "<light {} spectrum=\"constant:1\" scale=\"{}\" shadows=\"true\"/>",
                            text(ball), radius, lamp, intensity)),
                        samples(1));
            int dark = 0, bright = 0, wrong = 0;
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x) {
                    const Vec3 place = plane.seen(x, y);
                    const Vec3 eye = orthographic
                                         ? place + normalized(plane.from - plane.at) * length(plane.from)
                                         : plane.from;
                    const auto before = missOf(place, eye, ball),
                               shadow = missOf(place, directional ? place + far * 20 : light, ball);
                    // Triangles lie up to a tenth of a pixel inside of the ball.
                    constexpr double chord = 0.01;
                    if (before && *before < radius + chord) continue;
                    if (shadow && std::abs(*shadow - radius) < chord) continue;
                    const bool hidden = shadow && *shadow < radius;
                    const double lit = intensity * (directional ? plane.reflectance / std::numbers::pi *
                                                                      dot(plane.normal(), far)
                                                                : plane.underPoint(light, x, y));
                    (hidden ? dark : bright)++;
                    wrong += std::abs(image.at(x, y) - (hidden ? 0.0 : lit)) > 1e-5 * lit;
                }
            INFO(orthographic << directional);
            CHECK(dark > 60);
            CHECK(bright > 1000);
            CHECK(wrong == 0);
        }
}

TEST_CASE("planes, balls, boxes and rods hide nothing of themselves: the same bytes as without shadows") {
    if (!haveDevice()) return;
    for (
        const char* body :
        {R"(<node rotate="1 0 0 -90"><plane size="20" material="m"/></node>)",
         R"(<node rotate="1 0 0 -90"><plane size="2000" material="m"/></node>)",
         R"(<node translate="0 1 0"><sphere radius="1" material="m"/></node>)",
         R"(<node translate="0 1 0" rotate="0 1 0 30"><box size="1" material="m"/></node>)",
         R"(<node translate="0 1 0" rotate="3 1 2 50"><box size="30 0.05 0.05" material="m"/></node>)",
         R"(<node translate="0 1 0" rotate="2 -1 2 70"><box size="30 0.01 0.01" material="m"/></node>)",
         R"(<node translate="0 1 0" rotate="1 3 1 40"><box size="100 0.05 0.05" material="m"/></node>)",
         R"(<node translate="0 1 0" rotate="1 1 3 50"><plane size="20 0.05" material="m"/></node>)",
         R"(<node translate="0 1 0" rotate="1 0.2 0.3 40"><cylinder radius="0.01" height="10" material="m"/></node>)"})
        for (const int count : {1, 16}) {
            const std::string scene =
                bodies(body + std::string(lamps),
                       "<diffuse reflectance=\"constant:0.5\"/><gloss ior=\"1.5\" roughness=\"0.4\"/>");
            const Image with = imageOf(withShadows(scene, true), samples(count)),
                        without = imageOf(withShadows(scene, false), samples(count));
            INFO(body);
            CHECK(largest(without) > 0);
            CHECK((with.values == without.values));
        }
}

TEST_CASE("a mesh of few triangles with the normals of a ball is shaded to its terminator") {
    if (!haveDevice()) return;
    // Faces that turn away from a light which the ball's normals still see would be dark, one by one.
    Mesh mesh;
    constexpr int around = 12, down = 8;
    for (int j = 0; j <= down; ++j)
        for (int i = 0; i < around; ++i) {
            const double polar = std::numbers::pi * j / down, azimuth = 2 * std::numbers::pi * i / around;
            const std::array<float, 3> p{static_cast<float>(std::sin(polar) * std::cos(azimuth)),
                                         static_cast<float>(std::cos(polar)),
                                         static_cast<float>(std::sin(polar) * std::sin(azimuth))};
            mesh.position.push_back(p);
            mesh.normal.push_back(p);
        }
    for (std::uint32_t j = 0; j < down; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t a = j * around + i, b = j * around + (i + 1) % around;
            for (const std::uint32_t corner : {a, b, b + around, a, b + around, a + around})
                mesh.index.push_back(corner);
        }
    std::array<Image, 2> image;
    for (const bool shadows : {false, true}) {
        Scene scene = sceneFrom(withShadows(bodies(lamps), shadows));
        scene.nodes.front().meshes.push_back({std::make_shared<const Mesh>(mesh), 0});
        image[shadows] = imageOf(scene, samples(4));
    }
    const double most = largest(image[0]);
    double worst = 0;
    for (size_t i = 0; i < image[0].values.size(); ++i)
        worst = std::max<double>(worst, std::abs(image[0].values[i] - image[1].values[i]));
    INFO("of " << most << ": " << worst);
    CHECK(worst <= 0.02 * most);
}

TEST_CASE("no light leaves a closed body") {
    if (!haveDevice()) return;
    // Its surroundings alone are seen: at an outline its inside shows where both sides are equally far.
    const std::string scene =
        R"(<scene version="1"><wavelengths>550</wavelengths><material name="m"><diffuse reflectance="constant:0.5"/></material>BODY
<light type="point" position="0.3 0.1 0.2" spectrum="constant:1" scale="100" SHADOWS/>
<node translate="0 -2 0" rotate="1 0 0 -90"><plane size="20" material="m"/></node>
<camera fov="60" look-from="0 -1.6 3" look-at="0 -2 0.4" size="128x64"/></scene>)";
    for (const char* body :
         {R"(<sphere radius="1" material="m"/>)",
          R"(<node rotate="1 2 3 40"><box size="1.5" material="m"/></node>)",
          R"(<node rotate="3 1 1 70"><cylinder radius="0.9" height="1.6" material="m"/></node>)"}) {
        INFO(body);
        std::string with = scene;
        with.replace(with.find("BODY"), 4, body);
        CHECK(largest(imageOf(withShadows(with, true), samples(64))) == 0);
        CHECK(largest(imageOf(withShadows(with, false), samples(64))) > 0);
    }
}

TEST_CASE("what is told to throw no shadow throws none, nor do lights that are not asked") {
    if (!haveDevice()) return;
    const std::string floor = R"(<node rotate="1 0 0 -90"><plane size="20" material="m"/></node>)";
    const std::string globe =
        R"(<node ATTRIBUTE><node translate="0 1 0"><sphere radius="0.2" material="m"/></node></node>)";
    const std::string bulb =
        R"(<light type="point" position="0 1 0" spectrum="constant:1" scale="5" shadows="true"/>)";
    const auto at = [&](const std::string& attribute, const std::string& content) {
        std::string node = globe;
        node.replace(node.find("ATTRIBUTE"), 9, attribute);
        return imageOf(bodies(floor + node + content), samples(1)).at(48, 60);
    };
    CHECK(at("", bulb) == 0);
    const float lit = at(R"(shadows="false")", bulb);
    CHECK(lit > 0);
    CHECK(at(R"(name="n" shadows="false")", "<instance of=\"n\"/>" + bulb) == lit);
    // Another lamp of the same spectrum shines through.
    CHECK(at("", bulb + R"(<light type="point" position="0 1 0" spectrum="constant:1" scale="5"/>)") == lit);
}

TEST_CASE("shadows are the same at every scale of lengths") {
    if (!haveDevice()) return;
    const auto scene = [](double metres) {
        const auto l = [&](double x) { return shortest(x * metres); };
        return fmt::format(
            R"(<scene version="1"><wavelengths>550</wavelengths><material name="m"><diffuse reflectance="constant:0.5"/></material>
<node scale="{0}"><node rotate="1 0 0 -90"><plane size="20" material="m"/></node><node translate="0 1 0"><box size="1" material="m"/></node>
<node translate="1.5 0.5 1"><sphere radius="0.5" material="m"/></node></node>
<light type="directional" direction="1 -1 -0.3" spectrum="constant:1" scale="10" shadows="true"/>
<light type="spot" position="{1} {2} {3}" target="0 0 0" angle="80" spectrum="constant:1" scale="{8}" shadows="true"/>
<camera fov="35" look-from="{4} {5} {6}" look-at="0 {7} 0" size="96x64"/></scene>)",
            l(1), l(-3), l(5), l(4), l(3), l(3.5), l(8), l(0.6), shortest(90 * metres * metres));
    };
    const Image one = imageOf(scene(1), samples(4));
    CHECK(largest(one) > 0);
    for (const double metres : {0x1p-30, 0x1p30})
        CHECK((imageOf(scene(metres), samples(4)).values == one.values));
}

TEST_CASE("a shadow has the colour of the other lamp") {
    if (!haveDevice()) return;
    const std::string scene =
        R"(<scene version="1"><wavelengths>450 550 650</wavelengths><material name="m"><diffuse reflectance="constant:1"/></material>
<node rotate="1 0 0 -90"><plane size="20" material="m"/></node><node translate="0 0.5 0"><box size="0.4 1 0.4" material="m"/></node>
<light type="directional" direction="1 -1 0" spectrum="illuminants/A" scale="2" shadows="true"/>
<light type="directional" direction="-1 -1 0" spectrum="illuminants/D65" scale="3" shadows="true"/>
<camera type="orthographic" height="4" look-from="0 5 0" look-at="0 0 0" up="0 0 -1" size="40x40"/></scene>)";
    const Image image = imageOf(scene, samples(1));
    const int row = 20, left = 15, right = 24, beside = 3;  // 0.1 m a pixel; the box is in the middle four
    for (size_t band = 0; band < 3; ++band) {
        const float a = image.at(left, row, band), d = image.at(right, row, band),
                    both = image.at(beside, row, band);
        CHECK(a > 0);
        CHECK(d > 0);
        CHECK(a + d == Approx(both).epsilon(1e-6));
    }
    // On the left stands no daylight, on the right no incandescent light.
    CHECK(image.at(left, row, 2) / image.at(left, row, 0) > 2);
    CHECK(image.at(right, row, 2) / image.at(right, row, 0) < 1);
}

TEST_CASE("baked shadows lie where they are seen") {
    if (!haveDevice()) return;
    const std::string scene =
        R"(<scene version="1"><wavelengths>550</wavelengths><material name="m"><diffuse reflectance="constant:1"/></material>
<node name="wall"><plane size="2" material="m"/></node>
<node name="post" translate="0 0 0.5"><box size="0.2 2 0.1" material="m"/></node>
<light type="directional" direction="0.6 0 -0.8" spectrum="constant:1" scale="1" shadows="true"/>
<camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="40x40"/></scene>)";
    const Image seen = imageOf(scene, samples(1));
    CHECK(seen.at(27, 20) == 0);  // the post's shadow, 0.5 · 0.75 to the right of it
    CHECK(seen.at(35, 20) > 0);
    RenderSettings settings = samples(1);
    settings.bake = Bake{"wall", PassKind::radiance};
    settings.size = {40, 40};
    const Image baked = imageOf(scene, settings);
    for (int x = 0; x < 40; ++x)
        if (x < 17 || x > 22) CHECK(baked.at(x, 20) == seen.at(x, 20));
    settings.bake->as = PassKind::irradiance;
    settings.substitute = Substitute::irradiance;
    CHECK(imageOf(scene, settings).at(27, 20) == 0);
}

TEST_CASE("reflectances have no shadows") {
    if (!haveDevice()) return;
    const std::string scene =
        R"(<scene version="1"><wavelengths>550</wavelengths><material name="m"><diffuse reflectance="constant:0.4"/></material>
<node><plane size="2" material="m"/></node><node translate="0 0 0.5"><box size="0.2 2 0.1" material="m"/></node>
<light type="directional" direction="0.6 0 -0.8" spectrum="constant:1" scale="1" shadows="true"/>
<camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="40x40"/></scene>)";
    RenderSettings settings = samples(1);
    settings.substitute = Substitute::equalEnergy;
    CHECK(imageOf(scene, settings).at(27, 20) > 0);
}

TEST_CASE("a lamp that lies in a surface is not hidden by it") {
    if (!haveDevice()) return;
    const std::string scene =
        R"(<scene version="1"><wavelengths>550</wavelengths><material name="m"><diffuse reflectance="constant:0.5"/></material>
<node rotate="1 0 0 -90"><plane size="6" material="m"/></node>
<node translate="0 2.7 0" rotate="1 0 0 90"><plane size="6" material="m"/></node>
<light type="point" position="0.3 HEIGHT 0.2" spectrum="constant:1" scale="9" SHADOWS/>
<camera fov="70" look-from="1.1 1.6 2.8" look-at="0 0.8 0" size="96x64"/></scene>)";
    const auto at = [&](const std::string& height, bool shadows) {
        std::string text = scene;
        text.replace(text.find("HEIGHT"), 6, height);
        return imageOf(withShadows(text, shadows), samples(16));
    };
    for (const char* height : {"2.7", "2.7000001", "2.6999999"}) {
        INFO(height);
        CHECK((at(height, true).values == at(height, false).values));
    }
    CHECK(at("2.701", true).at(48, 60) == 0);
}

TEST_CASE("a ball on a box whose normals were averaged over its edges throws its shadow there") {
    if (!haveDevice()) return;
    Mesh box;
    for (int i = 0; i < 8; ++i) {
        const std::array<float, 3> p{i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f};
        box.position.push_back(p);
        box.normal.push_back(p);
    }
    box.index = {2, 6, 3, 3, 6, 7, 0, 1, 4, 1, 5, 4, 4, 5, 6, 5, 7, 6,
                 0, 2, 1, 1, 2, 3, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    Scene scene = sceneFrom(
        R"(<scene version="1"><wavelengths>550</wavelengths><material name="m"><diffuse reflectance="constant:0.5"/></material>
<node translate="0 0.58 0"><sphere radius="0.08" material="m"/></node>
<light type="directional" direction="1 -1 0" spectrum="constant:1" scale="1" shadows="true"/>
<camera type="orthographic" height="1" look-from="0 5 0" look-at="0 0 0" up="0 0 -1" size="100x100"/></scene>)");
    scene.nodes.front().meshes.push_back({std::make_shared<const Mesh>(box), 0});
    const Image image = imageOf(scene, samples(1));
    CHECK(image.at(62, 50) == 0);
    CHECK(image.at(40, 50) > 0);
}

TEST_CASE("what lies behind a mirror hides lamps in it as it does outside") {
    if (!haveDevice()) return;
    // The mirror itself stands between the lamp and all that it shows.
    const std::string scene =
        R"(<scene version="1"><wavelengths>550</wavelengths><material name="m"><diffuse reflectance="constant:0.5"/></material>
<node rotate="1 0 0 -90"><plane size="8" material="m"/></node>
<node name="glass"><plane size="40" material="m"/></node>
<light type="point" position="0 1 -2" spectrum="constant:1" scale="9" SHADOWS/>
<camera name="eye" fov="60" look-from="0 1.5 3" look-at="0 0.5 0" size="64x48"/>
<pass name="mirrored" mirror="glass" camera="eye"/></scene>)";
    RenderSettings settings = samples(4);
    settings.pass = "mirrored";
    CHECK(largest(imageOf(sceneFrom(withShadows(scene, true)), settings)) == 0);
    CHECK(largest(imageOf(sceneFrom(withShadows(scene, false)), settings)) > 0);
}

TEST_CASE("a node that throws no shadow throws none in a pass of what stands in it, nor when it is baked") {
    if (!haveDevice()) return;
    const std::string scene =
        R"(<scene version="1"><wavelengths>550</wavelengths><material name="m"><diffuse reflectance="constant:0.5"/></material>
<node WORD rotate="1 2 0 20"><node rotate="0 1 3 30"><node rotate="2 1 0 -40"><node name="group">
<node rotate="1 0 0 -90"><plane size="4" material="m"/></node>
<node translate="0 0.5 0"><box size="0.5" material="m"/></node></node></node></node></node>
<light name="lamp" type="point" position="3 9 2" spectrum="constant:1" scale="100" shadows="true"/>
<camera name="eye" fov="40" look-from="2 9 3" look-at="0 0 0" size="64x64"/>
<pass name="all" camera="eye"/><pass name="part" of="group" lights="lamp" camera="eye"/></scene>)";
    for (const bool casts : {false, true}) {
        std::string text = scene;
        text.replace(text.find("WORD"), 4, casts ? "" : "shadows=\"false\"");
        const Scene read = sceneFrom(text);
        RenderSettings settings = samples(1);
        settings.pass = "all";
        const Image all = imageOf(read, settings);
        settings.pass = "part";
        CHECK((imageOf(read, settings).values == all.values));
        RenderSettings bake = samples(1);
        bake.bake = Bake{"group", PassKind::radiance};
        bake.size = {32, 32};
        const Plan plan = planOf(read, bake);
        CHECK(plan.world.casters.size() == (casts ? plan.triangles() : 0));
    }
}
