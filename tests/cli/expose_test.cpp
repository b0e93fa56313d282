// expose: raw counts by the command line, the same for the same seed; compare by two observers.
#include "cli/support.h"
#include "image/png16.h"
#include "support/read_picture.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;
using nlohmann::json;

namespace {

void writeFlat(const Folder& folder, double value = 0.5) {
    cli::writeCube(folder / "flat.exr", 16, 8, "380:780:5", [value](int, int, double) { return value; },
                   spectrad::CubeKind::radiance, {{"white", "constant:1"}});
}

/// The values of a linear 16-bit PNG, unchanged.
spectrad::Picture16 readPng16(const cli::fs::path& path) {
    const std::string bytes = cli::bytesOf(path);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) != 0);
    const bool colour = (image.format & PNG_FORMAT_FLAG_COLOR) != 0;
    image.format = colour ? PNG_FORMAT_LINEAR_RGB : PNG_FORMAT_LINEAR_Y;
    spectrad::Picture16 picture{static_cast<int>(image.width), static_cast<int>(image.height), colour ? 3 : 1,
                                std::vector<std::uint16_t>(PNG_IMAGE_SIZE(image) / 2)};
    REQUIRE(png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr) != 0);
    return picture;
}

}  // namespace

TEST_CASE("expose counts the electrons that radiance, lens and time make") {
    const Folder folder;
    writeFlat(folder);
    // QE 0.5 from 500 to 600 nm: electrons are ∫ L QE λ/hc dλ · π/(4 N²) · pitch² · t.
    const double hc = 6.62607015e-34 * 299'792'458, lambda2 = (600.0 * 600 - 500.0 * 500) / 2 * 1e-9;
    const double electrons =
        0.5 * 0.5 * lambda2 / hc * std::numbers::pi / (4 * 2.8 * 2.8) * std::pow(3e-6, 2) * 1e-3;
    const Outcome outcome =
        run(folder,
            {"expose", "flat.exr", "-o", "raw.png", "--observer", "qe:500:0.5 600:0.5", "--f-number", "2.8",
             "--time", "0.001", "--pitch", "3", "--no-shot-noise", "--full-well", "200000", "--bits", "16"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const spectrad::Picture16 raw = readPng16(folder / "raw.png");
    CHECK(raw.width == 16);
    CHECK(raw.channels == 1);
    CHECK(raw.pixels[5] == Approx(electrons * 65535 / 200000).epsilon(0.01));
}

TEST_CASE(
    "expose with a mosaic and a seed: the same bytes again, others with another seed, and a grey picture of "
    "a grey scene") {
    const Folder folder;
    writeFlat(folder, 0.02);
    const auto shot = [&](const std::string& name, const std::string& seed) {
        const Outcome outcome = run(folder, {"expose", "flat.exr", "-o", name, "--full-well", "1e6", "--bits",
                                             "14", "--read-noise", "2", "--mosaic", "RGGB", "--seed", seed,
                                             "--time", "0.02", "--picture", "p.png", "--json"});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        CHECK(outcome.json().at("channels") == json{"raw"});
        return cli::bytesOf(folder / name);
    };
    const std::string first = shot("a.png", "7");
    CHECK(shot("b.png", "7") == first);
    CHECK(shot("c.png", "8") != first);
}

TEST_CASE("a picture of full pixels is white, and says how many are full") {
    const Folder folder;
    cli::writeCube(folder / "ramp.exr", 16, 4, "380:780:5",
                   [](int x, int, double nm) { return 0.002 * (1 + x) * nm / 500; },
                   spectrad::CubeKind::radiance,
                   {{"white", "illuminants/A"}, {"whiteXYZ", "1.0985,1,0.3558"}});
    const auto shot = [&](const std::string& fullWell) {
        const Outcome outcome =
            run(folder, {"expose", "ramp.exr", "-o", "r.exr", "--picture", "p.png", "--json",
                         "--no-shot-noise", "--full-well", fullWell, "--time", "0.1"});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        CHECK(outcome.json().at("taken_with").at("full well electrons") == fullWell);
        return outcome.json().at("full_pixels").get<int>();
    };
    CHECK(shot("1e9") == 0);
    const int some = shot("1.5e5");
    INFO(some);
    CHECK((some > 0 && some < 64));
    CHECK(shot("10") == 64);
    const spectrad::Picture8 burnt = spectrad::readPicture8(folder / "p.png");
    for (const std::uint8_t code : burnt.pixels)
        CHECK(int(code) >= 254);
}

TEST_CASE(
    "a picture is balanced on the light that lit it, known for what it is, or refused before anything is "
    "written") {
    const Folder folder;
    const auto greyIn = [&](const std::string& cube) {
        const Outcome outcome =
            run(folder, {"expose", cube, "-o", "r.exr", "--picture", "p.png", "--no-shot-noise"});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        const auto rgb = spectrad::readPicture8(folder / "p.png").pixels;
        for (size_t c = 1; c < 3; ++c)
            CHECK(std::abs(int(rgb[c]) - int(rgb[0])) <= 1);
    };
    // A reflectance under D65, though its scene had another lamp.
    cli::writeCube(folder / "grey.exr", 4, 4, "380:780:5", [](int, int, double) { return 0.5; },
                   spectrad::CubeKind::reflectance,
                   {{"white", "illuminants/A"}, {"whiteXYZ", "1.0985,1,0.3558"}});
    greyIn("grey.exr");
    // A name that means another light here than it did there.
    folder.write("lamp.csv", "400,1\n700,20\n");
    cli::writeCube(folder / "own.exr", 4, 4, "380:780:5", [](int, int, double) { return 0.5; },
                   spectrad::CubeKind::radiance, {{"white", "lamp.csv"}, {"whiteXYZ", "1,1,1"}});
    requireError(run(folder, {"expose", "own.exr", "-o", "raw.exr", "--picture", "q.png"}), 1,
                 "--white LIGHT");
    CHECK_FALSE(cli::fs::exists(folder / "raw.exr"));
    requireError(
        run(folder, {"expose", "own.exr", "-o", "raw.exr", "--picture", "q.png", "--white", "at:1,1"}), 2,
        "a light's spectrum");
    CHECK(run(folder, {"expose", "own.exr", "-o", "raw.exr", "--picture", "q.png", "--white", "constant:1"})
              .code == 0);
}

TEST_CASE("raw counts in a PNG are linear, of no known primaries, with their bits and what took them") {
    const Folder folder;
    writeFlat(folder);
    REQUIRE(run(folder, {"expose", "flat.exr", "-o", "raw.png", "--full-well", "1e6", "--bits", "12",
                         "--time", "0.02"})
                .code == 0);
    const std::string bytes = cli::bytesOf(folder / "raw.png");
    for (const char* there : {"gAMA", "sBIT", "f-number", "full well electrons"})
        CHECK(bytes.find(there) < bytes.find("IEND"));
    for (const char* absent : {"cHRM", "sRGB", "cICP"})
        CHECK(bytes.find(absent) == std::string::npos);
}

TEST_CASE("light that a detector would see beyond the cube's bands is said to be missing") {
    const Folder folder;
    writeFlat(folder);
    const Outcome sensor =
        run(folder, {"expose", "flat.exr", "-o", "raw.exr", "--observer", "qe:sensors/ccd"});
    CHECK(sensor.err.find("outside the cube's 380 to 780 nm") != std::string::npos);
    CHECK(run(folder, {"observe", "flat.exr", "-o", "x.exr"}).err.empty());
}

TEST_CASE("expose refuses what has no meaning") {
    const Folder folder;
    writeFlat(folder);
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.exr", "--observer", "nikon-5100"}), 1,
                 "'qe:nikon-5100' takes its curves as one");
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.exr", "--observer", "cie1931-2"}), 1,
                 "no quantum efficiency");
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.exr", "--black", "64"}), 2, "--bits");
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.exr", "--f-number", "0.3"}), 2, "--f-number");
    cli::writeCube(folder / "e.exr", 4, 4, "380:780:5", [](int, int, double) { return 0.5; },
                   spectrad::CubeKind::irradiance, {});
    requireError(run(folder, {"expose", "e.exr", "-o", "raw.exr"}), 1, "irradiance");
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.png"}), 2, "--bits");
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.png", "--bits", "12"}), 2, "--full-well");
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.exr", "--mosaic", "RGB"}), 2, "no square");
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.exr", "--observer", "generic-reversal"}), 2,
                 "film");
    requireError(run(folder, {"expose", "flat.exr", "-o", "raw.exr", "--f-number", "0"}), 2, "--f-number");
}

TEST_CASE(
    "compare --observers: the same eye sees no difference in one cube, a scaled one neither, another eye "
    "does") {
    const Folder folder;
    cli::writeCube(folder / "a.exr", 8, 4, "380:780:5",
                   [](int x, int, double nm) { return 0.1 * (1 + x) * (1 + (nm - 380) / 400 * (x % 3)); },
                   spectrad::CubeKind::radiance, {{"white", "constant:1"}, {"whiteXYZ", "1,1,1"}});
    const auto largest = [&](const std::vector<std::string>& arguments) {
        const Outcome outcome = run(folder, arguments);
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        return outcome.json().at("deltae00").at("max").get<double>();
    };
    CHECK(largest({"compare", "a.exr", "--observers", "cie1931-2", "cie1931-2", "--json", "-q"}) < 1e-6);
    CHECK(largest({"compare", "a.exr", "--observers", "cie1931-2", "cie1964-10", "--json", "-q", "--map",
                   "m.png"}) > 0.1);
    CHECK(largest({"compare", "a.exr", "--observers", "cie1931-2", "protanope", "--json", "-q"}) > 1);
    requireError(run(folder, {"compare", "a.exr"}), 2, "--observers");
}
