// A model's own pictures are shown as the scene's own textures are: from files beside it, from inside it.
#include "base/files.h"
#include "image/picture.h"
#include "scenes/scene_image.h"
#include "support/quad_model.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace spectrad;
using namespace spectrad::test;
using namespace spectrad::testing;

namespace {

/// `seen`: the scene's own colours are those that their coats show, as a model's are.
Image rendered(const TemporaryFolder& folder, const std::string& content, bool seen = false) {
    Notes notes;
    RenderSettings settings;
    settings.samples = 4;
    const std::string text =
        R"(<scene><wavelengths from="400" to="700" step="50"/>)" + content +
        R"(<light type="directional" direction="-0.3 -0.4 -1" spectrum="illuminants/D65" illuminance="1000 lx"/>
<camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="24x24"/></scene>)";
    Scene scene = loadScene(folder.write("scene.xml", text), library(), {}, notes);
    for (Material& material : scene.materials)
        if (material.diffuse && seen) material.diffuse->isSeenThroughCoat = true;
    return imageOf(scene, settings);
}
std::string own(const std::string& lobes) {
    return "<material name=\"m\">" + lobes + R"(</material><plane size="1" material="m"/>)";
}
std::string imported(const std::string& file) {
    return "<import file=\"" + file + "\"/>";
}
/// A square is cut into the same two triangles along another diagonal: the same but for rounding.
void same(const Image& a, const Image& b) {
    REQUIRE(a.values.size() == b.values.size());
    const float most = *std::max_element(b.values.begin(), b.values.end());
    double worst = 0;
    for (size_t i = 0; i < a.values.size(); ++i)
        worst = std::max(worst, double{std::abs(a.values[i] - b.values[i])} / most);
    CHECK(most > 0);
    CHECK(worst < 1e-5);
}

/// Four by three colours, none like another.
void writePicture(const TemporaryFolder& folder) {
    Picture8 picture{4, 3, 3, {}};
    for (int i = 0; i < 36; ++i)
        picture.pixels.push_back(static_cast<std::uint8_t>(i * 71 + i * i * 5));
    writePng(folder.path() / "p.png", picture);
    writePng(folder.path() / "n.png", {1, 1, 3, {180, 100, 220}}, {}, {});
}
const std::string inks =
    R"("materials":[{"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.5,"baseColorTexture":{"index":0}}}],"textures":[{"source":0}])";

}  // namespace

TEST_CASE("a model's picture beside it or inside it looks like the scene's own texture") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    writePicture(folder);
    folder.write("quad.bin", quadBuffer());
    folder.write("quad.mtl", "newmtl m\nKd 1 1 1\nillum 1\nmap_Kd p.png\n");
    folder.write("quad.obj", quadObj("quad.mtl", "m"));
    folder.write("quad.gltf", quadGltf(inks + R"(,"images":[{"uri":"p.png"}])"));
    folder.write("quad.glb", quadGlb(inks, readFile(folder.path() / "p.png")));
    const std::string texture = R"(<diffuse texture="p.png" wrap="repeat"/>)",
                      coat = R"(<gloss ior="1.5" roughness="0.5"/>)";
    same(rendered(folder, imported("quad.obj")), rendered(folder, own(texture)));
    const Image coated = rendered(folder, own(texture + coat), true);
    same(rendered(folder, imported("quad.gltf")), coated);
    same(rendered(folder, imported("quad.glb")), coated);
    same(rendered(folder, R"(<node><mesh file="quad.glb"/></node>)"), coated);
}

TEST_CASE("a model's normal map bends its normals as the scene's own does") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    writePicture(folder);
    folder.write("quad.bin", quadBuffer());
    folder.write(
        "quad.gltf",
        quadGltf(
            R"("materials":[{"normalTexture":{"index":1,"scale":0.5},"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.5,"baseColorTexture":{"index":0}}}],
"textures":[{"source":0},{"source":1}],"images":[{"uri":"p.png"},{"uri":"n.png"}])"));
    const std::string painted =
        R"(<diffuse texture="p.png" wrap="repeat"/><gloss ior="1.5" roughness="0.5"/>)";
    const Image bent = rendered(folder, own(painted + R"(<normal map="n.png" strength="0.5"/>)"), true);
    same(rendered(folder, imported("quad.gltf")), bent);
    CHECK(bent.values != rendered(folder, own(painted), true).values);
}
