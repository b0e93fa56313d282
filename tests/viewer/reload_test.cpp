// Files that change on disk while they are looked at.
#include "viewer/support.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>

using namespace spectrad;
using view::test::canView;
using view::test::Desk;

namespace {

std::string scene(const std::string& lamp, const std::string& paint = "charts/colorchecker/red",
                  const std::string& more = "") {
    return R"(<scene version="1">
  <material name="paint"><diffuse reflectance=")" +
           paint + R"("/></material>
  <node name="ball"><sphere radius="1" material="paint"/></node>
  <light name="lamp" type="point" position="2 4 4" )" +
           lamp + R"(/>
)" + more + R"(  <camera name="eye" fov="40" look-from="0 0 5" look-at="0 0 0" size="48x32"/>
</scene>
)";
}

/// Writes a file and makes sure that its time of change is another.
void rewrite(const Desk& desk, const std::string& name, const std::string& text) {
    const auto file = desk.folder.write(name, text);
    static int later = 0;
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(++later));
}

constexpr const char* day = "spectrum=\"illuminants/D65\" intensity=\"300 cd\"";
constexpr const char* dusk = "spectrum=\"illuminants/A\" intensity=\"300 cd\"";

}  // namespace

TEST_CASE("a scene that changes on disk is shown as it is now") {
    if (!canView()) return;
    Desk desk(scene(day));
    desk.viewer->showPanels(false);
    const Picture8 first = desk.viewer->picture();
    rewrite(desk, "scene.xml", scene(dusk));
    const Picture8 changed = desk.viewer->picture();
    Desk other(scene(dusk));
    other.viewer->showPanels(false);
    // The luminance shown as white is held, as it is for every change.
    other.session->heldLuminance = desk.session->heldLuminance;
    CHECK(changed.pixels == other.viewer->picture().pixels);
    CHECK(changed.pixels != first.pixels);
    rewrite(desk, "scene.xml", scene(day));
    CHECK(desk.viewer->picture().pixels == first.pixels);
}

TEST_CASE("a file that a scene names is watched, too, and so is one that was chosen in the viewer") {
    if (!canView()) return;
    Desk desk(scene(day));
    desk.viewer->showPanels(false);
    rewrite(desk, "paint.csv", "nm,r\n400,0.2\n700,0.2\n");
    rewrite(desk, "scene.xml", scene(day, "paint.csv"));
    const Picture8 grey = desk.viewer->picture();
    rewrite(desk, "paint.csv", "nm,r\n400,0.1\n700,0.9\n");
    const Picture8 red = desk.viewer->picture();
    CHECK(red.pixels != grey.pixels);
    rewrite(desk, "mine.csv", "nm,r\n400,0.7\n700,0.7\n");
    desk.session->set("paint.reflectance=mine.csv");
    const Picture8 mine = desk.viewer->picture();
    CHECK(mine.pixels != red.pixels);
    rewrite(desk, "mine.csv", "nm,r\n400,0.1\n700,0.9\n");
    CHECK(desk.viewer->picture().pixels == red.pixels);
}

TEST_CASE("an error on disk is said with line and column, and the last good picture stays") {
    if (!canView()) return;
    Desk desk(scene(day));
    desk.viewer->showPanels(false);
    const Picture8 good = desk.viewer->picture();
    rewrite(desk, "scene.xml", scene("spectrum=\"illuminants/D66\" intensity=\"300 cd\""));
    CHECK(desk.session->reload());
    CHECK_THAT(desk.session->problem, Catch::Contains("scene.xml:4:3: ") && Catch::Contains("D66"));
    CHECK_FALSE(desk.session->reload());  // said once
    rewrite(desk, "scene.xml", "<scene version=\"1\">\n  <node");
    CHECK(desk.session->reload());
    CHECK_THAT(desk.session->problem, Catch::Contains("scene.xml:"));
    std::filesystem::remove(desk.folder.path() / "scene.xml");
    CHECK(desk.session->reload());
    CHECK_FALSE(desk.session->problem.empty());
    view::Codes before, after, unused;
    (void)desk.refresh(before, unused);
    desk.session->invalidate();
    (void)desk.refresh(after, unused);
    rewrite(desk, "scene.xml", scene(day));
    CHECK(desk.session->reload());
    CHECK(desk.session->problem.empty());
    CHECK(desk.viewer->picture().pixels == good.pixels);
}

TEST_CASE("the window shows the error over the picture") {
    if (!canView()) return;
    Desk desk(scene(day));
    const Picture8 plain = desk.viewer->picture();
    rewrite(desk, "scene.xml", scene("spectrum=\"illuminants/D66\" intensity=\"300 cd\""));
    const Picture8 told = desk.viewer->picture();
    CHECK(told.pixels != plain.pixels);
    rewrite(desk, "scene.xml", scene(day));
    CHECK(desk.viewer->picture().pixels == plain.pixels);
}

TEST_CASE("what was changed in the viewer stays until the file says something else of it") {
    if (!canView()) return;
    Desk desk(scene(day));
    desk.session->set("lamp.spectrum=illuminants/FL2");
    desk.session->set("lamp.times=0.5");
    desk.session->set("paint.reflectance=charts/colorchecker/blue");
    desk.session->set("observer=cie1964-10");
    desk.play("camera orbit 30 10");
    const Vec3 eye = desk.session->stand.pose.eye;
    rewrite(
        desk, "scene.xml",
        scene(
            day, "charts/colorchecker/red",
            "  <light name=\"fill\" type=\"ambient\" spectrum=\"illuminants/E\" luminance=\"1 cd/m2\"/>\n"));
    REQUIRE(desk.session->reload());
    REQUIRE(desk.session->problem.empty());
    const view::Look& look = desk.session->look(0);
    REQUIRE(look.lights.size() == 2);
    CHECK(look.lights[0].emitter.spectrum.text == "illuminants/FL2");
    CHECK(look.lights[0].times == 0.5);
    CHECK(look.reflectances.size() == 1);
    CHECK(look.eye->detector.name == "cie1964-10");
    CHECK(desk.session->stand.pose.eye.x == eye.x);

    rewrite(desk, "scene.xml", scene("spectrum=\"illuminants/A\" intensity=\"100 cd\"", "constant:0.3"));
    REQUIRE(desk.session->reload());
    CHECK(desk.session->look(0).lights[0].emitter.spectrum.text == "illuminants/A");
    CHECK(desk.session->look(0).lights[0].times == 1);
    CHECK(desk.session->look(0).reflectances.empty());
    CHECK(desk.session->stand.pose.eye.x == eye.x);
}
