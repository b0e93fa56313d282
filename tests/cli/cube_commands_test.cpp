// measure, observe, compare and info on cubes whose every value is known.
#include "cli/support.h"
#include "support/read_picture.h"

#include <cmath>
#include <fstream>
#include <sstream>

using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;
using nlohmann::json;

namespace {

constexpr double luminousEfficacy = 683.002;  // lm/W
constexpr double integralOfY = 106.856895;    // nm, of the CIE 1931 colour matching function at 1 nm

/// Equal energy of 0.25 W/(m² sr nm) on the left half, of half that on the right one.
double halves(int x, int, double) {
    return x < 4 ? 0.25 : 0.125;
}

void writeHalves(const Folder& folder, const std::string& name = "halves.exr") {
    cli::writeCube(folder / name, 8, 6, "360:830:5", halves);
}

}  // namespace

TEST_CASE("measure prints the radiance of a pixel and its colorimetry") {
    const Folder folder;
    writeHalves(folder);
    const Outcome outcome = run(folder, {"measure", "halves.exr", "--at", "1,2", "--at", "6,5", "--json"});
    REQUIRE(outcome.code == 0);
    CHECK(outcome.err.empty());
    const json readings = outcome.json();
    REQUIRE(readings.size() == 2);
    const json& first = readings[0];
    CHECK(first.at("x") == 1);
    CHECK(first.at("y") == 2);
    CHECK(first.at("radius") == 0);
    REQUIRE(first.at("wavelengths_nm").size() == 95);
    CHECK(first.at("wavelengths_nm")[0] == 360);
    for (const json& value : first.at("radiance"))
        REQUIRE(value == 0.25);
    for (const json& value : readings[1].at("radiance"))
        REQUIRE(value == 0.125);
    const double y = 0.25 * luminousEfficacy * integralOfY;
    CHECK(first.at("XYZ")[1].get<double>() == Approx(y).epsilon(2e-4));
    CHECK(first.at("luminance_cd_m2") == first.at("XYZ")[1]);
    CHECK(first.at("xy")[0].get<double>() == Approx(1.0 / 3).margin(2e-4));
    CHECK(first.at("uv_prime")[0].get<double>() == Approx(4.0 / 19).margin(2e-4));
    CHECK(first.at("cct_K").get<double>() == Approx(5455).margin(5));
    CHECK(first.at("duv").get<double>() == Approx(-0.0044).margin(2e-4));
    CHECK_FALSE(first.contains("Lab"));
}

TEST_CASE("measure takes the cube and the places in any order") {
    const Folder folder;
    writeHalves(folder);
    const std::string expected =
        run(folder, {"measure", "halves.exr", "--at", "1,2", "--at", "5,2", "--json"}).out;
    CHECK(!expected.empty());
    CHECK(run(folder, {"measure", "halves.exr", "--at", "1,2", "5,2", "--json"}).out == expected);
    CHECK(run(folder, {"measure", "--json", "--at", "1,2", "5,2", "halves.exr"}).out == expected);
    CHECK(run(folder, {"measure", "--at=1,2", "--at=5,2", "halves.exr", "--json"}).out == expected);
}

TEST_CASE("the radius averages the pixels whose centres lie within it") {
    const Folder folder;
    cli::writeCube(folder / "c.exr", 9, 9, "500,510", [](int x, int y, double) {
        return x == 4 && y == 4 ? 1 : x == 5 && y == 4 ? 3 : 0;
    });
    const auto radiance = [&](const std::string& at) {
        const json reading = run(folder, {"measure", "c.exr", "--at", at, "--json"}).json()[0];
        return std::pair(reading.at("radiance")[0].get<double>(), reading.at("pixels").get<int>());
    };
    CHECK(radiance("4,4") == std::pair(1.0, 1));
    CHECK(radiance("4,4,0.99") == std::pair(1.0, 1));
    CHECK(radiance("4,4,1") == std::pair(4.0 / 5, 5));
    CHECK(radiance("4,4,1.5") == std::pair(4.0 / 9, 9));
    CHECK(radiance("0,0,1") == std::pair(0.0, 3));  // what lies outside the image does not count
    CHECK(radiance("4,4,1e9") == std::pair(4.0 / 81, 81));
}

TEST_CASE("without --json measure prints CSV that reads as a spectrum") {
    const Folder folder;
    writeHalves(folder);
    const Outcome outcome = run(folder, {"measure", "halves.exr", "--at", "1,2"});
    REQUIRE(outcome.code == 0);
    std::istringstream lines(outcome.out);
    std::string line;
    while (std::getline(lines, line) && line[0] == '#') {
    }
    CHECK(line == "wavelength_nm,radiance_W_m2_sr_nm");
    CHECK_THAT(outcome.out,
               Catch::Contains("luminance") && Catch::Contains("cd/m2") && Catch::Contains("CCT"));
    size_t rows = 0;
    while (std::getline(lines, line)) {
        ++rows;
        CHECK_THAT(line, Catch::EndsWith(",0.25"));
    }
    CHECK(rows == 95);
    folder.write("lamp.csv", outcome.out);
    const Outcome info = run(folder, {"info", "lamp.csv", "--json"});
    REQUIRE(info.code == 0);
    CHECK(info.json().at("channels")[0].at("samples") == 95);
    CHECK(info.json().at("channels")[0].at("integral").get<double>() == Approx(0.25 * 470));
    CHECK_THAT(run(folder, {"measure", "halves.exr", "--at", "1,2", "6,2"}).out,
               Catch::Contains("\n360,0.25,0.125\n"));
}

TEST_CASE("the colour of black is undefined, not wrong") {
    const Folder folder;
    cli::writeCube(folder / "black.exr", 2, 2, "400:700:10", [](int, int, double) { return 0; });
    const json reading = run(folder, {"measure", "black.exr", "--at", "0,0", "--json"}).json()[0];
    CHECK(reading.at("XYZ")[1] == 0);
    for (const char* key : {"xy", "uv_prime", "cct_K", "duv"})
        CHECK(reading.at(key).is_null());
    requireError(run(folder, {"measure", "black.exr", "--at", "0,0", "--white", "illuminants/D65"}), 1,
                 "black");
}

TEST_CASE("CIELAB is relative to the white that is given") {
    const Folder folder;
    writeHalves(folder);
    const auto lab = [&](const std::string& white) {
        return run(folder, {"measure", "halves.exr", "--at", "6,2", "--white", white, "--json"})
            .json()[0]
            .at("Lab");
    };
    const double half = 116 * std::cbrt(0.5) - 16;
    for (const char* white : {"at:1,1", "constant:1"}) {
        INFO(white);
        CHECK(lab(white)[0].get<double>() == Approx(half).margin(1e-2));
        CHECK(lab(white)[1].get<double>() == Approx(0).margin(0.05));
        CHECK(lab(white)[2].get<double>() == Approx(0).margin(0.05));
    }
    const double y = 0.125 * luminousEfficacy * integralOfY;
    CHECK(lab(std::to_string(y) + "," + std::to_string(y) + "," + std::to_string(y))[0].get<double>() ==
          Approx(100).margin(1e-2));
    requireError(run(folder, {"measure", "halves.exr", "--at", "1,1", "--white", "at:8,0"}), 1, "outside");
    requireError(run(folder, {"measure", "halves.exr", "--at", "1,1", "--white", "at:x"}), 2, "--white");
    requireError(run(folder, {"measure", "halves.exr", "--at", "1,1", "--white", "nosuch"}), 1, "nosuch");
}

TEST_CASE("a camera adds its channels to the colorimetry of CIE 1931") {
    const Folder folder;
    writeHalves(folder);
    const json camera =
        run(folder, {"measure", "halves.exr", "--at", "1,1", "--observer", "nikon-5100", "--json"}).json()[0];
    const json eye = run(folder, {"measure", "halves.exr", "--at", "1,1", "--json"}).json()[0];
    CHECK(camera.at("channels").size() == 3);
    CHECK(camera.at("XYZ") == eye.at("XYZ"));
    CHECK_FALSE(eye.contains("channels"));
}

TEST_CASE("places that are not in the image, or no places, are errors") {
    const Folder folder;
    writeHalves(folder);
    requireError(run(folder, {"measure", "halves.exr", "--at", "8,0"}), 1, "outside the image");
    requireError(run(folder, {"measure", "halves.exr", "--at", "0,6,2"}), 1, "outside the image");
    for (const char* place : {"1", "1,2,3,4", "-1,2", "1.5,2", "1,2,-1", "1,2,x", "nan,1"}) {
        INFO(place);
        requireError(run(folder, {"measure", "halves.exr", "--at", place}), 2, "--at");
    }
    requireError(run(folder, {"measure", "halves.exr", "--at", "1,1", "--observer", "cie1931"}), 1,
                 "cie1931");
}

TEST_CASE("a reflectance is seen under a light, the perfect diffuser at Y = 100") {
    const Folder folder;
    cli::writeCube(
        folder / "r.exr", 2, 1, "360:830:5", [](int x, int, double) { return x == 0 ? 1 : 0.5; },
        spectrad::CubeKind::reflectance);
    const json white =
        run(folder, {"measure", "r.exr", "--at", "0,0", "--white", "illuminants/A", "--json"}).json()[0];
    CHECK(white.at("quantity") == "reflectance");
    CHECK(white.at("XYZ")[1].get<double>() == Approx(100).epsilon(1e-4));
    CHECK(white.at("xy")[0].get<double>() == Approx(0.44758).margin(2e-4));
    CHECK(white.at("Lab")[0].get<double>() == Approx(100).margin(1e-2));
    CHECK(white.at("luminance_cd_m2").is_null());
    const json grey = run(folder, {"measure", "r.exr", "--at", "1,0", "--json"}).json()[0];
    CHECK(grey.at("XYZ")[1].get<double>() == Approx(50).epsilon(1e-4));
    CHECK(grey.at("xy")[0].get<double>() == Approx(0.31272).margin(2e-4));
    const Outcome csv = run(folder, {"measure", "r.exr", "--at", "1,0"});
    CHECK_THAT(csv.out, Catch::Contains("wavelength_nm,reflectance\n"));
}

TEST_CASE("observe shows the white as display white, and halves of it as their code") {
    const Folder folder;
    writeHalves(folder);
    const Outcome outcome =
        run(folder, {"observe", "halves.exr", "-o", "x.png", "--white", "at:1,1", "--json"});
    REQUIRE(outcome.code == 0);
    CHECK(outcome.json().at("output") == "x.png");
    const spectrad::Picture8 picture = spectrad::readPicture8(folder / "x.png");
    REQUIRE(picture.width == 8);
    REQUIRE(picture.height == 6);
    for (size_t channel = 0; channel < 3; ++channel) {
        CHECK(picture.pixels[channel] == 255);
        CHECK(int(picture.pixels[6 * 3 + channel]) == 188);  // sRGB of 0.5
    }
    REQUIRE(
        run(folder, {"observe", "halves.exr", "-o", "y.png", "--white", "at:1,1", "--exposure", "-1"}).code ==
        0);
    CHECK(int(spectrad::readPicture8(folder / "y.png").pixels[0]) == 188);
    CHECK(folder.names() == std::vector<std::string>{"halves.exr", "x.png", "y.png"});
}

TEST_CASE("without a white of its own a cube is seen under the light that it states") {
    const Folder folder;
    // Illuminant A's chromaticity, stated for a lamp that the library does not have.
    cli::writeCube(folder / "a.exr", 2, 2, "360:830:5", [](int, int, double nm) { return nm / 1000; },
                   spectrad::CubeKind::radiance, {{"white", "lamp"}, {"whiteXYZ", "1.0985,1,0.35585"}});
    const json stated = run(folder, {"observe", "a.exr", "-o", "x.png", "--json"}).json().at("white");
    CHECK(stated.at("name") == "lamp");
    CHECK(stated.at("XYZ")[2] == 0.35585);
    const Outcome other =
        run(folder, {"observe", "a.exr", "-o", "x.png", "--observer", "cie1964-10", "--json"});
    CHECK(other.code == 0);
    CHECK_THAT(other.err, Catch::Contains("warning") && Catch::Contains("lamp"));
    writeHalves(folder);
    CHECK(run(folder, {"observe", "halves.exr", "-o", "x.png", "--json"}).json().at("white").at("name") ==
          "E");
    CHECK(run(folder, {"observe", "halves.exr", "-o", "x.png", "--quiet", "--white", "illuminants/D65"})
              .err.empty());
}

TEST_CASE("observe writes a detector's own channels as EXR") {
    const Folder folder;
    writeHalves(folder);
    const json out =
        run(folder, {"observe", "halves.exr", "-o", "lms.exr", "--observer", "stockman-sharpe-2", "--json"})
            .json();
    CHECK(out.at("channels") == json({"L", "M", "S"}));
    CHECK(cli::fs::file_size(folder / "lms.exr") > 0);
}

TEST_CASE("observe says which options shape a picture only, where it writes channels") {
    const Folder folder;
    writeHalves(folder);
    const Outcome plain = run(folder, {"observe", "halves.exr", "-o", "xyz.exr", "--white", "illuminants/A"});
    CHECK(plain.err.find("picture only") == std::string::npos);
    const std::string before = cli::bytesOf(folder / "xyz.exr");
    const Outcome shaped = run(folder, {"observe", "halves.exr", "-o", "xyz.exr", "--white", "illuminants/A",
                                        "--exposure", "1", "--tone", "reinhard"});
    CHECK(shaped.code == 0);
    CHECK(shaped.err.find("--exposure, --tone shape a picture only") != std::string::npos);
    CHECK(cli::bytesOf(folder / "xyz.exr") == before);
    const Outcome film = run(folder, {"observe", "halves.exr", "-o", "film.exr", "--observer",
                                      "generic-reversal", "--exposure", "1"});
    CHECK(film.code == 0);
    CHECK(film.err.find("picture only") == std::string::npos);
}

TEST_CASE("observe refuses what it cannot do, and leaves files as they were") {
    const Folder folder;
    writeHalves(folder);
    const std::string before = cli::bytesOf(folder / "halves.exr");
    requireError(run(folder, {"observe", "halves.exr", "-o", "x.jpg"}), 2, "-o");
    requireError(run(folder, {"observe", "halves.exr", "-o", "halves.exr"}), 2, "-o");
    requireError(run(folder, {"observe", "halves.exr", "-o", "x.png", "--adapt", "cat02"}), 2, "cat02");
    requireError(run(folder, {"observe", "halves.exr", "-o", "x.png", "--exposure", "much"}), 2,
                 "--exposure");
    requireError(run(folder, {"observe", "halves.exr", "-o", "x.png", "--observer", "nosuch"}), 1, "nosuch");
    requireError(run(folder, {"observe", "halves.exr", "-o", "nowhere/x.png"}), 3, "nowhere/x.png");
    folder.write("text.exr", "not an image");
    requireError(run(folder, {"observe", "text.exr", "-o", "x.png"}), 1, "text.exr");
    CHECK(cli::bytesOf(folder / "halves.exr") == before);
    CHECK(folder.names() == std::vector<std::string>{"halves.exr", "text.exr"});
}

TEST_CASE("compare finds a cube equal to itself") {
    const Folder folder;
    writeHalves(folder);
    const Outcome outcome =
        run(folder, {"compare", "halves.exr", "halves.exr", "--max-deltae", "0", "--json"});
    CHECK(outcome.code == 0);
    const json result = outcome.json();
    CHECK(result.at("band_rmse") == 0);
    CHECK(result.at("band_relative_max") == 0);
    CHECK(result.at("gfc_min").get<double>() == Approx(1));
    CHECK(result.at("spectral_angle_max_rad").get<double>() == Approx(0).margin(1e-7));
    CHECK(result.at("deltae00").at("max") == 0);
}

TEST_CASE("compare measures a difference that is known, and ends with 1 beyond the bound") {
    const Folder folder;
    writeHalves(folder, "a.exr");
    cli::writeCube(folder / "b.exr", 8, 6, "360:830:5",
                   [](int x, int y, double nm) { return x == 7 && y == 3 ? 0.0625 : halves(x, y, nm); });
    const Outcome outcome = run(folder, {"compare", "a.exr", "b.exr", "--json", "--map", "map.png"});
    REQUIRE(outcome.code == 0);
    const json result = outcome.json();
    CHECK(result.at("band_relative_max").get<double>() == Approx(0.25));
    CHECK(result.at("band_rmse").get<double>() == Approx(0.0625 / std::sqrt(48.0)));
    const json& errors = result.at("band_relative");  // one pixel of 48
    CHECK(errors.at("mean").get<double>() == Approx(0.25 / 48));
    CHECK(errors.at("p95") == 0);
    CHECK(errors.at("p99").get<double>() == Approx(0.25 * 0.53));  // 0.99 × 47 = 46.53 of places 0 to 47
    CHECK(errors.at("max") == result.at("band_relative_max"));
    CHECK(result.at("spectral_angle_max_rad").get<double>() == Approx(0).margin(1e-7));
    CHECK(result.at("deltae00").at("max_at") == json({7, 3}));
    const double worst = result.at("deltae00").at("max");
    CHECK(worst > 5);
    CHECK(result.at("deltae00").at("mean").get<double>() == Approx(worst / 48));
    CHECK(result.at("map").at("deltae00_to") == worst);
    CHECK(spectrad::readPicture8(folder / "map.png").width == 8);

    const Outcome beyond = run(folder, {"compare", "a.exr", "b.exr", "--max-deltae", "1"});
    CHECK(beyond.code == 1);
    CHECK_THAT(beyond.out, Catch::Contains("CIEDE2000"));
    CHECK(cli::isOneLine(beyond.err));
    CHECK(run(folder, {"compare", "a.exr", "b.exr", "--max-deltae", "99"}).code == 0);
    for (const char* kept : {"99", "max:99", "14%rad", "max:26%rad"})
        CHECK(run(folder, {"compare", "a.exr", "b.exr", "--tolerance", kept}).code == 0);
    for (const char* broken : {"1", "max:1", "13%rad", "max:24%rad"}) {
        const Outcome far = run(folder, {"compare", "a.exr", "b.exr", "--tolerance", broken});
        CHECK(far.code == 1);
        CHECK(cli::isOneLine(far.err));
        CHECK_THAT(far.err, Catch::Contains("beyond the tolerance ("));
    }
    requireError(run(folder, {"compare", "a.exr", "b.exr", "--tolerance", "much"}), 2, "--tolerance");
    requireError(run(folder, {"compare", "a.exr", "b.exr", "--colours", "--tolerance", "1%rad"}), 2, "bands");
}

TEST_CASE("compare says which of size, wavelengths and quantity differ") {
    const Folder folder;
    const auto one = [](int, int, double) { return 1; };
    cli::writeCube(folder / "a.exr", 2, 2, "400:700:10", one);
    cli::writeCube(folder / "size.exr", 2, 3, "400:700:10", one);
    cli::writeCube(folder / "count.exr", 2, 2, "400:700:5", one);
    cli::writeCube(folder / "shift.exr", 2, 2, "401:701:10", one);
    cli::writeCube(folder / "kind.exr", 2, 2, "400:700:10", one, spectrad::CubeKind::reflectance);
    requireError(run(folder, {"compare", "a.exr", "size.exr"}), 1, "sizes differ");
    requireError(run(folder, {"compare", "a.exr", "count.exr"}), 1, "31 bands");
    requireError(run(folder, {"compare", "a.exr", "shift.exr"}), 1, "401");
    requireError(run(folder, {"compare", "a.exr", "kind.exr"}), 1, "reflectance");
    requireError(run(folder, {"compare", "a.exr", "a.exr", "--max-deltae", "-1"}), 2, "--max-deltae");
}

TEST_CASE("compare --colours holds cubes of other wavelengths against each other by what is seen of them") {
    const Folder folder;
    cli::writeCube(folder / "fine.exr", 2, 2, "360:830:1", [](int, int, double) { return 1; });
    // Hats over any grid hold a constant exactly.
    cli::writeCube(folder / "coarse.exr", 2, 2, "360:830:10", [](int, int, double) { return 1; });
    cli::writeCube(folder / "brighter.exr", 2, 2, "360:830:10",
                   [](int x, int, double) { return x == 0 ? 1 : 1.1; });
    const json same = run(folder, {"compare", "fine.exr", "coarse.exr", "--colours", "--json"}).json();
    CHECK(same.at("deltae00").at("max").get<double>() < 1e-4);
    CHECK(same.at("band_rmse").is_null());
    CHECK(same.at("gfc_min").is_null());
    const json other = run(folder, {"compare", "fine.exr", "brighter.exr", "--colours", "--json"}).json();
    CHECK(other.at("deltae00").at("p99").get<double>() > 1);
    CHECK(other.at("deltae00").at("max").get<double>() ==
          Approx(2 * other.at("deltae00").at("mean").get<double>()));
    const Outcome table =
        run(folder, {"compare", "fine.exr", "coarse.exr", "--colours", "--max-deltae", "1"});
    CHECK(table.code == 0);
    CHECK_THAT(table.out, Catch::StartsWith("CIEDE2000"));
}

TEST_CASE("two black cubes have no difference that could be undefined to their harm") {
    const Folder folder;
    cli::writeCube(folder / "black.exr", 2, 2, "400:700:10", [](int, int, double) { return 0; });
    const Outcome outcome = run(folder, {"compare", "black.exr", "black.exr", "--json", "--max-deltae", "0"});
    CHECK(outcome.code == 0);
    const json result = outcome.json();
    CHECK(result.at("band_rmse") == 0);
    CHECK(result.at("gfc_min").is_null());
    CHECK(result.at("deltae00").at("max").is_null());
    writeHalves(folder, "light.exr");
    cli::writeCube(folder / "dark.exr", 8, 6, "360:830:5", [](int, int, double) { return 0; });
    CHECK(run(folder, {"compare", "dark.exr", "light.exr", "--max-deltae", "1"}).code == 1);
    const json infinite = run(folder, {"compare", "dark.exr", "light.exr", "--json"}).json();
    CHECK(infinite.at("band_relative_max").is_null());
}

TEST_CASE("info describes a cube by its bands") {
    const Folder folder;
    writeHalves(folder);
    const json info = run(folder, {"info", "halves.exr", "--json"}).json();
    CHECK(info.at("width") == 8);
    CHECK(info.at("height") == 6);
    CHECK(info.at("bands") == 95);
    CHECK(info.at("projection") == "slit");
    CHECK(info.at("kind") == "radiance");
    CHECK(info.at("unit") == "W.m^-2.sr^-1.nm^-1");
    CHECK(info.at("min")[7] == 0.125);
    CHECK(info.at("max")[7] == 0.25);
    CHECK(info.at("mean")[7] == 0.1875);
    CHECK_THAT(run(folder, {"info", "halves.exr"}).out, Catch::Contains("every 5 nm"));
}
