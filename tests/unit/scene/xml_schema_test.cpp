// scenes/spectrad.rng says what the reader takes: the same elements and attributes, checked by an independent
// validator.
#include "scene/grammar.h"
#include "unit/scene/xml_support.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <map>
#include <set>

using namespace spectrad;
using namespace spectrad::testing;

namespace {

const std::filesystem::path schema = std::filesystem::path(SPECTRAD_SOURCE) / "scenes/spectrad.rng";

bool haveXmllint() {
    if (std::system("xmllint --version >/dev/null 2>&1") == 0) return true;
    WARN("skipped: xmllint is not here");
    return false;
}

bool isValid(const std::filesystem::path& file) {
    const std::string command =
        "xmllint --huge --noout --relaxng '" + schema.string() + "' '" + file.string() + "' >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
}

struct SchemaElement {
    std::set<std::string> attributes, children;
    bool text = false;
};

/// Gathers what stands in an element of the schema: follows references, stops at other elements.
void gather(pugi::xml_node at, const std::map<std::string, pugi::xml_node>& defines, SchemaElement& into) {
    for (const pugi::xml_node node : at.children()) {
        const std::string_view kind = node.name();
        if (kind == "attribute") {
            into.attributes.insert(node.attribute("name").value());
        } else if (kind == "element") {
            into.children.insert(node.attribute("name").value());
        } else if (kind == "ref") {
            gather(defines.at(node.attribute("name").value()), defines, into);
        } else {
            if (kind == "data" || kind == "text") into.text = true;
            gather(node, defines, into);
        }
    }
}

std::map<std::string, SchemaElement> schemaElements() {
    pugi::xml_document document;
    REQUIRE(document.load_file(schema.c_str()));
    std::map<std::string, pugi::xml_node> defines;
    for (const pugi::xml_node node : document.child("grammar").children("define"))
        defines[node.attribute("name").value()] = node;
    std::map<std::string, SchemaElement> elements;
    for (const auto& [name, define] : defines)
        if (const pugi::xml_node element = define.child("element"))
            gather(element, defines, elements[element.attribute("name").value()]);
    return elements;
}

}  // namespace

TEST_CASE("schema and reader know the same elements, attributes and places") {
    const auto elements = schemaElements();
    CHECK(elements.size() == grammar().size());
    for (const ElementRule& rule : grammar()) {
        CAPTURE(rule.name);
        REQUIRE(elements.contains(rule.name));
        const SchemaElement& other = elements.at(rule.name);
        std::set<std::string> attributes;
        for (const ElementRule::Attribute& attribute : rule.attributes)
            attributes.insert(attribute.name);
        CHECK(other.attributes == attributes);
        CHECK(other.children == std::set<std::string>(rule.children.begin(), rule.children.end()));
        CHECK(other.text == rule.text);
    }
}

TEST_CASE("the scenes that ship and the contract's are valid") {
    if (!haveXmllint()) return;
    size_t scenes = 0;
    for (const std::filesystem::path& folder : {std::filesystem::path(SPECTRAD_SOURCE) / "scenes",
                                                std::filesystem::path(SPECTRAD_SHARED) / "contract"}) {
        if (!std::filesystem::exists(folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            if (entry.path().extension() != ".xml") continue;
            CAPTURE(entry.path());
            CHECK(isValid(entry.path()));
            ++scenes;
        }
    }
    if (scenes == 0) WARN("no scenes were found to validate");
}

TEST_CASE("the format's own example is valid, and so is every form of value that the reader takes") {
    if (!haveXmllint()) return;
    const TemporaryFolder folder;
    CHECK(isValid(folder.write("all.xml", R"(<scene version="1" unit="mm">
  <wavelengths projection="box">400 405.2 410</wavelengths>
  <spectrum name="a" quantity="intensity">400:1 <!-- why not --> 700:2</spectrum>
  <spectrum name="b" file="lamp.csv" column="Patch 7" relative="true"/>
  <spectrum name="c" value="constant:1"/>
  <material name="ink">
    <emission spectrum="illuminants/A" luminance="100 cd/m2"/>
    <fluorescence excitation="gaussian:380,60" emission="gaussian:520,40" yield="0.9" strength="1" emission-unit="photons" anti-stokes="true"/>
    <fluorescence matrix="donaldson.csv" diagonal="none"/>
    <conductor ior="metals/Au" roughness="0.1" fresnel="exact"/>
    <specular reflectance="constant:0.9" roughness="0.1"/>
    <gloss ior="1.5" roughness="0.3"/>
    <diffuse texture="pass:NAME" roughness="20" filter="mip" wrap="repeat" offset="0.5 -1" scale="2 3" rotate="90"/>
  </material>
  <material name="map">
    <diffuse select="map.png" values="mix" scale="2"><choose value="0" reflectance="a"/><choose value="255" reflectance="b"/></diffuse>
    <fluorescence excitation="a" emission="b" mask="ink.png" filter="nearest"/>
    <normal map="bricks.png" strength="0.5" wrap="repeat"/>
  </material>
  <material name="dented">
    <bump height="dents.png" depth="-0.2" filter="mip"/>
  </material>
  <node name="cow" translate="0 -.5 -2e1" rotate="0 1 0 90" scale="2">
    <mesh file="cow.obj" material="ink" normals="smooth"/>
    <sphere radius="1"/> <box size="1 1 1"/> <box size="2"/> <plane size="2 1"/> <disc radius="1"/> <cylinder radius="1" height="2"/>
    <cone radius="1" height="2"/> <torus radius="1" tube="0.3"/> <teapot size="1"/>
    <node matrix="1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1"><light type="ambient" spectrum="a" scale="2"/></node>
    <node shadows="false"/>
  </node>
  <instance of="cow" translate="3 0 0" shadows="true"/>
  <background spectrum="a" radiance="1 W/m²/sr over 400:700"/>
  <import file="room.dae"> <bind material="Wall*" to="ink"/> </import>
  <light type="point" position="0 3 0" spectrum="illuminants/D65" intensity="800 cd"/>
  <light type="spot" position="0 1 0" target="0 0 0" angle="30" blend="0.2" spectrum="a"/>
  <light type="directional" shadows="true" direction="0 -1 0" spectrum="a" irradiance="100 W/m2 over 400:700"/>
  <camera name="main" type="perspective" fov="40" look-from="0 1 5" look-at="0 0 0" up="0 1 0" size="1280x720"/>
  <camera sensor="36x24" focal="50"/>
  <camera name="flat" type="orthographic" height="4" look-from="0 0 5" look-at="0 0 0" size="600x400"/>
  <detector name="eye" observer="observers/cie1931-2"/>
  <pass name="inner" camera="flat" of="cow" size="512x512" samples="16" as="reflectance" wavelengths="400:700:10" projection="slit" save="x.exr"/>
</scene>)")));
}

TEST_CASE("malformed scenes are invalid") {
    if (!haveXmllint()) return;
    const TemporaryFolder folder;
    REQUIRE(isValid(folder.write("good.xml", inScene("<node/>"))));
    for (const char* content : {
             "<spere/>",
             "<node><sphere radios=\"1\"/></node>",
             "<node><sphere radius=\"-1\"/></node>",
             "<node><sphere radius=\"NaN\"/></node>",
             "<node>text</node>",
             "<node translate=\"1 2\"/>",
             "<node matrix=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\" scale=\"2\"/>",
             "<node><bind material=\"a\" to=\"b\"/></node>",
             "<instance/>",
             "<material><diffuse reflectance=\"a\"/></material>",
             "<material name=\"m\"><diffuse/></material>",
             "<material name=\"m\"><diffuse reflectance=\"a\" texture=\"b\"/></material>",
             "<material name=\"m\"><diffuse select=\"a.png\"/></material>",
             "<material name=\"m\"><bump height=\"a.png\"/></material>",
             "<material name=\"m\"><normal map=\"a.png\" strength=\"-1\"/></material>",
             "<material name=\"m\"><diffuse reflectance=\"a\" wrap=\"repeat\"/></material>",
             "<material name=\"m\"><diffuse reflectance=\"constant:1\"><choose value=\"0\" "
             "reflectance=\"constant:1\"/></diffuse></material>",
             "<material name=\"m\"><diffuse texture=\"a.png\" filter=\"cubic\"/></material>",
             "<material name=\"m\"><gloss ior=\"1.5\" roughness=\"2\"/></material>",
             "<material name=\"m\"><fluorescence excitation=\"a\"/></material>",
             "<light type=\"point\" spectrum=\"a\" intensity=\"800\"/>",
             "<light type=\"point\" spectrum=\"a\" intensity=\"800 lx\"/>",
             "<light type=\"point\" spectrum=\"a\" intensity=\"800 cd\" scale=\"2\"/>",
             "<light type=\"point\" spectrum=\"a\" luminance=\"800 cd/m2\"/>",
             "<light type=\"spot\" spectrum=\"a\" intensity=\"800 cd\"/>",
             "<light type=\"sun\" spectrum=\"a\" scale=\"1\"/>",
             "<camera fov=\"180\"/>",
             "<camera fov=\"40\" sensor=\"36x24\" focal=\"50\"/>",
             "<camera type=\"orthographic\"/>",
             "<camera size=\"1280\"/>",
             "<pass camera=\"a\"/>",
             "<pass name=\"p\" samples=\"0\"/>",
             "<spectrum name=\"a\" column=\"2\" value=\"b\"/>",
             "<spectrum name=\"a\" quantity=\"colour\" value=\"b\"/>",
             "<wavelengths projection=\"slot\"/>",
             "<background spectrum=\"a\" scale=\"1\"/><background spectrum=\"a\" scale=\"1\"/>",
         }) {
        CAPTURE(content);
        CHECK_FALSE(isValid(folder.write("bad.xml", inScene(content))));
        CHECK_FALSE(refusal(folder, inScene(content)).empty());
    }
}
