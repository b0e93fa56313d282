// render --verify and certify: what a script may rely on.
#include "base/error.h"
#include "cli/support.h"

using cli::Folder;
using cli::requireError;
using cli::run;
using nlohmann::json;

namespace {

constexpr const char* ball = R"(<scene version="1">
  <wavelengths from="380" to="780" step="10"/>
  <material name="ink"><diffuse reflectance="ink.csv"/></material>
  <node><sphere radius="1" material="ink"/></node>
  <light name="lamp" type="directional" direction="0 -1 -1" spectrum="illuminants/FL11" illuminance="500 lx"/>
  <camera name="eye" look-from="0 0 4" look-at="0 0 0" size="48x40"/>
</scene>
)";
constexpr const char* ink = "wavelength_nm,reflectance\n380,0.2\n780,0.7\n";

void checkCertificate(const json& c) {
    CHECK(c.at("pixels") == 1000);
    CHECK(c.at("of") == 48 * 40);
    CHECK(c.at("seed") == 1);
    CHECK(c.at("confidence") == 0.99);
    CHECK(c.at("observer") == "cie1931-2");
    CHECK(c.at("white").at("name") == "illuminants/FL11");
    const json& d = c.at("deltae00");
    for (const char* key : {"mean", "p95", "p99"}) {
        CHECK(d.at(key).at("value") >= d.at(key).at("low"));
        CHECK(d.at(key).at("value") <= d.at(key).at("high"));
    }
    CHECK(d.at("max").at("found") >= d.at("p99").at("value"));
    CHECK(c.at("band_relative").at("p99").at("value").is_number());
    CHECK(c.at("area").at("pixels") == 1000);
    CHECK(c.at("area").at("samples") == 1024);
    CHECK(c.at("area").at("deltae00").at("p99").at("value").is_number());
    CHECK(c.at("area").at("band_relative").at("p99").at("value").is_number());
}

}  // namespace

TEST_CASE("--verify writes what it found into the file and prints it; the pixels stay the same") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("ball.xml", ball);
    folder.write("ink.csv", ink);
    const auto plain = run(folder, {"render", "ball.xml", "-o", "plain.exr", "-q"});
    REQUIRE(plain.code == 0);
    const auto outcome = run(folder, {"render", "ball.xml", "--verify", "-o", "sure.exr", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    checkCertificate(outcome.json().at("certificate"));
    spectrad::Notes notes;
    const auto a = spectrad::readCube(folder / "plain.exr", notes),
               b = spectrad::readCube(folder / "sure.exr", notes);
    CHECK(a.values == b.values);
    for (const char* key :
         {"verifyPixels", "verifyConfidence", "verifyObserver", "verifyWhite", "verifyDeltaE00Mean",
          "verifyDeltaE00P95", "verifyDeltaE00P99", "verifyDeltaE00Max", "verifyBandError", "verifyArea"}) {
        CHECK(b.info.attributes.contains(key));
        CHECK_FALSE(a.info.attributes.contains(key));
    }
    CHECK(run(folder, {"render", "ball.xml", "--verify=100%", "-o", "all.exr", "--json"})
              .json()
              .at("certificate")
              .at("pixels") == 48 * 40);
    requireError(run(folder, {"render", "ball.xml", "--verify=0%"}), 2, "--verify");
}

TEST_CASE("certify finds later what --verify found, also with the options that the image was rendered with") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("ball.xml", ball);
    folder.write("ink.csv", ink);
    const auto rendered = run(folder, {"render", "ball.xml", "--verify", "-o", "a.exr", "--set",
                                       "lamp.illuminance=900 lx", "--projection", "point", "--json"});
    REQUIRE(rendered.code == 0);
    const auto later = run(folder, {"certify", "a.exr", "ball.xml", "--json"});
    INFO(later.err);
    REQUIRE(later.code == 0);
    const json found = later.json();
    checkCertificate(found);
    CHECK(found.at("changed").empty());
    CHECK(found.at("deltae00") == rendered.json().at("certificate").at("deltae00"));
    CHECK(run(folder, {"certify", "a.exr", "ball.xml", "--tolerance", "50"}).code == 0);
    const auto beyond = run(folder, {"certify", "a.exr", "ball.xml", "--tolerance", "0.01", "--json"});
    CHECK(beyond.code == 1);
    CHECK(beyond.json().at("tolerance").at("verdict") == "refuted");
}

TEST_CASE("certify notices a scene or a spectrum that has changed since, and names it") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("ball.xml", ball);
    folder.write("ink.csv", ink);
    REQUIRE(run(folder, {"render", "ball.xml", "-o", "a.exr", "-q"}).code == 0);
    folder.write("ink.csv", std::string(ink) + "800,0.7\n");
    const auto spectrum = run(folder, {"certify", "a.exr", "ball.xml", "--json"});
    CHECK(spectrum.code == 1);
    REQUIRE(spectrum.json().at("changed").size() == 1);
    CHECK(spectrum.err.find("'ink.csv' has changed") != std::string::npos);
    folder.write("ink.csv", ink);
    folder.write("ball.xml", std::string(ball) + "<!-- -->\n");
    const auto scene = run(folder, {"certify", "a.exr", "ball.xml"});
    CHECK(scene.code == 1);
    CHECK(scene.err.find("'ball.xml' has changed") != std::string::npos);
    requireError(run(folder, {"certify", "missing.exr", "ball.xml"}), 1, "missing.exr");
    requireError(run(folder, {"certify", "a.exr", "ball.xml", "--tolerance", "red"}), 2, "--tolerance");
}

TEST_CASE("--tolerance chooses settings, says why, and certifies them; what nothing keeps ends with 1") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("ball.xml", ball);
    folder.write("ink.csv", ink);
    const auto outcome = run(folder, {"render", "ball.xml", "--tolerance", "0.5", "-o", "a.exr", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const json out = outcome.json();
    CHECK(out.at("wavelengths_nm").size() < 41);
    checkCertificate(out.at("certificate"));
    const json& t = out.at("tolerance");
    CHECK(t.at("asked") == "0.5");
    CHECK(t.at("met") == true);
    CHECK(t.at("reached") <= 0.5);
    CHECK(t.at("verdict") != "refuted");
    CHECK(t.at("white").at("name") == "illuminants/FL11");
    CHECK(t.at("choices").size() >= 3);
    for (const json& choice : t.at("choices"))
        CHECK_FALSE(choice.at("why").get<std::string>().empty());
    spectrad::Notes notes;
    const auto info = spectrad::readCubeInfo(folder / "a.exr", notes);
    CHECK(info.attributes.contains("tolerance"));
    CHECK(info.attributes.contains("toleranceChoices"));
    CHECK(run(folder, {"certify", "a.exr", "ball.xml", "--share", "100%", "--tolerance", "0.5"}).code == 0);

    const auto asked = run(folder, {"render", "ball.xml", "--tolerance", "1%rad", "--wavelengths",
                                    "400:700:20", "-o", "b.exr", "--json"});
    REQUIRE(asked.code == 0);
    CHECK(asked.json().at("wavelengths_nm").size() == 16);
    const auto never = run(folder, {"render", "ball.xml", "--tolerance", "1e-9", "-o", "c.exr", "-q"});
    CHECK(never.code == 1);
    CHECK(never.err.find("no settings keep") != std::string::npos);
    requireError(run(folder, {"render", "ball.xml", "--tolerance", "low"}), 2, "--tolerance");
}

TEST_CASE(
    "A picture of a pass that glows is certified too: the pass stays on the device, the reference does not") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("s.xml", R"(<scene version="1"><wavelengths from="400" to="700" step="20"/>
<material name="ink"><diffuse reflectance="400:0.2 700:0.7"/></material>
<material name="picture"><emission texture="pass:inner"/></material>
<node name="ball"><sphere radius="0.9" material="ink"/></node>
<node name="wall" translate="0 0 -1"><plane size="3 3" material="picture"/></node>
<light name="lamp" type="directional" direction="0 -1 -1" spectrum="400:1 700:2" irradiance="5 W/m2"/>
<camera look-from="0 0 6" look-at="0 0 0" fov="38" size="48x40"/>
<pass name="inner" of="ball" lights="lamp"/><pass name="main" of="wall"/></scene>)");
    const cli::Outcome outcome =
        run(folder, {"render", "s.xml", "-o", "s.exr", "--samples", "64", "--verify", "--json", "-q"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    // The same samples. The curves bend at 400 and 700 nm, where they end: a pass of 20 nm bands rounds the
    // bend, and its own picture rounds it again; the reference's pass has bands of a nanometre.
    CHECK(outcome.json().at("certificate").at("band_relative").at("p99").at("value").get<double>() < 2e-2);
    CHECK(run(folder, {"certify", "s.exr", "s.xml", "-q"}).code == 0);
}

TEST_CASE("a lamp without any blue is not what colours are judged by: the next one is, or E") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    const std::string
        laser = R"(<light type="point" position="-2 1 3" spectrum="line:660" intensity="5 cd"/>)",
        rest =
            R"(<scene version="1"><material name="m"><diffuse reflectance="charts/colorchecker/cyan"/></material>
<sphere radius="0.9" material="m"/><camera look-from="0 0 6" look-at="0 0 0" fov="38" size="48x40"/>)",
        sun = R"(<light type="point" position="2 1 3" spectrum="illuminants/D65" intensity="50 cd"/>)";
    folder.write("two.xml", rest + laser + sun + "</scene>");
    folder.write("one.xml", rest + laser + "</scene>");
    // Bands that miss nearly all that daylight shows.
    REQUIRE(run(folder, {"render", "two.xml", "--wavelengths", "640,660,680", "-o", "red.exr", "-q"}).code ==
            0);
    const json red = run(folder, {"certify", "red.exr", "two.xml", "--json"}).json();
    CHECK(red.at("white").at("name") == "illuminants/D65");
    CHECK(red.at("deltae00").at("p99").at("value") > 5);
    const auto chosen = run(folder, {"render", "two.xml", "--tolerance", "1", "-o", "a.exr", "--json"});
    INFO(chosen.err);
    REQUIRE(chosen.code == 0);
    REQUIRE(run(folder, {"render", "two.xml", "--wavelengths", "360:830:1", "--samples", "64", "-o",
                         "fine.exr", "-q"})
                .code == 0);
    CHECK(run(folder,
              {"compare", "fine.exr", "a.exr", "--colours", "--white", "illuminants/D65", "--tolerance", "1"})
              .code == 0);

    REQUIRE(run(folder, {"render", "one.xml", "-o", "one.exr", "-q"}).code == 0);
    CHECK(run(folder, {"certify", "one.exr", "one.xml", "--json"}).json().at("white").at("name") == "E");
    const auto same = run(folder, {"compare", "one.exr", "one.exr", "--json"});
    CHECK(same.code == 0);
    CHECK(same.json().at("band_rmse") == 0);
    CHECK(same.json().at("deltae00").at("p99").is_null());
    CHECK(same.err.find("has no Z") != std::string::npos);
}

TEST_CASE("samples with which a pass cannot be rendered are passed over, not an error") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("s.xml", R"(<scene version="1"><wavelengths from="400" to="700" step="50"/>
<material name="a"><diffuse reflectance="400:0.2 700:0.7"/></material><material name="picture"><diffuse texture="pass:p"/></material>
<node name="src"><sphere radius="0.5" material="a"/><light type="directional" direction="0 -0.5 -1" spectrum="constant:1" scale="1"/>
<node translate="0 0 -1"><plane size="8" material="a"/></node><camera name="pc" fov="40" look-from="0.4 0.3 3" look-at="0.4 0 0" size="48x48"/></node>
<node name="wall" translate="0 50 0"><plane size="2" material="picture"/><light type="directional" direction="-1 -0.3 -1" spectrum="illuminants/D65" illuminance="100 lx"/><camera name="gc" fov="40" look-from="0.5 0.5 3" look-at="0 0 0" size="48x40"/></node>
<pass name="p" camera="pc" of="src" as="reflectance"/><pass name="main" camera="gc" of="wall"/></scene>)");
    REQUIRE(run(folder, {"render", "s.xml", "--samples", "1", "-o", "a.exr", "-q"}).code == 1);
    for (const char* tolerance : {"90", "90%rad"}) {
        const auto outcome =
            run(folder, {"render", "s.xml", "--tolerance", tolerance, "-o", "a.exr", "--json"});
        INFO(outcome.err);
        CHECK(outcome.code == 0);
        CHECK(outcome.json().at("samples") > 1);
    }
}
