// What a well-formed scene becomes: numbers in metres, spectra resolved, names joined up.
#include "unit/scene/xml_support.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace spectrad;
using namespace spectrad::testing;

namespace {

bool near(Vec3 a, Vec3 b) {
    return length(a - b) < 1e-12;
}

bool hasNote(const std::vector<std::string>& notes, const std::string& part) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

const char* const cube = "mtllib cube.mtl\nusemtl red\nv 0 0 0\nv 2 0 0\nv 0 4 0\nf 1 2 3\n";
const char* const cubeMaterial = "newmtl red\nKd 0.8 0.1 0.1\n";

}  // namespace

TEST_CASE("the contract's scenes load") {
    const std::filesystem::path folder = std::filesystem::path(SPECTRAD_SHARED) / "contract";
    if (!std::filesystem::exists(folder)) {
        WARN("skipped: " << folder << " is not here");
        return;
    }
    size_t scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".xml") continue;
        ++scenes;
        CAPTURE(entry.path());
        Notes notes;
        Scene scene;
        REQUIRE_NOTHROW(scene = loadScene(entry.path(), library(), {}, notes));
        CHECK(notes.lines().empty());
        CHECK(scene.cameras.size() >= 1);
        CHECK_FALSE(flatten(scene).objects.empty());
    }
    CHECK(scenes >= 5);
}

TEST_CASE(
    "without anything said a scene has 380 to 780 nm in steps of 5, a camera, a grey material and a "
    "warning") {
    const Loaded loaded = load("<scene><node><sphere/></node></scene>");
    const Scene& scene = loaded.scene;
    CHECK(scene.wavelengths.size() == 81);
    CHECK(scene.wavelengths.projection == Projection::slit);
    CHECK(scene.metresPerUnit == 1);
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].diffuse->reflectance->curve().at(550) == 0.5);
    CHECK(scene.cameras.size() == 1);
    CHECK(flatten(scene).cameras.size() == 1);
    CHECK(hasNote(loaded.notes, "no camera"));
    CHECK(hasNote(loaded.notes, "scene.xml: warning: the scene has no light: it is black"));
}

TEST_CASE(
    "background, ambient light and an emission that is worn each count as light; a transmittance needs "
    "none") {
    for (const char* content : {"<background spectrum=\"constant:1\" scale=\"1\"/>",
                                "<light type=\"ambient\" spectrum=\"constant:1\" scale=\"1\"/>",
                                "<material name=\"m\"><emission spectrum=\"illuminants/A\" luminance=\"1 "
                                "cd/m2\"/></material><node><sphere "
                                "material=\"m\"/></node>",
                                "<pass name=\"p\" as=\"transmittance\"/>"}) {
        CAPTURE(content);
        CHECK_FALSE(hasNote(load("<scene>" + std::string(content) + "</scene>").notes, "black"));
    }
    CHECK(hasNote(load("<scene><material name=\"m\"><emission spectrum=\"illuminants/A\" luminance=\"1 "
                       "cd/m2\"/></material></scene>")
                      .notes,
                  "black"));
}

TEST_CASE("every length is turned into metres, and only lengths") {
    const std::string content = R"(
      <node name="n" translate="1 2 3" scale="2">
        <sphere radius="4"/> <box size="1 2 3"/> <plane size="5 6"/> <cylinder radius="1" height="7"/>
        <torus radius="3" tube="2"/> <teapot size="8"/>
        <light name="l" type="point" position="1 0 0" spectrum="illuminants/A" intensity="3 cd"/>
      </node>
      <node name="m" matrix="1 0 0 10  0 2 0 20  0 0 3 30  0 0 0 1"/>
      <camera name="o" type="orthographic" height="4" look-from="0 0 5" look-at="0 0 0"/>)";
    for (const auto& [unit, metres] : {std::pair{"m", 1.0},
                                       {"cm", 0.01},
                                       {"mm", 0.001},
                                       {"um", 1e-6},
                                       {"km", 1000.0},
                                       {"in", 0.0254},
                                       {"ft", 0.3048}}) {
        CAPTURE(unit);
        const Scene scene = load(inScene(content, std::string("unit=\"") + unit + "\"")).scene;
        CHECK(scene.metresPerUnit == metres);
        const Node& n = scene.nodes[1];
        CHECK(near(n.local.point({0, 0, 0}) * (1 / metres), {1, 2, 3}));
        CHECK(near(n.local.direction({1, 0, 0}), {2, 0, 0}));
        CHECK(n.shapes[0].shape.radius == 4 * metres);
        CHECK(n.shapes[1].shape.size == Vec3{1 * metres, 2 * metres, 3 * metres});
        CHECK(n.shapes[2].shape.size.y == 6 * metres);
        CHECK(n.shapes[3].shape.height == 7 * metres);
        CHECK(n.shapes[4].shape.tube == 2 * metres);
        CHECK(n.shapes[5].shape.size.x == 8 * metres);
        CHECK(scene.lights[0].position.x == metres);
        CHECK(scene.lights[0].emitter.amount->value == 3);
        CHECK(
            near(scene.nodes[2].local.point({1, 1, 1}), {1 + 10 * metres, 2 + 20 * metres, 3 + 30 * metres}));
        CHECK(scene.cameras[0].viewHeight == 4 * metres);
        CHECK(near(scene.cameras[0].toNode.point({0, 0, 0}) * (1 / metres), {0, 0, 5}));
    }
}

TEST_CASE("a node's transform is translation times rotation times scale") {
    const Scene scene =
        load(inScene("<node translate=\"1 0 0\" rotate=\"0 0 1 90\" scale=\"2 3 4\"/>")).scene;
    CHECK(near(scene.nodes[1].local.point({1, 0, 0}), {1, 2, 0}));
    CHECK(near(scene.nodes[1].local.point({0, 1, 0}), {-2, 0, 0}));
    CHECK(near(scene.nodes[1].local.point({0, 0, 1}), {1, 0, 4}));
}

TEST_CASE("a scale may mirror") {
    const Scene scene = load(inScene("<node scale=\"-1 1 1\"><sphere/></node>")).scene;
    CHECK(flatten(scene).objects[0].toWorld.determinant() < 0);
}

TEST_CASE("wavelengths come as a range or a list, and a single one keeps its step") {
    CHECK(
        load("<scene><wavelengths from=\"400\" to=\"700\" step=\"10\"/></scene>").scene.wavelengths.size() ==
        31);
    CHECK(load("<scene><wavelengths step=\"10\" projection=\"box\"/></scene>").scene.wavelengths.projection ==
          Projection::box);
    const Wavelengths list =
        load("<scene><wavelengths>400 405.2 410</wavelengths></scene>").scene.wavelengths;
    CHECK(list.nm == std::vector<double>{400, 405.2, 410});
    const Wavelengths one =
        load("<scene><wavelengths step=\"2\">546.1</wavelengths></scene>").scene.wavelengths;
    CHECK(one.size() == 1);
    CHECK(one.step == 2);
}

TEST_CASE("a spectrum can be written as value, pairs, columns or file, and may name a later one") {
    TemporaryFolder folder;
    folder.write("paint.csv", "nm,first,second\n400,0.1,0.2\n700,0.3,0.4\n");
    const std::string content = R"(
      <spectrum name="late" value="pairs"/>
      <spectrum name="pairs" quantity="reflectance">400:0.1 <!-- comment --> 700:0.3</spectrum>
      <spectrum name="columns">
        400 0.1
        700 0.3
      </spectrum>
      <spectrum name="first" file="paint.csv"/>
      <spectrum name="second" file="paint.csv" column="3"/>
      <spectrum name="named" file="paint.csv" column="second"/>)";
    std::string all = content;
    for (const char* name : {"late", "pairs", "columns", "first", "second", "named"})
        all +=
            "<material name=\"" + std::string(name) + "\"><diffuse reflectance=\"" + name + "\"/></material>";
    const Loaded loaded = load(folder, inScene(all));
    const auto at550 = [&](size_t material) {
        return loaded.scene.materials[material].diffuse->reflectance->curve().at(550);
    };
    for (const size_t material : {1u, 2u, 3u, 4u})
        CHECK(at550(material) == Approx(0.2));
    for (const size_t material : {5u, 6u})
        CHECK(at550(material) == Approx(0.3));
    // Reflectances are held outside their range, however they were written.
    CHECK(loaded.scene.materials[3].diffuse->reflectance->curve().at(300) == Approx(0.1));
    CHECK(loaded.scene.filesRead.size() == 2);
}

TEST_CASE("what is defined and not used is a warning with its place") {
    const Loaded loaded =
        load(inScene("<spectrum name=\"a\" value=\"constant:1\"/>\n<material name=\"m\"><diffuse "
                     "reflectance=\"constant:1\"/></material>"));
    CHECK(hasNote(loaded.notes, "scene.xml:2:1: warning: spectrum 'a' is not used"));
    CHECK(hasNote(loaded.notes, "scene.xml:3:1: warning: material 'm' is not used"));
}

TEST_CASE("every lobe of the format is read") {
    TemporaryFolder folder;
    folder.write("donaldson.csv", "emission_nm,ex380,ex400\n400,0,0.5\n420,0.1,0\n");
    folder.write("wood.png", "not looked at yet");
    const Scene scene = load(folder, inScene(R"(
      <material name="a">
        <diffuse reflectance="constant:0.5" roughness="20"/><gloss ior="1.5" roughness="0.3"/>
        <fluorescence excitation="gaussian:380,60" emission="gaussian:520,40" yield="0.9" strength="0.5" emission-unit="photons" anti-stokes="true"/>
        <fluorescence excitation="gaussian:450,60" emission="gaussian:600,40"/>
        <emission spectrum="illuminants/A" luminance="100 cd/m2"/>
      </material>
      <material name="b"><conductor ior="metals/Au" roughness="0.1" fresnel="schlick"/></material>
      <material name="c"><specular reflectance="constant:0.9" roughness="0.2"/></material>
      <material name="d"><diffuse texture="wood.png"/></material>
      <material name="e"><fluorescence matrix="donaldson.csv" diagonal="none"/><diffuse texture="pass:p"/></material>
      <material name="f"><gloss ior="cauchy:1.5046,0.0042"/></material>
      <pass name="p" as="reflectance"/>)"))
                            .scene;
    const auto& m = scene.materials;
    REQUIRE(m.size() == 7);
    CHECK(m[1].diffuse->roughnessDegrees == 20);
    CHECK(m[1].gloss->ior.curve().at(500) == 1.5);
    CHECK(m[1].gloss->roughness.v == 0.3);
    REQUIRE(m[1].fluorescence.size() == 2);
    CHECK(m[1].fluorescence[0].yield == 0.9);
    CHECK(m[1].fluorescence[0].strength == 0.5);
    CHECK(m[1].fluorescence[0].emissionInPhotons);
    CHECK(m[1].fluorescence[0].antiStokes);
    CHECK(m[1].fluorescence[1].yield == 1);
    CHECK(m[1].emission->amount->value == 100);
    CHECK(m[2].conductor->ior.curves.size() == 2);
    CHECK(m[2].conductor->schlick);
    CHECK(m[3].specular->roughness.u == 0.2);
    CHECK(m[4].diffuse->texture->source == (folder.path() / "wood.png").string());
    CHECK(m[5].fluorescence[0].diagonalNone);
    CHECK(m[5].diffuse->texture->source == "pass:p");
    CHECK(m[6].gloss->ior.curve().at(500) == Approx(1.5046 + 0.0042 / 0.25));
}

TEST_CASE("amounts keep value, unit and range; scale leaves the spectrum as it stands") {
    const auto emitter = [](const std::string& attributes) {
        return load(inScene("<light " + attributes + "/>")).scene.lights[0].emitter;
    };
    const std::string lamp = " spectrum=\"illuminants/D65\" ";
    CHECK(emitter("type=\"point\"" + lamp + "intensity=\"800 cd\"").amount->unit == AmountUnit::candela);
    CHECK(emitter("type=\"point\"" + lamp + "intensity=\"8e2 W/sr\"").amount->value == 800);
    CHECK(emitter("type=\"point\"" + lamp + "power=\"800 lm\"").amount->unit == AmountUnit::lumen);
    CHECK(emitter("type=\"point\"" + lamp + "power=\"3 W\"").amount->unit == AmountUnit::watt);
    CHECK(emitter("type=\"directional\" direction=\"0 -1 0\"" + lamp + "illuminance=\"1000 lx\"")
              .amount->unit == AmountUnit::lux);
    CHECK(emitter("type=\"ambient\"" + lamp + "luminance=\"20 cd/m\xC2\xB2\"").amount->unit ==
          AmountUnit::candelaPerSquareMetre);
    const Emitter ranged = emitter(
        "type=\"directional\" direction=\"0 -1 0\" spectrum=\"constant:1\" irradiance=\"100 W/m2 over "
        "400:700\"");
    CHECK(ranged.amount->over == std::pair{400.0, 700.0});
    const Emitter scaled = emitter("type=\"point\"" + lamp + "scale=\"2\"");
    CHECK_FALSE(scaled.amount);
    CHECK(scaled.scale == 2);
    const Scene absolute = load(inScene("<spectrum name=\"lamp\" quantity=\"intensity\">400:1 "
                                        "700:2</spectrum><light type=\"point\" spectrum=\"lamp\"/>"))
                               .scene;
    CHECK_FALSE(absolute.lights[0].emitter.amount);
    CHECK(absolute.lights[0].emitter.scale == 1);
    CHECK(isPhotometric(AmountUnit::lumen));
    CHECK_FALSE(isPhotometric(AmountUnit::wattPerSquareMetreSteradian));
}

TEST_CASE("lights and cameras stand where they say and look where they say") {
    const Scene scene = load(inScene(R"(
      <light type="spot" position="1 2 3" target="1 0 3" angle="40" blend="0.3" spectrum="illuminants/A" intensity="1 cd"/>
      <light type="directional" direction="0 -2 0" spectrum="illuminants/A" illuminance="1 lx"/>
      <camera name="a" fov="35" look-from="0 0 8" look-at="0 0 0" size="320x160"/>
      <camera name="b" sensor="36x24" focal="50" look-from="1 1 1"/>)"))
                            .scene;
    CHECK(near(scene.lights[0].direction, {0, -1, 0}));
    CHECK(scene.lights[0].angle == 40);
    CHECK(scene.lights[0].blend == 0.3);
    CHECK(near(scene.lights[1].direction, {0, -1, 0}));
    CHECK(scene.cameras[0].fovDegrees == 35);
    CHECK(scene.cameras[0].width == 320);
    CHECK(near(scene.cameras[0].toNode.direction({0, 0, -1}), {0, 0, -1}));
    CHECK(scene.cameras[1].fovDegrees == Approx(2 * std::atan(12.0 / 50) * 180 / std::numbers::pi));
    CHECK(near(scene.cameras[1].toNode.direction({0, 0, -1}), {0, 0, -1}));
}

TEST_CASE("lights throw shadows where they say so, or else the scene; nodes may throw none") {
    const std::string content = R"(
      <light type="point" spectrum="illuminants/A" intensity="1 cd"/>
      <light type="point" spectrum="illuminants/A" intensity="1 cd" shadows="true"/>
      <light type="point" spectrum="illuminants/A" intensity="1 cd" shadows="false"/>
      <light type="ambient" spectrum="illuminants/A" luminance="1 cd/m2"/>
      <node shadows="false"><node name="lamp" shadows="true"><sphere/></node></node><instance of="lamp"/>)";
    for (const bool all : {false, true}) {
        const Scene scene = load(std::string(R"(<scene version="1")") + (all ? " shadows=\"true\">" : ">") +
                                 content + "</scene>")
                                .scene;
        std::vector<bool> throws;
        for (const Light& light : scene.lights)
            throws.push_back(light.shadows);
        CHECK(throws == std::vector<bool>{all, true, false, false});
        const FlatScene flat = flatten(scene);
        REQUIRE(flat.objects.size() == 2);
        CHECK_FALSE(flat.objects[0].throwsShadows);
        CHECK(flat.objects[1].throwsShadows);
    }
}

TEST_CASE("passes name cameras and nodes, also those written later") {
    const Scene scene = load(inScene(R"(
      <pass name="inner" camera="eye" of="cow" size="512x256" samples="4" as="reflectance" wavelengths="400:700:10" projection="box" save="inner.exr"/>
      <pass name="main"/>
      <node name="cow"><sphere/></node>
      <camera name="other"/><camera name="eye"/>)"))
                            .scene;
    const Pass& pass = scene.passes[0];
    CHECK(scene.cameras[pass.camera].name == "eye");
    CHECK(scene.nodes[*pass.of].name == "cow");
    CHECK(pass.size == std::pair{512, 256});
    CHECK(pass.samples == 4);
    CHECK(pass.as == PassKind::reflectance);
    CHECK(pass.wavelengths->size() == 31);
    CHECK(pass.wavelengths->projection == Projection::box);
    CHECK(pass.save.ends_with("/inner.exr"));
    CHECK_FALSE(scene.passes[1].wavelengths);
}

TEST_CASE("a mesh is read once, scaled to metres, and wears its file's materials unless told otherwise") {
    TemporaryFolder folder;
    folder.write("cube.obj", cube);
    folder.write("cube.mtl", cubeMaterial);
    const Scene scene = load(folder, inScene(R"(
      <material name="ink"><diffuse reflectance="constant:0.1"/></material>
      <node><mesh file="cube.obj"/></node>
      <node><mesh file="cube.obj"/></node>
      <node><mesh file="cube.obj" material="ink"/></node>)",
                                             "unit=\"mm\""))
                            .scene;
    const MeshUse &first = scene.nodes[1].meshes.at(0), &second = scene.nodes[2].meshes.at(0),
                  &dressed = scene.nodes[3].meshes.at(0);
    CHECK(first.mesh == second.mesh);
    CHECK(first.material == second.material);
    CHECK(scene.materials[first.material].name == "red");
    CHECK(scene.materials[dressed.material].name == "ink");
    CHECK(scene.materials.size() == 3);
    CHECK(first.mesh->origin.x == Approx(0.001));
    CHECK(first.mesh->origin.y == Approx(0.002));
    CHECK(first.mesh->normal.size() == first.mesh->position.size());
    CHECK(std::count(scene.filesRead.begin(), scene.filesRead.end(), (folder.path() / "cube.obj").string()) ==
          1);
}

TEST_CASE("an import becomes a node with a transform, its materials bound by pattern") {
    TemporaryFolder folder;
    folder.write("cube.obj", cube);
    folder.write("cube.mtl", cubeMaterial);
    const Loaded loaded = load(folder, inScene(R"(
      <material name="ink"><diffuse reflectance="constant:0.1"/></material>
      <import name="room" file="cube.obj" translate="1 0 0"><bind material="re*" to="ink"/></import>
      <instance of="room" translate="5 0 0"/>)",
                                               "unit=\"cm\""));
    const FlatScene flat = flatten(loaded.scene);
    REQUIRE(flat.objects.size() == 2);
    CHECK(loaded.scene.materials[flat.objects[0].node->meshes[0].material].name == "ink");
    CHECK(flat.objects[0].toWorld.point({0, 0, 0}).x == Approx(0.01));
    CHECK(flat.objects[1].toWorld.point({0, 0, 0}).x == Approx(0.05));
    CHECK(flat.objects[0].toWorld.direction({1, 0, 0}).x == Approx(0.01));
}

TEST_CASE("a foreign model is a scene of its own, and a scene of ours may have any extension") {
    TemporaryFolder folder;
    Notes notes;
    folder.write("cube.mtl", cubeMaterial);
    const Scene model = loadScene(folder.write("cube.obj", cube), library(), {}, notes);
    CHECK(model.lights.size() == 1);
    CHECK(model.cameras.size() == 1);
    CHECK(model.filesRead.size() == 2);
    CHECK(model.sha256.size() == 64);
    CHECK(loadScene(folder.write(
                        "scene.txt",
                        "\xEF\xBB\xBF<?xml version=\"1.0\"?><!-- ours --><scene><node name=\"a\"/></scene>"),
                    library(), {}, notes)
              .nodes.size() == 2);
    CHECK_THROWS_AS(loadScene(folder.path() / "cube.obj", library(), {{"a.b=c"}, false}, notes), UsageError);
}

TEST_CASE("the hash tells scenes and the files they read apart") {
    TemporaryFolder folder;
    const std::string xml = inScene("<spectrum name=\"a\" file=\"a.csv\"/>");
    folder.write("a.csv", "nm,v\n400,1\n700,1\n");
    const std::string first = load(folder, xml).scene.sha256;
    CHECK(load(folder, xml).scene.sha256 == first);
    folder.write("a.csv", "nm,v\n400,1\n700,2\n");
    CHECK(load(folder, xml).scene.sha256 != first);
    folder.write("a.csv", "nm,v\n400,1\n700,1\n");
    CHECK(load(folder, xml + " ").scene.sha256 != first);
}

TEST_CASE("ten thousand levels load, beyond the limit an error says it") {
    const auto deep = [](int levels) {
        std::string xml = "<scene>";
        for (int i = 0; i < levels; ++i)
            xml += "<node translate=\"0 0 1\">";
        xml += "<sphere/>";
        for (int i = 0; i < levels; ++i)
            xml += "</node>";
        return xml + "<camera/><background spectrum=\"constant:1\" scale=\"1\"/></scene>";
    };
    const Scene scene = load(deep(10'000)).scene;
    CHECK(flatten(scene).objects[0].toWorld.point({0, 0, 0}).z == 10'000);
    CHECK(refusal(deep(100'000)).find("nested deeper than 100000 levels (the limit)") != std::string::npos);
}

TEST_CASE("a hundred thousand nodes with names load in a moment") {
    std::string xml = "<scene>";
    for (int i = 0; i < 100'000; ++i)
        xml +=
            "<node name=\"n" + std::to_string(i) + "\" translate=\"1 2 3\"><sphere radius=\"1\"/></node>\n";
    xml += "<camera/><background spectrum=\"constant:1\" scale=\"1\"/></scene>";
    CHECK(flatten(load(xml).scene).objects.size() == 100'000);
}

TEST_CASE("noise that is declared is set to the limit and said; more than that, or undeclared, is an error") {
    const auto scene = [](const std::string& attributes, const std::string& pairs) {
        return "<scene><spectrum name=\"s\" quantity=\"reflectance\" " + attributes + ">" + pairs +
               "</spectrum><material name=\"m\"><diffuse reflectance=\"s\"/></material><node><sphere "
               "material=\"m\"/></node></scene>";
    };
    const std::string measured = "400:-0.002 500:0.5 600:1.004 700:0.9";
    const Loaded loaded = load(scene("noise=\"0.005\"", measured));
    const Curve& curve = loaded.scene.materials.at(1).diffuse->reflectance->curve();
    CHECK(curve.at(400) == 0);
    CHECK(curve.at(500) == 0.5);
    CHECK(curve.at(600) == 1);
    CHECK(curve.at(750) == 0.9);  // held, as reflectances are
    CHECK(hasNote(loaded.notes, "2 of 4 values lie outside 0 … 1, by up to 0.004: set to the limit (noise)"));
    CHECK(refusal(scene("", measured)).find("value -0.002 at 400 nm (allowed: 0 … 1)") != std::string::npos);
    CHECK(refusal(scene("noise=\"0.003\"", measured)).find("value 1.004 at 600 nm") != std::string::npos);
    CHECK(
        refusal("<scene><spectrum name=\"s\" quantity=\"power\" noise=\"0.1\">400:1 500:1</spectrum></scene>")
            .find("is of a share of light") != std::string::npos);
}
