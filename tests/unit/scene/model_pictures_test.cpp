// The pictures of a model's own materials: found, placed, refused; decoding them is not this room's work.
#include "scene/import.h"
#include "support/quad_model.h"
#include "unit/scene/xml_support.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace spectrad;
using namespace spectrad::testing;

namespace {

const std::string png = "\x89PNG\r\n\x1a\n", jpeg = "\xff\xd8\xff\xe0";

std::string material(const std::string& picture) {
    return "newmtl wood\nKd 1 1 1\nillum 1\nmap_Kd " + picture + "\n";
}

const Material& wornIn(const Scene& scene) {
    const FlatScene flat = flatten(scene);
    REQUIRE(flat.objects.size() == 1);
    return scene.materials[flat.objects[0].node->meshes.at(0).material];
}

bool said(const std::vector<std::string>& notes, const std::string& part) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

const std::string import = R"(<scene><import file="models/quad.obj"/></scene>)";

/// A folder with a scene's models below it.
struct Place : TemporaryFolder {
    Place() {
        for (const char* folder : {"models", "models/maps", "textures"})
            std::filesystem::create_directories(path() / folder);
        write("models/quad.obj", quadObj("quad.mtl", "wood"));
    }
};

ImportedMaterial gltfMaterial(const std::string& rest) {
    const TemporaryFolder folder;
    folder.write("quad.bin", quadBuffer());
    const ImportedScene model = importModel(folder.write("quad.gltf", quadGltf(rest)), false);
    return model.materials.at(model.meshMaterial.at(0));
}

}  // namespace

TEST_CASE("a picture is found by its name, by another system's, by a URI's, and beside the model") {
    const Place folder;
    const auto foundAs = [&](const std::string& name) {
        folder.write("models/quad.mtl", material(name));
        const Loaded loaded = load(folder, import);
        const Material& worn = wornIn(loaded.scene);
        return worn.diffuse->texture
                   ? std::filesystem::relative(worn.diffuse->texture->source, folder.path()).string()
                   : std::string("none");
    };
    folder.write("models/maps/a.png", png);
    CHECK(foundAs("maps/a.png") == "models/maps/a.png");
    CHECK(foundAs("maps\\a.png") == "models/maps/a.png");
    CHECK(foundAs((folder.path() / "models/maps/a.png").string()) == "models/maps/a.png");
    folder.write("models/b 1.jpg", jpeg);
    CHECK(foundAs("C:\\Users\\me\\pictures\\b 1.jpg") == "models/b 1.jpg");
    CHECK(foundAs("b%201.jpg") == "models/b 1.jpg");
    folder.write("textures/c.png", png);
    CHECK(foundAs("../textures/c.png") == "textures/c.png");
    CHECK(foundAs("d.png") == "none");
}

TEST_CASE("a picture that is not there, or none, is a remark, and the colour counts") {
    const Place folder;
    folder.write("models/quad.mtl", material("gone.png") + "Kd 0.5 0 0\n");
    const Loaded gone = load(folder, import);
    CHECK(said(gone.notes, "models/quad.obj: warning: picture 'gone.png' is not there: not shown"));
    CHECK(wornIn(gone.scene).diffuse->reflectance->curve().at(650) > 0.1);
    folder.write("models/gone.png", "TRUEVISION");
    CHECK(said(load(folder, import).notes, "picture 'gone.png' is neither PNG nor JPEG: not shown"));
}

TEST_CASE("pictures count for the scene's hash, also in a mesh and in a model rendered as it stands") {
    const Place folder;
    folder.write("models/quad.mtl", material("a.png"));
    for (const std::string& text :
         {import, std::string(R"(<scene><node><mesh file="models/quad.obj"/></node></scene>)")}) {
        CAPTURE(text);
        folder.write("models/a.png", png + "1");
        const Scene first = load(folder, text).scene;
        CHECK(first.filesRead.back() == (folder.path() / "models/a.png").string());
        CHECK(first.filesRead.size() == 4);
        CHECK(wornIn(first).diffuse->texture);
        folder.write("models/a.png", png + "2");
        CHECK(load(folder, text).scene.sha256 != first.sha256);
    }
    Notes notes;
    const Scene model = loadScene(folder.path() / "models/quad.obj", library(), {}, notes);
    CHECK(model.filesRead.size() == 3);
    // What wears something else needs no pictures.
    const Scene dressed =
        load(folder, R"(<scene><material name="m"><diffuse reflectance="constant:0.5"/></material>
        <node><mesh file="models/quad.obj" material="m"/></node></scene>)")
            .scene;
    CHECK(dressed.filesRead.size() == 3);
}

TEST_CASE("restricted: a model's pictures come from the scene's folder only") {
    const Place folder;
    const TemporaryFolder elsewhere;
    elsewhere.write("secret.png", png);
    const std::string secret = (elsewhere.path() / "secret.png").string();
    std::filesystem::create_symlink(secret, folder.path() / "models/link.png");
    const std::string climbing = "../../" + elsewhere.path().filename().string() + "/secret.png";
    for (const std::string& name : {secret, climbing, std::string("link.png")}) {
        CAPTURE(name);
        folder.write("models/quad.mtl", material(name));
        const Loaded free = load(folder, import);
        CHECK(wornIn(free.scene).diffuse->texture);
        const Loaded held = load(folder, import, {}, true);
        CHECK_FALSE(wornIn(held.scene).diffuse->texture);
        CHECK(said(held.notes, "lies outside the scene's folder, which is not allowed here (--restrict)"));
        CHECK(held.scene.filesRead.size() == 3);
    }
    // What is outside is not asked for: it cannot be told whether it is there.
    folder.write("models/quad.mtl", material("/nowhere/at/all.png"));
    CHECK(said(load(folder, import, {}, true).notes, "not allowed here"));
    folder.write("textures/c.png", png);
    folder.write("models/quad.mtl", material("../textures/c.png"));
    CHECK(wornIn(load(folder, import, {}, true).scene).diffuse->texture);
}

TEST_CASE("glTF's texture transform, wrapping and filter arrive as they are meant") {
    const std::array<double, 2> offset{0.3, -0.2}, scale{1.7, 0.6};
    const double turn = 0.7;
    const ImportedMaterial m =
        gltfMaterial(R"("materials":[{"name":"m","pbrMetallicRoughness":{"metallicFactor":0,
"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.3,-0.2],"scale":[1.7,0.6],"rotation":0.7}}}},
"normalTexture":{"index":0,"scale":0.25}}],"textures":[{"source":0,"sampler":0}],"images":[{"uri":"p.png"}],
"samplers":[{"magFilter":9728,"wrapS":33071,"wrapT":33071}],"extensionsUsed":["KHR_texture_transform"])");
    REQUIRE(m.colours);
    CHECK(m.colours->name == "p.png");
    CHECK(m.colours->nearest);
    CHECK_FALSE(m.colours->repeat);
    REQUIRE(m.normals);
    CHECK(m.normals->amount == Approx(0.25));
    CHECK(m.normals->scale == std::array<double, 2>{1, 1});
    const double c = std::cos(m.colours->rotateDegrees * M_PI / 180),
                 s = std::sin(m.colours->rotateDegrees * M_PI / 180);
    for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.3, 0.8}}) {
        // KHR_texture_transform, v downwards: translation · rotation · scale.
        const double x = u * scale[0], y = v * scale[1];
        const double wantU = offset[0] + std::cos(turn) * x + std::sin(turn) * y,
                     wantV = offset[1] - std::sin(turn) * x + std::cos(turn) * y;
        // Ours, v upwards: scaled, turned, moved.
        const double a = u * m.colours->scale[0], b = (1 - v) * m.colours->scale[1];
        CHECK(m.colours->offset[0] + c * a - s * b == Approx(wantU).margin(1e-6));
        CHECK(1 - (m.colours->offset[1] + s * a + c * b) == Approx(wantV).margin(1e-6));
    }
}

TEST_CASE("a mesh brings the coordinates that its material's picture lies on") {
    const TemporaryFolder folder;
    folder.write("quad.bin", quadBuffer());
    const auto most = [&](int set) {
        const ImportedScene model = importModel(
            folder.write(
                "quad.gltf",
                quadGltf(
                    R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":)" +
                    std::to_string(set) + R"(}}}],"textures":[{"source":0}],"images":[{"uri":"p.png"}])")),
            false);
        float u = 0;
        for (const auto& uv : model.meshes.at(0)->uv)
            u = std::max(u, uv[0]);
        return u;
    };
    CHECK(most(0) == 1);
    CHECK(most(1) == 0.5f);
}

TEST_CASE("what a model's pictures say that no material here can show is said") {
    const TemporaryFolder folder;
    folder.write("quad.bin", quadBuffer());
    const ImportedScene model = importModel(
        folder.write(
            "quad.gltf",
            quadGltf(
                R"("materials":[{"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0},
"metallicRoughnessTexture":{"index":1}},"emissiveTexture":{"index":2},"occlusionTexture":{"index":1}}],
"textures":[{"source":0},{"source":1},{"source":2}],"images":[{"uri":"p.png"},{"uri":"orm.png"},{"uri":"glow.png"}])")),
        false);
    CHECK(said(model.remarks, "pictures of metalness and roughness ignored: orm.png"));
    CHECK(said(model.remarks, "pictures of emission ignored: glow.png"));
    CHECK(said(model.remarks, "pictures of baked light ignored: orm.png"));
    CHECK(said(model.remarks, "opacity ignored in 1 materials"));
}

TEST_CASE("a picture inside a GLB comes with it, byte by byte; a metal with a picture is shown as painted") {
    const TemporaryFolder folder;
    const std::string picture = png + std::string("\0abc", 4);
    const auto file = folder.write(
        "quad.glb",
        quadGlb(
            R"("materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],"baseColorTexture":{"index":0}}}],"textures":[{"source":0}])",
            picture));
    Notes notes;
    const Scene scene = loadScene(file, library(), {}, notes);
    const Material& worn = wornIn(scene);
    REQUIRE(worn.diffuse);
    REQUIRE(worn.diffuse->texture);
    REQUIRE(worn.diffuse->texture->bytes);
    CHECK(*worn.diffuse->texture->bytes == picture);
    CHECK(worn.diffuse->texture->repeat);
    CHECK(worn.diffuse->texture->tint == std::array<double, 3>{1, 0.5, 0.25});
    CHECK(worn.gloss);
    CHECK_FALSE(worn.specular);
    CHECK(scene.filesRead.size() == 1);
    CHECK(said(notes.lines(), "material 'm': a metal with a picture is shown as painted"));
}
