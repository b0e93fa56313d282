#include "scene/import_wire.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace spectrad;

namespace {

ImportedScene sample() {
    ImportedScene s;
    auto mesh = std::make_shared<Mesh>();
    mesh->name = "m";
    mesh->origin = {1, 2, 3};
    mesh->position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh->index = {0, 1, 2};
    s.meshes = {mesh};
    s.meshMaterial = {0};
    s.materials.resize(1);
    s.materials[0].metal = {0.1, 0.2, 0.3};
    s.materials[0].colours.emplace().name = "wood.png";
    s.materials[0].colours->embedded = 0;
    s.pictures = {std::string("\x89PNG\0x", 6)};
    s.lights.resize(1);
    s.cameras.resize(1);
    s.nodes.resize(2);
    s.nodes[0].children = {1};
    s.nodes[1].meshes = {0};
    s.nodes[1].lights = {0};
    s.nodes[1].cameras = {0};
    s.remarks = {"r"};
    s.filesRead = {"f"};
    return s;
}

std::string bytesOf(const ImportedScene& scene) {
    std::string bytes;
    sendScene(scene,
              [&](const void* data, size_t size) { bytes.append(static_cast<const char*>(data), size); });
    return bytes;
}

}  // namespace

TEST_CASE("a scene goes over the wire unchanged") {
    const ImportedScene s = receiveScene(bytesOf(sample()));
    CHECK(bytesOf(s) == bytesOf(sample()));
    CHECK(s.meshes[0]->index == sample().meshes[0]->index);
    CHECK(s.materials[0].metal == sample().materials[0].metal);
    CHECK(s.remarks == sample().remarks);
}

TEST_CASE("bytes that are cut short, lengthened or altered never crash the reader") {
    const std::string whole = bytesOf(sample());
    for (size_t size = 0; size < whole.size(); ++size)
        CHECK_THROWS_AS((void)receiveScene(whole.substr(0, size)), InputError);
    CHECK_THROWS_AS((void)receiveScene(whole + "x"), InputError);
    size_t refused = 0;
    for (size_t at = 0; at < whole.size(); ++at) {
        std::string altered = whole;
        altered[at] = static_cast<char>(~altered[at]);
        try {
            (void)receiveScene(altered);
        } catch (const InputError&) {
            ++refused;
        }
    }
    CHECK(refused > whole.size() / 4);
}

TEST_CASE("scenes that contradict themselves are refused") {
    const std::vector<std::function<void(ImportedScene&)>> wrongs = {
        [](ImportedScene& s) { s.meshMaterial[0] = 1; },
        [](ImportedScene& s) { s.nodes[1].meshes = {1}; },
        [](ImportedScene& s) { s.nodes[1].children = {0}; },
        [](ImportedScene& s) {
            s.nodes[0].children = {1, 1};
        },
        [](ImportedScene& s) { s.nodes[0].children.clear(); },
        [](ImportedScene& s) { s.nodes[0].local.m[3] = NAN; },
        [](ImportedScene& s) {
            s.lights[0].direction = {0, 0, 0};
        },
        [](ImportedScene& s) { s.cameras[0].fovDegrees = 180; },
        [](ImportedScene& s) { s.materials[0].diffuse[0] = 1.5; },
        [](ImportedScene& s) { s.materials[0].tint[2] = -0.5; },
        [](ImportedScene& s) { s.materials[0].colours->embedded = 1; },
        [](ImportedScene& s) { s.materials[0].colours->scale[1] = 0; },
        [](ImportedScene& s) { s.materials[0].colours->offset[0] = NAN; },
        [](ImportedScene& s) {
            auto mesh = std::make_shared<Mesh>(*s.meshes[0]);
            mesh->index[0] = 3;
            s.meshes[0] = mesh;
        },
        [](ImportedScene& s) {
            auto mesh = std::make_shared<Mesh>(*s.meshes[0]);
            mesh->position[0][0] = INFINITY;
            s.meshes[0] = mesh;
        },
    };
    for (const auto& wrong : wrongs) {
        ImportedScene s = sample();
        wrong(s);
        CHECK_THROWS_AS((void)receiveScene(bytesOf(s)), InputError);
    }
}
