// Passes as textures of other passes: what a reflectance keeps under another lamp, what a picture that glows
// shows, what is refused.
#include "render/passes.h"

#include "colour/detector.h"
#include "colour/observe.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

const char* const lamps[] = {"illuminants/A", "illuminants/D65", "illuminants/FL11", "illuminants/LED-B3"};

/// One pixel a reflectance, in one row, lit by `lamp` from the front: directly, and as the texture that a
/// pass of the same row under an equal-energy light makes.
std::string loop(const std::vector<std::string>& reflectances, const std::string& lamp,
                 const std::string& wavelengths) {
    const size_t count = reflectances.size();
    std::string text = "<scene version=\"1\">\n" + wavelengths;
    std::string row;
    for (size_t i = 0; i < count; ++i) {
        text += fmt::format("<material name=\"m{}\"><diffuse reflectance=\"{}\"/></material>\n", i,
                            reflectances[i]);
        row += fmt::format("<node translate=\"{} 0 0\"><plane material=\"m{}\"/></node>\n",
                           static_cast<double>(i) - 0.5 * static_cast<double>(count) + 0.5, i);
    }
    return text +
           fmt::format(
               "<material name=\"print\"><diffuse texture=\"pass:chart\" filter=\"nearest\"/></material>\n"
               "<node name=\"chart\">{0}</node>\n"
               "<node name=\"print\"><plane size=\"{1} 1\" material=\"print\"/></node>\n"
               "<light name=\"lamp\" type=\"directional\" direction=\"0 0 -1\" spectrum=\"{2}\" "
               "irradiance=\"100 W/m2\"/>\n"
               "<light name=\"other\" type=\"point\" position=\"0 1 900\" spectrum=\"illuminants/FL2\" "
               "intensity=\"5 W/sr\"/>\n"
               "<camera type=\"orthographic\" height=\"1\" look-from=\"0 0 5\" look-at=\"0 0 0\" "
               "size=\"{1}x1\"/>\n"
               "<pass name=\"direct\" of=\"chart\" lights=\"lamp\"/>\n"
               "<pass name=\"chart\" of=\"chart\" lights=\"other\" as=\"reflectance\"/>\n"
               "<pass name=\"print\" of=\"print\" lights=\"lamp\"/>\n</scene>",
               row, count, lamp);
}

Image passOf(const Scene& scene, const std::string& name, RenderSettings settings = {}) {
    settings.pass = name;
    return imageOf(scene, settings);
}

Worst compared(const Image& image, const Image& with) {
    Worst worst;
    REQUIRE((image.width == with.width && image.height == with.height));
    REQUIRE(image.wavelengths.nm == with.wavelengths.nm);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (size_t band = 0; band < image.wavelengths.size(); ++band)
                worst.add(image.at(x, y, band), with.at(x, y, band), with.at(x, y, band), x, y, band);
    return worst;
}

std::string refusalOf(const std::string& text, const RenderSettings& settings = {}) {
    const Scene scene = sceneFrom(text);
    try {
        Notes notes;
        static_cast<void>(PassTextures(scene, library(), device(), settings, notes).render());
    } catch (const InputError& error) {
        const std::string message = error.what();
        return message.substr(std::min(message.size(), message.find("scene.xml")));
    }
    return {};
}

/// A plane that fills the picture of 4 × 4 pixels, and whatever else.
std::string wall(const std::string& material, const std::string& more) {
    return "<scene version=\"1\"><wavelengths from=\"400\" to=\"700\" step=\"10\"/>\n" + material +
           "<node name=\"wall\"><plane size=\"2 2\" material=\"m\"/></node>\n"
           "<camera type=\"orthographic\" height=\"2\" look-from=\"0 0 5\" look-at=\"0 0 0\" "
           "size=\"4x4\"/>\n" +
           more + "</scene>";
}

}  // namespace

TEST_CASE("a reflectance that is linear between the bands comes back from a pass under any lamp") {
    if (!haveDevice()) return;
    std::vector<std::string> reflectances;
    for (int i = 0; i < 12; ++i) {
        // Knots at every tenth nanometre, up and down between 0.04 and 0.95 without two alike.
        std::string pairs;
        for (int nm = 380; nm <= 780; nm += 10)
            pairs += fmt::format("{}:{:.4f} ", nm,
                                 0.04 + 0.91 * ((nm * 7 + i * 131 + nm * nm / (i + 3)) % 997) / 996.0);
        reflectances.push_back(pairs);
    }
    for (const char* projection : {"slit", "point"})
        for (const char* lamp : lamps) {
            CAPTURE(projection, lamp);
            const Scene scene = sceneFrom(
                loop(reflectances, lamp,
                     fmt::format("<wavelengths from=\"380\" to=\"780\" step=\"10\" projection=\"{}\"/>\n",
                                 projection)));
            const Worst worst = compared(passOf(scene, "print"), passOf(scene, "direct"));
            INFO(worst.str());
            CHECK(worst.error < 1e-4);
        }
}

TEST_CASE("every chart of the library, printed by a pass at 5 nm, keeps its colours under other lamps") {
    if (!haveDevice()) return;
    std::vector<std::string> reflectances;
    for (const LibraryEntry& entry : library().list())
        if (entry.quantity == Quantity::reflectance &&
            std::count(entry.name.begin(), entry.name.end(), '/') == 2)
            reflectances.push_back(entry.name);
    REQUIRE(reflectances.size() > 150);
    const Detector observer = standardObserver(library());
    for (const char* lamp : lamps) {
        const Scene scene =
            sceneFrom(loop(reflectances, lamp, "<wavelengths from=\"380\" to=\"780\" step=\"5\"/>\n"));
        const Image direct = passOf(scene, "direct"), print = passOf(scene, "print");
        const DetectorWeights weights = weightsOn(direct.wavelengths, observer);
        // A perfect white under the same lamp.
        const auto spectrum = library().find(lamp);
        const std::array<const Curve*, 1> curve{&spectrum->curve()};
        Triple white = respondXyz(observer, curve);
        const double brightest = [&] {
            ChannelImage xyz(direct.width, 1, 3);
            observeRow(weights, direct.values.data(), 0, xyz);
            return *std::max_element(xyz.plane[1].begin(), xyz.plane[1].end());
        }();
        const double scale = brightest / white[1];
        for (double& v : white)
            v *= scale;
        ChannelImage a(direct.width, 1, 3), b(direct.width, 1, 3);
        observeRow(weights, direct.values.data(), 0, a);
        observeRow(weights, print.values.data(), 0, b);
        double worst = 0;
        size_t at = 0;
        for (size_t i = 0; i < a.pixels(); ++i) {
            const double difference = deltaE00(lab(a.triple(i), white), lab(b.triple(i), white));
            if (difference > worst) worst = difference, at = i;
        }
        INFO(lamp << ": " << reflectances[at] << " is off by ΔE00 " << worst);
        CHECK(worst < 0.1);
    }
}

TEST_CASE("a picture that glows shows the radiances it was made of, lines and all, times its scale") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(R"(<scene version="1"><wavelengths from="400" to="700" step="10"/>
<material name="a"><diffuse reflectance="400:0.1 500:0.7 600:0.2 700:0.4"/></material>
<material name="screen"><emission texture="pass:taken" scale="2" filter="nearest"/></material>
<node name="room"><plane size="2 1" material="a"/>
  <light type="point" position="0.3 0.2 1" spectrum="illuminants/FL11" intensity="9 cd"/></node>
<node name="screen"><plane size="2 1" material="screen"/></node>
<camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="8x4"/>
<pass name="taken" of="room"/><pass name="shown" of="screen"/></scene>)");
    Image taken = passOf(scene, "taken");
    for (float& value : taken.values)
        value *= 2;
    const Worst worst = compared(passOf(scene, "shown"), taken);
    INFO(worst.str());
    CHECK(worst.error < 2e-6);
}

TEST_CASE("only what the target needs is rendered, each pass once, in order") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(loop({"constant:0.5"}, "illuminants/A", ""));
    const auto names = [&](const std::string& target) {
        RenderSettings settings;
        settings.pass = target;
        Notes notes;
        std::string text;
        for (const GraphNode& node : renderGraph(scene, settings, notes))
            text += node.shot.pass->name + " ";
        return text;
    };
    CHECK(names("direct") == "direct ");
    CHECK(names("print") == "chart print ");
}

TEST_CASE("radiances are refused where a pass has none; reflectances are held beyond its bands, and said") {
    if (!haveDevice()) return;
    const auto scene = [](const char* lobe, const char* as) {
        return wall(
            fmt::format("<material name=\"m\"><{} texture=\"pass:p\"/></material>\n", lobe),
            fmt::format(
                "<node name=\"n\"><plane size=\"3 3\"/><light type=\"ambient\" spectrum=\"constant:1\" "
                "scale=\"1\"/></node>\n<light type=\"ambient\" spectrum=\"constant:1\" scale=\"1\"/>"
                "<pass name=\"p\" of=\"n\" as=\"{}\" wavelengths=\"450:650:10\"/><pass "
                "name=\"main\" of=\"wall\"/>",
                as));
    };
    CHECK(refusalOf(scene("emission", "radiance")) ==
          "scene.xml:2:20: pass 'p' has bands from 450 to 650 nm, but pass 'main', which shows it, is "
          "rendered from 400 to 700 nm (wavelengths= of the pass sets them)");
    RenderSettings within;
    within.wavelengths = Wavelengths{{500, 520, 540}, Projection::slit, 20};
    CHECK(refusalOf(scene("emission", "radiance"), within).empty());
    const Scene held = sceneFrom(scene("diffuse", "reflectance"));
    Notes notes;
    CHECK(renderGraph(held, {}, notes).size() == 2);
    REQUIRE(notes.lines().size() == 1);
    CHECK(notes.lines()[0].find("its end values are held") != std::string::npos);
}

TEST_CASE("a reflectance refuses to divide by no light, naming the pixel, and what fluoresces, saying why") {
    if (!haveDevice()) return;
    // The plane's back: light from in front of it does not reach the side that is seen.
    CHECK(refusalOf(wall("<material name=\"m\"><diffuse reflectance=\"constant:0.5\"/></material>\n",
                         "<light type=\"directional\" direction=\"0 0 1\" spectrum=\"illuminants/A\" "
                         "irradiance=\"1 W/m2\"/><pass name=\"p\" as=\"reflectance\"/>"))
              .find("pass 'p': no light arrives at pixel 0,0, so it has no reflectance") !=
          std::string::npos);
    CHECK(refusalOf(wall("<material name=\"m\"><fluorescence excitation=\"gaussian:400,40\" "
                         "emission=\"gaussian:500,40\"/></material>\n",
                         "<light type=\"ambient\" spectrum=\"illuminants/D65\" luminance=\"1 cd/m2\"/><pass "
                         "name=\"p\" as=\"reflectance\"/>"))
              .find("material 'm' is fluorescent: what it sends out depends on the lamp, so no reflectance "
                    "can carry it (as=\"radiance\" can)") != std::string::npos);
}

TEST_CASE("an irradiance is what the lamps send: each with its spectrum, by cosine and distance") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(wall(
        "<material name=\"m\"><diffuse reflectance=\"constant:0.2\"/><emission spectrum=\"illuminants/A\" "
        "luminance=\"9 cd/m2\"/></material>\n",
        "<spectrum name=\"s\" quantity=\"intensity\">400:1 700:4</spectrum><light type=\"point\" "
        "position=\"0.25 0.25 2\" spectrum=\"s\"/><pass name=\"p\" as=\"irradiance\" samples=\"1\"/>"));
    Notes notes;
    PassTextures passes(scene, library(), device(), {}, notes);
    const Cube cube = passes.render();
    CHECK(cube.info.kind == CubeKind::irradiance);
    Worst worst;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            for (size_t band = 1; band + 1 < cube.info.wavelengths.size(); ++band) {
                const double dx = 0.25 + 0.5 * (x - 2) - 0.25, dy = 0.25 + 0.5 * (1 - y) - 0.25,
                             square = dx * dx + dy * dy + 4;
                const double intensity = 1 + (cube.info.wavelengths.nm[band] - 400) / 100;
                const double expected = intensity * 2 / (square * std::sqrt(square));
                worst.add(cube.row(y, band)[x], expected, expected, x, y, band);
            }
    INFO(worst.str());
    CHECK(worst.error < 1e-5);
}

TEST_CASE(
    "a transmittance is what surfaces leave of each pixel, whatever the light: a cube behind them shows "
    "through as if it stood there") {
    if (!haveDevice()) return;
    // An edge after a quarter of column 15, and a ball with all its outlines.
    const std::string scene =
        R"(<scene version="1"><wavelengths from="400" to="700" step="100"/>
        <material name="m"><diffuse reflectance="constant:0.5"/></material>
        <node name="things"><node translate="-1.25 0 0"><plane size="1.55 2" material="m"/></node>
          <node translate="1.3 0 0"><sphere radius="0.6" material="m"/></node></node>
        <light type="directional" direction="0 0 -1" spectrum="illuminants/D65" illuminance="1000 lx"/>
        <background spectrum="illuminants/A" luminance="50 cd/m2"/>
        <camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="40x20"/>
        <pass name="through" of="things" as="transmittance" samples="64"/>
        <pass name="before" of="things" samples="64"/></scene>)";
    const auto cubeOf = [](const std::string& text, const std::string& pass) {
        RenderSettings settings;
        settings.pass = pass;
        Notes notes;
        const Scene read = sceneFrom(text);
        return PassTextures(read, library(), device(), settings, notes).render();
    };
    const Cube through = cubeOf(scene, "through");
    CHECK(through.info.kind == CubeKind::transmittance);
    REQUIRE(through.info.wavelengths.nm == std::vector<double>{400, 500, 600, 700});
    double covered = 0;
    for (int row = 0; row < 20; ++row) {
        for (size_t band = 0; band < 4; ++band) {
            CHECK(through.row(row, band)[14] == 0);
            CHECK(through.row(row, band)[15] == 0.75f);
            CHECK(through.row(row, band)[16] == 1);
            CHECK(std::equal(through.row(row, band), through.row(row, band) + 40, through.row(row, 0)));
        }
        for (size_t x = 20; x < 40; ++x)
            covered += 0.01 * (1 - through.row(row, 0)[x]);
    }
    CHECK(covered == Approx(std::numbers::pi * 0.36).epsilon(0.02));
    const Cube whole = cubeOf(scene, "before");
    std::string dark = scene, lone = scene;
    dark.replace(dark.find("<background"), dark.find("<camera") - dark.find("<background"), "");
    lone.replace(lone.find("<node name=\"things\">"), 0, "<node name=\"nothing\"/>");
    lone.replace(lone.find("before\" of=\"things"), 18, "before\" of=\"nothing");
    const Cube before = cubeOf(dark, "before"), behind = cubeOf(lone, "before");
    double worst = 0;
    for (size_t i = 0; i < whole.values.size(); ++i)
        worst = std::max<double>(
            worst, std::abs(before.values[i] + through.values[i] * behind.values[i] - whole.values[i]) /
                       whole.values[i]);
    CHECK(worst < 1e-6);
    // It is no reflectance.
    CHECK_THROWS_WITH(
        sceneFrom(R"(<scene version="1"><material name="m"><diffuse texture="pass:t"/></material>
        <node name="n"><plane/></node><plane material="m"/>
        <camera size="4x4" look-from="0 0 5" look-at="0 0 0"/>
        <pass name="t" of="n" as="transmittance"/><pass name="main"/></scene>)"),
        Catch::Contains("pass 't' is as=\"transmittance\", but a <diffuse> texture is a reflectance"));
}

TEST_CASE("a pass that repeats sees its generation before: a geometric series") {
    if (!haveDevice()) return;
    // The wall reflects 0.25 under light of radiance 1 and shows half of what it was before.
    for (int generations : {1, 2, 5}) {
        const Scene scene = sceneFrom(
            wall("<material name=\"m\"><diffuse reflectance=\"constant:0.25\"/><emission texture=\"pass:p\" "
                 "scale=\"0.5\"/></material>\n",
                 fmt::format("<light type=\"ambient\" spectrum=\"constant:1\" scale=\"1\"/><pass name=\"p\" "
                             "repeat=\"{}\"/>",
                             generations)));
        const Image image = passOf(scene, "p");
        CHECK(image.at(2, 1, 7) == Approx(0.5 * (1 - std::pow(0.5, generations))).epsilon(1e-6));
    }
}
