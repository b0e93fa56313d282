// Passes in a scene file: what needs what, and what is refused before anything renders.
#include "scene/pass_needs.h"
#include "unit/scene/xml_support.h"

#include <catch2/catch.hpp>

using namespace spectrad;
using namespace spectrad::testing;

namespace {

/// Nodes a, b, c, each a plane whose <diffuse> is the pass of the given name ("" for grey), and passes a, b,
/// c of them.
std::string chain(const std::string& a, const std::string& b, const std::string& c) {
    std::string text =
        "<scene version=\"1\">\n<light type=\"ambient\" spectrum=\"constant:1\" scale=\"1\"/>\n";
    const std::string uses[] = {a, b, c};
    for (size_t i = 0; i < 3; ++i) {
        const std::string name(1, static_cast<char>('a' + i));
        text += "<material name=\"" + name + "\"><diffuse " +
                (uses[i].empty() ? "reflectance=\"constant:0.5\"" : "texture=\"pass:" + uses[i] + "\"") +
                "/></material>\n<node name=\"" + name + "\"><plane material=\"" + name +
                "\"/></node>\n<pass name=\"" + name + "\" of=\"" + name + "\" as=\"reflectance\"/>\n";
    }
    return text + "<camera look-from=\"0 0 5\"/></scene>\n";
}

}  // namespace

TEST_CASE("passes that need each other are refused with the chain, at the texture that closes it") {
    CHECK(refusal(chain("b", "a", "")) == "scene.xml:6:20: passes need each other: a -> b -> a");
    CHECK(refusal(chain("b", "c", "a")) == "scene.xml:9:20: passes need each other: a -> b -> c -> a");
    CHECK(refusal(chain("b", "c", "b")) == "scene.xml:9:20: passes need each other: b -> c -> b");
    CHECK(refusal(chain("a", "", "")) ==
          "scene.xml:3:20: passes need each other: a -> a (repeat= lets a pass see itself)");
    CHECK(refusal(chain("b", "c", "")).empty());
}

TEST_CASE("only what a pass shows counts as needed") {
    // Material a wears pass b and is seen by no pass but a.
    const Loaded loaded = load(chain("b", "c", ""));
    const Scene& scene = loaded.scene;
    REQUIRE(passesNeeded(scene, &scene.passes[0]).size() == 1);
    CHECK(passesNeeded(scene, &scene.passes[0])[0].pass == 1);
    CHECK(passesNeeded(scene, &scene.passes[1])[0].pass == 2);
    CHECK(passesNeeded(scene, &scene.passes[2]).empty());
    CHECK(passesNeeded(scene, nullptr).size() == 2);
}

TEST_CASE("a pass must be there and hold what its use is made of") {
    const auto wearing = [](const std::string& lobe, const std::string& as) {
        return inScene("<material name=\"m\">" + lobe +
                       "</material>\n<node name=\"n\"><plane/></node><plane material=\"m\"/>\n<pass "
                       "name=\"p\" of=\"n\" as=\"" +
                       as + "\"/>");
    };
    CHECK(refusal(wearing("<diffuse texture=\"pass:q\"/>", "reflectance")) ==
          "scene.xml:2:20: unknown pass 'q' (did you mean 'p'?)");
    CHECK(refusal(wearing("<diffuse texture=\"pass:p\"/>", "radiance")) ==
          "scene.xml:2:20: pass 'p' is as=\"radiance\", but a <diffuse> texture is a reflectance "
          "(as=\"reflectance\")");
    CHECK(refusal(wearing("<emission texture=\"pass:p\"/>", "irradiance")) ==
          "scene.xml:2:20: pass 'p' is as=\"irradiance\", but what glows is a radiance (as=\"radiance\")");
    CHECK(refusal(wearing("<emission texture=\"pass:p\" scale=\"2\"/>", "radiance")).empty());
    CHECK(refusal(wearing("<emission texture=\"pass:p\" luminance=\"3 cd/m2\"/>", "radiance"))
              .find("cannot stand beside 'texture'") != std::string::npos);
    CHECK(refusal(wearing("<emission/>", "radiance")) ==
          "scene.xml:2:20: <emission> needs the attribute 'spectrum' or 'texture'");
}

TEST_CASE("a pass counts the lights that it names, wherever they stand, or those inside its node") {
    const Loaded loaded = load(R"(<scene version="1">
<node name="n"><plane/><light name="in" type="ambient" spectrum="constant:1" scale="1"/></node>
<light name="out" type="ambient" spectrum="constant:1" scale="1"/>
<camera/>
<pass name="inside" of="n"/>
<pass name="named" of="n" lights="out"/>
<pass name="both" of="n" lights="out in"/>
<pass name="all"/>
</scene>)");
    const Scene& scene = loaded.scene;
    const auto lights = [&](size_t pass) {
        std::string names;
        for (const Placed& light : flatten(scene, scene.passes[pass]).lights)
            names += scene.lights[light.index].name + " ";
        return names;
    };
    CHECK(lights(0) == "in ");
    CHECK(lights(1) == "out ");
    CHECK(lights(2) == "in out ");
    CHECK(lights(3) == "in out ");
    CHECK(refusal(inScene("<light name=\"sun\" type=\"ambient\" spectrum=\"constant:1\" "
                          "scale=\"1\"/><pass name=\"p\" lights=\"sum\"/>")) ==
          "scene.xml:2:67: unknown light 'sum' (did you mean 'sun'?)");
}

TEST_CASE("a pass repeats only if it shows itself") {
    CHECK(refusal(inScene("<pass name=\"p\" repeat=\"3\"/>")) ==
          "scene.xml:2:1: pass 'p' repeats, but nothing that it shows is textured with pass:p");
    CHECK(refusal(inScene("<material name=\"m\"><emission texture=\"pass:p\"/></material><plane "
                          "material=\"m\"/><pass name=\"p\" repeat=\"3\"/>"))
              .empty());
}

TEST_CASE("a pass of another file is what that file renders by itself, but for what it says") {
    const TemporaryFolder folder;
    folder.write("other.xml", R"(<scene version="1">
<wavelengths from="400" to="700" step="10"/>
<node name="n"><plane/></node><light name="l" type="ambient" spectrum="constant:1" scale="1"/>
<camera name="first"/><camera name="second" look-from="0 0 3" size="20x10"/>
<pass name="main" camera="second" as="reflectance" save="kept.exr"/><pass name="last"/>
</scene>)");
    const Loaded loaded = load(folder, inScene("<pass name=\"a\" scene=\"other.xml\"/>\n<pass name=\"b\" "
                                               "scene=\"other.xml\" camera=\"first\" of=\"n\" "
                                               "as=\"radiance\" lights=\"l\"/>"));
    const Pass &a = loaded.scene.passes[0], &b = loaded.scene.passes[1];
    REQUIRE(a.scene);
    CHECK((a.name == "a" && a.camera == 1 && a.as == PassKind::reflectance && a.save.empty()));
    CHECK((b.camera == 0 && b.of && b.as == PassKind::radiance && b.lights->size() == 1));
    CHECK(loaded.scene.filesRead.size() == 2);
    CHECK(refusal(folder, inScene("<pass name=\"a\" scene=\"other.xml\" camera=\"frist\"/>")) ==
          "scene.xml:2:1: camera=\"frist\" in <pass>: other.xml names nothing of the kind 'frist' (did you "
          "mean 'first'?)");
    CHECK(refusal(folder, inScene("<pass name=\"a\" scene=\"none.xml\"/>"))
              .starts_with("scene.xml:2:1: cannot find the file 'none.xml'"));
    folder.write("turn.xml", inScene("<pass name=\"p\" scene=\"scene.xml\"/>"));
    CHECK(refusal(folder, inScene("<pass name=\"p\" scene=\"turn.xml\"/>")) ==
          "turn.xml:2:1: scenes have passes of each other: scene.xml -> turn.xml -> scene.xml");
}

TEST_CASE("a pass is saved beside its scene, into a file of a kind we write, and over nothing that is read") {
    const TemporaryFolder folder;
    const Loaded loaded = load(folder, inScene("<pass name=\"p\" save=\"p.exr\"/>"));
    CHECK(loaded.scene.passes[0].save == (folder.path() / "p.exr").string());
    CHECK(refusal(inScene("<pass name=\"p\" save=\"p.png\"/>")) ==
          "scene.xml:2:1: save=\"p.png\" in <pass>: expected a name that ends in .exr or .img (ENVI)");
    CHECK(refusal(folder, inScene("<pass name=\"p\" save=\"../p.exr\"/>"), {}, true) ==
          "scene.xml:2:1: '../p.exr' lies outside the scene's folder, which is not allowed here "
          "(--restrict)");
    folder.write("t.exr", "");
    CHECK(refusal(folder, inScene("<material name=\"m\"><diffuse texture=\"t.exr\"/></material><plane "
                                  "material=\"m\"/><pass name=\"p\" save=\"./t.exr\"/>"))
              .find("this file is read by the scene") != std::string::npos);
}
