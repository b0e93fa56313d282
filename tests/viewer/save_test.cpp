// What is saved: only what changed, and it renders to what was seen.
#include "viewer/save.h"

#include "base/files.h"
#include "render/renderer.h"
#include "support/read_picture.h"
#include "viewer/support.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace spectrad;
using view::Codes;
using view::test::canView;
using view::test::Desk;

namespace {

// Laid out as nobody would, to be kept so.
constexpr const char* original =
    "\xEF\xBB\xBF<?xml version=\"1.0\"?>\r\n"
    R"(<!-- a scene: <light> is no light here -->
<scene version='1'	unit = "cm" >
  <material name="a &amp; b"><!-- red --><diffuse
      reflectance = 'charts/colorchecker/red' /></material>
  <material name="lacquer"><diffuse reflectance="charts/colorchecker/cyan"/><gloss ior="1.5" roughness="0.3"/></material>
  <node translate="-50 0 0"><sphere radius="50" material="a &amp; b"/></node>
  <node translate="50 0 0"><sphere radius="50" material="lacquer"/></node>
  <node name="crane" translate="0 10 0" rotate="0 1 0 20">
    <camera name="eye" fov="40"   look-from="0 0 300" size="64x48"></camera>
  </node>
  <light name="lamp" type="point" position="200 400 400" spectrum="illuminants/D65" intensity="  300   cd"/>
  <light name="sun" type="directional" direction="-1 -1 -1" spectrum="illuminants/A" scale="0.001"/><!-- end -->
</scene>
)";

std::string between(const std::string& text, const std::string& from, const std::string& to) {
    const size_t begin = text.find(from) + from.size();
    return text.substr(begin, text.find(to, begin) - begin);
}

std::string without(std::string text, const std::string& part) {
    const size_t at = text.find(part);
    REQUIRE(at != std::string::npos);
    return text.erase(at, part.size());
}

}  // namespace

TEST_CASE("a scene in which nothing was changed is saved byte for byte") {
    if (!canView()) return;
    Desk desk{std::string(original)};
    CHECK(view::sceneText(*desk.session->aboutScene(), desk.session->look(0), desk.session->stand.pose) ==
          original);
    desk.session->set("a & b.reflectance=charts/colorchecker/blue");
    desk.session->set("a & b.reflectance=charts/colorchecker/red");
    desk.session->set("lamp.times=1");
    desk.play("camera orbit 10 5\nkey home");
    CHECK(view::sceneText(*desk.session->aboutScene(), desk.session->look(0), desk.session->stand.pose) ==
          original);
}

TEST_CASE("saved scenes differ in the changed attributes alone") {
    if (!canView()) return;
    Desk desk{std::string(original)};
    desk.session->set("lamp.spectrum=illuminants/FL11");
    desk.session->set("lamp.times=0.5");
    desk.session->set("sun.on=false");
    desk.session->set("a & b.reflectance=400:0.1 700:0.9");
    std::string text =
        view::sceneText(*desk.session->aboutScene(), desk.session->look(0), desk.session->stand.pose);
    CHECK(between(text, "position=\"200 400 400\" ", "/>") ==
          "spectrum=\"illuminants/FL11\" intensity=\"150   cd\"");
    CHECK(between(text, "name=\"sun\" ", "/>") ==
          "type=\"directional\" direction=\"-1 -1 -1\" spectrum=\"illuminants/A\" scale=\"0\"");
    CHECK(between(text, "reflectance = ", " />") == "'400:0.1 700:0.9'");
    // With these put back it is the original.
    const auto back = [&](const std::string& now, const std::string& then) {
        const size_t at = text.find(now);
        REQUIRE(at != std::string::npos);
        text.replace(at, now.size(), then);
    };
    back("illuminants/FL11", "illuminants/D65");
    back("150   cd", "  300   cd");
    back("scale=\"0\"", "scale=\"0.001\"");
    back("400:0.1 700:0.9", "charts/colorchecker/red");
    CHECK(text == original);

    // A camera that moved gets what it lacks.
    desk.session->set("lamp.spectrum=illuminants/D65");
    desk.play("camera orbit 25 5");
    text = view::sceneText(*desk.session->aboutScene(), desk.session->look(0), desk.session->stand.pose);
    const std::string camera = between(text, "<camera ", ">");
    CHECK_THAT(camera, Catch::StartsWith("name=\"eye\" fov=\"40\"   look-from=\"") &&
                           Catch::Contains("size=\"64x48\" look-at=\"") && Catch::Contains("\" up=\""));
}

TEST_CASE("a saved scene renders to what the viewer shows, and so does a saved cube") {
    if (!canView()) return;
    RenderSettings settings;
    settings.samples = 4;
    Desk desk{std::string(original), settings};
    desk.session->set("lamp.spectrum=illuminants/A");
    desk.session->set("lamp.times=0.7");
    desk.session->set("sun.times=2");
    desk.session->set("lacquer.reflectance=charts/colorchecker/purple");
    desk.play("camera orbit 25 15\ncamera dolly 2\ncamera pan 5 3");
    (void)desk.viewer->picture();
    Codes shown, again, unused;
    desk.session->invalidate();
    (void)desk.refresh(shown, unused);

    const std::filesystem::path file = desk.folder.path() / "saved.xml";
    desk.session->saveScene(file);
    Desk saved(file, settings);
    saved.session->heldLuminance = desk.session->heldLuminance;
    (void)saved.viewer->picture();
    saved.session->invalidate();
    (void)saved.refresh(again, unused);
    REQUIRE(again.size() == shown.size());
    size_t other = 0;
    for (size_t i = 0; i < again.size(); ++i)
        for (const int shift : {0, 8, 16})
            other += std::abs(static_cast<int>(again[i] >> shift & 255) -
                              static_cast<int>(shown[i] >> shift & 255)) > 1;
    CHECK(other == 0);

    desk.session->saveCube(desk.folder.path() / "saved.exr");
    Desk cube(desk.folder.path() / "saved.exr");
    cube.session->heldLuminance = desk.session->heldLuminance;
    (void)cube.refresh(again, unused);
    REQUIRE(again.size() == shown.size());
    for (size_t i = 0; i < again.size(); ++i)
        for (const int shift : {0, 8, 16})
            other += std::abs(static_cast<int>(again[i] >> shift & 255) -
                              static_cast<int>(shown[i] >> shift & 255)) > 1;
    CHECK(other == 0);
    const std::vector<double> metered = desk.measured(30, 20).spectrum,
                              stored = cube.measured(30, 20).spectrum;
    REQUIRE(stored.size() == metered.size());
    for (size_t band = 0; band < stored.size(); ++band)  // lights apart or together: sums of floats
        CHECK(std::abs(stored[band] - metered[band]) <= 1e-6 * stored[band]);
}

TEST_CASE("a scene saved over itself is looked at as before") {
    if (!canView()) return;
    Desk desk{std::string(original)};
    desk.session->set("lamp.spectrum=illuminants/A");
    desk.session->set("lamp.times=0.25");
    desk.play("camera orbit 25 15");
    desk.viewer->showPanels(false);
    const Picture8 before = desk.viewer->picture();
    desk.session->saveScene(desk.folder.path() / "scene.xml");
    const Picture8 after = desk.viewer->picture();
    REQUIRE(desk.session->problem.empty());
    CHECK(desk.session->look(0).lights[0].times == 1);
    size_t other = 0;
    for (size_t i = 0; i < after.pixels.size(); ++i)
        other += std::abs(after.pixels[i] - before.pixels[i]) > 1;
    CHECK(other == 0);
}

TEST_CASE("a scene without a camera gets the one it was looked at with") {
    if (!canView()) return;
    const std::string bare = R"(<scene version="1" unit="mm">
  <node><sphere radius="50"/></node>
  <light name="lamp" type="point" position="200 400 400" spectrum="illuminants/D65" intensity="300 cd"/>
</scene>
)";
    Desk desk(bare);
    desk.play("camera orbit 10 0");
    const std::string text =
        view::sceneText(*desk.session->aboutScene(), desk.session->look(0), desk.session->stand.pose);
    const std::string added = "  <camera" + between(text, "  <camera", "/>") + "/>\n";
    CHECK(without(text, added) == bare);
    const std::filesystem::path file = desk.folder.write("again.xml", text);
    Desk again(file);
    CHECK(length(again.session->scene()->home().eye - desk.session->stand.pose.eye) < 1e-9);
}

TEST_CASE("what cannot be saved is refused in one line") {
    if (!canView()) return;
    Desk desk{std::string(original)};
    CHECK_THROWS_AS(desk.session->saveScene(desk.folder.path() / "x.txt"), UsageError);
    CHECK_THROWS_AS(desk.session->saveScene("elsewhere.xml"), UsageError);
    CHECK_THROWS_AS(desk.session->saveCube(desk.folder.path() / "x.png"), UsageError);
    CHECK_THROWS_AS(desk.viewer->savePicture(desk.folder.path() / "x.jpg"), UsageError);
    desk.viewer->savePicture(desk.folder.path() / "x.png");
    desk.viewer->showPanels(false);
    CHECK(readPicture8(desk.folder.path() / "x.png").pixels == desk.viewer->picture().pixels);
    for (const char* wrong : {"save", "save picture", "save all x.png"})
        CHECK_THROWS_WITH(view::parseScript(wrong, "s.txt"), Catch::StartsWith("s.txt:1:1: "));
}
