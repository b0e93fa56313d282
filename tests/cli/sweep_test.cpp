// sweep: one render for many lights, materials and detectors gives what each render by itself would.
#include "cli/support.h"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;
using nlohmann::json;

namespace {

constexpr const char* scene =
    "<scene version=\"1\"><wavelengths from=\"380\" to=\"780\" step=\"10\"/>"
    "<material name=\"ink\"><diffuse reflectance=\"charts/colorchecker/foliage\"/></material>"
    "<material name=\"coat\"><diffuse reflectance=\"charts/colorchecker/blue\"/><gloss ior=\"1.5\" "
    "roughness=\"0.4\"/></material>"
    "<node translate=\"-0.6 0 0\"><sphere radius=\"0.5\" material=\"ink\"/></node>"
    "<node translate=\"0.6 0 0\"><sphere radius=\"0.5\" material=\"coat\"/></node>"
    "<light name=\"key\" type=\"directional\" direction=\"0 0 -1\" spectrum=\"illuminants/D65\" "
    "illuminance=\"1000 lx\"/>"
    "<light name=\"fill\" type=\"ambient\" spectrum=\"illuminants/D65\" luminance=\"50 cd/m2\"/>"
    "<camera look-from=\"0 0 4\" look-at=\"0 0 0\" fov=\"25\" size=\"64x32\"/></scene>";

}  // namespace

TEST_CASE("A sweep measures what separate renders measure, for every light, material and detector") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("s.xml", scene);
    const Outcome swept =
        run(folder, {"sweep", "s.xml", "-o", "out", "--samples", "4", "--vary",
                     "key.spectrum=illuminants/D65|illuminants/FL11", "--vary",
                     "ink.diffuse.reflectance=charts/colorchecker/foliage|charts/colorchecker/red",
                     "--observer", "cie1931-2", "--observer", "nikon-5100", "--region", "left=18,16,1,1",
                     "--region", "right=45,16,1,1", "--json"});
    INFO(swept.err);
    REQUIRE(swept.code == 0);
    const json rows = swept.json().at("regions");
    REQUIRE(rows.size() == 2 * 2 * 2 * 2);
    for (const json& row : rows) {
        const std::string variant = row.at("variant");
        const bool fluorescent = variant.find("FL11") != std::string::npos,
                   red = variant.find("red") != std::string::npos;
        const Outcome rendered =
            run(folder,
                {"render", "s.xml", "-o", "one.exr", "-q", "--samples", "4", "--set",
                 std::string("key.spectrum=illuminants/") + (fluorescent ? "FL11" : "D65"), "--set",
                 std::string("ink.diffuse.reflectance=charts/colorchecker/") + (red ? "red" : "foliage")});
        REQUIRE(rendered.code == 0);
        const std::string observer = row.at("detector");
        const Outcome measured = run(folder, {"measure", "one.exr", "--json", "-q", "--observer", observer,
                                              "--at", row.at("region") == "left" ? "18,16" : "45,16"});
        const json reading = measured.json()[0];
        if (observer == "nikon-5100")
            for (const char* channel : {"R", "G", "B"})
                CHECK(row.at("channels").at(channel).get<double>() ==
                      Approx(reading.at("channels").at(channel).get<double>()).epsilon(2e-5));
        else
            for (size_t k = 0; k < 3; ++k)
                CHECK(row.at("XYZ")[k].get<double>() ==
                      Approx(reading.at("XYZ")[k].get<double>()).epsilon(2e-5));
    }
    // Eight pictures and two tables.
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "out"),
                        std::filesystem::directory_iterator{}) == 10);
    std::ifstream table(folder / "out/sweep.csv");
    std::string line;
    int lines = 0;
    while (std::getline(table, line))
        ++lines;
    CHECK(lines == 17);
}

TEST_CASE("Variants of a sweep that would be called the same are told apart, and none overwrites another") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("s.xml", scene);
    folder.write("p q.csv", "wavelength,value\n400,0.2\n700,0.2\n");
    folder.write("p_q.csv", "wavelength,value\n400,0.8\n700,0.8\n");
    folder.write("p_q.csv-2", "wavelength,value\n400,0.4\n700,0.4\n");
    const Outcome swept =
        run(folder, {"sweep", "s.xml", "-o", "out", "--samples", "1", "--size", "32x16", "--vary",
                     "ink.diffuse.reflectance=p q.csv|p_q.csv|p_q.csv-2|p_q.csv", "--observer", "cie1931-2",
                     "--observer", "cie1931-2", "--region", "left=9,8,1,1", "--json"});
    INFO(swept.err);
    REQUIRE(swept.code == 0);
    CHECK_THAT(swept.err, Catch::Contains("variant 'p_q.csv-3' is ink.diffuse.reflectance=p_q.csv"));
    std::map<std::string, double> luminance;
    const json rows = swept.json().at("regions");
    for (const json& row : rows)
        luminance[row.at("variant")] = row.at("XYZ")[1];
    REQUIRE(luminance.size() == 4);
    CHECK(luminance.at("p_q.csv-3") == Approx(4 * luminance.at("p_q.csv")).epsilon(1e-5));
    CHECK(luminance.at("p_q.csv-2") == Approx(2 * luminance.at("p_q.csv")).epsilon(1e-5));
    CHECK(luminance.at("p_q.csv-4") == luminance.at("p_q.csv-3"));
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "out"),
                        std::filesystem::directory_iterator{}) == 4 * 2 + 2);
}

TEST_CASE("A sweep refuses what changes more than spectra, and says what it wants") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("s.xml", scene);
    requireError(run(folder, {"sweep", "s.xml", "-q", "-o", "out", "--vary", "coat.gloss.roughness=0.2|0.8"}),
                 1, "more than spectra");
    requireError(run(folder, {"sweep", "s.xml", "-o", "out", "--vary", "key.spectrum"}), 2, "--vary");
    requireError(run(folder, {"sweep", "s.xml", "-o", "out", "--region", "r=1,2"}), 2, "--region");
    requireError(run(folder, {"sweep", "s.xml", "-q", "-o", "out", "--region", "r=60,2,10,2"}), 1,
                 "outside the image");
}

namespace {

// A red plane of 32 x 32 pixels whose right half a blue one hides, and the same red one by itself as an
// instance.
constexpr const char* batch =
    "<scene version=\"1\"><wavelengths from=\"380\" to=\"780\" step=\"10\"/>\n"
    "<material name=\"red\"><diffuse reflectance=\"charts/colorchecker/red\"/></material>\n"
    "<material name=\"blue\"><diffuse reflectance=\"charts/colorchecker/blue\"/></material>\n"
    "<node name=\"back\"><plane size=\"1 1\" material=\"red\"/></node>\n"
    "<node name=\"pair\"><node name=\"front\" translate=\"0.25 0 0.5\"><plane size=\"0.5 1\" "
    "material=\"blue\"/></node>\n"
    "<instance name=\"again\" of=\"back\" translate=\"-1.5 0 0\"/></node>\n"
    "<light name=\"key\" type=\"ambient\" spectrum=\"illuminants/D65\" luminance=\"50 cd/m2\"/>\n"
    "<camera type=\"orthographic\" height=\"2\" look-from=\"0 0 4\" look-at=\"0 0 0\" size=\"128x64\"/>\n"
    "<detector name=\"eye\" observer=\"cie1964-10\"/>\n"
    "<region name=\"back\" node=\"back\"/><region name=\"front\" node=\"front\"/>\n"
    "<region name=\"pair\" node=\"pair\"/><region name=\"again\" node=\"again\"/>\n"
    "<region name=\"pixel\" rect=\"52 32 1 1\"/>\n"
    "<sweep name=\"lamps\" detectors=\"eye generic-reversal\">\n"
    "<vary attributes=\"key.spectrum\" values=\"illuminants/D65 | illuminants/A\"/></sweep>\n"
    "</scene>\n";

std::string changed(const std::string& from, const std::string& to) {
    std::string text = batch;
    const size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE(
    "A scene's own sweep measures its regions; a node's are the pixels that it fills, not those of its "
    "instances") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("s.xml", batch);
    const Outcome swept = run(folder, {"sweep", "s.xml", "-o", "out", "-q", "--json"});
    INFO(swept.err);
    REQUIRE(swept.code == 0);
    const json rows = swept.json().at("regions");
    REQUIRE(rows.size() == 2 * 2 * 5);
    const std::map<std::string, int> pixels{
        {"back", 512}, {"front", 512}, {"pair", 512 + 1024}, {"again", 1024}, {"pixel", 1}};
    for (const json& row : rows) {
        CHECK(row.at("pixels") == pixels.at(row.at("region")));
        // One flat colour: all that is red is the same.
        if (row.at("region") == "back") {
            const Outcome rendered =
                run(folder, {"render", "s.xml", "-o", "one.exr", "-q", "--set",
                             row.at("variant") == "illuminants_A" ? "key.spectrum=illuminants/A"
                                                                  : "key.spectrum=illuminants/D65"});
            REQUIRE(rendered.code == 0);
            const bool film = row.at("detector") == "generic-reversal";
            const json reading = run(folder, {"measure", "one.exr", "--json", "-q", "--at", "52,32",
                                              "--observer", film ? "generic-reversal" : "cie1964-10"})
                                     .json()[0];
            const json& xyz = film ? reading.at("rendered").at("XYZ") : reading.at("XYZ");
            for (size_t k = 0; k < 3; ++k)
                CHECK(row.at("XYZ")[k].get<double>() == Approx(xyz[k].get<double>()).epsilon(1e-4));
        }
    }
    CHECK(std::filesystem::exists(folder / "out/illuminants_A-generic-reversal.png"));
    // The command line goes before the scene.
    const Outcome other = run(folder, {"sweep", "s.xml", "-o", "out", "-q", "--json", "--observer",
                                       "nikon-5100", "--format", "none"});
    CHECK(other.json().at("regions").size() == 2 * 5);
}

TEST_CASE("What is wrong with a scene's sweep is said with its place") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    const auto complaint = [&](const std::string& text) {
        folder.write("s.xml", text);
        const Outcome outcome = run(folder, {"sweep", "s.xml", "-o", "out", "-q"});
        CHECK(outcome.code == 1);
        return outcome.err;
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(complaint(changed("eye generic", "eyes generic")), Contains("s.xml:13:1: detector 'eyes'"));
    CHECK_THAT(
        complaint(changed("\"key.spectrum", "\"keys.spectrum")),
        Contains(
            "s.xml:14:1: keys.spectrum=illuminants/D65: no element is named 'keys' (did you mean 'key'?)"));
    CHECK_THAT(complaint(changed("\"key.spectrum", "\"spectrum")),
               Contains("s.xml:14:1: ") && Contains("is not NAME.ATTRIBUTE"));
    CHECK_THAT(complaint(changed("D65 | ", "D65 || ")), Contains("a value is empty"));
    CHECK_THAT(complaint(changed("52 32 1 1", "52 64 1 1")),
               Contains("s.xml:12:1: the region 'pixel' lies outside the image of 128 x 64 pixels"));
    CHECK_THAT(complaint(changed("52 32 1 1", "52 32 0 1")), Contains("s.xml:12:1: rect="));
    CHECK_THAT(complaint(changed("name=\"pixel\" rect", "name=\"pixel\" node=\"back\" rect")),
               Contains("s.xml:12:1: <region> needs either 'rect' (pixels) or 'node', not both"));
    CHECK_THAT(
        complaint(changed(
            "<region name=\"pair\" node=\"pair\"/>",
            "<node name=\"gone\" translate=\"0 0 9\"><sphere/></node><region name=\"g\" node=\"gone\"/>")),
        Contains("the node of region 'g' fills no pixel of this picture of 128 x 64"));
    CHECK_FALSE(std::filesystem::exists(folder / "out/sweep.csv"));
}

TEST_CASE("A sweep refuses variants whose shadows differ") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("s.xml", R"(<scene version="1" shadows="true"><wavelengths>500 600</wavelengths>
<node rotate="1 0 0 -90"><plane size="8"/></node><node name="ball" translate="0 1 0"><sphere radius="0.5"/></node>
<light name="key" type="point" position="1 4 2" spectrum="constant:1" scale="9"/>
<camera fov="60" look-from="0 1.5 3" look-at="0 0.5 0" size="16x12"/></scene>)");
    for (const char* what : {"ball.shadows=true|false", "key.shadows=true|false"}) {
        const Outcome outcome =
            run(folder, {"sweep", "s.xml", "-o", "out", "-q", "--vary", what, "--region", "all=0,0,16,12"});
        CHECK(outcome.code != 0);
        CHECK_THAT(outcome.err, Catch::Matchers::Contains("changes more than spectra"));
    }
}

TEST_CASE(
    "A sweep shows passes as a render does: a print under every lamp; a picture that changes is refused") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    const auto text = [](const std::string& worn, const std::string& as) {
        return "<scene version=\"1\"><wavelengths from=\"400\" to=\"700\" step=\"20\"/>"
               "<material name=\"ink\"><diffuse reflectance=\"charts/colorchecker/foliage\"/></material>"
               "<material name=\"print\">" +
               worn +
               "</material><node name=\"chart\"><plane size=\"2 2\" material=\"ink\"/></node>"
               "<node name=\"print\"><plane size=\"2 2\" material=\"print\"/></node>"
               "<light name=\"key\" type=\"directional\" direction=\"0 0 -1\" "
               "spectrum=\"illuminants/D65\" illuminance=\"1000 lx\"/>"
               "<camera type=\"orthographic\" height=\"2\" look-from=\"0 0 5\" size=\"16x16\"/>"
               "<pass name=\"chart\" of=\"chart\" lights=\"key\" as=\"" +
               as + "\"/><pass name=\"main\" of=\"print\" lights=\"key\"/></scene>";
    };
    const std::vector<std::string> sweep{
        "sweep",    "s.xml",      "-o",   "out",    "-q",
        "--json",   "--format",   "none", "--vary", "key.spectrum=illuminants/D65|illuminants/A",
        "--region", "all=4,4,8,8"};
    folder.write("s.xml", text("<diffuse texture=\"pass:chart\"/>", "reflectance"));
    const Outcome swept = run(folder, sweep);
    INFO(swept.err);
    REQUIRE(swept.code == 0);
    const json said = swept.json();
    for (const json& row : said.at("regions")) {
        const std::string lamp = row.at("variant");
        REQUIRE(run(folder, {"render", "s.xml", "-q", "-o", "one.exr", "--set",
                             "key.spectrum=illuminants/" + lamp.substr(lamp.rfind('_') + 1)})
                    .code == 0);
        const double y =
            run(folder, {"measure", "one.exr", "--at", "8,8", "--json", "-q"}).json()[0].at("XYZ")[1];
        CHECK(y > 10);
        CHECK(row.at("XYZ")[1].get<double>() == Approx(y).epsilon(1e-5));
    }
    folder.write("s.xml", text("<emission texture=\"pass:chart\"/>", "radiance"));
    const Outcome picture = run(folder, sweep);
    CHECK(picture.code == 1);
    CHECK(picture.err.find("changes more than spectra") != std::string::npos);
}
