// view: off screen and in a window, as a script uses it.
#include "cli/support.h"

#include <algorithm>
#include <cstdlib>

using cli::canDraw;
using cli::codesApart;
using cli::Folder;
using cli::requireError;
using cli::run;

namespace {

constexpr const char* balls = R"(<scene version="1">
  <wavelengths from="380" to="780" step="5"/>
  <material name="red"><diffuse reflectance="charts/colorchecker/red"/><gloss ior="1.5" roughness="0.4"/></material>
  <node name="ball"><sphere radius="1" material="red"/></node>
  <node name="wall" translate="0 0 -2"><plane size="9 9"/></node>
  <light name="lamp" type="point" position="2 4 4" spectrum="illuminants/D65" intensity="300 cd"/>
  <camera name="eye" fov="40" look-from="0 0 5" look-at="0 0 0" size="120x80"/>
</scene>
)";

}  // namespace

TEST_CASE("the viewer's picture is that of render and observe, within one code") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("balls.xml", balls);
    folder.write(
        "script.txt",
        "screenshot first.png\nset lamp.spectrum=illuminants/A\nset exposure=auto\nscreenshot warm.png\n"
        "pin 60 40\npins pins.csv\n");
    if (!canDraw(run(folder,
                     {"view", "balls.xml", "--offscreen", "last.png", "--plain", "--script", "script.txt"})))
        return;
    REQUIRE(run(folder, {"render", "balls.xml", "-o", "a.exr", "-q"}).code == 0);
    REQUIRE(run(folder, {"render", "balls.xml", "-o", "b.exr", "-q", "--set", "lamp.spectrum=illuminants/A"})
                .code == 0);
    REQUIRE(run(folder, {"observe", "a.exr", "-o", "a.png", "-q"}).code == 0);
    REQUIRE(run(folder, {"observe", "b.exr", "-o", "b.png", "-q"}).code == 0);
    CHECK(codesApart(folder / "first.png", folder / "a.png") <= 1);
    CHECK(codesApart(folder / "warm.png", folder / "b.png") <= 1);
    CHECK(codesApart(folder / "warm.png", folder / "last.png") == 0);
    CHECK(codesApart(folder / "first.png", folder / "warm.png") > 1);

    // The spot meter's spectrum is measure's, to the last digit.
    const auto bands = [](const std::string& csv) { return csv.substr(csv.find("\n380,")); };
    CHECK(bands(cli::bytesOf(folder / "pins.csv")) ==
          bands(run(folder, {"measure", "b.exr", "--at", "60,40"}).out));
}

TEST_CASE("films, detectors of scenes and whites of the image: view shows what observe makes") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("balls.xml", balls);
    folder.write("rig.xml",
                 "<scene version=\"1\"><detector name=\"left\" sensitivity=\"cameras/nikon-5100\"/></scene>");
    folder.write(
        "script.txt",
        "set observer=generic-reversal\nscreenshot film.png\n"
        "set white=illuminants/D65\nset exposure=0.5\nscreenshot brighter.png\nset exposure=0\nset white=\n"
        "set observer=rig.xml#left\nset exposure=auto\nscreenshot left.png\n"
        "set observer=cie1931-2\nset white=at:20,30\nscreenshot place.png\n"
        "set white=image\nset exposure=auto\nscreenshot grey.png\n"
        "set mode=split\nset look=B\nset observer=generic-reversal\nset divider=0\n");
    if (!canDraw(run(folder,
                     {"view", "balls.xml", "--offscreen", "last.png", "--plain", "--script", "script.txt"})))
        return;
    REQUIRE(run(folder, {"render", "balls.xml", "-o", "a.exr", "-q"}).code == 0);
    const auto observed = [&](const char* picture, const std::vector<std::string>& options) {
        cli::requireObserved(folder, "a.exr", picture, options);
    };
    observed("film.png", {"--observer", "generic-reversal"});
    observed("brighter.png",
             {"--observer", "generic-reversal", "--white", "illuminants/D65", "--exposure", "0.5"});
    observed("left.png", {"--observer", "rig.xml#left"});
    observed("place.png", {"--white", "at:20,30"});
    observed("grey.png", {"--white", "image"});
    observed("last.png", {"--observer", "generic-reversal"});
    const auto refused = [&](const char* script, const char* why) {
        folder.write("wrong.txt", script);
        requireError(
            run(folder, {"view", "balls.xml", "-q", "--offscreen", "x.png", "--script", "wrong.txt"}), 1,
            why);
    };
    refused("set white=at:500,3\n", "outside");
    refused("set observer=rig.xml#right\n", "left");
    refused("wait 1\nset nolight.spectrum=illuminants/A\n", "wrong.txt:2:1: the scene has no light");
    refused("set exposure=much\n", "wrong.txt:1:1: exposure: 'much'");
}

TEST_CASE("what view saves is what it showed: picture, scene, cube") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("balls.xml", balls);
    folder.write(
        "script.txt",
        "set lamp.spectrum=illuminants/A\nset lamp.times=0.5\ncamera orbit 20 10\nset exposure=auto\n"
        "save picture saved.png\nsave scene saved.xml\nsave cube saved.exr\n");
    if (!canDraw(run(folder, {"view", "balls.xml", "--offscreen", "last.png", "--script", "script.txt",
                              "--set", "red.gloss.roughness=0.2"})))
        return;
    REQUIRE(run(folder, {"observe", "saved.exr", "-o", "a.png", "-q"}).code == 0);
    REQUIRE(run(folder, {"render", "saved.xml", "-o", "b.exr", "-q"}).code == 0);
    REQUIRE(run(folder, {"observe", "b.exr", "-o", "b.png", "-q"}).code == 0);
    CHECK(codesApart(folder / "saved.png", folder / "a.png") <= 1);
    CHECK(codesApart(folder / "saved.png", folder / "b.png") <= 1);
    const std::string text = cli::bytesOf(folder / "saved.xml");
    CHECK(text.find("roughness=\"0.2\"") != std::string::npos);
    CHECK(text.find("spectrum=\"illuminants/A\" intensity=\"150 cd\"") != std::string::npos);
    // All but three lines are the original's.
    const std::string original = balls;
    size_t kept = 0;
    for (size_t from = 0, to; from < original.size(); from = to + 1) {
        to = original.find('\n', from);
        kept += text.find(original.substr(from, to - from + 1)) != std::string::npos;
    }
    CHECK(kept == static_cast<size_t>(std::count(original.begin(), original.end(), '\n')) - 3);
}

TEST_CASE("view says in one line what is wrong") {
    const Folder folder;
    folder.write("balls.xml", balls);
    requireError(run(folder, {"view", "balls.xml", "--offscreen", "x.jpg"}), 2, "must end in .png");
    requireError(run(folder, {"view", "balls.xml", "--offscreen", "x.png", "--frames", "-1"}), 2, "--frames");
    if (!cli::haveDevice()) return;
    requireError(run(folder, {"view", "nothing.xml", "--offscreen", "x.png"}), 1, "nothing.xml");
    folder.write("script.txt", "wait 1\nclick here\n");
    requireError(run(folder, {"view", "balls.xml", "-q", "--offscreen", "x.png", "--script", "script.txt"}),
                 1, "script.txt:2:1");
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    requireError(run(folder, {"view", "balls.xml", "-q", "--frames", "1"}), 3, "window");
}
