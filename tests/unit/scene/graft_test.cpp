#include "scene/graft.h"

#include "scene/graft_materials.h"
#include "scene/reading.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <set>

using namespace spectrad;

namespace {

struct Workshop {
    Library library = Library::open();
    Notes notes;
    SpectrumResolver resolver{library, ".", false, notes};
    Scene scene = emptyScene();

    void add(const ImportedScene& model, const GraftOptions& options = {}) {
        graft(scene, 0, model, options, resolver, notes);
    }
    [[nodiscard]] bool said(const std::string& part) const {
        for (const std::string& line : notes.lines())
            if (line.find(part) != std::string::npos) return true;
        return false;
    }
};

std::shared_ptr<const Mesh> triangle(Vec3 origin = {}) {
    auto mesh = std::make_shared<Mesh>();
    mesh->origin = origin;
    mesh->position = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh->index = {0, 1, 2};
    return mesh;
}

/// root → two nodes that show the same mesh; three materials, of which one is worn.
ImportedScene twoTriangles() {
    ImportedScene model;
    model.meshes = {triangle()};
    model.meshMaterial = {1};
    model.materials.resize(3);
    model.materials[0].name = "Floor";
    model.materials[1].name = "Wall paint";
    model.materials[1].diffuse = {0.2, 0.5, 0.8};
    model.materials[1].ior = 1.5;
    model.materials[1].roughness = 0.3;
    model.materials[2].name = "Brass";
    model.nodes.resize(3);
    model.nodes[0].name = "room";
    model.nodes[0].children = {1, 2};
    model.nodes[1].name = model.nodes[2].name = "side";
    model.nodes[1].meshes = model.nodes[2].meshes = {0};
    model.nodes[1].local = Affine::translation({1, 0, 0});
    model.nodes[2].local = Affine::translation({-1, 0, 0});
    model.filesRead = {"room.dae"};
    return model;
}

bool inPicture(const Camera& camera, Vec3 point, double& edge) {
    const Vec3 p = inverse(camera.toNode).point(point);
    const double t = std::tan(camera.fovDegrees * std::numbers::pi / 360);
    const double y = std::abs(p.y) / (-p.z * t),
                 x = std::abs(p.x) / (-p.z * t * camera.width / camera.height);
    edge = std::max({edge, x, y});
    return p.z < 0 && x <= 1 && y <= 1;
}

}  // namespace

TEST_CASE("a grafted model keeps its hierarchy; instances share one mesh with normals") {
    Workshop w;
    w.add(twoTriangles());
    REQUIRE(w.scene.nodes.size() == 4);
    const FlatScene flat = flatten(w.scene);
    REQUIRE(flat.objects.size() == 2);
    CHECK(flat.objects[0].toWorld.point({}) == Vec3{1, 0, 0});
    CHECK(flat.objects[1].toWorld.point({}) == Vec3{-1, 0, 0});
    CHECK(flat.objects[0].node->meshes[0].mesh == flat.objects[1].node->meshes[0].mesh);
    CHECK(flat.objects[0].node->meshes[0].mesh->normal.size() == 3);
    CHECK(w.scene.nodes[2].name == "side");
    CHECK(w.scene.nodes[3].name == "side.2");
}

TEST_CASE("lengths of models that state no unit are the scene's; those in metres stay") {
    for (const bool inMetres : {false, true}) {
        Workshop w;
        ImportedScene model = twoTriangles();
        model.inMetres = inMetres;
        GraftOptions options;
        options.metresPerUnit = 0.01;
        w.add(model, options);
        CHECK(flatten(w.scene).objects[0].toWorld.point({}).x == Approx(inMetres ? 1 : 0.01));
    }
}

TEST_CASE("materials are lifted to spectra, only those that are worn, under names of their own") {
    Workshop w;
    w.add(twoTriangles());
    w.add(twoTriangles());
    REQUIRE(w.scene.materials.size() == 3);
    CHECK(w.scene.materials[1].name == "Wall paint");
    CHECK(w.scene.materials[2].name == "Wall paint.2");
    const Material& paint = w.scene.materials[1];
    REQUIRE(paint.diffuse);
    const Curve& curve = paint.diffuse->reflectance->curve();
    CHECK(curve.at(450) > curve.at(540));
    CHECK(curve.at(540) > curve.at(640));
    REQUIRE(paint.gloss);
    CHECK(paint.gloss->roughness.u == 0.3);
    CHECK(paint.diffuse->isSeenThroughCoat);
    CHECK(paint.gloss->ior.curve().at(550) == 1.5);
}

TEST_CASE("black, white and metal materials have spectra; glow becomes an emission with a luminance") {
    Workshop w;
    ImportedScene model = twoTriangles();
    model.materials[1].diffuse = {0, 0, 0};
    model.materials[1].emissive = {2, 2, 2};
    w.add(model);
    const Material& glowing = w.scene.materials.back();
    CHECK(glowing.diffuse->reflectance->curve().at(550) < 0.01);
    REQUIRE(glowing.emission);
    CHECK(glowing.emission->amount->unit == AmountUnit::candelaPerSquareMetre);
    CHECK(glowing.emission->amount->value == Approx(200));
    model.photometric = true;
    model.materials[1].metal = {1, 1, 1};
    w.add(model);
    const Material& metal = w.scene.materials.back();
    CHECK_FALSE(metal.diffuse);
    REQUIRE(metal.specular);
    CHECK(metal.specular->reflectance.curve().at(550) > 0.99);
    CHECK(metal.emission->amount->value == Approx(2));
}

TEST_CASE(
    "bindings dress imported materials in the scene's own, the first that matches; idle ones are said") {
    Workshop w;
    Material ink;
    ink.name = "ink";
    w.scene.materials.push_back(ink);
    w.scene.materials.push_back(ink);
    GraftOptions options;
    options.bindings = {
        {"Wall*", 1, {"s.xml", 3, 4}}, {"*", 2, {"s.xml", 4, 4}}, {"Flor", 1, {"s.xml", 5, 4}}};
    w.add(twoTriangles(), options);
    CHECK(w.scene.materials.size() == 3);
    CHECK(flatten(w.scene).objects[0].node->meshes[0].material == 1);
    CHECK(w.said("s.xml:5:4: warning: no material of the model matches 'Flor' (did you mean 'Floor'?)"));
    CHECK_FALSE(w.said("'Wall*'"));
    // What importers add and no mesh wears is not among those that there are.
    ImportedScene model = twoTriangles();
    model.materials.push_back({});
    model.materials.back().name = "DefaultMaterial";
    options.bindings = {{"Nosuch", 1, {"s.xml", 6, 4}}};
    w.add(model, options);
    CHECK(w.said("s.xml:6:4: warning: no material of the model matches 'Nosuch'"));
    CHECK_FALSE(w.said("DefaultMaterial"));
}

TEST_CASE("one material for everything leaves the model's own out") {
    Workshop w;
    GraftOptions options;
    options.material = 0;
    w.add(twoTriangles(), options);
    CHECK(w.scene.materials.size() == 1);
    CHECK(flatten(w.scene).objects[1].node->meshes[0].material == 0);
}

TEST_CASE("patterns match as a shell's do") {
    CHECK(matches("Wall*", "Wall"));
    CHECK(matches("Wall*", "Wall paint"));
    CHECK(matches("*a?l*", "Wall"));
    CHECK(matches("*", ""));
    CHECK(matches("a*b*c", "a-b-b-c"));
    CHECK_FALSE(matches("Wall", "Wall paint"));
    CHECK_FALSE(matches("?", ""));
    CHECK_FALSE(matches("a*b*c", "a-c-b"));
    CHECK(matches(std::string(30, '*') + "b", std::string(10000, 'a') + "b"));
}

TEST_CASE("lights come over with an amount: as stated for glTF, by one stated rule otherwise") {
    for (const bool photometric : {true, false}) {
        Workshop w;
        ImportedScene model = twoTriangles();
        model.photometric = photometric;
        model.lights.resize(2);
        model.lights[0].name = "lamp";
        model.lights[0].type = ImportedLight::Type::spot;
        model.lights[0].colour = {80, 40, 20};
        model.lights[0].angleDegrees = 50;
        model.lights[0].blend = 0.25;
        model.lights[1].type = ImportedLight::Type::directional;
        model.lights[1].direction = {0, -2, 0};
        model.nodes[1].lights = {0, 1};
        w.scene.shadows = photometric;
        w.add(model);
        REQUIRE(w.scene.lights.size() == 2);
        CHECK(w.scene.lights[0].shadows == photometric);
        const Light& lamp = w.scene.lights[0];
        const double brightness = 0.2126 * 80 + 0.7152 * 40 + 0.0722 * 20;
        CHECK(lamp.type == LightType::spot);
        CHECK(lamp.emitter.amount->unit == AmountUnit::candela);
        CHECK(lamp.emitter.amount->value == Approx(brightness * (photometric ? 1 : 100)));
        CHECK(lamp.emitter.spectrum.curve().at(620) > lamp.emitter.spectrum.curve().at(460));
        CHECK(lamp.angle == 50);
        CHECK(lamp.blend == 0.25);
        CHECK(w.scene.lights[1].emitter.amount->unit == AmountUnit::lux);
        CHECK(w.scene.lights[1].emitter.amount->value == Approx(photometric ? 1 : 1000));
        CHECK(w.scene.lights[1].direction == Vec3{0, -1, 0});
        CHECK(flatten(w.scene).lights[0].toWorld.point({}) == Vec3{1, 0, 0});
        CHECK(w.said("state no unit") != photometric);
    }
}

TEST_CASE("nodes that are scaled to nothing stay out, with what is below them") {
    Workshop w;
    ImportedScene model = twoTriangles();
    model.nodes[1].local = Affine::scaling({0, 0, 0});
    w.add(model);
    CHECK(flatten(w.scene).objects.size() == 1);
    CHECK(w.said("room.dae: warning: node 'side' is scaled to nothing"));
}

TEST_CASE("cameras keep their view; a stated aspect sets the picture's width") {
    Workshop w;
    ImportedScene model = twoTriangles();
    model.cameras.resize(2);
    model.cameras[0].fovDegrees = 30;
    model.cameras[0].aspect = 1.5;
    model.cameras[1].orthographicHeight = 4;
    model.nodes[2].cameras = {0, 1};
    w.add(model);
    REQUIRE(w.scene.cameras.size() == 2);
    CHECK(w.scene.cameras[0].fovDegrees == 30);
    CHECK(w.scene.cameras[0].width == 1080);
    CHECK(w.scene.cameras[0].name == "camera");
    CHECK(w.scene.cameras[1].orthographic);
    CHECK(w.scene.cameras[1].viewHeight == 4);
    CHECK(w.scene.cameras[1].name == "camera.2");
}

TEST_CASE("the framing camera shows the whole, from the front and a little above, and wastes no room") {
    for (const Vec3 size : {Vec3{1, 1, 1}, Vec3{100, 1, 3}, Vec3{0.001, 0.02, 0.001}, Vec3{1, 1, 1000}}) {
        Workshop w;
        ImportedScene model = twoTriangles();
        model.nodes[0].local = Affine::translation({1000, 50, -3}) * Affine::scaling(size);
        w.add(model);
        const Camera camera = framingCamera(w.scene);
        CHECK(camera.width == 1280);
        CHECK(camera.height == 720);
        CHECK(camera.fovDegrees == 40);
        double edge = 0;
        for (const double x : {-2.0, 2.0})
            for (const double y : {-1.0, 1.0})
                CHECK(inPicture(camera, model.nodes[0].local.point({x, y, 0}), edge));
        CHECK(edge == Approx(0.9));  // a margin of 5 % on each side
        const Vec3 look = camera.toNode.direction({0, 0, -1});
        CHECK(look.z < -0.9);
        CHECK(look.y < 0);
    }
}

TEST_CASE("an empty scene and a scene of one point can be framed") {
    Workshop w;
    CHECK(framingCamera(w.scene).toNode.finite());
    ImportedScene model = twoTriangles();
    model.nodes.resize(1);
    model.nodes[0].children.clear();
    model.nodes[0].meshes = {0};
    auto point = std::make_shared<Mesh>(*triangle());
    for (auto& p : point->position)
        p = {0, 0, 0};
    model.meshes = {point};
    w.add(model);
    CHECK(framingCamera(w.scene).toNode.finite());
}

TEST_CASE("a model as a scene: grey, framed and lit by D65 where it says nothing, all of it said") {
    const TemporaryFolder folder;
    const auto file = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    Workshop w;
    const Scene scene = sceneFromModel(file, w.resolver, true, w.notes);
    REQUIRE(scene.cameras.size() == 1);
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.wavelengths.size() == 81);
    CHECK(scene.filesRead == std::vector<std::string>{file.string()});
    const Light& lamp = scene.lights[0];
    CHECK(lamp.type == LightType::directional);
    CHECK(lamp.emitter.amount->unit == AmountUnit::lux);
    CHECK(lamp.emitter.amount->value == 1000);
    CHECK(length(lamp.direction - scene.cameras[0].toNode.direction({0, 0, -1})) < 1e-12);
    CHECK(w.said("no camera"));
    CHECK(w.said("no light"));
}

TEST_CASE("the project's own models come in with cameras, lights, materials and shared meshes") {
    const std::filesystem::path models = std::filesystem::path(SPECTRAD_SOURCE) / "scenes" / "models";
    for (const std::string name : {"pavilion.gltf", "chess.dae"}) {
        INFO(name);
        REQUIRE(std::filesystem::exists(models / name));
        CHECK(std::filesystem::file_size(models / name) < 400000);
        Workshop w;
        const Scene scene = sceneFromModel(models / name, w.resolver, true, w.notes);
        CHECK(scene.cameras.size() == 1);
        CHECK(scene.lights.size() >= 2);
        CHECK(scene.materials.size() >= 5);
        const FlatScene flat = flatten(scene);
        std::set<const Mesh*> meshes;
        size_t uses = 0;
        for (const FlatScene::Object& object : flat.objects) {
            for (const MeshUse& use : object.node->meshes) {
                meshes.insert(use.mesh.get());
                ++uses;
            }
        }
        CHECK(uses > 2 * meshes.size());
        CHECK_FALSE(w.said("ignored"));
        CHECK_FALSE(w.said("left out"));
        CHECK_FALSE(w.said("field of view"));
    }
}
