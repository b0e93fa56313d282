// Every malformed scene is refused in one line that names the place, what is wrong and what is allowed.
#include "unit/scene/xml_support.h"

#include <catch2/catch.hpp>

using namespace spectrad;
using namespace spectrad::testing;

namespace {

struct Refused {
    const char* scene;
    const char* message;
};

// clang-format off
/// Whole files.
constexpr Refused files[] = {
    {R"(<scene version="1">
  <node>
</scene>)",
     R"(scene.xml:3:1: not well-formed: end tag </scene> where <node> is open)"},
    {R"(<scene version="1">
  <node></nod>
</scene>)",
     R"(scene.xml:2:9: not well-formed: end tag </nod> where <node> is open)"},
    {R"(<scene version="1"
)",
     R"(scene.xml:1:19: not well-formed: malformed start tag)"},
    {R"()",
     R"(scene.xml:1:1: no element in the file)"},
    {R"(<?xml version="1.0"?>
<!DOCTYPE scene [<!ENTITY a "b">]>
<scene/>)",
     R"(scene.xml:2:1: DOCTYPE and other declarations are not allowed in a scene)"},
    {R"(<scene version="1">
 <node name="&a;"/></scene>)",
     R"(scene.xml:2:14: entity '&a;' (allowed: &lt; &gt; &amp; &quot; &apos; and character numbers; a bare & is written &amp;))"},
    {R"(<scene version="1">
 <node name="a & b"/></scene>)",
     R"(scene.xml:2:16: entity '&' (allowed: &lt; &gt; &amp; &quot; &apos; and character numbers; a bare & is written &amp;))"},
    {R"(<scene version="1">
 <node name="&#0;"/></scene>)",
     R"(scene.xml:2:14: entity '&#0;' (allowed: &lt; &gt; &amp; &quot; &apos; and character numbers; a bare & is written &amp;))"},
    {"<scene version=\"1\">\n <node name=\"a\xff\"/></scene>",
     R"(scene.xml:2:15: byte 0xff is not UTF-8)"},
    {R"(<?xml version="1.0" encoding="latin1"?>
<scene/>)",
     R"(scene.xml:1:1: encoding 'latin1' (allowed: UTF-8))"},
    {R"(<scene version="1"/>
<scene/>)",
     R"(scene.xml:2:1: second root element <scene> (a file has one))"},
    {R"(<scene version="1">
 <!-- never ends </scene>)",
     R"(scene.xml:2:25: not well-formed: comment without end)"},
    {R"(<scene version="1"><node name=x/></scene>)",
     R"(scene.xml:1:31: not well-formed: malformed attribute (expected name="value"))"},
    {R"(<szene version="1"/>)",
     R"(scene.xml:1:1: the root element is <szene> (a scene begins with <scene>))"},
    {R"(<scene version="2"/>)",
     R"(scene.xml:1:1: version="2" in <scene>: this program reads version 1)"},
};

/// What stands on line 2 of a scene.
constexpr Refused contents[] = {
    {R"(<spere radius="1"/>)",
     R"(scene.xml:2:1: unknown element <spere> in <scene> (allowed: wavelengths, spectrum, material, mesh, sphere, box, plane, disc, cylinder, cone, torus, teapot, node, instance, import, light, camera, background, detector, pass, region, sweep; did you mean <sphere>?))"},
    {R"(<node><sphere radios="1"/></node>)",
     R"(scene.xml:2:7: unknown attribute 'radios' in <sphere> (allowed: radius, material; did you mean 'radius'?))"},
    {R"(<node><box radius="1"/></node>)",
     R"(scene.xml:2:7: unknown attribute 'radius' in <box> (allowed: size, material))"},
    {R"(<node>
  <sphere radius="1" radius="2"/></node>)",
     R"(scene.xml:3:3: attribute 'radius' stands twice in <sphere>)"},
    {R"(<bind material="a" to="b"/>)",
     R"(scene.xml:2:1: misplaced element <bind> in <scene> (it stands in <import>; allowed here: wavelengths, spectrum, material, mesh, sphere, box, plane, disc, cylinder, cone, torus, teapot, node, instance, import, light, camera, background, detector, pass, region, sweep))"},
    {R"(<node><scene/></node>)",
     R"(scene.xml:2:7: misplaced element <scene> in <node> (it is the root; allowed here: mesh, sphere, box, plane, disc, cylinder, cone, torus, teapot, node, instance, import, light, camera))"},
    {R"(<node>hello</node>)",
     R"(scene.xml:2:7: text 'hello' in <node> (no text may stand there))"},
    {R"(<sphere><sphere/></sphere>)",
     R"(scene.xml:2:9: misplaced element <sphere> in <sphere> (it stands in <scene>, <node>; allowed here: nothing))"},
    {R"(<background spectrum="constant:1" scale="1"/><background spectrum="constant:1" scale="1"/>)",
     R"(scene.xml:2:46: second <background> in <scene> (the first is at scene.xml:2:1))"},
    {R"(<material><diffuse reflectance="constant:1"/></material>)",
     R"(scene.xml:2:1: <material> needs the attribute 'name')"},
    {R"(<light spectrum="constant:1"/>)",
     R"(scene.xml:2:1: <light> needs the attribute 'type')"},
    {R"(<wavelengths from="400">400 500</wavelengths>)",
     R"(scene.xml:2:1: attribute 'from' of <wavelengths> cannot stand beside a list of wavelengths)"},
    {R"(<node><sphere radius="-1"/></node>)",
     R"(scene.xml:2:7: radius="-1" in <sphere>: expected a number above 0)"},
    {R"(<node><sphere radius="big"/></node>)",
     R"(scene.xml:2:7: radius="big" in <sphere>: expected a number above 0)"},
    {R"(<node><sphere radius="nan"/></node>)",
     R"(scene.xml:2:7: radius="nan" in <sphere>: expected a number above 0)"},
    {R"(<node><sphere radius=""/></node>)",
     R"(scene.xml:2:7: attribute 'radius' of <sphere> is empty)"},
    {R"(<node><box size="1 2"/></node>)",
     R"(scene.xml:2:7: size="1 2" in <box>: expected 1 or 3 numbers with blanks between, found 2)"},
    {R"(<node><box size="1 2 0"/></node>)",
     R"(scene.xml:2:7: size="1 2 0" in <box>: every side must be a number above 0)"},
    {R"(<node><torus radius="1" tube="1"/></node>)",
     R"(scene.xml:2:7: <torus> needs a tube thinner than its ring (tube below radius))"},
    {R"(<node translate="1 2"/>)",
     R"(scene.xml:2:1: translate="1 2" in <node>: expected 3 numbers with blanks between, found 2)"},
    {R"(<node translate="1,2,3"/>)",
     R"(scene.xml:2:1: translate="1,2,3" in <node>: expected 3 numbers with blanks between, found 1)"},
    {R"(<node rotate="0 0 0 90"/>)",
     R"(scene.xml:2:1: rotate="0 0 0 90" in <node>: the axis cannot be 0 0 0 (expected axis x y z and degrees))"},
    {R"(<node scale="0"/>)",
     R"(scene.xml:2:1: scale="0" in <node>: a scale cannot be 0)"},
    {R"(<node scale="1 2 0"/>)",
     R"(scene.xml:2:1: scale="1 2 0" in <node>: a scale cannot be 0)"},
    {R"(<node matrix="1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1"/>)",
     R"(scene.xml:2:1: matrix="1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1" in <node>: the last row must be 0 0 0 1)"},
    {R"(<node matrix="1 0 0 0 2 0 0 0 0 0 1 0 0 0 0 1"/>)",
     R"(scene.xml:2:1: matrix="1 0 0 0 2 0 0 0 0 0 1 0 0 0 0 1" in <node>: the matrix is singular or beyond the range of numbers (it must have an inverse))"},
    {R"(<node matrix="1 2 3 0 4 5 6 0 7 8 9 0 0 0 0 1"/>)",
     R"(scene.xml:2:1: matrix="1 2 3 0 4 5 6 0 7 8 9 0 0 0 0 1" in <node>: the matrix is singular or beyond the range of numbers (it must have an inverse))"},
    {R"(<node matrix="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1" translate="1 0 0"/>)",
     R"(scene.xml:2:1: attribute 'translate' of <node> cannot stand beside 'matrix')"},
    {R"(<node name="a"/>
<node name="a"/>)",
     R"(scene.xml:3:1: the name 'a' is taken by another node at scene.xml:2:1)"},
    {R"(<material name="a"><diffuse reflectance="constant:1"/></material><node><sphere material="b"/></node>)",
     R"(scene.xml:2:72: unknown material 'b' (did you mean 'a'?))"},
    {R"(<material name="paint"><diffuse reflectance="constant:1"/></material><node><sphere material="pant"/></node>)",
     R"(scene.xml:2:76: unknown material 'pant' (did you mean 'paint'?))"},
    {R"(<instance of="cow"/>)",
     R"(scene.xml:2:1: unknown node 'cow' (the scene names none))"},
    {R"(<node name="a"><node name="b"><instance of="a"/></node></node>)",
     R"(scene.xml:2:31: instance contains itself: a -> b -> a)"},
    {R"(<node name="a"><instance of="b"/></node>
<node name="b"><instance of="a"/></node>)",
     R"(scene.xml:3:16: instance contains itself: a -> b -> a)"},
    {R"(<spectrum name="a" value="b"/><spectrum name="b" value="a"/>)",
     R"(scene.xml:2:1: <spectrum> defines itself by itself: a -> b -> a)"},
    {R"(<spectrum name="a" value="constant:1"/>
<spectrum name="a" value="constant:1"/>)",
     R"(scene.xml:3:1: spectrum 'a' is defined already, at scene.xml:2:1)"},
    {R"(<spectrum name="a"/>)",
     R"(scene.xml:2:1: <spectrum> has no data (allowed: value=, file=, or pairs or two columns in its body))"},
    {R"(<spectrum name="a" value="constant:1">400:1 500:1</spectrum>)",
     R"(scene.xml:2:1: <spectrum> has its data twice (allowed: one of value=, file=, body))"},
    {R"(<spectrum name="a" column="2" value="constant:1"/>)",
     R"(scene.xml:2:1: attribute 'column' of <spectrum> stands only beside 'file')"},
    {R"(<spectrum name="a" relative="yes" value="constant:1"/>)",
     R"(scene.xml:2:1: relative="yes" in <spectrum>: unknown value (allowed: true, false))"},
    {R"(<material name="m"><diffuse/></material>)",
     R"(scene.xml:2:20: <diffuse> needs the attribute 'reflectance', 'texture' or 'select')"},
    {R"(<material name="m"><diffuse reflectance="constant:1" texture="a.exr"/></material>)",
     R"(scene.xml:2:20: <diffuse> has both 'reflectance' and 'texture' (one is allowed))"},
    {R"(<material name="m"><diffuse reflectance="constant:1" roughness="91"/></material>)",
     R"(scene.xml:2:20: roughness="91" in <diffuse>: expected a number from 0 to 90)"},
    {R"(<material name="m"><diffuse reflectance="constant:1"/><diffuse reflectance="constant:1"/></material>)",
     R"(scene.xml:2:55: second <diffuse> in <material> (the first is at scene.xml:2:20))"},
    {R"(<material name="m"><gloss ior="metals/Au"/></material>)",
     R"(scene.xml:2:20: ior="metals/Au" in <gloss>: a coat needs n alone, this has 2 columns (for n and k use <conductor>))"},
    {R"(<material name="m"><gloss ior="1.5" roughness="0.2 2"/></material>)",
     R"(scene.xml:2:20: roughness="0.2 2" in <gloss>: expected numbers from 0 to 1)"},
    {R"(<material name="m"><gloss ior="1.5" roughness="0.1 0.6"/></material>)",
     R"(scene.xml:2:20: roughness="0.1 0.6" in <gloss>: along and across differ too much (allowed: one up to 5 times the other))"},
    {R"(<material name="m"><gloss ior="1.5" roughness="2"/></material>)",
     R"(scene.xml:2:20: roughness="2" in <gloss>: expected a number from 0 to 1)"},
    {R"(<material name="m"><conductor ior="1.5"/></material>)",
     R"(scene.xml:2:20: ior="1.5" in <conductor>: a conductor needs two columns, n and k (allowed: metals/..., or a file with them))"},
    {R"(<material name="m"><conductor ior="metals/Au" fresnel="exakt"/></material>)",
     R"(scene.xml:2:20: fresnel="exakt" in <conductor>: unknown value (allowed: exact, schlick; did you mean 'exact'?))"},
    {R"(<material name="m"><fluorescence excitation="gaussian:380,60"/></material>)",
     R"(scene.xml:2:20: <fluorescence> needs the attributes 'excitation' and 'emission', or 'matrix')"},
    {R"(<material name="m"><fluorescence excitation="gaussian:380,60" emission="gaussian:520,40" yield="1.2"/></material>)",
     R"(scene.xml:2:20: yield="1.2" in <fluorescence>: expected a number from 0 to 1)"},
    {R"(<material name="m"><fluorescence matrix="d.csv" yield="1"/></material>)",
     R"(scene.xml:2:20: attribute 'yield' of <fluorescence> cannot stand beside 'matrix')"},
    {R"(<material name="m"><diffuse reflectance="constant:1"/><fluorescence matrix="table.csv"/></material>)",
     R"(scene.xml:2:55: the matrix holds the reflectance in its diagonal, so <diffuse> cannot stand beside it (diagonal="none" where it holds none))"},
    {R"(<material name="m"><diffuse texture="pass:inner"/></material>)",
     R"(scene.xml:2:20: unknown pass 'inner' (the scene names none))"},
    {R"(<material name="m"><emission spectrum="illuminants/A"/></material>)",
     R"(scene.xml:2:20: spectrum="illuminants/A" in <emission>: the spectrum is relative, so an emission needs an amount (allowed: luminance=, radiance=, scale=, or an absolute spectrum of quantity="radiance"))"},
    {R"(<light type="point" spectrum="illuminants/D65" intensity="800"/>)",
     R"(scene.xml:2:1: intensity="800" in <light>: the unit is missing (allowed: cd, W/sr))"},
    {R"(<light type="point" spectrum="illuminants/D65" intensity="800 lx"/>)",
     R"(scene.xml:2:1: intensity="800 lx" in <light>: 'lx' is a unit of illuminance (allowed: cd, W/sr))"},
    {R"(<light type="point" spectrum="illuminants/D65" intensity="800 candles"/>)",
     R"(scene.xml:2:1: intensity="800 candles" in <light>: unknown unit 'candles' (allowed: cd, W/sr))"},
    {R"(<light type="point" spectrum="illuminants/D65" intensity="-800 cd"/>)",
     R"(scene.xml:2:1: intensity="-800 cd" in <light>: expected a number of at least 0 and a unit with a blank between (allowed units: cd, W/sr))"},
    {R"(<light type="point" spectrum="illuminants/D65" intensity="800 cd" power="3 W"/>)",
     R"(scene.xml:2:1: <light> has two amounts, 'intensity' and 'power' (one is allowed))"},
    {R"(<light type="point" spectrum="illuminants/D65" intensity="800 cd" scale="2"/>)",
     R"(scene.xml:2:1: attribute 'scale' of <light> cannot stand beside the amount 'intensity')"},
    {R"(<light type="point" spectrum="illuminants/D65" luminance="800 cd/m2"/>)",
     R"(scene.xml:2:1: attribute 'luminance' of <light> does not state the amount of a point light (allowed: intensity, power))"},
    {R"(<light type="directional" direction="0 -1 0" spectrum="illuminants/D65" irradiance="800 lx"/>)",
     R"(scene.xml:2:1: irradiance="800 lx" in <light>: 'lx' is a unit of illuminance (allowed: W/m2))"},
    {R"(<light type="point" spectrum="illuminants/D65"/>)",
     R"(scene.xml:2:1: spectrum="illuminants/D65" in <light>: the spectrum is relative, so a point light needs an amount (allowed: intensity=, power=, scale=, or an absolute spectrum of quantity="intensity"))"},
    {R"(<light type="point" spectrum="400:1 700:1"/>)",
     R"(scene.xml:2:1: spectrum="400:1 700:1" in <light>: the spectrum does not say of which quantity it is, so a point light needs an amount (allowed: intensity=, power=, scale=, or an absolute spectrum of quantity="intensity"))"},
    {R"(<spectrum name="a" quantity="radiance">400:1 700:1</spectrum><light type="point" spectrum="a"/>)",
     R"(scene.xml:2:62: spectrum="a" in <light>: without an amount the spectrum of a point light must be of quantity intensity, this one is of radiance (allowed: intensity=, power=, scale=, or an absolute spectrum of quantity="intensity"))"},
    {R"(<light type="ambient" spectrum="constant:1" luminance="1 cd/m2" shadows="true"/>)",
     R"(scene.xml:2:1: attribute 'shadows' of <light> does not belong to an ambient light, which comes from everywhere)"},
    {R"(<node shadows="yes"/>)",
     R"(scene.xml:2:1: shadows="yes" in <node>: unknown value (allowed: true, false))"},
    {R"(<light type="ambient" spectrum="constant:1" radiance="1 W/m2/sr"/>)",
     R"(scene.xml:2:1: radiance="1 W/m2/sr" in <light>: a constant spectrum has no range of its own to integrate over; say one, as in '1 W/m2/sr over 400:700')"},
    {R"(<light type="ambient" spectrum="constant:1" luminance="1 cd/m2 over 400:700"/>)",
     R"(scene.xml:2:1: luminance="1 cd/m2 over 400:700" in <light>: 'over' is for radiometric amounts; cd/m2 counts what the eye sees)"},
    {R"(<light type="ambient" spectrum="constant:1" radiance="1 W/m2/sr over 700:400"/>)",
     R"(scene.xml:2:1: radiance="1 W/m2/sr over 700:400" in <light>: after the unit only a range in nm may follow, as in 'over 400:700')"},
    {R"(<light type="ambient" spectrum="constant:0" luminance="1 cd/m2"/>)",
     R"(scene.xml:2:1: spectrum="constant:0" in <light>: the spectrum is zero everywhere, no factor gives it the amount of 'luminance')"},
    {R"(<light type="sun" spectrum="constant:1" scale="1"/>)",
     R"(scene.xml:2:1: type="sun" in <light>: unknown value (allowed: point, spot, directional, ambient))"},
    {R"(<light type="point" direction="0 0 1" spectrum="constant:1" scale="1"/>)",
     R"(scene.xml:2:1: attribute 'direction' of <light> does not belong to a point light)"},
    {R"(<light type="spot" position="0 1 0" spectrum="constant:1" scale="1"/>)",
     R"(scene.xml:2:1: <light> of type spot needs the attribute 'target' or 'direction')"},
    {R"(<light type="spot" position="0 1 0" target="0 1 0" spectrum="constant:1" scale="1"/>)",
     R"(scene.xml:2:1: target="0 1 0" in <light>: the target is the light's own position)"},
    {R"(<light type="spot" position="0 1 0" target="0 0 0" angle="181" spectrum="constant:1" scale="1"/>)",
     R"(scene.xml:2:1: angle="181" in <light>: expected a number above 0 and at most 180)"},
    {R"(<light type="directional" spectrum="constant:1" scale="1"/>)",
     R"(scene.xml:2:1: <light> of type directional needs the attribute 'direction')"},
    {R"(<light type="directional" direction="0 0 0" spectrum="constant:1" scale="1"/>)",
     R"(scene.xml:2:1: direction="0 0 0" in <light>: a direction cannot be 0 0 0)"},
    {R"(<camera fov="180"/>)",
     R"(scene.xml:2:1: fov="180" in <camera>: expected a number above 0 and below 180)"},
    {R"(<camera fov="40" sensor="36x24" focal="50"/>)",
     R"(scene.xml:2:1: attribute 'fov' of <camera> cannot stand beside 'sensor' and 'focal')"},
    {R"(<camera sensor="36x24"/>)",
     R"(scene.xml:2:1: <camera> has 'sensor' without 'focal' (both are needed, in mm))"},
    {R"(<camera sensor="36" focal="50"/>)",
     R"(scene.xml:2:1: sensor="36" in <camera>: expected two lengths above 0, as in 36x24)"},
    {R"(<camera type="orthographic"/>)",
     R"(scene.xml:2:1: <camera> of type orthographic needs the attribute 'height')"},
    {R"(<camera type="orthographic" height="1" fov="40"/>)",
     R"(scene.xml:2:1: attribute 'fov' of <camera> does not belong to an orthographic camera (its view has a height))"},
    {R"(<camera height="1"/>)",
     R"(scene.xml:2:1: attribute 'height' of <camera> does not belong to a perspective camera (its view has a fov))"},
    {R"(<camera size="1280"/>)",
     R"(scene.xml:2:1: size="1280" in <camera>: expected WIDTHxHEIGHT in pixels, as in 1280x720)"},
    {R"(<camera size="70000x10"/>)",
     R"(scene.xml:2:1: size="70000x10" in <camera>: each side has 1 to 65536 pixels)"},
    {R"(<camera look-from="1 1 1" look-at="1 1 1"/>)",
     R"(scene.xml:2:1: look-at="1 1 1" in <camera>: the camera looks at its own place)"},
    {R"(<camera up="0 0 0"/>)",
     R"(scene.xml:2:1: up="0 0 0" in <camera>: a direction cannot be 0 0 0)"},
    {R"(<pass name="p" camera="nobody"/>)",
     R"(scene.xml:2:1: unknown camera 'nobody' (the scene names none))"},
    {R"(<pass name="p" samples="0"/>)",
     R"(scene.xml:2:1: samples="0" in <pass>: expected a whole number from 1 to 64)"},
    {R"(<pass name="p" as="albedo"/>)",
     R"(scene.xml:2:1: as="albedo" in <pass>: unknown value (allowed: radiance, reflectance, transmittance, irradiance))"},
    {R"(<pass name="p"/><pass name="p"/>)",
     R"(scene.xml:2:17: the name 'p' is taken by another pass at scene.xml:2:1)"},
    {R"(<node><mesh file="cube.obj" normals="round"/></node>)",
     R"(scene.xml:2:7: normals="round" in <mesh>: unknown value (allowed: smooth, flat, file))"},
    {R"(<import file="cube.obj" material="m"><bind material="*" to="m"/></import><material name="m"/>)",
     R"(scene.xml:2:1: <import> has both 'material', which dresses everything, and <bind> (one is allowed))"},
};
// clang-format on

}  // namespace

TEST_CASE("a file that is no scene in well-formed UTF-8 XML is refused at its place") {
    for (const Refused& refused : files) {
        INFO(refused.scene);
        CHECK(refusal(refused.scene) == refused.message);
    }
}

TEST_CASE("every malformed scene is refused in one line with place, fault and what is allowed") {
    TemporaryFolder folder;
    folder.write("table.csv", "emission_nm,ex380\n400,0\n");
    folder.write("cube.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const Refused& refused : contents) {
        INFO(refused.scene);
        CHECK(refusal(folder, inScene(refused.scene)) == refused.message);
    }
}

TEST_CASE("attributes of the scene itself are checked like any other") {
    CHECK(refusal(inScene("", "unit=\"parsec\"")) ==
          "scene.xml:1:1: unit=\"parsec\" in <scene>: unknown value (allowed: m, cm, mm, um, km, in, ft)");
    CHECK(refusal(inScene("<node translate=\"1e308 0 0\"/>", "unit=\"km\"")) ==
          "scene.xml:2:1: translate=\"1e308 0 0\" in <node>: the length in metres is beyond the range of "
          "numbers");
}

TEST_CASE("faults that the spectrum room finds are reported at the scene's own line") {
    CHECK(startsWith(refusal(inScene("<spectrum name=\"a\">\n400 1\n500 x\n</spectrum>")), "scene.xml:4"));
    CHECK(startsWith(refusal(inScene("<spectrum name=\"a\">400:1 300:2</spectrum>")), "scene.xml:2:20: "));
    CHECK(startsWith(refusal(inScene("<wavelengths from=\"700\" to=\"400\"/>")), "scene.xml:2:1: "));
    CHECK(startsWith(refusal(inScene("<wavelengths projection=\"slot\"/>")), "scene.xml:2:1: "));
    CHECK(startsWith(
        refusal(inScene("<material name=\"m\"><diffuse reflectance=\"constant:1.5\"/></material>")),
        "scene.xml:2:20: "));
    CHECK(startsWith(refusal(inScene("<detector name=\"d\" observer=\"observers/cie1932\"/>")),
                     "scene.xml:2:1: "));
    CHECK(startsWith(
        refusal(inScene("<light type=\"point\" spectrum=\"charts/colorchecker/green\" intensity=\"1 cd\"/>")),
        "scene.xml:2:1: "));
}

TEST_CASE("a missing or broken model is an error at the element that wants it") {
    TemporaryFolder folder;
    folder.write("broken.obj", "v 0 0 q\nf 1 2 9\n");
    const std::string missing = refusal(folder, inScene("<node>\n <mesh file=\"cow.obj\"/></node>"));
    CHECK(startsWith(missing, "scene.xml:3:2: "));
    CHECK(missing.find("cow.obj") != std::string::npos);
    CHECK(startsWith(refusal(folder, inScene("<node>\n <mesh file=\"broken.obj\"/></node>")),
                     "scene.xml:3:2: "));
}

TEST_CASE("a restricted scene reads nothing outside its folder") {
    TemporaryFolder folder;
    folder.write("outside.csv", "nm,v\n400,1\n700,1\n");
    folder.write("inner/scene.xml", inScene("<spectrum name=\"a\" file=\"../outside.csv\"/>"));
    Notes notes;
    const auto path = folder.path() / "inner/scene.xml";
    CHECK_NOTHROW(loadScene(path, library(), {}, notes));
    CHECK_THROWS_AS(loadScene(path, library(), {{}, true}, notes), InputError);
}
