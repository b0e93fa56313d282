// The graph flattened: where each thing stands in the world, instances expanded.
#include "unit/scene/xml_support.h"

#include <catch2/catch.hpp>

using namespace spectrad;
using namespace spectrad::testing;

namespace {

Index nodeNamed(const Scene& scene, const std::string& name) {
    for (Index i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].name == name) return i;
    FAIL("no node " << name);
    return 0;
}

std::vector<double> xOf(const FlatScene& flat) {
    std::vector<double> x;
    for (const FlatScene::Object& object : flat.objects)
        x.push_back(object.toWorld.point({0, 0, 0}).x);
    return x;
}

}  // namespace

TEST_CASE("objects come in document order with all transforms above them") {
    const Scene scene = load(inScene(R"(
      <node translate="1 0 0"><sphere/><node translate="10 0 0"><sphere/></node></node>
      <node translate="2 0 0"><node translate="20 0 0"><sphere/></node><node translate="30 0 0"/></node>)"))
                            .scene;
    CHECK(xOf(flatten(scene)) == std::vector<double>{1, 11, 22});
}

TEST_CASE("an instance shows the content under its own transform instead of the node's") {
    const Scene scene = load(inScene(R"(
      <node name="cow" translate="100 0 0"><sphere/><node translate="1 0 0"><sphere/></node></node>
      <instance of="cow" translate="3 0 0"/>
      <node translate="1000 0 0"><instance name="again" of="cow" translate="3 0 0"/></node>
      <instance of="again" translate="7 0 0"/>)"))
                            .scene;
    CHECK(xOf(flatten(scene)) == std::vector<double>{100, 101, 3, 4, 1003, 1004, 7, 8});
}

TEST_CASE("an instance's lights and cameras come once for each occurrence, the written order kept") {
    const Scene scene = load(R"(<scene>
      <node name="lamp"><light name="inner" type="point" spectrum="illuminants/A" intensity="1 cd"/><camera name="c"/></node>
      <light name="outer" type="ambient" spectrum="constant:1" scale="1"/>
      <instance of="lamp" translate="5 0 0"/></scene>)")
                            .scene;
    const FlatScene flat = flatten(scene);
    REQUIRE(flat.lights.size() == 3);
    CHECK(scene.lights[flat.lights[0].index].name == "inner");
    CHECK(scene.lights[flat.lights[1].index].name == "inner");
    CHECK(flat.lights[1].toWorld.point({0, 0, 0}).x == 5);
    CHECK(scene.lights[flat.lights[2].index].name == "outer");
    CHECK(flat.cameras.size() == 2);
}

TEST_CASE("a part of the scene keeps its place in the world") {
    const Scene scene = load(inScene(R"(
      <node translate="1 0 0"><node name="part" translate="10 0 0"><sphere/><node translate="5 0 0"><sphere/></node>
        <light type="point" spectrum="illuminants/A" intensity="1 cd"/></node><sphere/></node>)"))
                            .scene;
    const FlatScene flat = flatten(scene, nodeNamed(scene, "part"));
    CHECK(xOf(flat) == std::vector<double>{11, 16});
    REQUIRE(flat.lights.size() == 1);
    CHECK(flat.lights[0].toWorld.point({0, 0, 0}).x == 11);
    CHECK(flat.cameras.empty());
}

TEST_CASE("instances of instances multiply, up to a limit that is named") {
    std::string xml = "<node name=\"n0\"><sphere/></node>";
    const auto doubled = [&](int levels) {
        std::string all = xml;
        for (int i = 1; i <= levels; ++i) {
            const std::string before = "<instance of=\"n" + std::to_string(i - 1) + "\"/>";
            all += "<node name=\"n" + std::to_string(i) + "\">" + before + before + "</node>";
        }
        return inScene(all);
    };
    CHECK(flatten(load(doubled(10)).scene).objects.size() == 2047);
    CHECK(refusal(doubled(40)).find("instances expand to more than 16777216 nodes (the limit)") !=
          std::string::npos);
}

TEST_CASE("transforms that multiply beyond the range of numbers are an error at the node") {
    std::string xml;
    for (int i = 0; i < 12; ++i)
        xml += "<node scale=\"1e30\">";
    xml += "<sphere/>";
    for (int i = 0; i < 12; ++i)
        xml += "</node>";
    const Scene scene = load(inScene(xml)).scene;
    CHECK_THROWS_AS(flatten(scene), InputError);
}
