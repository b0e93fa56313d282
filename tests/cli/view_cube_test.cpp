// view of a cube: its pixels are observe's, its meter is measure's.
#include "cli/support.h"
#include "support/read_picture.h"

#include <cmath>

using cli::canDraw;
using cli::codesApart;
using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;

namespace {

double value(int x, int y, double nm) {
    return 0.5 + 0.45 * std::sin(nm / 30 + 0.1 * x) * std::cos(0.05 * y);
}

std::string bandsOf(const std::string& csv) {
    return csv.substr(csv.find("\n400,"));
}

}  // namespace

TEST_CASE("a radiance cube in the viewer is the picture that observe makes, within one code") {
    const Folder folder;
    cli::writeCube(folder / "cube.exr", 60, 40, "400:700:10", value, spectrad::CubeKind::radiance,
                   {{"white", "illuminants/FL2"}, {"whiteXYZ", "0.9915,1,0.6732"}});
    folder.write(
        "script.txt",
        "screenshot first.png\n"
        "set observer=cie1964-10\nset exposure=auto\nscreenshot ten.png\n"
        "set observer=cie1931-2\nset white=illuminants/A\nset adapt=bradford\nset degree=0.6\n"
        "set tone=reinhard\nset mapping=desaturate\nset exposure=auto\nset exposure=0.5\nset display=p3\n"
        "screenshot bent.png\n"
        "set display=displays/lcd-apple-studio\nset tone=linear\nset mapping=clip\nset degree=1\n"
        "set exposure=0\nscreenshot lcd.png\n"
        "pin 31 17\npins pins.csv\nset band=550\nscreenshot band.png\nset bands=650,550,450\n");
    if (!canDraw(run(folder,
                     {"view", "cube.exr", "--offscreen", "last.png", "--plain", "--script", "script.txt"})))
        return;
    const auto observed = [&](const char* picture, const std::vector<std::string>& options) {
        cli::requireObserved(folder, "cube.exr", picture, options);
    };
    observed("first.png", {});
    observed("ten.png", {"--observer", "cie1964-10"});
    observed("bent.png", {"--white", "illuminants/A", "--adapt", "bradford", "--degree", "0.6", "--tone",
                          "reinhard", "--gamut", "desaturate", "--exposure", "0.5", "--display", "p3"});
    observed("lcd.png",
             {"--white", "illuminants/A", "--adapt", "bradford", "--display", "displays/lcd-apple-studio"});
    CHECK(bandsOf(cli::bytesOf(folder / "pins.csv")) ==
          bandsOf(run(folder, {"measure", "cube.exr", "--at", "31,17"}).out));
    const spectrad::Picture8 band = spectrad::readPicture8(folder / "band.png");
    CHECK(band.pixels[3] == band.pixels[4]);
    CHECK(band.pixels[3] == band.pixels[5]);
    CHECK(codesApart(folder / "band.png", folder / "last.png") > 10);
}

TEST_CASE(
    "a reflectance cube is relit in the viewer as observe --white relights it; ENVI and point values too") {
    const Folder folder;
    cli::writeCube(folder / "paint.exr", 48, 32, "400:700:10", value, spectrad::CubeKind::reflectance);
    folder.write("script.txt",
                 "screenshot day.png\nset light.spectrum=illuminants/A\nscreenshot warm.png\npin 5 6\npins "
                 "pins.csv\n");
    if (!canDraw(run(folder,
                     {"view", "paint.exr", "--offscreen", "last.png", "--plain", "--script", "script.txt"})))
        return;
    REQUIRE(run(folder, {"observe", "paint.exr", "-o", "a.png", "-q"}).code == 0);
    REQUIRE(run(folder, {"observe", "paint.exr", "-o", "b.png", "-q", "--white", "illuminants/A"}).code == 0);
    CHECK(codesApart(folder / "day.png", folder / "a.png") <= 1);
    CHECK(codesApart(folder / "warm.png", folder / "b.png") <= 1);
    const std::string pins = cli::bytesOf(folder / "pins.csv");
    const auto measured =
        run(folder, {"measure", "paint.exr", "--at", "5,6", "--white", "illuminants/A", "-q"}).out;
    CHECK(bandsOf(pins) == bandsOf(measured));
    // XYZ under the lamp, the perfect diffuser at Y = 100.
    const auto xyz = [](const std::string& text) {
        const size_t from = text.find("XYZ ");
        return text.substr(from, text.find_first_of(";\n", from) - from);
    };
    CHECK(xyz(pins) == xyz(measured));

    // A raster of another program: values at points, ascending or not.
    folder.write("field.hdr",
                 "ENVI\nsamples = 3\nlines = 2\nbands = 3\ndata type = 1\nbyte order = 0\ninterleave = bip\n"
                 "reflectance scale factor = 255\nwavelength units = nm\nwavelength = {640, 550, 450}\n");
    folder.write("field.img",
                 std::string("\x10\x80\xf0\x20\x90\xe0\x30\xa0\xd0\x40\xb0\xc0\x50\x60\x70\x11\x22\x33"));
    REQUIRE(run(folder, {"view", "field.img", "--offscreen", "field.png", "--plain", "-q"}).code == 0);
    REQUIRE(run(folder, {"observe", "field.img", "-o", "c.png", "-q"}).code == 0);
    CHECK(codesApart(folder / "field.png", folder / "c.png") <= 1);
}

TEST_CASE("view of a cube says in one line what is wrong") {
    const Folder folder;
    cli::writeCube(folder / "cube.exr", 6, 4, "400:700:100", value);
    requireError(run(folder, {"view", "cube.exr", "--offscreen", "x.png", "--samples", "4"}), 2,
                 "--samples 4");
    requireError(run(folder, {"view", "cube.exr", "--offscreen", "cube.exr"}), 2, ".png");
    folder.write("script.txt", "set lamp.spectrum=illuminants/A\n");
    const Outcome outcome =
        run(folder, {"view", "cube.exr", "--offscreen", "x.png", "--script", "script.txt"});
    if (outcome.code == 3) return;  // no OSMesa
    requireError(outcome, 1, "script.txt:1:1: the cube has no light 'lamp'");
    const std::string bytes = cli::bytesOf(folder / "cube.exr");
    folder.write("cube.exr", bytes.substr(0, bytes.size() / 2));
    requireError(run(folder, {"view", "cube.exr", "--offscreen", "x.png"}), 1, "cube.exr");
}
