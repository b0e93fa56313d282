// Passes from the command line: chains against the same done by hand through files, --pass, save=.
#include "cli/support.h"
#include "image/cube.h"

#include <algorithm>
#include <cmath>

using cli::Folder;
using cli::requireError;
using cli::run;

namespace {

/// A print (reflectance) of a chart in a room under another lamp, photographed (radiance) onto a screen in a
/// hall. What the print and the screen show is left open.
std::string scene(const std::string& print, const std::string& screen) {
    return R"(<scene version="1">
  <wavelengths from="400" to="700" step="10"/>
  <material name="a"><diffuse reflectance="400:0.1 505:0.7 600:0.2 700:0.4"/></material>
  <material name="b"><diffuse reflectance="400:0.6 500:0.2 603:0.1 700:0.8"/><gloss ior="1.5" roughness="0.4"/></material>
  <material name="print"><diffuse texture=")" +
           print + R"("/></material>
  <material name="screen"><emission texture=")" +
           screen + R"(" scale="1.5"/></material>
  <node name="studio">
    <sphere radius="0.4" material="b"/><node translate="0 0 -0.5"><plane size="3 3" material="a"/></node>
    <light type="point" position="1 1 2" spectrum="illuminants/A" intensity="100 cd"/>
    <light type="ambient" spectrum="illuminants/D65" luminance="5 cd/m2"/>
    <camera name="studio" type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="33x20"/>
  </node>
  <node name="room" translate="9 0 0">
    <node rotate="0 1 0 20"><plane size="1.6 1" material="print"/></node>
    <light type="spot" position="0 1 2" target="0 0 0" angle="60" blend="0.5" spectrum="illuminants/FL11" intensity="300 cd"/>
    <camera name="room" look-from="0 0 2" look-at="0 0 0" fov="30" size="40x30"/>
  </node>
  <node name="hall" translate="-9 0 0">
    <node rotate="1 0 0 -15"><plane size="1.6 1.2" material="screen"/></node><node translate="0 0 -1"><plane size="4 4"/></node>
    <light type="directional" direction="0 0 -1" spectrum="illuminants/D65" illuminance="20 lx"/>
    <camera name="hall" look-from="0 0 2" look-at="0 0 0" fov="45" size="50x40"/>
  </node>
  <pass name="chart" camera="studio" of="studio" as="reflectance" size="24x16" save="kept/chart.exr"/>
  <pass name="photograph" camera="room" of="room" samples="4"/>
  <pass name="main" camera="hall" of="hall"/>
  <pass name="unused" camera="hall" of="hall" save="unused.exr"/>
</scene>
)";
}

spectrad::Cube cubeIn(const Folder& folder, const std::string& name) {
    spectrad::Notes notes;
    return spectrad::readCube(folder / name, notes);
}

void requireSame(const Folder& folder, const std::string& a, const std::string& b) {
    CAPTURE(a, b);
    const spectrad::Cube first = cubeIn(folder, a), second = cubeIn(folder, b);
    REQUIRE(first.info.kind == second.info.kind);
    REQUIRE(first.info.wavelengths.nm == second.info.wavelengths.nm);
    REQUIRE(first.values == second.values);
    REQUIRE(std::any_of(first.values.begin(), first.values.end(), [](float v) { return v > 0; }));
}

}  // namespace

TEST_CASE("a chain of passes is bit for bit the same done by hand through files") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    std::filesystem::create_directory(folder / "kept");
    folder.write("chain.xml", scene("pass:chart", "pass:photograph"));
    REQUIRE(run(folder, {"render", "chain.xml", "-q", "-o", "chain.exr"}).code == 0);
    CHECK(std::filesystem::exists(folder / "kept/chart.exr"));
    CHECK_FALSE(std::filesystem::exists(folder / "unused.exr"));

    std::filesystem::remove(folder / "kept/chart.exr");
    REQUIRE(run(folder, {"render", "chain.xml", "-q", "--pass", "chart", "-o", "chart.exr"}).code == 0);
    requireSame(folder, "chart.exr", "kept/chart.exr");
    folder.write("first.xml", scene("chart.exr", "pass:photograph"));
    REQUIRE(run(folder, {"render", "first.xml", "-q", "--pass", "photograph", "-o", "photograph.exr"}).code ==
            0);
    folder.write("second.xml", scene("chart.exr", "photograph.exr"));
    REQUIRE(run(folder, {"render", "second.xml", "-q", "-o", "hand.exr"}).code == 0);
    requireSame(folder, "chain.exr", "hand.exr");

    // What is saved as well goes by the host instead of staying on the device.
    REQUIRE(run(folder, {"render", "chain.xml", "-q", "-o", "saved.exr", "--set",
                         "pass:photograph.save=kept/photograph.exr"})
                .code == 0);
    requireSame(folder, "kept/photograph.exr", "photograph.exr");
    REQUIRE(run(folder, {"compare", "saved.exr", "hand.exr", "--json", "-q"}).json().at("band_rmse") == 0);
}

TEST_CASE("what stays on the device – prints under coats, displays, their pyramids – is what files make") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    const auto text = [](const std::string& chart, const std::string& screen) {
        std::string scene = R"(<scene version="1"><wavelengths from="400" to="700" step="10"/>
  <material name="a"><diffuse reflectance="400:0.1 505:0.9 600:0.2 700:0.4"/></material>
  <material name="b"><diffuse reflectance="400:0.6 500:0 544:0 546:0.9 560:0 700:0.97"/></material>
  <material name="glazed"><diffuse texture="CHART" filter="mip"/><gloss ior="1.6" roughness="0.2"/></material>
  <material name="plaster"><diffuse texture="CHART" filter="mip" roughness="20" wrap="repeat" scale="3"/></material>
  <material name="near"><diffuse texture="CHART"/></material>
  <material name="screen"><emission texture="SCREEN" filter="mip"/></material>
  <node name="chart"><node translate="-0.5 0 0"><plane size="0.9 1" material="a"/></node><node translate="0.6 0 0"><sphere radius="0.5" material="b"/></node></node>
  <node name="room"><node translate="-1.2 0 0" rotate="0 1 0 50"><plane size="2 2" material="glazed"/></node>
    <node translate="1 0 0" rotate="0 1 0 -70"><plane size="2 2" material="plaster"/></node><node translate="0 -0.6 0.5"><plane size="0.5 0.5" material="near"/></node>
    <node translate="0 0.4 -2"><plane size="0.7 0.5" material="screen"/></node></node>
  <light name="lamp" type="point" position="0 1 3" spectrum="illuminants/FL11" intensity="90 cd"/>
  <light name="sky" type="ambient" spectrum="illuminants/D65" luminance="4 cd/m2"/>
  <detector name="eye" observer="observers/cie1931-2"/>
  <camera name="front" type="orthographic" height="1.4" look-from="0 0 5" look-at="0 0 0" size="47x29"/>
  <camera name="room" look-from="0 0 3" look-at="0 0 0" fov="50" size="60x40"/>
  <pass name="chart" camera="front" of="chart" lights="sky" as="reflectance"/>
  <pass name="photograph" camera="front" of="chart" lights="lamp" through="eye" display="displays/crt-brainard-1997" luminance="1 cd/m2"/>
  <pass name="main" camera="room" of="room" lights="lamp sky"/></scene>)";
        for (const auto& [mark, by] :
             {std::pair<std::string, std::string>{"CHART", chart}, {"SCREEN", screen}})
            for (size_t at = scene.find(mark); at != std::string::npos; at = scene.find(mark))
                scene.replace(at, mark.size(), by);
        return scene;
    };
    folder.write("chain.xml", text("pass:chart", "pass:photograph"));
    folder.write("hand.xml", text("chart.exr", "photograph.exr"));
    const auto done = [&](const std::vector<std::string>& arguments) { return run(folder, arguments); };
    const auto chain = done({"render", "chain.xml", "-o", "chain.exr"});
    INFO(chain.err);
    REQUIRE(chain.code == 0);
    for (const std::string name : {"chart", "photograph"})
        REQUIRE(done({"render", "chain.xml", "-q", "--pass", name, "-o", name + ".exr"}).code == 0);
    const auto hand = done({"render", "hand.xml", "-o", "hand.exr"});
    REQUIRE(hand.code == 0);
    requireSame(folder, "chain.exr", "hand.exr");
    // What is said is the same too: pixels that the display clips, reflectances below zero between bands.
    CHECK(chain.err.find("lie outside what it shows and were clipped") != std::string::npos);
    CHECK(chain.err.find("reflectances came out below zero") != std::string::npos);
    CHECK(hand.err.find("reflectances came out below zero") != std::string::npos);

    // A pass that is saved as well stays where it is.
    REQUIRE(done({"render", "chain.xml", "-q", "-o", "saved.exr", "--set", "pass:photograph.save=p.exr",
                  "--set", "pass:chart.save=c.exr"})
                .code == 0);
    requireSame(folder, "p.exr", "photograph.exr");
    requireSame(folder, "c.exr", "chart.exr");
    requireSame(folder, "saved.exr", "hand.exr");
    // Where there is nothing to divide by, a print is refused as a picture of its own is.
    requireError(done({"render", "chain.xml", "-q", "--set", "pass:chart.lights=lamp", "--set",
                       "light:lamp.position=0 0 -3"}),
                 1, "pass 'chart': no light arrives at pixel");
}

TEST_CASE("a print of a node without lights of its own says how others come to count") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    const auto printed = [&](const char* lights) {
        folder.write("s.xml", std::string(R"(<scene><node name="n"><plane size="9"/></node>
<light name="lamp" type="directional" direction="0 0 -1" spectrum="illuminants/A" illuminance="1 lx"/>
<camera type="orthographic" height="1" look-from="0 0 1" look-at="0 0 0" size="3x3"/>
<pass name="p" as="reflectance" of="n")") +
                                  lights + "/></scene>");
        return run(folder, {"render", "s.xml", "-q"});
    };
    requireError(printed(""), 1, "lights= names others");
    CHECK(printed(" lights=\"lamp\"").code == 0);
}

TEST_CASE("an image that cannot be read is told where the scene names it") {
    const Folder folder;
    folder.write("o.obj", "v 0 0 0\n");
    folder.write("s.xml", R"(<scene>
 <material name="m"><diffuse texture="o.obj"/></material><sphere material="m"/>
<light type="ambient" spectrum="constant:1" scale="1"/><camera size="4x4"/></scene>)");
    requireError(run(folder, {"info", "s.xml"}), 1, "s.xml:2:21: ./o.obj: is no spectral image");
}

TEST_CASE("a pass of another file is what rendering that file makes") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    std::filesystem::create_directory(folder / "kept");
    folder.write("studio.xml", scene("pass:chart", "pass:photograph"));
    folder.write("wall.xml", R"(<scene version="1"><wavelengths from="400" to="700" step="10"/>
  <material name="m"><emission texture="pass:p" filter="nearest"/></material><plane size="5 4" material="m"/>
  <camera type="orthographic" height="4" look-from="0 0 5" look-at="0 0 0" size="50x40"/>
  <pass name="p" scene="studio.xml"/><pass name="main"/></scene>)");
    REQUIRE(run(folder, {"render", "studio.xml", "-q"}).code == 0);
    REQUIRE(run(folder, {"render", "wall.xml", "-q", "--pass", "p", "-o", "p.exr"}).code == 0);
    requireSame(folder, "p.exr", "studio.exr");
    REQUIRE(run(folder, {"render", "wall.xml", "-q"}).code == 0);
    const spectrad::Cube shown = cubeIn(folder, "wall.exr"), made = cubeIn(folder, "studio.exr");
    double worst = 0, largest = 0;
    REQUIRE(shown.values.size() == made.values.size());
    for (size_t i = 0; i < made.values.size(); ++i) {
        worst = std::max<double>(worst, std::abs(shown.values[i] - made.values[i]));
        largest = std::max<double>(largest, made.values[i]);
    }
    CHECK(worst < 1e-6 * largest);
}

TEST_CASE("what a pass saves never replaces the result, and a cycle is one line before anything renders") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    std::filesystem::create_directory(folder / "kept");
    folder.write("chain.xml", scene("pass:chart", "pass:photograph"));
    requireError(run(folder, {"render", "chain.xml", "--pass", "chart", "-o", "kept/chart.exr"}), 2,
                 "where pass 'chart' is saved");
    std::string text = scene("pass:paper", "pass:photograph");
    text.insert(text.rfind("</scene>"), "<pass name=\"paper\" of=\"room\" as=\"reflectance\"/>");
    folder.write("cycle.xml", text);
    requireError(run(folder, {"render", "cycle.xml"}), 1,
                 "cycle.xml:5:26: passes need each other: paper -> paper");
    CHECK_FALSE(std::filesystem::exists(folder / "cycle.exr"));
}

TEST_CASE("bake writes a texture that a later scene wears") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    const std::string scene = R"(<scene version="1"><wavelengths from="400" to="700" step="50"/>
  <material name="m"><diffuse )";
    const std::string rest = R"(/></material><node name="wall"><plane size="2 1" material="m"/></node>
  <light type="directional" direction="0 0 -1" spectrum="illuminants/D65" illuminance="100 lx"/>
  <camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="20x10"/></scene>)";
    folder.write("paint.xml", scene + "reflectance=\"400:0.2 700:0.8\"" + rest);
    folder.write("print.xml", scene + "texture=\"wall.exr\"" + rest);
    REQUIRE(run(folder, {"bake", "paint.xml", "--node", "wall", "-o", "wall.exr", "--as", "reflectance",
                         "--size", "8x4", "-q"})
                .code == 0);
    CHECK(cubeIn(folder, "wall.exr").info.kind == spectrad::CubeKind::reflectance);
    REQUIRE(run(folder, {"render", "paint.xml", "-q"}).code == 0);
    REQUIRE(run(folder, {"render", "print.xml", "-q"}).code == 0);
    const spectrad::Cube paint = cubeIn(folder, "paint.exr"), print = cubeIn(folder, "print.exr");
    double worst = 0;
    for (size_t i = 0; i < paint.values.size(); ++i)
        worst = std::max<double>(worst, std::abs(print.values[i] / paint.values[i] - 1));
    CHECK(worst < 1e-5);
    requireError(run(folder, {"bake", "paint.xml", "--node", "wal", "-o", "x.exr"}), 1,
                 "the scene has no node 'wal' (did you mean 'wall'?)");
    requireError(run(folder, {"bake", "paint.xml", "--node", "wall", "-o", "x.exr", "--as", "albedo"}), 2,
                 "--as: 'albedo' is not known");
    CHECK_FALSE(std::filesystem::exists(folder / "x.exr"));
}
