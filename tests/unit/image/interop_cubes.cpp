// Not a test by itself: cubes, and what must be found in them, for other programs to read
// (tests/interop/run.sh).
#include "base/files.h"
#include "base/text.h"
#include "samples.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <half.h>

using namespace spectrad;
using namespace spectrad::test;

namespace {

/// {"kind": …, "width": …, "height": …, "wavelengths_nm": […], "samples": [{"x": …, "y": …, "values": […]}]}
std::string expectation(const Cube& cube, bool half) {
    static constexpr const char* kinds[] = {"radiance", "irradiance", "reflectance", "transmittance"};
    const auto number = [](auto value) { return shortest(static_cast<double>(value)); };
    std::string wavelengths, samples;
    for (double nm : cube.info.wavelengths.nm)
        wavelengths += (wavelengths.empty() ? "" : ", ") + number(nm);
    const int right = cube.info.width - 1, bottom = cube.info.height - 1;
    for (const auto& [x, y] :
         {std::pair(0, 0), std::pair(right, 0), std::pair(right / 2, bottom / 2), std::pair(right, bottom)}) {
        std::string values;
        for (size_t b = 0; b < cube.info.wavelengths.size(); ++b) {
            const float value = cube.row(y, b)[x];
            values += (b ? ", " : "") + (half ? number(static_cast<float>(::half(value))) : number(value));
        }
        samples += fmt::format("{}{{\"x\": {}, \"y\": {}, \"values\": [{}]}}", samples.empty() ? "" : ",\n  ",
                               x, y, values);
    }
    return fmt::format(
        "{{\"kind\": \"{}\", \"width\": {}, \"height\": {},\n \"wavelengths_nm\": [{}],\n \"samples\": [\n  "
        "{}]}}\n",
        kinds[static_cast<int>(cube.info.kind)], cube.info.width, cube.info.height, wavelengths, samples);
}

}  // namespace

TEST_CASE("cubes for other programs", "[.interop]") {
    const char* folder = std::getenv("SPECTRAD_INTEROP");  // an existing folder
    REQUIRE(folder);
    const auto path = [&](const std::string& name) { return std::filesystem::path(folder) / name; };
    const auto exr = [&](const std::string& name, const Cube& cube, WriteOptions options) {
        writeStrips(*createExr(path(name + ".exr"), cube.info, options), cube);
        writeFile(path(name + ".json"), expectation(cube, options.half));
    };
    const auto visible = sampleCube(37, 41, ascending(380, 5, 81), 100);
    exr("none", visible, {Compression::none, false});
    exr("zips", visible, {Compression::zips, false});
    exr("zip", visible, {Compression::zip, false});
    exr("piz", visible, {Compression::piz, false});
    exr("half", visible, {Compression::piz, true});
    exr("infrared", sampleCube(5, 4, ascending(900, 5, 41), 100), {});
    exr("irregular", sampleCube(5, 4, {380.1234567890123, 401, 555.5, 555.5000001, 1000.25}, 100), {});
    Cube paint = sampleCube(5, 4, ascending(400, 10, 31), 1);
    paint.info.kind = CubeKind::reflectance;
    paint.info.attributes["scene"] = "a paint, λ";
    exr("reflectance", paint, {});

    for (auto [name, cube] : {std::pair("envi", visible),
                              std::pair("envi_bands", sampleCube(3, 2, ascending(380, 0.1, 4001), 1))}) {
        cube.info.attributes["Scene"] = "{λ}";
        writeStrips(*createEnvi(path(std::string(name) + ".img"), cube.info), cube);
        writeFile(path(std::string(name) + ".json"), expectation(cube, false));
    }
}
