// --set: what it changes, and what it says when it cannot.
#include "unit/scene/xml_support.h"

#include <catch2/catch.hpp>

using namespace spectrad;
using namespace spectrad::testing;

namespace {

const std::string scene = R"(<scene version="1">
  <material name="ink"><diffuse reflectance="constant:0.2"/></material>
  <node name="cow" scale="2"><sphere radius="1" material="ink"/></node>
  <node name="herd.left"><sphere/><sphere/></node>
  <spectrum name="both" value="illuminants/A"/>
  <light name="both" type="point" spectrum="both" intensity="10 cd"/>
  <light name="lamp" type="point" spectrum="illuminants/D65" intensity="10 cd"/>
  <camera name="eye" look-from="0 0 5"/>
</scene>
)";

ExitCode codeOf(const std::string& option) {
    try {
        static_cast<void>(load(scene, {option}));
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::ok;
}

}  // namespace

TEST_CASE("--set changes, adds and removes attributes of named elements") {
    CHECK(load(scene, {"lamp.spectrum=illuminants/A"}).scene.lights[1].emitter.spectrum.text ==
          "illuminants/A");
    CHECK(load(scene, {"cow.translate=1 2 3"}).scene.nodes[1].local.point({0, 0, 0}) == Vec3{1, 2, 3});
    CHECK(load(scene, {"cow.scale="}).scene.nodes[1].local.determinant() == 1);
    CHECK(load(scene, {"lamp.intensity=", "lamp.power=5 W"}).scene.lights[1].emitter.amount->unit ==
          AmountUnit::watt);
    CHECK(load(scene, {"eye.size=10x20"}).scene.cameras[0].height == 20);
    CHECK(load(scene, {"light:both.intensity=20 cd"}).scene.lights[0].emitter.amount->value == 20);
    CHECK(load(scene, {"spectrum:both.value=illuminants/D65"})
              .scene.lights[0]
              .emitter.spectrum.curve()
              .at(560) == Approx(100));
    CHECK(load(scene, {"lamp.intensity=1 cd", "lamp.intensity=2 cd"}).scene.lights[1].emitter.amount->value ==
          2);
}

TEST_CASE("--set reaches child elements, names with dots, and what a scene has one of") {
    CHECK(load(scene, {"ink.diffuse.reflectance=constant:0.7"})
              .scene.materials[1]
              .diffuse->reflectance->curve()
              .at(500) == 0.7);
    CHECK(load(scene, {"cow.sphere.radius=3"}).scene.nodes[1].shapes[0].shape.radius == 3);
    CHECK(load(scene, {"herd.left.scale=3"}).scene.nodes[2].local.direction({1, 0, 0}).x == 3);
    CHECK(load(scene, {"scene.unit=mm"}).scene.metresPerUnit == 0.001);
}

TEST_CASE(
    "a --set that is malformed or names nothing, or several, is a usage error that says what there is") {
    CHECK(refusal(scene, {"lamp"}) ==
          "--set lamp: expected NODE.ATTR=VALUE, as in lamp.spectrum=illuminants/A");
    CHECK(refusal(scene, {"lamp=1"}) ==
          "--set lamp=1: expected NODE.ATTR=VALUE, as in lamp.spectrum=illuminants/A");
    CHECK(refusal(scene, {"lamp.=1"}) ==
          "--set lamp.=1: expected NODE.ATTR=VALUE, as in lamp.spectrum=illuminants/A");
    CHECK(refusal(scene, {"lump.scale=1"}) ==
          "--set lump.scale=1: no element is named 'lump' (did you mean 'lamp'?)");
    CHECK(refusal(scene, {"camera:lamp.fov=1"}) ==
          "--set camera:lamp.fov=1: no camera is named 'lamp' (allowed: eye)");
    CHECK(
        refusal(scene, {"both.scale=1"}) ==
        "--set both.scale=1: 'both' names several elements (write spectrum:both.scale or light:both.scale)");
    CHECK(refusal(scene, {"ink.gloss.ior=1"}) ==
          "--set ink.gloss.ior=1: <material> has no <gloss> (allowed: diffuse)");
    CHECK(refusal(scene, {"herd.left.sphere.radius=1"}) ==
          "--set herd.left.sphere.radius=1: <node> has several <sphere> (give the one meant a node with a "
          "name)");
    for (const char* option : {"lamp", "lump.scale=1", "both.scale=1", "ink.gloss.ior=1", "pass:a.b=1"}) {
        CAPTURE(option);
        CHECK(codeOf(option) == ExitCode::usage);
    }
}

TEST_CASE("what --set writes is checked like the file, and errors name the option") {
    CHECK(refusal(scene, {"cow.size=3"}) ==
          "--set cow.size=3: unknown attribute 'size' in <node> (allowed: name, translate, rotate, scale, "
          "matrix, shadows)");
    CHECK(refusal(scene, {"cow.scale=0"}) == "--set cow.scale=0: scale=\"0\" in <node>: a scale cannot be 0");
    CHECK(refusal(scene, {"lamp.power=5 W"}) ==
          "scene.xml:7:3: <light> has two amounts, 'intensity' and 'power' (one is allowed)");
    CHECK(codeOf("cow.scale=0") == ExitCode::input);
}
