// info on spectra and the library.
#include "cli/support.h"

#include <algorithm>
#include <map>

using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;
using nlohmann::json;

TEST_CASE("info tells a lamp's chromaticity and colour temperature") {
    const Folder folder;
    const json a = run(folder, {"info", "illuminants/A", "--json"}).json();
    CHECK(a.at("relative") == true);
    CHECK(a.at("light").at("xy")[0].get<double>() == Approx(0.44758).margin(1e-4));
    CHECK(a.at("light").at("xy")[1].get<double>() == Approx(0.40745).margin(1e-4));
    CHECK(a.at("light").at("cct_K").get<double>() == Approx(2856).margin(1));
    const json black = run(folder, {"info", "blackbody:2856", "--json"}).json();
    CHECK(black.at("light").at("cct_K").get<double>() == Approx(2856).margin(0.5));
    CHECK(black.at("channels")[0].at("integral").is_null());
}

TEST_CASE("info tells a reflectance's colour under D65") {
    const Folder folder;
    const json grey = run(folder, {"info", "constant:0.18", "--json"}).json();
    CHECK(grey.at("under_D65").at("XYZ")[1].get<double>() == Approx(18).epsilon(1e-4));
    CHECK(grey.at("under_D65").at("Lab")[1].get<double>() == Approx(0).margin(1e-6));
    const json skin = run(folder, {"info", "charts/colorchecker/dark-skin", "--json"}).json();
    CHECK(skin.at("quantity") == "reflectance");
    CHECK(skin.at("under_D65").at("Lab")[0].get<double>() == Approx(38).margin(1));
}

TEST_CASE("info plots a curve, and counts its samples and integral") {
    const Folder folder;
    folder.write("ramp.csv", "wavelength,value\n400,0\n500,1\n600,0\n");
    const json ramp = run(folder, {"info", "ramp.csv", "--json"}).json();
    CHECK(ramp.at("channels")[0].at("samples") == 3);
    CHECK(ramp.at("channels")[0].at("from_nm") == 400);
    CHECK(ramp.at("channels")[0].at("integral").get<double>() == Approx(100));
    const Outcome text = run(folder, {"info", "ramp.csv"});
    CHECK(text.code == 0);
    CHECK_THAT(text.out, Catch::Contains("█") && Catch::Contains("400") && Catch::Contains("600 nm"));
    CHECK_THAT(run(folder, {"info", "line:632.8"}).out,
               Catch::Contains("line at 632.8 nm") && Catch::Contains("█"));
    CHECK(run(folder, {"info", "metals/Au", "--json"}).json().at("channels").size() == 2);
}

TEST_CASE("info lists the library, whole or below a prefix") {
    const Folder folder;
    const json all = run(folder, {"info", "--list", "--json"}).json();
    REQUIRE(all.size() > 50);
    const json illuminants = run(folder, {"info", "--list", "illuminants", "--json"}).json();
    CHECK(illuminants.size() < all.size());
    bool d65 = false;
    for (const json& entry : illuminants) {
        CHECK_THAT(entry.at("name").get<std::string>(), Catch::StartsWith("illuminants"));
        d65 = d65 || entry.at("name") == "illuminants/D65";
    }
    CHECK(d65);
    CHECK_THAT(run(folder, {"info", "--list", "illuminants"}).out, Catch::Contains("illuminants/FL11"));
    requireError(run(folder, {"info", "--list", "nosuch"}), 1, "nosuch");
}

TEST_CASE("films are in the library's list, and info tells what they are made of") {
    const Folder folder;
    const json films = run(folder, {"info", "--list", "films/", "--json"}).json();
    const auto listed = std::find_if(films.begin(), films.end(), [](const json& entry) {
        return entry.at("name") == "films/generic-reversal";
    });
    REQUIRE(listed != films.end());
    CHECK(listed->at("quantity") == "film");
    CHECK_THAT(run(folder, {"info", "--list", "films/"}).out, Catch::Contains("reversal film\n"));
    for (const char* name : {"films/generic-reversal", "generic-reversal"}) {
        const json film = run(folder, {"info", name, "--json"}).json();
        CHECK(film.at("projector") == "illuminants/A");
        CHECK(film.at("curves").at("green").at("dmax") == 3.5);
        CHECK_THAT(run(folder, {"info", name}).out,
                   Catch::Contains("layer G: ") && Catch::Contains("density of magenta: "));
    }
    requireError(run(folder, {"info", "nosuch.film"}), 1, "nosuch.film");
}

TEST_CASE("info on what does not exist says so") {
    const Folder folder;
    requireError(run(folder, {"info", "illuminants/D66"}), 1, "did you mean");
    requireError(run(folder, {"info", "blackbody:-5"}), 1, "blackbody");
    folder.write("bad.csv", "400,1\n500,x\n");
    requireError(run(folder, {"info", "bad.csv"}), 1, "bad.csv:2");
}

TEST_CASE("info on a scene reports its materials: fluorophores, matrices, Fresnel terms, white light") {
    const Folder folder;
    folder.write("m.csv", "emission_nm,ex400,ex420\n400,0.5,0.01\n420,0.2,0.6\n440,0.1,0.2\n");
    folder.write("s.xml", R"(<scene version="1"><wavelengths from="380" to="720" step="20"/>
<material name="paper"><fluorescence matrix="m.csv"/></material>
<material name="gold"><conductor ior="metals/Au" roughness="0.4" fresnel="schlick"/></material>
<material name="wall"><diffuse reflectance="constant:0.5"/></material>
<sphere material="paper"/><sphere material="gold"/><sphere material="wall"/>
<light type="directional" direction="0 0 -1" spectrum="illuminants/D65" illuminance="1000 lx"/>
<camera size="16x16"/></scene>)");
    const json materials = run(folder, {"info", "s.xml", "--json"}).json().at("material_reports");
    const auto of = [&](const std::string& name) {
        for (const json& material : materials)
            if (material.at("name") == name) return material;
        FAIL("no report on " << name);
        return json();
    };
    const json paper = of("paper").at("fluorescence").at(0);
    CHECK(paper.at("stokes_shift_nm") == 20);
    CHECK(paper.at("quantum_yield").get<double>() > 0.3);
    CHECK(paper.at("matrix").at("cells_zeroed") == 1);
    CHECK(of("paper").at("peak_total_radiance_factor").at(0).at("light") == "illuminants/D65");
    CHECK(of("gold").at("fresnel").at("model") == "schlick");
    CHECK(of("gold").at("fresnel").at("largest_error").get<double>() > 0.001);
    CHECK(of("gold").at("furnace").at("most").get<double>() <= 1);
    CHECK_FALSE(of("wall").contains("fresnel"));
    const std::string text = run(folder, {"info", "s.xml"}).out;
    CHECK_THAT(text, Catch::Contains("Stokes shift 20 nm") && Catch::Contains("Schlick's formula") &&
                         Catch::Contains("total radiance factor"));
    CHECK_THAT(text, !Catch::Contains("material   wall"));
}

TEST_CASE("info counts the materials that surfaces wear: the built-in grey only where a surface names none") {
    const Folder folder;
    const auto of = [&](const std::string& shapes) {
        folder.write("s.xml",
                     R"(<scene version="1"><material name="a"><diffuse reflectance="constant:1"/></material>
<material name="b"><diffuse reflectance="constant:0.5"/></material>)" +
                         shapes + R"(<background spectrum="constant:1" scale="1"/>
<light type="ambient" spectrum="constant:1" scale="1"/><camera size="16x16"/></scene>)");
        CHECK_THAT(
            run(folder, {"info", "s.xml"}).out,
            Catch::Contains(
                "materials  " +
                std::to_string(run(folder, {"info", "s.xml", "--json"}).json().at("materials").get<int>()) +
                "\n"));
        return run(folder, {"info", "s.xml", "--json"}).json();
    };
    const json named = of(R"(<sphere material="a"/><sphere material="b"/>)");
    CHECK(named.at("materials") == 2);
    CHECK(named.at("material_reports").size() == 2);
    const json unnamed = of(R"(<sphere material="a"/><sphere material="b"/><sphere/>)");
    CHECK(unnamed.at("materials") == 3);
    CHECK(unnamed.at("material_reports").size() == 3);
}

TEST_CASE("info on a scene is on the scene, with its own ENVI image beside it") {
    const Folder folder;
    folder.write("s.xml", R"(<scene version="1"><sphere/>
<light type="ambient" spectrum="constant:1" scale="1"/><camera size="16x16"/></scene>)");
    REQUIRE(run(folder, {"render", "s.xml", "-o", "s.img"}).code == 0);
    CHECK(run(folder, {"info", "s.xml", "--json"}).json().at("lights") == 1);
}

TEST_CASE("info --cost tells of each feature what it costs and what the picture is without it") {
    if (!cli::haveDevice()) return;
    const cli::Folder folder;
    folder.write("two.xml", R"(<scene version="1">
      <wavelengths from="400" to="700" step="20"/>
      <material name="car"><diffuse reflectance="constant:0.5"/><gloss ior="1.5" roughness="0.4"/></material>
      <material name="gold"><conductor ior="metals/Au" roughness="0.4"/></material>
      <node translate="-1 0 0"><sphere material="car"/></node><node translate="1 0 0"><sphere material="gold"/></node>
      <light type="point" position="2 3 5" spectrum="illuminants/D65" intensity="500 cd"/>
      <camera look-from="0 0 8" size="64x32"/></scene>)");
    const cli::Outcome outcome = cli::run(folder, {"info", "two.xml", "--cost", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const nlohmann::json report = outcome.json();
    CHECK(report.at("seconds") > 0);
    CHECK(report.at("bytes_per_strip") > 0);
    std::map<std::string, nlohmann::json> of;
    for (const nlohmann::json& feature : report.at("features"))
        of[feature.at("feature")] = feature;
    for (const char* feature : {"gloss", "conductor", "conductor fresnel", "point"})
        REQUIRE(of.contains(feature));
    CHECK(of.at("gloss").at("terms") == 1);
    CHECK(of.at("conductor").at("deltae00").at("max") > 5);
    CHECK(of.at("conductor fresnel").at("deltae00").at("max") < of.at("conductor").at("deltae00").at("max"));
    CHECK(of.at("conductor fresnel").at("terms") > 0);
    CHECK(of.at("point").at("deltae00").at("max") > 50);
    cli::requireError(cli::run(folder, {"info", "illuminants/D65", "--cost"}), 2, "--cost");
}

namespace {

// A matrix whose diagonal is the reflectance; nothing comes out below the light that excites it.
constexpr const char* donaldson =
    "emission_nm,ex400,ex420,ex440,ex460,ex480\n"
    "400,0.30,0,0,0,0\n420,0.10,0.40,0,0,0\n440,0.05,0.20,0.50,0,0\n"
    "460,0.025,0.125,0.25,0.60,0\n480,0.0625,0.03125,0.10,0.15,0.70\n";

std::string fluorescentScene(const std::string& fluorescence) {
    return "<scene version=\"1\"><wavelengths>400 410 420 430 440 450 460 470 480</wavelengths>"
           "<material name=\"ink\">" +
           fluorescence +
           "</material><node><plane size=\"4 4\" material=\"ink\"/></node>"
           "<light name=\"lamp\" type=\"directional\" direction=\"0 0 -1\" spectrum=\"400:1 425:3 455:0.5 "
           "480:2\" irradiance=\"10 W/m2\"/>"
           "<camera type=\"orthographic\" height=\"2\" look-from=\"0 0 3\" look-at=\"0 0 0\" "
           "size=\"4x4\"/></scene>";
}

json radianceOf(const Folder& folder, const std::string& scene) {
    const Outcome rendered = run(folder, {"render", scene, "-q", "-o", "seen.exr"});
    INFO(rendered.err);
    REQUIRE(rendered.code == 0);
    return run(folder, {"measure", "seen.exr", "-q", "--json", "--at", "1,1"}).json()[0].at("radiance");
}

}  // namespace

TEST_CASE("A matrix written as EXR or CSV and read back is the same fluorescence") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("donaldson.csv", donaldson);
    folder.write("first.xml", fluorescentScene("<fluorescence matrix=\"donaldson.csv\"/>"));
    const json right = radianceOf(folder, "first.xml");
    for (const std::string file : {"again.exr", "again.csv"}) {
        const Outcome written = run(folder, {"info", "first.xml", "-q", "--reradiation", "ink", "-o", file,
                                             "--wavelengths", "400:480:20", "--json"});
        INFO(written.err);
        REQUIRE(written.code == 0);
        CHECK(written.json().at("cells") == 15);
        folder.write("second.xml", fluorescentScene("<fluorescence matrix=\"" + file + "\"/>"));
        const json there = radianceOf(folder, "second.xml");
        for (size_t band = 0; band < right.size(); ++band)
            CHECK(there[band].get<double>() == Approx(right[band].get<double>()).epsilon(1e-6));
    }
}

TEST_CASE("A dye in curves, written as a fine matrix, glows as before") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write(
        "first.xml",
        fluorescentScene("<diffuse reflectance=\"constant:0.4\"/><fluorescence "
                         "excitation=\"gaussian:415,15\" emission=\"gaussian:460,20\" yield=\"0.9\"/>"));
    const json right = radianceOf(folder, "first.xml");
    REQUIRE(run(folder, {"info", "first.xml", "-q", "--reradiation", "ink", "-o", "m.exr", "--wavelengths",
                         "380:500:1"})
                .code == 0);
    folder.write("second.xml", fluorescentScene("<fluorescence matrix=\"m.exr\"/>"));
    const json there = radianceOf(folder, "second.xml");
    for (size_t band = 0; band < right.size(); ++band)
        CHECK(there[band].get<double>() == Approx(right[band].get<double>()).epsilon(2e-3));
    requireError(run(folder, {"info", "first.xml", "-q", "--reradiation", "paint", "-o", "m.exr"}), 2,
                 "fluorescent are: ink");
    requireError(run(folder, {"info", "first.xml", "-q", "--reradiation", "ink"}), 2, "belong together");
    requireError(run(folder, {"info", "first.xml", "-q", "--reradiation", "ink", "-o", "m.png"}), 2,
                 ".exr or .csv");
}
