#include "scene/import.h"

#include "scene/import_isolate.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <unistd.h>

using namespace spectrad;

namespace {

std::string errorOf(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::vector<std::string>& list, const std::string& part) {
    for (const std::string& text : list)
        if (text.find(part) != std::string::npos) return true;
    return false;
}

Vec3 corner(const Mesh& m, size_t k) {
    const auto& p = m.position[m.index[k]];
    return m.origin + Vec3{p[0], p[1], p[2]};
}

const char* const triangleObj = "v 1 2 3\nv 4 2 3\nv 1 7 3\nf 1 2 3\n";

/// A triangle in a COLLADA file of centimetres with z up, in a library node shown twice, with a camera and a
/// spot light.
std::string collada(const std::string& cameraOptics) {
    return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_cameras><camera id="cam"><optics><technique_common><perspective>)" +
           cameraOptics +
           R"(<znear>1</znear><zfar>100</zfar></perspective></technique_common></optics></camera></library_cameras>
<library_lights><light id="lamp"><technique_common><spot><color>0.5 1 0.25</color><falloff_angle>60</falloff_angle></spot></technique_common></light></library_lights>
<library_effects><effect id="fx"><profile_COMMON><technique sid="t"><phong>
<diffuse><color>0.5 0 1 1</color></diffuse><specular><color>0.2 0.2 0.2 1</color></specular><shininess><float>30</float></shininess>
</phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="mat" name="violet"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="geo"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 100 0 0 0 0 100</float_array><technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_nodes><node id="part" name="part"><instance_geometry url="#geo"><bind_material><technique_common><instance_material symbol="m" target="#mat"/></technique_common></bind_material></instance_geometry></node></library_nodes>
<library_visual_scenes><visual_scene id="s" name="s">
<node id="a" name="a"><translate>0 0 200</translate><instance_node url="#part"/></node>
<node id="b" name="b"><translate>300 0 0</translate><instance_node url="#part"/></node>
<node id="c" name="c"><translate>0 -500 0</translate><rotate>1 0 0 90</rotate><instance_camera url="#cam"/></node>
<node id="d" name="d"><instance_light url="#lamp"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";
}

/// World places of the first corner of every mesh and of every camera, the graph followed from the root.
struct Found {
    std::vector<Vec3> meshes;
    std::vector<Affine> cameras;
};
Found follow(const ImportedScene& scene) {
    Found found;
    std::vector<Affine> world(scene.nodes.size());
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        world[i] = i == 0 ? scene.nodes[0].local : world[i];
        for (const auto m : scene.nodes[i].meshes)
            found.meshes.push_back(world[i].point(corner(*scene.meshes[m], 0)));
        for (const auto c : scene.nodes[i].cameras)
            found.cameras.push_back(world[i] * scene.cameras[c].toNode);
        for (const auto child : scene.nodes[i].children)
            world[child] = world[i] * scene.nodes[child].local;
    }
    return found;
}

void near(Vec3 a, Vec3 b, double tolerance = 1e-5) {
    INFO(a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z);
    CHECK(length(a - b) <= tolerance);
}

}  // namespace

// ---- formats
// -----------------------------------------------------------------------------------------------------------

TEST_CASE("OBJ: positions as stated, polygons cut, plain grey without a material, points and lines said") {
    const TemporaryFolder folder;
    const auto file = folder.write(
        "a.obj", "v 1000001 2 3\nv 1000004 2 3\nv 1000004 7 3\nv 1000001 7 3\nf 1 2 3 4\nl 1 2\np 1\n");
    const ImportedScene s = importModel(file, false);
    REQUIRE(s.meshes.size() == 1);
    CHECK(s.meshes[0]->triangles() == 2);
    CHECK(s.meshes[0]->position.size() == 4);
    CHECK(s.meshes[0]->normal.empty());
    near(corner(*s.meshes[0], 0), {1000001, 2, 3}, 0);
    near(s.meshes[0]->origin, {1000002.5, 4.5, 3}, 0);
    CHECK(s.materials[s.meshMaterial[0]].diffuse == std::array<double, 3>{0.5, 0.5, 0.5});
    CHECK_FALSE(s.materials[s.meshMaterial[0]].ior);
    CHECK_FALSE(s.inMetres);
    CHECK(contains(s.remarks, "lines left out"));
    CHECK(contains(s.remarks, "points left out"));
}

TEST_CASE(
    "OBJ materials: display colours become linear, a highlight becomes a coat, textures and files are "
    "named") {
    const TemporaryFolder folder;
    folder.write("a.mtl",
                 "newmtl red\nKd 0.5 0 1\nKs 0.3 0.3 0.3\nNs 30\nNi 1.33\nillum 2\nmap_Kd wood.png\nnewmtl "
                 "matt\nKd 1 1 1\nillum 1\n");
    const auto file = folder.write(
        "a.obj",
        std::string("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl matt\nf 3 2 1\n"));
    const ImportedScene s = importModel(file, true);
    REQUIRE(s.meshes.size() == 2);
    const ImportedMaterial& red = s.materials[s.meshMaterial[0]];
    CHECK(red.name == "red");
    CHECK(red.diffuse[0] == Approx(0.2140411).epsilon(1e-5));  // IEC 61966-2-1 of 0.5
    CHECK(red.diffuse[2] == 1);
    REQUIRE(red.ior);
    CHECK(*red.ior == Approx(1.33).epsilon(1e-6));
    CHECK(red.roughness == Approx(0.5));  // (2 / (30 + 2))^¼
    REQUIRE(red.colours);
    CHECK(red.colours->name == "wood.png");
    CHECK(red.colours->repeat);
    CHECK(red.tint[0] ==
          Approx(0.2140411).epsilon(1e-5));  // OBJ multiplies a picture by the colour beside it
    CHECK_FALSE(s.materials[s.meshMaterial[1]].ior);
    REQUIRE(s.filesRead.size() == 2);
    CHECK(s.filesRead[1].find("a.mtl") != std::string::npos);
}

TEST_CASE("PLY and STL arrive with their triangles") {
    const TemporaryFolder folder;
    const auto ply = folder.write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
        "z\nelement "
        "face 1\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n4 2 3\n1 7 3\n3 0 1 2\n");
    const auto stl = folder.write("a.stl",
                                  "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 4 2 "
                                  "3\nvertex 1 7 3\nendloop\nendfacet\nendsolid a\n");
    const auto obj = folder.write("a.obj", triangleObj);
    for (const auto& file : {ply, stl, obj}) {
        const ImportedScene s = importModel(file, false);
        INFO(file.string());
        REQUIRE(s.meshes.size() == 1);
        REQUIRE(s.meshes[0]->triangles() == 1);
        near(corner(*s.meshes[0], 0), {1, 2, 3}, 0);
        near(corner(*s.meshes[0], 1), {4, 2, 3}, 0);
        near(corner(*s.meshes[0], 2), {1, 7, 3}, 0);
    }
}

TEST_CASE("X3D: hierarchy and display colours") {
    const TemporaryFolder folder;
    const auto file = folder.write(
        "a.x3d", R"(<?xml version="1.0" encoding="UTF-8"?><X3D profile="Interchange" version="3.3"><Scene>
<Transform translation="0 5 0"><Shape><Appearance><Material diffuseColor="1 0.5 0"/></Appearance>
<IndexedFaceSet coordIndex="0 1 2 -1"><Coordinate point="0 0 0 1 0 0 0 1 0"/></IndexedFaceSet></Shape></Transform></Scene></X3D>)");
    const ImportedScene s = importModel(file, false);
    const Found found = follow(s);
    REQUIRE(found.meshes.size() == 1);
    near(found.meshes[0], {0, 5, 0});
    CHECK(s.materials[s.meshMaterial[0]].diffuse[1] == Approx(0.2140411).epsilon(1e-5));
}

TEST_CASE(
    "COLLADA: unit and up axis lead to metres and y up, instances share a mesh, camera and light stand in "
    "their nodes") {
    const TemporaryFolder folder;
    const ImportedScene s =
        importModel(folder.write("a.dae", collada("<xfov>60</xfov><aspect_ratio>1.5</aspect_ratio>")), false);
    CHECK(s.inMetres);
    CHECK_FALSE(s.photometric);
    CHECK(s.meshes.size() == 1);
    const Found found = follow(s);
    REQUIRE(found.meshes.size() == 2);
    near(found.meshes[0], {0, 2, 0});  // z up, 200 cm
    near(found.meshes[1], {3, 0, 0});
    REQUIRE(found.cameras.size() == 1);
    near(found.cameras[0].point({}), {0, 0, 5});
    near(normalized(found.cameras[0].direction({0, 0, -1})), {0, 0, -1});
    near(normalized(found.cameras[0].direction({0, 1, 0})), {0, 1, 0});
    CHECK(s.cameras[0].aspect == Approx(1.5));
    CHECK(s.cameras[0].fovDegrees == Approx(42.1034).epsilon(1e-5));  // 2 atan(tan 30° / 1.5)
    REQUIRE(s.lights.size() == 1);
    CHECK(s.lights[0].type == ImportedLight::Type::spot);
    CHECK(s.lights[0].angleDegrees == Approx(60));
    CHECK(s.lights[0].blend == 0);
    CHECK(s.lights[0].colour[1] == 1);
    near(s.lights[0].direction, {0, 0, -1}, 0);
    const ImportedMaterial& m = s.materials[s.meshMaterial[0]];
    CHECK(m.name == "violet");
    CHECK(m.diffuse[0] == Approx(0.2140411).epsilon(1e-5));
    CHECK(m.ior.value_or(0) == 1.5);
}

TEST_CASE("COLLADA cameras in every form that the standard allows have their stated view") {
    const TemporaryFolder folder;
    const auto camera = [&](const std::string& optics) {
        const ImportedScene s = importModel(folder.write("a.dae", collada(optics)), false);
        REQUIRE(s.cameras.size() == 1);
        CHECK_FALSE(contains(s.remarks, "field of view"));
        return s.cameras[0];
    };
    CHECK(camera("<yfov>30</yfov>").fovDegrees == Approx(30));
    CHECK(camera("<yfov>30</yfov>").aspect == 0);
    CHECK(camera("<yfov>30</yfov><aspect_ratio>2</aspect_ratio>").fovDegrees == Approx(30));
    CHECK(camera("<xfov>60</xfov><yfov>45</yfov>").fovDegrees == Approx(45));
    CHECK(camera("<xfov>60</xfov><yfov>45</yfov>").aspect ==
          Approx(1.39385).epsilon(1e-5));                                          // tan 30° / tan 22.5°
    CHECK(camera("<xfov>60</xfov>").fovDegrees == Approx(35.9834).epsilon(1e-5));  // of a 16:9 picture

    std::string plan = collada("<xmag>3</xmag><aspect_ratio>1.5</aspect_ratio>");
    for (size_t at = 0; (at = plan.find("perspective>")) != std::string::npos;)
        plan.replace(at, 12, "orthographic>");
    const ImportedScene s = importModel(folder.write("plan.dae", plan), false);
    REQUIRE(s.cameras.size() == 1);
    CHECK(s.cameras[0].orthographicHeight == Approx(4));
}

TEST_CASE("COLLADA cameras without optics get a usual view, and that is said") {
    const TemporaryFolder folder;
    const ImportedScene s = importModel(folder.write("a.dae", collada("")), false);
    REQUIRE(s.cameras.size() == 1);
    CHECK(s.cameras[0].fovDegrees == 40);
    CHECK(contains(s.remarks, "field of view"));
}

TEST_CASE(
    "glTF: linear colours, metals, candela, half cones, vertical field of view, orthographic height, shared "
    "meshes") {
    const TemporaryFolder folder;
    // One triangle (0,0,0) (1,0,0) (0,1,0) in 36 bytes, base64.
    const auto file = folder.write(
        "a.gltf", R"({"asset":{"version":"2.0"},"scene":0,"extensionsUsed":["KHR_lights_punctual"],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1],"metallicFactor":0,"roughnessFactor":0.3},"emissiveFactor":[0.5,0,0]},
{"name":"gold","pbrMetallicRoughness":{"baseColorFactor":[1,0.75,0.25,1],"metallicFactor":1,"roughnessFactor":0.2}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]},{"primitives":[{"attributes":{"POSITION":0},"material":1}]},{"primitives":[{"attributes":{"POSITION":0}}]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.7,"aspectRatio":1.5,"znear":0.1,"zfar":100}},{"type":"orthographic","orthographic":{"xmag":3,"ymag":2,"znear":0.1,"zfar":100}}],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","color":[1,0.5,0.25],"intensity":80,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.4}},{"type":"directional","intensity":1000}]}},
"nodes":[{"name":"top","children":[1,2,3,4,5,6,8],"translation":[0,1,0]},{"name":"left","mesh":0,"translation":[-2,0,0]},{"name":"right","mesh":0,"translation":[2,0,0]},
{"name":"gilt","mesh":1},{"name":"eye","camera":0,"translation":[0,0,4]},{"name":"plan","camera":1},
{"name":"lamp","extensions":{"KHR_lights_punctual":{"light":0}},"children":[7]},{"name":"sun","extensions":{"KHR_lights_punctual":{"light":1}}},{"name":"bare","mesh":2}],
"scenes":[{"nodes":[0]}]})");
    const ImportedScene s = importModel(file, false);
    CHECK(s.inMetres);
    CHECK(s.photometric);
    REQUIRE(s.meshes.size() == 3);
    CHECK(s.materials[s.meshMaterial[2]].diffuse[0] == 0.5);  // without a material: grey, as everywhere
    CHECK_FALSE(s.materials[s.meshMaterial[2]].metal);
    const Found found = follow(s);
    REQUIRE(found.meshes.size() == 4);
    near(found.meshes[0], {-2, 1, 0});
    near(found.meshes[1], {2, 1, 0});
    const ImportedMaterial& paint = s.materials[s.meshMaterial[0]];
    CHECK(paint.diffuse[1] == Approx(0.25));
    CHECK(paint.roughness == Approx(0.3));
    CHECK(paint.ior.value_or(0) == 1.5);
    CHECK_FALSE(paint.metal);
    CHECK(paint.emissive[0] == Approx(0.5));
    const ImportedMaterial& gold = s.materials[s.meshMaterial[1]];
    REQUIRE(gold.metal);
    CHECK((*gold.metal)[1] == Approx(0.75));
    CHECK_FALSE(gold.ior);
    REQUIRE(s.cameras.size() == 2);
    CHECK(s.cameras[0].fovDegrees == Approx(0.7 * 180 / 3.14159265).epsilon(1e-5));
    near(found.cameras[0].point({}), {0, 1, 4});
    CHECK(s.cameras[1].orthographicHeight == Approx(4));
    CHECK(s.cameras[1].aspect == Approx(1.5));
    REQUIRE(s.lights.size() == 2);
    const ImportedLight& lamp = s.lights[s.lights[0].name == "lamp" ? 0 : 1];
    const ImportedLight& sun = s.lights[s.lights[0].name == "lamp" ? 1 : 0];
    CHECK(lamp.colour[0] == Approx(80));
    CHECK(lamp.colour[2] == Approx(20));
    CHECK(lamp.angleDegrees == Approx(0.8 * 180 / 3.14159265).epsilon(1e-5));
    CHECK(lamp.blend == Approx(0.5));
    CHECK(sun.type == ImportedLight::Type::directional);
    CHECK(sun.colour[0] == Approx(1000));
}

// ---- what goes wrong
// -----------------------------------------------------------------------------------------------------

TEST_CASE("triangles with corners that are not finite go, and are counted") {
    const TemporaryFolder folder;
    const auto file = folder.write("a.ply",
                                   "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty "
                                   "float y\nproperty float z\nelement "
                                   "face 2\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n4 2 "
                                   "3\n1 7 3\nnan 0 0\n3 0 1 2\n3 0 1 3\n");
    const ImportedScene s = importModel(file, false);
    REQUIRE(s.meshes.size() == 1);
    CHECK(s.meshes[0]->triangles() == 1);
    CHECK(s.meshes[0]->position.size() == 3);
    CHECK(contains(s.remarks, "1 triangles left out"));
}

TEST_CASE("what cannot be imported is said in one line that names the file") {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::filesystem::path, std::string>> cases = {
        {folder.path() / "none.obj", "none.obj: no such file"},
        {folder.path(), "is no file"},
        {folder.write("a.xyz", "hello"), "a.xyz: no importer knows this kind of file"},
        {folder.write("empty.ply", ""), "empty.ply: "},
        {folder.write("bad.gltf", "{\"asset\": [1,2"), "bad.gltf: "},
        {folder.write("bad.dae", "<COLLADA><oops>"), "bad.dae: "},
        {folder.write("points.obj", "v 0 0 0\nv 1 1 1\np 1 2\n"), "points.obj: holds no triangles"},
        {folder.write("claims.off", "OFF\n2000000000 2000000000 0\n0 0 0\n"), "claims.off: "},
    };
    for (const auto& [file, part] : cases) {
        const std::string text = errorOf([&file = file] { (void)importModel(file, false, 20); });
        INFO(text);
        CHECK(text.find(part) != std::string::npos);
        CHECK(text.find('\n') == std::string::npos);
    }
}

TEST_CASE("restricted: files outside the model's folder are not there, not even through a symbolic link") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "inside");
    folder.write("outside.mtl", "newmtl red\nKd 1 0 0\n");
    std::filesystem::create_symlink(folder.path() / "outside.mtl", folder.path() / "inside" / "linked.mtl");
    for (const char* const library : {"../outside.mtl", "linked.mtl"}) {
        const auto file =
            folder.write("inside/a.obj", std::string("mtllib ") + library + "\nusemtl red\n" + triangleObj);
        const auto red = [&](bool restricted) {
            const ImportedScene s = importModel(file, restricted);
            return s.materials[s.meshMaterial[0]].diffuse[1] == 0;
        };
        CHECK(red(false));
        CHECK_FALSE(red(true));
    }
}

// ---- the child process
// -----------------------------------------------------------------------------------------------------

TEST_CASE(
    "a child that crashes, aborts, throws, leaves or hangs is one short remark; its output is not ours") {
    ChildLimits limits;
    limits.seconds = 20;
    const auto failure = [&](const std::function<void()>& work) {
        return runInChild([&](const ByteSink&) { work(); }, limits).failure;
    };
    CHECK(failure([] { std::raise(SIGSEGV); }) == "crashed (signal 11)");
    CHECK(failure([] { std::abort(); }) == "crashed (signal 6)");
    CHECK(failure([] { throw std::runtime_error("x"); }) == "failed (exit code 3)");
    CHECK(failure([] { throw std::bad_alloc(); }) == "ran out of memory");
    CHECK(failure([] { ::_exit(7); }) == "failed (exit code 7)");
    CHECK(failure([] { (void)!::write(1, "noise\n", 6); }).empty());
    limits.seconds = 0.2;
    const auto start = std::chrono::steady_clock::now();
    CHECK(failure([] { std::this_thread::sleep_for(std::chrono::seconds(60)); }) == "took longer than 0.2 s");
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
}

TEST_CASE("an import that takes too long ends in time with one line") {
    const TemporaryFolder folder;
    const std::string text =
        errorOf([&] { (void)importModel(folder.write("a.obj", triangleObj), false, 1e-6); });
    CHECK(text.find("a.obj: import took longer than 1e-06 s") != std::string::npos);
}

TEST_CASE("many bytes come back whole, and imports on several threads do not wait for each other's ends") {
    std::vector<std::thread> threads;
    std::vector<size_t> sizes(4);
    for (size_t t = 0; t < sizes.size(); ++t) {
        threads.emplace_back([&sizes, t] {
            const std::string block(size_t{1} << 20, 'x');
            const ChildOutcome outcome = runInChild(
                [&](const ByteSink& sink) {
                    for (int i = 0; i < 20; ++i)
                        sink(block.data(), block.size());
                },
                ChildLimits{});
            sizes[t] = outcome.bytes.size();
        });
    }
    for (std::thread& thread : threads)
        thread.join();
    for (const size_t size : sizes)
        CHECK(size == size_t{20} << 20);
}
