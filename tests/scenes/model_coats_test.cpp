// Colours of models under a gloss are those that are seen: as bright as glTF's own formula has them, and
// never brighter than the light.
#include "image/picture.h"
#include "scenes/scene_image.h"
#include "support/quad_model.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;
using namespace spectrad::testing;

namespace {

/// A square in light of 45° and irradiance cos 45° W/m²/nm, seen square-on; pictures lie beside the model.
float radianceOf(const TemporaryFolder& folder, const std::string& model) {
    const std::string text =
        "<scene><wavelengths>550</wavelengths><import file=\"" + model +
        R"("/><light type="directional" direction="-1 0 -1" spectrum="constant:1" scale="1"/>
<camera type="orthographic" height="0.5" look-from="0 0 5" look-at="0 0 0" size="3x3"/></scene>)";
    Notes notes;
    return imageOf(loadScene(folder.write("scene.xml", text), library(), {}, notes)).at(1, 1);
}

std::string dielectric(const std::string& colour, double roughness) {
    return fmt::format(
        R"("materials":[{{"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":{},{}}}}}])",
        roughness, colour);
}

/// glTF 2.0, appendix B: radiance factor of a dielectric of index 1.5 in that light, seen so.
double asGltfHasIt(double colour, double roughness) {
    const double a2 = std::pow(roughness, 4), nl = std::sqrt(0.5), nh = std::cos(std::numbers::pi / 8);
    const double fresnel = 0.04 + 0.96 * std::pow(1 - nh, 5);
    const double density = a2 / (std::numbers::pi * std::pow(nh * nh * (a2 - 1) + 1, 2));
    const double visible = 0.5 / (nl + std::sqrt(nl * nl * (1 - a2) + a2));
    return (1 - fresnel) * colour + std::numbers::pi * fresnel * density * visible;
}

/// A plane in light of radiance 1 from everywhere; its base is stated as seen through its coat.
Image inUniformLight(const std::string& lobes) {
    const TemporaryFolder folder;
    writePng(folder.path() / "white.png", {1, 1, 3, {255, 255, 255}});
    const std::string text =
        "<scene version=\"1\"><wavelengths>400 500 600 700</wavelengths><material name=\"m\">" + lobes +
        "</material><plane size=\"100 100\" material=\"m\"/>"
        R"(<light type="ambient" spectrum="constant:1" scale="1"/>)"
        R"(<camera type="perspective" fov="60" look-from="0 0 3" look-at="2 0 0" size="16x8"/></scene>)";
    Notes notes;
    Scene scene = loadScene(folder.write("scene.xml", text), library(), {}, notes);
    for (Material& material : scene.materials)
        if (material.diffuse) material.diffuse->isSeenThroughCoat = true;
    return imageOf(scene);
}

const std::vector<std::string> coats{R"(<gloss ior="1.5"/>)", R"(<gloss ior="1.5" roughness="0.5"/>)",
                                     R"(<gloss ior="2.4" roughness="1"/>)",
                                     R"(<gloss ior="cauchy:1.6,0.02" roughness="0.2 0.6"/>)"};

}  // namespace

TEST_CASE("a dielectric of glTF is as bright as its own formula has it, in a constant colour and a picture") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    folder.write("quad.bin", quadBuffer());
    for (const double roughness : {0.5, 1.0})
        for (const double colour : {0.05, 0.2, 0.5, 0.8, 1.0}) {
            const auto level = static_cast<std::uint8_t>(std::lround(
                255 * (colour <= 0.0031308 ? 12.92 * colour : 1.055 * std::pow(colour, 1 / 2.4) - 0.055)));
            writePng(folder.path() / "p.png", {1, 1, 3, {level, level, level}});
            folder.write(
                "plain.gltf",
                quadGltf(dielectric(fmt::format(R"("baseColorFactor":[{0},{0},{0},1])", colour), roughness)));
            folder.write("picture.gltf",
                         quadGltf(dielectric(R"("baseColorTexture":{"index":0})", roughness) +
                                  R"(,"textures":[{"source":0}],"images":[{"uri":"p.png"}])"));
            const double want = asGltfHasIt(colour, roughness);
            const double scale = std::numbers::pi / std::sqrt(0.5);
            const double plain = radianceOf(folder, "plain.gltf") * scale;
            CAPTURE(colour, roughness);
            CHECK(plain == Approx(want).epsilon(0.05).margin(0.005));
            CHECK(radianceOf(folder, "picture.gltf") * scale == Approx(plain).epsilon(0.02));
        }
}

TEST_CASE("a white base that is stated as seen through its coat reflects all light, and no more") {
    if (!haveDevice()) return;
    for (const std::string& coat : coats)
        for (const std::string base :
             {R"(<diffuse reflectance="constant:1"/>)", R"(<diffuse texture="white.png"/>)",
              R"(<diffuse reflectance="constant:1" roughness="35"/>)",
              R"(<diffuse texture="white.png" roughness="35"/>)"}) {
            const Image image = inUniformLight(base + coat);
            const auto [least, most] = std::minmax_element(image.values.begin(), image.values.end());
            CAPTURE(coat, base);
            CHECK(*most <= 1 + 1e-3f);
            CHECK(*least >= 0.99f);
        }
}

TEST_CASE("what is stated as seen through a coat is linear in the base's reflectance") {
    if (!haveDevice()) return;
    for (const std::string& coat : coats) {
        const auto with = [&](const std::string& reflectance) {
            return inUniformLight("<diffuse reflectance=\"constant:" + reflectance + "\"/>" + coat);
        };
        const Image black = with("0"), middle = with("0.3"), white = with("1");
        double worst = 0;
        for (size_t i = 0; i < middle.values.size(); ++i)
            worst = std::max<double>(
                worst, std::abs(middle.values[i] - (0.7 * black.values[i] + 0.3 * white.values[i])));
        CAPTURE(coat);
        CHECK(worst < 1e-5);
    }
}
