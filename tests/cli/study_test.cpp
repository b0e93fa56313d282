// spectrad study: what it leaves in its folder, and what is known of the methods it measures.
#include "cli/support.h"
#include "image/picture.h"

using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;
using nlohmann::json;

namespace {

/// Six colours of the chart, 12 × 8 pixels, under FL11: a lamp of lines.
constexpr const char* chart = R"(<scene version="1">
<wavelengths from="380" to="730" step="5"/>
<camera name="c" type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="12x8"/>
<light name="lamp" type="directional" direction="0 0 -1" spectrum="illuminants/FL11" illuminance="1000 lx"/>
)";

std::string patches() {
    std::string text = chart;
    int i = 0;
    for (const char* name : {"blue", "green", "red", "yellow", "cyan", "white"}) {
        text += std::string("<material name=\"") + name + "\"><diffuse reflectance=\"charts/colorchecker/" +
                name + "\"/></material>\n<node name=\"" + name + "-patch\" translate=\"" +
                std::to_string(i % 3 - 1) + " " + (i < 3 ? "0.5" : "-0.5") +
                " 0\"><plane size=\"1 1\" material=\"" + name + "\"/></node>\n";
        ++i;
    }
    return text + "</scene>\n";
}

const json& rowOf(const json& study, const std::string& setting) {
    for (const json& row : study.at("rows"))
        if (row.at("setting") == setting) return row;
    throw std::runtime_error("no row " + setting);
}

double mean(const json& study, const std::string& setting) {
    return rowOf(study, setting).at("deltae00").at("mean");
}

}  // namespace

TEST_CASE("study: slits follow a lamp of lines, points and few wavelengths do not") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("chart.xml", patches());
    const Outcome outcome = run(folder, {"study", "chart.xml", "-o", "out", "--json", "--quiet"});
    REQUIRE(outcome.code == 0);
    const json study = outcome.json();
    // Published for this lamp at 10 nm: points err by about 4, slits with projected detectors by 0.03.
    CHECK(mean(study, "slit-5nm") < 0.001);
    CHECK(mean(study, "slit-10nm") < 0.05);
    CHECK(mean(study, "point-10nm") > 3);
    CHECK(mean(study, "point-10nm") < 6);
    CHECK(mean(study, "gauss-4") > 3);
    CHECK(mean(study, "rgb") > 2);
    // Six surfaces under one lamp have six spectra.
    CHECK(mean(study, "linear-3") > 0.5);
    CHECK(mean(study, "linear-6") < 1e-4);
    // The bands themselves: a slit's are exact, a point's are other numbers; half keeps 11 bits, fewer of the
    // smallest.
    CHECK(rowOf(study, "slit-10nm").at("band_relative_max") == 0);
    CHECK(rowOf(study, "point-10nm").at("band_relative_max") > 0.1);
    CHECK(rowOf(study, "half").at("band_relative_max") <= 1e-3);
    CHECK(rowOf(study, "half").at("band_relative_max") > 0x1p-14);
    CHECK(rowOf(study, "half").at("file_bytes") < rowOf(study, "bits-20").at("file_bytes"));
    // Compression is lossless: only files and times differ.
    CHECK(rowOf(study, "exr-none").at("deltae00") == rowOf(study, "slit-5nm").at("deltae00"));
    CHECK(rowOf(study, "exr-none").at("file_bytes") > rowOf(study, "slit-5nm").at("file_bytes"));
    // Other arithmetic than the kernels': last bits, no colours. (Whether a compiler uses its freedom is its
    // own affair.)
    for (const char* build : {"contracted", "fast-math"}) {
        CHECK(rowOf(study, build).at("band_relative_max") < 1e-4);
        CHECK(mean(study, build) == Approx(mean(study, "slit-5nm")).margin(1e-3));
    }
    for (const json& row : study.at("rows"))
        CHECK(row.at("knob") != "texture");
    for (const char* name : {"index.html", "results.csv", "results.json"})
        CHECK(cli::fs::exists(folder / "out" / name));
    CHECK(json::parse(cli::bytesOf(folder / "out" / "results.json")).at("rows").size() ==
          study.at("rows").size());
}

TEST_CASE("study: where textures are, their other filters are measured against many samples") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    // A chequer of 64 x 64 texels on 8 x 8 pixels, seen at one sample: only means can tell its grey.
    spectrad::Picture8 picture{64, 64, 3, {}};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                picture.pixels.push_back((x / 2 + y / 2) % 2 ? 230 : 20);
    spectrad::writePng(folder / "chequer.png", picture);
    folder.write("wall.xml", R"(<scene version="1"><wavelengths from="400" to="700" step="20"/>
      <material name="m"><diffuse texture="chequer.png"/></material>
      <node><plane size="2 2" material="m"/></node>
      <light type="directional" direction="0 0 -1" spectrum="illuminants/D65" illuminance="100 lx"/>
      <camera name="c" type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="8x8"/></scene>)");
    const json study =
        run(folder, {"study", "wall.xml", "-o", "out", "--json", "--quiet", "--samples", "1"}).json();
    CHECK(rowOf(study, "texture-mip").at("knob") == "texture");
    CHECK(mean(study, "texture-nearest") > 5);
    CHECK(mean(study, "texture-mip") < 0.2 * mean(study, "texture-nearest"));
    for (const json& row : study.at("rows"))
        CHECK(row.at("setting") != "texture-bilinear");  // is what the scene does
}

TEST_CASE("study goes on where it was stopped, and begins anew when the scene has changed") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("chart.xml", patches());
    const std::vector<std::string> command{"study",  "chart.xml", "-o",     "out",
                                           "--json", "--quiet",   "--size", "3x2"};
    REQUIRE(run(folder, command).code == 0);
    // A row of the first run is marked: it must come out of the second as it was, and not out of the third.
    const cli::fs::path file = folder / "out" / "results.json";
    json first = json::parse(cli::bytesOf(file));
    const size_t all = first.at("rows").size();
    first["rows"].erase(first["rows"].begin() + 1, first["rows"].end());
    first["rows"][0]["seconds"]["render"] = 123456;
    folder.write("out/results.json", first.dump());
    const json second = run(folder, command).json();
    CHECK(second.at("rows").size() == all);
    CHECK(second.at("rows")[0].at("seconds").at("render") == 123456);
    folder.write("out/results.json", first.dump());
    folder.write("chart.xml", patches() + "<!-- changed -->\n");
    const json third = run(folder, command).json();
    CHECK(third.at("rows").size() == all);
    CHECK(third.at("rows")[0].at("seconds").at("render") < 1000);
}

TEST_CASE("study: nothing is begun beyond the budget, and that is said") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    folder.write("chart.xml", patches());
    const Outcome outcome = run(folder, {"study", "chart.xml", "-o", "out", "--json", "--budget", "0.000001s",
                                         "--light", "illuminants/A", "--light", "illuminants/D65"});
    REQUIRE(outcome.code == 0);
    CHECK(outcome.json().at("rows").empty());
    CHECK(outcome.json().at("left_out").size() > 40);
    CHECK(outcome.json().at("left_out")[0] == "illuminants/A/cie1931-2/slit-5nm: beyond the budget");
    CHECK(cli::fs::exists(folder / "out" / "index.html"));
}

TEST_CASE("study refuses what it cannot do in a line") {
    const Folder folder;
    folder.write("chart.xml", patches());
    requireError(run(folder, {"study", "chart.xml", "-o", "out", "--budget", "soon"}), 2, "--budget");
    requireError(run(folder, {"study", "chart.xml"}), 2, "--output");
    if (!cli::haveDevice()) return;
    requireError(run(folder, {"study", "chart.xml", "-o", "out", "--observer", "nikon-5100"}), 1,
                 "no X, Y, Z");
    requireError(run(folder, {"study", "chart.xml", "-o", "out", "--light", "nonsense"}), 1, "nonsense");
    folder.write("file", "");
    requireError(run(folder, {"study", "chart.xml", "-o", "file"}), 3, "file");
}
