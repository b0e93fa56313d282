// Spectral textures: what was rendered as a reflectance is that reflectance under any lamp.
#include "image/cube.h"
#include "image/picture.h"
#include "render/passes.h"
#include "render/renderer.h"
#include "scenes/measured.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

const std::string paints = R"(
  <material name="a"><diffuse reflectance="charts/colorchecker/red"/></material>
  <material name="b"><diffuse reflectance="charts/colorchecker/foliage"/></material>
  <material name="c"><diffuse reflectance="charts/colorchecker/neutral-5"/></material>
  <material name="d"><diffuse reflectance="400:0.1 500:0.7 600:0.2 700:0.4"/></material>)";
const std::string patches = R"(
    <node translate="-0.75 0 0"><plane size="0.5 1" material="a"/></node>
    <node translate="-0.25 0 0"><plane size="0.5 1" material="b"/></node>
    <node translate="0.25 0 0"><plane size="0.5 1" material="c"/></node>
    <node translate="0.75 0 0"><plane size="0.5 1" material="d"/></node>)";

/// A chart of four paints beside a canvas of the same size that wears its reflectance.
std::string loop(const std::string& filter, const std::string& lamp, const std::string& extra = "") {
    return "<scene version=\"1\"><wavelengths from=\"400\" to=\"700\" step=\"10\"/>" + paints +
           "<material name=\"canvas\"><diffuse texture=\"pass:reflectance\" filter=\"" + filter +
           "\"/></material>" + "<node name=\"chart\" translate=\"50 0 0\">" + patches +
           R"(<light type="directional" direction="0.3 0.2 -1" spectrum="illuminants/A" illuminance="700 lx"/>
    <camera name="painter" type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="64x32"/></node>
  <node name="original">)" +
           patches + lamp +
           R"(<camera name="direct" type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="64x32"/></node>
  <node name="gallery" translate="0 50 0"><plane size="2 1" material="canvas"/>)" +
           lamp +
           R"(<camera name="visitor" type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="64x32"/></node>
  <pass name="reflectance" camera="painter" of="chart" as="reflectance"/>
  <pass name="again" camera="visitor" of="gallery" as="reflectance"/>
  <pass name="direct" camera="direct" of="original"/>
  <pass name="main" camera="visitor" of="gallery"/>)" +
           extra + "</scene>";
}

Image imageOfPass(const Scene& scene, const std::string& pass, const RenderSettings& given = {}) {
    RenderSettings settings = given;
    settings.pass = pass;
    Notes notes;
    PassTextures textures(scene, library(), device(), settings, notes);
    return imageOf(makePlan(scene, settings, library(), textures, notes));
}

Cube cubeOfPass(const Scene& scene, const std::string& name, const RenderSettings& given = {}) {
    RenderSettings settings = given;
    settings.pass = name;
    Notes notes;
    PassTextures textures(scene, library(), device(), settings, notes);
    return textures.render();
}

/// The message of the error that planning the main pass ends with.
std::string refusal(const std::string& text) {
    const Scene scene = sceneFrom(text);
    try {
        (void)imageOfPass(scene, "main");
    } catch (const InputError& error) {
        return error.what();
    }
    return "not refused";
}

const std::string window =
    R"(<light type="directional" direction="0.1 -0.2 -1" spectrum="illuminants/D65" illuminance="500 lx"/>)";

}  // namespace

TEST_CASE(
    "a chart's rendered reflectance hung as a texture is the chart, in every pixel and band and under any "
    "lamp") {
    if (!haveDevice()) return;
    for (const std::string lamp :
         {"illuminants/D65", "illuminants/A", "illuminants/FL11", "illuminants/LED-B3"}) {
        const std::string light = "<light type=\"directional\" direction=\"0.1 -0.2 -1\" spectrum=\"" + lamp +
                                  "\" illuminance=\"500 lx\"/>";
        const Scene scene = sceneFrom(loop("nearest", light));
        const Image direct = imageOfPass(scene, "direct"), hung = imageOfPass(scene, "main");
        Worst all;
        for (int y = 0; y < 32; ++y)
            for (size_t band = 0; band < 31; ++band)
                for (int x = 0; x < 64; ++x) {
                    const double want = direct.at(x, y, band);
                    // Charts are measured every 10 nm, so linear between the bands; so is the last paint.
                    all.add(hung.at(x, y, band), want, want, x, y, band);
                }
        INFO(lamp << ": " << all.str());
        CHECK(all.error <= 1e-6);
    }
}

TEST_CASE("a reflectance rendered from a texture that holds it is the same again") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(loop("nearest", window));
    const Cube first = cubeOfPass(scene, "reflectance"), second = cubeOfPass(scene, "again");
    CHECK(first.info.kind == CubeKind::reflectance);
    REQUIRE(first.values.size() == second.values.size());
    double worst = 0;
    for (size_t i = 0; i < first.values.size(); ++i)
        worst = std::max<double>(worst, std::abs(first.values[i] - second.values[i]) / first.values[i]);
    CHECK(worst <=
          5e-7);  // texel, g, c, their products and sums, the quotient: eight roundings of float, 6e-8 each
}

TEST_CASE("with point bands the loop is closed bit for bit where light arrives square-on") {
    if (!haveDevice()) return;
    std::string text =
        loop("nearest", R"(<light type="directional" direction="0 0 -1" spectrum="constant:1" scale="1"/>)");
    const std::string turned = R"(direction="0.3 0.2 -1" spectrum="illuminants/A" illuminance="700 lx")";
    text.replace(text.find(turned), turned.size(), R"(direction="0 0 -1" spectrum="constant:1" scale="1")");
    text.replace(text.find("step=\"10\""), 9, "step=\"10\" projection=\"point\"");
    const Scene scene = sceneFrom(text);
    // With more samples, pixels where two triangles meet add up shares of each.
    RenderSettings settings;
    settings.samples = 1;
    const Cube first = cubeOfPass(scene, "reflectance", settings),
               second = cubeOfPass(scene, "again", settings);
    size_t different = 0;
    for (size_t i = 0; i < first.values.size(); ++i)
        different += first.values[i] != second.values[i];
    CHECK(different == 0);
}

TEST_CASE("a reflectance written to a file and read as a texture is the pass itself") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    const Scene scene = sceneFrom(loop("nearest", window));
    const Cube cube = cubeOfPass(scene, "reflectance");
    const std::vector<float> preview(64 * 32 * 3, 0.0f);
    for (const std::string name : {"chart.exr", "chart.img"}) {
        const auto writer = name.ends_with("exr") ? createExr(folder.path() / name, cube.info, {})
                                                  : createEnvi(folder.path() / name, cube.info);
        writer->write(32, cube.values.data(), preview.data());
        (void)writer->finish();
        std::string text = loop("nearest", window);
        text.replace(text.find("pass:reflectance"), 16, name);
        Notes notes;
        const Scene fromFile = loadScene(folder.write("scene.xml", text), library(), {}, notes);
        const bool same = imageOfPass(fromFile, "main").values == imageOfPass(scene, "main").values;
        CHECK(same);
    }
}

TEST_CASE("bilinear filtering blends reflectances between the centres of texels and nothing else") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    CubeInfo info;
    info.width = 2;
    info.height = 1;
    info.kind = CubeKind::reflectance;
    info.wavelengths = parseWavelengths("400,700", {});
    info.wavelengths.projection = Projection::point;
    info.projectionStated = true;
    const auto writer = createExr(folder.path() / "two.exr", info, {});
    const float values[] = {0.2f, 0.6f, 0.8f, 0.4f}, preview[6] = {};  // 400 nm, 700 nm
    writer->write(1, values, preview);
    (void)writer->finish();
    for (const std::string filter : {"bilinear", "nearest"}) {
        const std::string text =
            "<scene version=\"1\"><wavelengths projection=\"point\">400 550 700</wavelengths><material "
            "name=\"m\"><diffuse texture=\"two.exr\" filter=\"" +
            filter +
            R"("/></material><plane size="2 1" material="m"/><light type="ambient" spectrum="constant:1" scale="1"/>
            <camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="64x32"/></scene>)";
        Notes notes;
        RenderSettings settings;
        settings.samples = 1;
        const Image image =
            imageOf(loadScene(folder.write("scene.xml", text), library(), {}, notes), settings);
        for (int x = 0; x < 64; ++x) {
            const double u = (x + 0.5) / 64,
                         t = filter == "nearest" ? (u < 0.5 ? 0 : 1) : std::clamp(2 * u - 0.5, 0.0, 1.0);
            CAPTURE(filter, x);
            CHECK(image.at(x, 16, 0) == Approx(0.2 + 0.4 * t).epsilon(2e-6));
            CHECK(image.at(x, 16, 1) == Approx(0.5).epsilon(2e-6));
            CHECK(image.at(x, 16, 2) == Approx(0.8 - 0.4 * t).epsilon(2e-6));
        }
    }
}

TEST_CASE("picture.xml under every lamp, with slit and point bands, is its closed form within 1e-4") {
    const std::filesystem::path path = std::filesystem::path(SPECTRAD_SHARED) / "contract/picture.xml";
    if (!std::filesystem::exists(path)) {
        WARN("skipped: no " << path.string());
        return;
    }
    if (!haveDevice()) return;
    const Polyline left{{400, 500, 600, 700}, {0.1, 0.7, 0.2, 0.4}, true},
        right{{400, 500, 600, 700}, {0.6, 0.2, 0.1, 0.8}, true};
    for (const std::string lampName : {"A", "D65", "FL11", "LED-B3"}) {
        const Polyline lamp = measuredTable("illuminants/" + lampName).curves.front();
        const double factor = 100 / static_cast<double>(integral(lamp)) / std::numbers::pi;
        // The text, since the light in the gallery has no name.
        std::ifstream file(path);
        std::string text{std::istreambuf_iterator<char>(file), {}};
        text.replace(text.find("illuminants/D65"), 15, "illuminants/" + lampName);
        const Scene scene = sceneFrom(text);
        for (const Projection projection : {Projection::slit, Projection::point}) {
            RenderSettings settings;
            settings.projection = projection;
            const Image image = imageOfPass(scene, "main", settings);
            Worst worst;
            for (size_t band = 0; band < image.wavelengths.size(); ++band)
                for (int y = 66; y < 190; ++y)
                    for (int x = 130; x < 382; ++x) {
                        if (std::abs(x - 255.5) < 4) continue;  // where the two halves blend
                        const double want =
                            factor * bandValue(lamp, x < 256 ? left : right, image.wavelengths, band);
                        worst.add(image.at(x, y, band), want, want, x, y, band);
                    }
            INFO(lampName << " " << name(projection) << ": " << worst.str());
            CHECK(worst.error <= 1e-4);
        }
    }
}

TEST_CASE("a pass as irradiance is what falls on the surface, lamp and all") {
    if (!haveDevice()) return;
    const std::string text =
        loop("nearest", window, R"(<pass name="lit" camera="direct" of="original" as="irradiance"/>)");
    const Cube cube = cubeOfPass(sceneFrom(text), "lit");
    CHECK(cube.info.kind == CubeKind::irradiance);
    const Polyline lamp = measuredTable("illuminants/D65").curves.front(),
                   photopic = measuredTable("observers/cie1931-2").curves.at(1);
    const double y =
        static_cast<double>(integral({&lamp, &photopic}, photopic.nm.front(), photopic.nm.back()));
    const double cosine = 1 / std::sqrt(1.05), factor = 500 / (683.002 * y) * cosine;
    const Polyline one{{300, 800}, {1, 1}, true};
    Worst worst;
    for (size_t band = 0; band < 31; ++band)
        for (int row = 0; row < 32; ++row)
            for (int x = 0; x < 64; ++x) {
                const double want = factor * bandValue(lamp, one, cube.info.wavelengths, band);
                worst.add(double{cube.row(row, band)[x]}, want, want, x, row, band);
            }
    INFO(worst.str());
    CHECK(worst.error <= 2e-6);
}

TEST_CASE("a radiance as a texture is refused by name, and so is a pass that is not there") {
    std::string wrong = loop("nearest", window);
    wrong.replace(wrong.find(R"(of="chart" as="reflectance")"), 27, R"(of="chart" as="radiance"   )");
    CHECK_THROWS_WITH(sceneFrom(wrong),
                      Catch::Contains("'reflectance'") && Catch::Contains("as=\"reflectance\""));
    std::string missing = loop("nearest", window);
    missing.replace(missing.find("pass:reflectance"), 16, "pass:refectance");
    CHECK_THROWS_WITH(sceneFrom(missing), Catch::Contains("refectance"));
}

TEST_CASE(
    "a fluorescent reflectance, and one where no light arrives, are refused with the material or the pixel") {
    if (!haveDevice()) return;
    std::string glowing = loop("nearest", window);
    glowing.replace(
        glowing.find(R"(<diffuse reflectance="charts/colorchecker/red"/>)"), 48,
        R"(<diffuse reflectance="constant:0.5"/><fluorescence excitation="fluorophores/green" emission="fluorophores/green"/>)");
    CHECK_THAT(refusal(glowing), Catch::Contains("'a'") && Catch::Contains("fluorescent"));
    std::string dark = loop("nearest", window);
    dark.replace(dark.find(R"(direction="0.3 0.2 -1")"), 22, R"(direction="0.3 0.2 1")");
    CHECK_THAT(refusal(dark), Catch::Contains("no light arrives at pixel"));
}
