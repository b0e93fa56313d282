// Work beside the frames: the window goes on while pictures are made, cubes are written and files are opened,
// and what comes out is what it would have been with everybody waiting.
#include "viewer/support.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>

using namespace spectrad;
using view::test::canView;
using view::test::Desk;
using view::test::replaced;
using view::test::smallScene;

namespace {

/// Another lamp in it renders a large picture again: a second of work, for a window of 96 x 64 pixels.
const std::string& heavyScene() {
    static const std::string text = R"(<scene version="1">
  <wavelengths from="380" to="780" step="5"/>
  <material name="red"><diffuse reflectance="charts/colorchecker/red"/></material>
  <material name="blue"><diffuse reflectance="charts/colorchecker/blue"/></material>
  <material name="screen"><emission texture="pass:shown"/></material>
  <node name="chart" translate="0 30 0">
    <node translate="-0.5 0 0"><plane size="1 2" material="red"/></node>
    <node translate="0.5 0 0"><plane size="1 2" material="blue"/></node>
  </node>
  <node name="room"><plane size="3 3" material="screen"/></node>
  <light name="lamp" type="ambient" spectrum="illuminants/A" luminance="8 cd/m2"/>
  <camera name="eye" fov="45" look-from="0 0.5 4.5" look-at="0 0 0" size="96x64"/>
  <camera name="flat" type="orthographic" height="2" look-from="0 30 3" look-at="0 30 0" size="1024x1024"/>
  <pass name="shown" camera="flat" of="chart" lights="lamp"/>
  <pass name="main" camera="eye" of="room" lights="lamp"/>
</scene>
)";
    return text;
}

std::vector<std::string> namesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// The picture that everybody waited for.
view::Codes waitedFor(Desk& desk, const std::string& script) {
    desk.play("jobs wait\n" + script);
    (void)desk.viewer->picture();
    return desk.session->painting().left;
}

}  // namespace

TEST_CASE("while a picture is made, frames are drawn, keys and the meter work; then it is the right one") {
    if (!canView()) return;
    Desk desk{heavyScene()};
    (void)desk.viewer->picture();
    const view::Codes before = desk.session->painting().left;
    desk.play("jobs beside\nset lamp.spectrum=illuminants/FL11\nmove 48 32");
    REQUIRE(desk.session->paints());
    int frames = 0;
    for (; desk.session->paints() && frames < 20; ++frames)
        desk.viewer->frame(0);
    CHECK(frames == 20);  // of a few milliseconds each
    CHECK(desk.session->painting().left == before);
    desk.play("key p\nkey x\nset divider=0.25");
    CHECK(desk.session->paints());
    REQUIRE(desk.session->pins.size() == 1);
    CHECK(desk.session->edited == 1);
    CHECK_FALSE(desk.viewer->settled());
    const double wanted = desk.session->pins[0].xyz[1];  // of the old lamp's picture
    desk.play("finish");
    CHECK(desk.viewer->settled());
    const view::Codes after = desk.session->painting().left;
    CHECK(after != before);
    Desk other{heavyScene()};
    (void)other.viewer->picture();
    CHECK(other.measured(48, 32).xyz[1] == wanted);
    CHECK(waitedFor(other, "set lamp.spectrum=illuminants/FL11") == after);
}

TEST_CASE("what is wished for meanwhile takes the place of what is being made") {
    if (!canView()) return;
    Desk desk{heavyScene()};
    (void)desk.viewer->picture();
    desk.play("jobs beside\nset lamp.spectrum=illuminants/FL11");
    REQUIRE(desk.session->paints());
    for (const char* lamp : {"FL2", "D65", "LED-B3"})
        desk.play("set lamp.spectrum=illuminants/" + std::string(lamp) + "\ncamera orbit 5 0\nwait 3");
    desk.play("finish");
    CHECK(desk.session->painting().wish.looks[0].version == desk.session->look(0).version);
    const view::Codes after = desk.session->painting().left;
    Desk other{heavyScene()};
    (void)other.viewer->picture();
    CHECK(waitedFor(other,
                    "set lamp.spectrum=illuminants/LED-B3\ncamera orbit 5 0\ncamera orbit 5 0\ncamera orbit "
                    "5 0") == after);
}

TEST_CASE("a camera that moves all the while is followed") {
    if (!canView()) return;
    Desk desk{smallScene()};
    (void)desk.viewer->picture();
    desk.play("jobs beside\nmove 48 60\npress");
    size_t pictures = 0;
    view::Codes last = desk.session->painting().left;
    // Kernels that were never used before are compiled meanwhile: seconds, where nothing is shown.
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (int i = 0; pictures <= 5 && std::chrono::steady_clock::now() < end; ++i) {
        desk.play("move " + std::to_string(48 + i % 20) + " 60");
        desk.session->await(0.05);
        pictures += desk.session->painting().left != last;
        last = desk.session->painting().left;
    }
    CHECK(pictures > 5);
    desk.play("release\nfinish");
    CHECK(desk.session->painting().wish.stand.samples == 16);
}

TEST_CASE("a cube is written while frames go on, and is the one that would have been waited for") {
    if (!canView()) return;
    Desk desk{replaced(smallScene(), "96x64", "480x320")};
    const auto written = desk.folder.path() / "beside.exr";
    desk.play("set lamp.spectrum=illuminants/FL11\njobs beside\nsave cube " + written.string());
    REQUIRE(desk.session->saves());
    CHECK_THAT(desk.session->busy(), Catch::Contains("beside.exr"));
    CHECK_THROWS_AS(desk.session->saveCube(desk.folder.path() / "second.exr"), UsageError);
    int frames = 0;
    for (; desk.session->saves() && frames < 3; ++frames)
        desk.viewer->frame(0);
    CHECK(frames == 3);
    // What is changed now is not in it.
    desk.play("set lamp.spectrum=illuminants/A\nfinish\njobs wait\nset lamp.spectrum=illuminants/FL11");
    CHECK_FALSE(desk.session->saves());
    desk.session->saveCube(desk.folder.path() / "waited.exr");
    Notes notes;
    CHECK(readCube(written, notes).values == readCube(desk.folder.path() / "waited.exr", notes).values);
    desk.play("jobs beside\nsave cube " + (desk.folder.path() / "no/such/folder.exr").string());
    CHECK_THROWS_AS(desk.play("finish"), Error);
}

TEST_CASE("closed or stopped while a cube is written: nothing is left of it") {
    if (!canView()) return;
    const TemporaryFolder kept;
    const std::string target = (kept.path() / "large.exr").string();
    {
        Desk desk{replaced(smallScene(), "96x64", "960x640")};
        desk.play("jobs beside\nsave cube " + target + "\nkey escape\nfinish");
        CHECK_FALSE(desk.session->saves());
        CHECK(namesIn(kept.path()).empty());
        desk.play("save cube " + target + "\nwait 2\nclose");
        CHECK(desk.session->saves());
    }
    CHECK(namesIn(kept.path()).empty());
}

TEST_CASE("closed while a picture is made and files are opened: it ends") {
    if (!canView()) return;
    Desk desk{heavyScene()};
    desk.play("jobs beside\nset lamp.spectrum=illuminants/FL11");
    const auto file = desk.folder.write("scene.xml", replaced(heavyScene(), "8 cd/m2", "9 cd/m2"));
    std::filesystem::last_write_time(file,
                                     std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
    desk.play("wait 2\nclose");
    CHECK(desk.viewer->closed());
}

TEST_CASE("files that change are opened beside the frames, and errors are told") {
    if (!canView()) return;
    Desk desk{heavyScene()};
    (void)desk.viewer->picture();
    const view::Codes before = desk.session->painting().left;
    int later = 0;
    const auto rewrite = [&](const std::string& text) {
        const auto file = desk.folder.write("scene.xml", text);
        std::filesystem::last_write_time(
            file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(++later));
    };
    desk.play("jobs beside");
    rewrite(replaced(heavyScene(), "colorchecker/red", "colorchecker/green"));
    int frames = 0;
    do
        desk.viewer->frame(0);
    while (!desk.session->settled() && desk.session->painting().left == before && ++frames < 10);
    CHECK(frames == 10);
    desk.play("finish");
    const view::Codes after = desk.session->painting().left;
    CHECK(after != before);
    rewrite("<scene version=\"1\">\n  <node");
    desk.play("finish");
    CHECK_THAT(desk.session->problem, Catch::Contains("scene.xml:"));
    CHECK(desk.session->painting().left == after);
    rewrite(heavyScene());
    desk.play("finish");
    CHECK(desk.session->problem.empty());
    CHECK(desk.session->painting().left == before);
}

TEST_CASE("a lamp that cannot shine is said, and the one before is back") {
    if (!canView()) return;
    Desk desk{smallScene()};
    (void)desk.viewer->picture();
    const view::Codes before = desk.session->painting().left;
    // 300 cd of ultraviolet light is nothing that there could be.
    CHECK_THROWS_AS(desk.session->set("lamp.spectrum=300:0 310:1 320:0"), Error);
    desk.session->waits = false;
    desk.session->set("lamp.spectrum=300:0 310:1 320:0");
    CHECK_FALSE(desk.session->begin());
    desk.session->await(60);
    CHECK_FALSE(desk.session->take().problem.empty());
    CHECK(desk.session->look(0).lights[0].emitter.spectrum.text == "illuminants/D65");
    CHECK_FALSE(desk.session->begin());
    CHECK(desk.session->settled());
    CHECK(desk.session->painting().left == before);
}
