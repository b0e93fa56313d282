// Images that passes make for other passes: mirrors, what is all around, what is behind everything, displays,
// lamps of the colour of a picture.
#include "colour/detector.h"
#include "colour/observe.h"
#include "image/cube.h"
#include "render/mirror.h"
#include "render/passes.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

Image passOf(const Scene& scene, const std::string& name) {
    RenderSettings settings;
    settings.pass = name;
    return imageOf(scene, settings);
}

std::string refusalOf(const std::string& text) {
    try {
        const Scene scene = sceneFrom(text);
        Notes notes;
        static_cast<void>(renderGraph(scene, {}, notes));
    } catch (const InputError& error) {
        const std::string message = error.what();
        return message.substr(std::min(message.size(), message.find("scene.xml")));
    }
    return {};
}

/// A material that glows evenly.
std::string glow(const std::string& name, double radiance) {
    return fmt::format("<material name=\"{}\"><emission spectrum=\"constant:1\" scale=\"{}\"/></material>\n",
                       name, radiance);
}

constexpr const char* bands = "<scene version=\"1\"><wavelengths from=\"400\" to=\"700\" step=\"20\"/>\n";

/// A floor mirror of Schlick reflectance 0.9 at normal incidence under a camera that looks down at it, a ball
/// over it, and something below it that no mirror shows.
std::string hall(const std::string& more, const std::string& mirrorPass = "mirror=\"floor\"") {
    return bands + glow("ball", 3) + glow("below", 7) +
           "<material name=\"mirror\"><specular reflectance=\"constant:0.9\" "
           "reflects=\"pass:image\"/></material>\n"
           "<node name=\"floor\" rotate=\"1 0 0 -90\"><plane size=\"8 8\" material=\"mirror\"/></node>\n"
           "<node name=\"twin\" translate=\"0.2 -1.2 0\"><sphere radius=\"0.5\" material=\"ball\"/></node>\n"
           "<node name=\"ball\" translate=\"0.2 1.2 0\"><sphere radius=\"0.5\" material=\"ball\"/></node>\n"
           "<node translate=\"0.5 -0.8 0.5\"><box size=\"0.4\" material=\"below\"/></node>\n"
           "<camera name=\"eye\" look-from=\"0 2 5\" look-at=\"0 0 0\" fov=\"50\" size=\"96x72\"/>"
           "<camera name=\"other\" look-from=\"1 2 5\" look-at=\"0 0 0\" size=\"96x72\"/>"
           "<pass name=\"image\" camera=\"eye\" " +
           mirrorPass +
           "/>\n<pass name=\"twin\" camera=\"eye\" of=\"twin\"/><pass name=\"main\" camera=\"eye\"/>" + more +
           "</scene>";
}

}  // namespace

TEST_CASE(
    "a planar mirror shows the scene before it where its mirror image would stand, times Fresnel's factor") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(hall(""));
    const Image image = passOf(scene, "main"), twin = passOf(scene, "twin");
    size_t compared = 0, wrong = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            // Whole pixels of the ball's mirror image, and all around them: images are filtered.
            bool whole = x > 0 && y > 0 && x + 1 < image.width && y + 1 < image.height;
            for (int i = 0; i < 9 && whole; ++i)
                whole = twin.at(x + i % 3 - 1, y + i / 3 - 1, 5) == 3.0f;
            if (!whole) continue;
            // Down the ray from the eye: the cosine with the floor's normal.
            const double slope = 2 * std::tan(25 * std::numbers::pi / 180) / 72;
            const double right = slope * (x + 0.5 - 48), up = slope * (35.5 - y);
            const Vec3 forward = normalized({0, -2, -5}), upward = normalized(cross({1, 0, 0}, forward));
            const double cosine = -normalized(forward + Vec3{1, 0, 0} * right + upward * up).y;
            const double expected = 3 * (0.9 + 0.1 * std::pow(1 - cosine, 5));
            ++compared;
            wrong += !(std::abs(image.at(x, y, 5) - expected) < 1e-3 * expected);
        }
    CHECK(compared > 50);
    CHECK(wrong == 0);
    float brightest = 0;
    for (float value : image.values)
        brightest = std::max(brightest, value);
    CHECK(brightest < 3.001f);  // nothing from below the floor
}

TEST_CASE("a mirror's pass belongs to its picture: camera and shape") {
    CHECK(refusalOf(hall("", "mirror=\"floor\" size=\"64x64\""))
              .find("the picture has 96x72: another shape (size=)") != std::string::npos);
    CHECK(refusalOf(hall("<pass name=\"main2\" camera=\"other\"/>")).empty());
    std::string text = hall("");
    text.replace(text.find("<pass name=\"main\" camera=\"eye\""), 30, "<pass name=\"main\" camera=\"other\"");
    CHECK(refusalOf(text).find("pass 'image' shows a mirror to another camera than the picture's") !=
          std::string::npos);
    CHECK(refusalOf(hall("", ""))
              .find("pass 'image' is no image for a mirror (allowed: a pass with mirror=, or "
                    "with a camera of type cube)") != std::string::npos);
}

TEST_CASE("six faces show a probe's surroundings in the direction that a ball mirrors") {
    if (!haveDevice()) return;
    // A room whose walls glow 1 … 6, in the order of the faces.
    std::string text = bands;
    const char* const walls[] = {"translate=\"4 0 0\" rotate=\"0 1 0 90\"",
                                 "translate=\"-4 0 0\" rotate=\"0 1 0 90\"",
                                 "translate=\"0 4 0\" rotate=\"1 0 0 90\"",
                                 "translate=\"0 -4 0\" rotate=\"1 0 0 90\"",
                                 "translate=\"0 0 4\"",
                                 "translate=\"0 0 -4\""};
    for (int i = 0; i < 6; ++i)
        text += glow(fmt::format("w{}", i), i + 1);
    text += "<node name=\"room\">";
    for (int i = 0; i < 6; ++i) {
        text += fmt::format("<node {}><plane size=\"8 8\" material=\"w{}\"/></node>\n", walls[i], i);
    }
    text +=
        "</node><material name=\"mirror\"><conductor ior=\"metals/Ag\" reflects=\"pass:probe\"/></material>\n"
        "<node name=\"ball\"><sphere radius=\"0.01\" material=\"mirror\"/></node>\n"
        "<camera name=\"around\" type=\"cube\" look-from=\"0 0 0\" size=\"32x32\"/>\n"
        "<camera name=\"eye\" type=\"orthographic\" height=\"0.03\" look-from=\"0.01 0.02 0.03\" look-at=\"0 "
        "0 0\" "
        "size=\"64x64\"/>\n"
        "<pass name=\"probe\" camera=\"around\" of=\"room\"/><pass name=\"main\" camera=\"eye\" "
        "of=\"ball\"/></scene>";
    const Scene scene = sceneFrom(text);
    RenderSettings settings;
    settings.pass = "probe";
    Notes notes;
    PassTextures passes(scene, library(), device(), settings, notes);
    const Cube probe = passes.render();
    REQUIRE((probe.info.width == 32 && probe.info.height == 6 * 32));
    for (int face = 0; face < 6; ++face)
        for (int corner : {0, 31})
            CHECK(probe.row(32 * face + corner, 3)[corner] == static_cast<float>(face + 1));

    const Image image = passOf(scene, "main");
    const Vec3 back = normalized({1, 2, 3}), right = normalized(cross({0, 1, 0}, back)),
               up = cross(back, right);
    size_t compared = 0, wrong = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double px = (x + 0.5 - 32) * 0.03 / 64 / 0.01, py = (31.5 - y) * 0.03 / 64 / 0.01;
            const double square = px * px + py * py;
            if (square > 0.7) continue;
            const double cosine = std::sqrt(1 - square);
            const Vec3 normal = right * px + up * py + back * cosine;
            const Vec3 d = normal * (2 * cosine) - back;
            const double size = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
            const std::array<double, 3> sorted{std::abs(d.x), std::abs(d.y), std::abs(d.z)};
            int close = 0;
            for (double c : sorted)
                close += c > 0.75 * size;
            if (close > 1) continue;  // near an edge of the room
            const double wall = std::abs(d.x) == size   ? (d.x > 0 ? 1 : 2)
                                : std::abs(d.y) == size ? (d.y > 0 ? 3 : 4)
                                                        : (d.z > 0 ? 5 : 6);
            ++compared;
            // Silver sends back 0.94 … 1 of it.
            const double share = image.at(x, y, 10) / wall;
            wrong += !(share > 0.93 && share < 1);
        }
    CHECK(compared > 300);
    CHECK(wrong == 0);
}

TEST_CASE("a picture behind everything fills the picture; six faces lie in their directions") {
    if (!haveDevice()) return;
    const Scene scene =
        sceneFrom(bands + glow("left", 2) + glow("right", 5) + glow("front", 1) +
                  R"(<node name="sky"><node translate="-2 0 0"><plane size="4 4" material="left"/></node>
<node translate="2 0 0"><plane size="4 4" material="right"/></node></node>
<node name="front" translate="0 0 1"><plane size="1 1" material="front"/></node>
<background texture="pass:sky" filter="nearest"/>
<camera type="orthographic" height="4" look-from="0 0 5" look-at="0 0 0" size="32x32"/>
<pass name="sky" of="sky"/><pass name="main" of="front"/></scene>)");
    const Image image = passOf(scene, "main");
    CHECK(image.at(2, 2, 3) == Approx(2).epsilon(1e-6));
    CHECK(image.at(29, 30, 3) == Approx(5).epsilon(1e-6));
    CHECK(image.at(16, 16, 3) == Approx(1).epsilon(1e-6));
    CHECK(refusalOf(bands + glow("left", 2) +
                    R"(<plane material="left"/><background texture="pass:sky" mapping="cube"/>
<camera/><pass name="sky"/><pass name="main"/></scene>)")
              .find("pass 'sky' is one picture, not six faces (mapping=\"picture\")") != std::string::npos);
}

TEST_CASE("a colorimetric camera and a display close the loop: each colour comes back, by other spectra") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(R"(<scene version="1"><detector name="eye" observer="observers/cie1931-2"/>
<material name="a"><diffuse reflectance="charts/colorchecker/foliage"/></material>
<node translate="-1 0 0"><plane size="2 2" material="a"/></node><node translate="1 0 0"><plane size="2 2"/></node>
<light type="directional" direction="0 0 -1" spectrum="illuminants/D65" illuminance="300 lx"/>
<camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="4x2"/>
<pass name="scene"/><pass name="shown" through="eye" display="displays/crt-brainard-1997" luminance="100 cd/m2"/></scene>)");
    Notes notes;
    RenderSettings settings;
    settings.pass = "shown";
    const Cube shown = PassTextures(scene, library(), device(), settings, notes).render();
    const Image direct = passOf(scene, "scene");
    const DetectorWeights weights = weightsOn(shown.info.wavelengths, standardObserver(library()));
    ChannelImage a(4, 1, 3), b(4, 1, 3);
    observeRow(weights, direct.values.data(), 0, a);
    observeRow(weights, shown.values.data(), 0, b);
    double spectrum = 0;
    for (size_t x = 0; x < 4; ++x)
        for (size_t c = 0; c < 3; ++c)
            CHECK(b.plane[c][x] == Approx(a.plane[c][x]).epsilon(2e-3));
    for (size_t i = 0; i < shown.values.size(); ++i)
        spectrum =
            std::max<double>(spectrum, std::abs(shown.values[i] - direct.values[i]) / direct.values[i]);
    CHECK(spectrum > 0.3);  // metamers
}

TEST_CASE("a lamp of the colour of a pass sends the pass's mean") {
    if (!haveDevice()) return;
    const Scene scene =
        sceneFrom(bands + glow("dark", 1) + glow("bright", 5) +
                  R"(<node name="sky"><node translate="-1 0 0"><plane size="2 2" material="dark"/></node>
<node translate="1 0 0"><plane size="2 2" material="bright"/></node></node><node name="wall"><plane size="4 2"/></node>
<light name="lamp" type="ambient" spectrum="pass:sky"/>
<camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="4x2"/>
<pass name="sky" of="sky"/><pass name="main" of="wall" lights="lamp"/></scene>)");
    CHECK(passOf(scene, "main").at(1, 1, 7) == Approx(3 * 0.5).epsilon(1e-6));
}

TEST_CASE("a mesh before a plane is cut where it crosses, and keeps nothing that lies in it") {
    Mesh mesh;
    mesh.position = {{0, 0, -1}, {2, 0, 1}, {0, 1, 1}, {5, 5, 0}, {6, 5, 0}, {5, 6, 0}};
    mesh.uv = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 0}, {0, 0}};
    mesh.index = {0, 1, 2, 3, 4, 5};
    const Mesh kept = before(mesh, {}, Plane{{0, 0, 1}, 0});
    REQUIRE(kept.triangles() == 2);
    double area = 0;
    for (size_t t = 0; t < kept.index.size(); t += 3) {
        std::array<Vec3, 3> p;
        for (size_t k = 0; k < 3; ++k) {
            const auto& from = kept.position[kept.index[t + k]];
            p[k] = {from[0], from[1], from[2]};
            CHECK(from[2] >= 0);
        }
        area += 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
    }
    const double whole = 0.5 * length(cross({2, 0, 2}, {0, 1, 2}));
    CHECK(area == Approx(0.75 * whole).epsilon(1e-6));
}
