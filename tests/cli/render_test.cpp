// render, and info on scenes: what a script may rely on.
#include "base/text.h"
#include "cli/support.h"
#include "support/read_picture.h"

#include <csignal>
#include <ctime>

using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;
using nlohmann::json;

namespace {

/// A grey plane of reflectance 0.5 that fills the picture, under 2 W/(m² nm) from the eye: radiance 1/π
/// everywhere.
constexpr const char* wall = R"(<scene version="1">
  <wavelengths from="400" to="700" step="10"/>
  <spectrum name="lamp" quantity="irradiance">300:2 900:2</spectrum>
  <material name="grey"><diffuse reflectance="constant:0.5"/></material>
  <node name="wall"><plane size="4 4" material="grey"/></node>
  <light name="sun" type="directional" direction="0 0 -1" spectrum="lamp"/>
  <camera name="eye" type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="40x30"/>
</scene>
)";

/// Waits until a hidden file is in the folder: rendering has begun.
bool waitForPending(const Folder& folder) {
    for (int i = 0; i < 600; ++i) {
        for (const std::string& name : folder.names())
            if (name[0] == '.') return true;
        const timespec pause{0, 50'000'000};
        ::nanosleep(&pause, nullptr);
    }
    return false;
}

}  // namespace

TEST_CASE("render writes a cube, a preview and a JSON object with the promised keys") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("wall.xml", wall);
    const Outcome outcome = run(folder, {"render", "wall.xml", "--preview", "wall.png", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const json result = outcome.json();
    CHECK(result.at("output") == "wall.exr");
    CHECK(result.at("width") == 40);
    CHECK(result.at("height") == 30);
    CHECK(result.at("wavelengths_nm").size() == 31);
    for (const char* key : {"load", "plan", "build", "render", "write", "total"})
        CHECK(result.at("seconds").at(key) >= 0);
    CHECK(result.at("peak_rss_bytes") > 1000000);
    CHECK(result.at("device").is_string());
    CHECK(result.at("triangles") == 2);
    CHECK(result.at("terms") >= 1);
    CHECK(result.at("features").is_array());
    CHECK(spectrad::readPicture8(folder / "wall.png").width == 40);
    CHECK(folder.names() == std::vector<std::string>{"wall.exr", "wall.png", "wall.xml"});

    const json reading = run(folder, {"measure", "wall.exr", "--at", "20,15,3", "--json"}).json()[0];
    for (const json& value : reading.at("radiance"))
        REQUIRE(value.get<double>() == Approx(1 / 3.14159265358979).epsilon(1e-6));
}

TEST_CASE("the file says what it is: scene, its hash, command line, samples, device, white") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("wall.xml", wall);
    REQUIRE(run(folder, {"render", "wall.xml", "--samples", "4", "-q"}).code == 0);
    const json attributes = run(folder, {"info", "wall.exr", "--json"}).json().at("attributes");
    CHECK(attributes.at("scene") == "wall.xml");
    CHECK(attributes.at("sceneSha256").get<std::string>().size() == 64);
    CHECK(attributes.at("commandLine") == "spectrad render wall.xml --samples 4");
    CHECK(attributes.at("samples") == "4");
    CHECK(attributes.at("white") == "lamp");
    CHECK(attributes.at("camera") == "eye");
    CHECK(!attributes.at("device").get<std::string>().empty());
    CHECK(run(folder, {"observe", "wall.exr", "-o", "x.png", "--json"}).json().at("white").at("name") ==
          "lamp");
}

TEST_CASE("the same scene, device and options give the same bytes") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("wall.xml", wall);
    REQUIRE(run(folder, {"render", "wall.xml", "-o", "a.exr", "--preview", "a.png"}).code == 0);
    REQUIRE(run(folder, {"render", "wall.xml", "-o", "b.exr", "--preview", "b.png", "--json"}).code == 0);
    CHECK(cli::bytesOf(folder / "a.exr") == cli::bytesOf(folder / "b.exr"));
    CHECK(cli::bytesOf(folder / "a.png") == cli::bytesOf(folder / "b.png"));
}

TEST_CASE("options change what they name") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("wall.xml", wall);
    const json result =
        run(folder, {"render", "wall.xml", "--size", "16x9", "--wavelengths", "500,510,530", "--projection",
                     "box", "--samples", "1", "--set", "sun.scale=2", "--json"})
            .json();
    CHECK(result.at("width") == 16);
    CHECK(result.at("height") == 9);
    CHECK(result.at("samples") == 1);
    CHECK(result.at("projection") == "box");
    CHECK(result.at("wavelengths_nm") == json({500, 510, 530}));
    const json reading = run(folder, {"measure", "wall.exr", "--at", "8,4", "--json"}).json()[0];
    CHECK(reading.at("radiance")[1].get<double>() == Approx(2 / 3.14159265358979).epsilon(1e-6));
}

TEST_CASE("ENVI comes as two files, and measures the same") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("wall.xml", wall);
    REQUIRE(run(folder, {"render", "wall.xml", "-o", "x.img"}).code == 0);
    REQUIRE(run(folder, {"render", "wall.xml", "--format", "envi", "-q"}).code == 0);
    CHECK(folder.names() == std::vector<std::string>{"wall.hdr", "wall.img", "wall.xml", "x.hdr", "x.img"});
    CHECK(cli::bytesOf(folder / "wall.img") == cli::bytesOf(folder / "x.img"));
    REQUIRE(run(folder, {"render", "wall.xml"}).code == 0);
    CHECK(run(folder, {"compare", "wall.exr", "x.img", "--max-deltae", "0.001"}).code == 0);
}

TEST_CASE("a failed render leaves what was there") {
    const Folder folder;
    folder.write("wall.xml", wall);
    folder.write("wall.exr", "precious");
    std::string broken = wall;
    broken.replace(broken.find("spectrum=\"lamp\""), 15, "spectrum=\"lmp\"");
    folder.write("broken.xml", broken);
    requireError(run(folder, {"render", "broken.xml", "-o", "wall.exr"}), 1, "broken.xml:6");
    requireError(run(folder, {"render", "wall.xml", "-o", "nowhere/x.exr"}), 3, "nowhere/x.exr");
    requireError(run(folder, {"render", "wall.xml", "-o", "wall.xml"}), 2, "-o");
    requireError(run(folder, {"render", "wall.xml", "--set", "sun.colour=red"}), 1, "colour");
    requireError(run(folder, {"render", "wall.xml", "--camera", "nosuch"}), 1, "nosuch");
    CHECK(cli::bytesOf(folder / "wall.exr") == "precious");
    CHECK(cli::bytesOf(folder / "wall.xml") == wall);
    CHECK(folder.names() == std::vector<std::string>{"broken.xml", "wall.exr", "wall.xml"});
}

TEST_CASE("a device that is not there is wrong usage, and writes nothing") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("wall.xml", wall);
    requireError(run(folder, {"render", "wall.xml", "--device", "99"}), 2, "99");
    CHECK(folder.names() == std::vector<std::string>{"wall.xml"});
}

TEST_CASE("a value beyond half is an error that names it, and no file appears") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    std::string bright = wall;
    bright.replace(bright.find("300:2 900:2"), 11, "300:1e6 900:1e6");
    folder.write("bright.xml", bright);
    const Outcome outcome = run(folder, {"render", "bright.xml", "--half", "-q"});
    requireError(outcome, 1, "half");
    CHECK(folder.names() == std::vector<std::string>{"bright.xml"});
}

TEST_CASE("a signal ends a render as signals do, and leaves nothing half-written") {
    if (!cli::haveDevice()) return;
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const Folder folder;
        folder.write("wall.xml", wall);
        folder.write("wall.exr", "precious");
        bool begun = false;
        const Outcome outcome = run(folder,
                                    {"render", "wall.xml", "--size", "4000x3000", "--compression", "zip",
                                     "--wavelengths", "400:700:2"},
                                    [&](int process) {
                                        begun = waitForPending(folder);
                                        ::kill(process, signal);
                                    });
        INFO(outcome.err);
        REQUIRE(begun);
        CHECK(outcome.signal == signal);
        CHECK(cli::bytesOf(folder / "wall.exr") == "precious");
        CHECK(folder.names() == std::vector<std::string>{"wall.exr", "wall.xml"});
    }
}

TEST_CASE("info prints the plan of a scene without rendering it") {
    const Folder folder;
    folder.write("wall.xml", wall);
    const Outcome outcome = run(folder, {"info", "wall.xml", "--json", "--size", "20x10"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const json plan = outcome.json();
    for (const char* key : {"triangles", "lights", "materials", "terms", "features", "bands", "samples",
                            "strip_rows", "bytes_per_strip"})
        CHECK(plan.contains(key));
    CHECK(plan.at("triangles") == 2);
    CHECK(plan.at("lights") == 1);
    CHECK(plan.at("bands") == 31);
    CHECK(plan.at("samples") == 16);
    CHECK(plan.at("width") == 20);
    CHECK(folder.names() == std::vector<std::string>{"wall.xml"});
    CHECK_THAT(run(folder, {"info", "wall.xml"}).out, Catch::Contains("triangles  2"));
}

TEST_CASE("a scene that a stranger sends cannot read outside its folder") {
    const Folder folder, other;
    other.write("secret.csv", "400,1\n700,1\n");
    std::string curious = wall;
    curious.replace(curious.find("constant:0.5"), 12, (other / "secret.csv").string());
    folder.write("curious.xml", curious);
    requireError(run(folder, {"info", "curious.xml", "--restrict"}), 1, "secret.csv");
    CHECK(run(folder, {"info", "curious.xml", "--quiet"}).code == 0);
}
