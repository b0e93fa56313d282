// sweep: one render for many lights, materials and detectors gives what each render by itself would.
#include "cli/support.h"

#include <cmath>
#include <fstream>
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
