// expose: raw counts by the command line, the same for the same seed; compare by two observers.
#include "cli/support.h"
#include "image/png16.h"

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

TEST_CASE("expose refuses what has no meaning") {
    const Folder folder;
    writeFlat(folder);
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
