#include "samples.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

using namespace spectrad;
using namespace spectrad::test;
using Catch::Matchers::Contains;

namespace {

/// value(x, y, b) = 100 b + 10 y + x + 1 of a raster of 3×2 pixels and 2 bands.
double sample(int x, int y, int b) {
    return 100 * b + 10 * y + x + 1;
}

template <typename T>
void append(std::string& bytes, T value, bool bigEndian) {
    std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (bigEndian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

void appendTyped(std::string& bytes, int type, double value, bool big) {
    switch (type) {
        case 1:
            return append(bytes, static_cast<std::uint8_t>(value), big);
        case 2:
            return append(bytes, static_cast<std::int16_t>(value), big);
        case 3:
            return append(bytes, static_cast<std::int32_t>(value), big);
        case 4:
            return append(bytes, static_cast<float>(value), big);
        case 5:
            return append(bytes, value, big);
        case 12:
            return append(bytes, static_cast<std::uint16_t>(value), big);
        default:
            return append(bytes, static_cast<std::uint32_t>(value), big);
    }
}

std::string dataBytes(const std::string& interleave, int type, bool big) {
    std::string bytes;
    if (interleave == "bsq")
        for (int b = 0; b < 2; ++b)
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 3; ++x)
                    appendTyped(bytes, type, sample(x, y, b), big);
    if (interleave == "bil")
        for (int y = 0; y < 2; ++y)
            for (int b = 0; b < 2; ++b)
                for (int x = 0; x < 3; ++x)
                    appendTyped(bytes, type, sample(x, y, b), big);
    if (interleave == "bip")
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 3; ++x)
                for (int b = 0; b < 2; ++b)
                    appendTyped(bytes, type, sample(x, y, b), big);
    return bytes;
}

std::string headerOf(const std::string& interleave, int type, bool big, const std::string& rest) {
    return "ENVI\nsamples = 3\nlines   = 2\nbands = 2\ndata type = " + std::to_string(type) +
           "\ninterleave = " + interleave + "\nbyte order = " + (big ? "1" : "0") + "\n" + rest;
}

const std::string nmHeader =
    "wavelength units = Nanometers\nwavelength = {400, 500}\ndata units = W/(m^2 sr nm)\n";

struct Result {
    Cube cube;
    std::string notes;
};

Result readFloat(const Folder& folder, const std::string& rest) {
    writeBytes(folder / "a.img", dataBytes("bil", 4, false));
    writeBytes(folder / "a.hdr", headerOf("bil", 4, false, rest));
    Notes notes;
    Result result{readCube(folder / "a.img", notes), {}};
    for (const std::string& line : notes.lines())
        result.notes += line + "\n";
    return result;
}

void checkSamples(const Cube& cube) {
    REQUIRE(cube.info.width == 3);
    REQUIRE(cube.info.height == 2);
    for (int b = 0; b < 2; ++b)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 3; ++x)
                CHECK(cube.row(y, static_cast<size_t>(b))[x] == static_cast<float>(sample(x, y, b)));
}

}  // namespace

TEST_CASE("an ENVI raster of ours comes back with the same bits, wavelengths and attributes") {
    const Folder folder;
    Cube cube = GENERATE(sampleCube(7, 9, {380.1234567890123, 555.5, 1000}), sampleCube(1, 1, {550}),
                         sampleCube(2, 2, ascending(380, 0.04, 10000)));
    cube.info.kind =
        GENERATE(CubeKind::radiance, CubeKind::irradiance, CubeKind::reflectance, CubeKind::transmittance);
    cube.info.wavelengths.projection = GENERATE(Projection::slit, Projection::box, Projection::point);
    cube.info.wavelengths.step = 0.3;
    cube.info.attributes = {{"white", "D65"}, {"Mixed Case", " {a} = 100% λ\n"}, {"empty", ""}};
    writeStrips(*createEnvi(folder / "a.img", cube.info), cube);
    CHECK(folder.files() == 2);
    for (const char* name : {"a.img", "a.hdr"}) {
        Notes notes;
        const Cube back = readCube(folder / name, notes);
        CHECK(notes.lines().empty());
        CHECK(back.info.wavelengths == cube.info.wavelengths);
        CHECK(back.info.projectionStated);
        CHECK(back.info.kind == cube.info.kind);
        CHECK(back.info.attributes == cube.info.attributes);
        CHECK(std::memcmp(back.values.data(), cube.values.data(), cube.values.size() * 4) == 0);
        CHECK(readCubeInfo(folder / name, notes).attributes == cube.info.attributes);
        CHECK(looksLikeCube(folder / name));
    }
    const std::string header = bytesOf(folder / "a.hdr");
    CHECK(std::all_of(header.begin(), header.end(),
                      [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
    CHECK(std::filesystem::file_size(folder / "a.img") == cube.values.size() * 4);
    // What stands beside it under the same name is something else: the scene or the model that it shows.
    for (const char* name : {"a.xml", "a.gltf", "a.obj"}) {
        writeBytes(folder / name, "<scene/>");
        CHECK_FALSE(looksLikeCube(folder / name));
    }
}

TEST_CASE("a header of ours says what every reader of the format needs") {
    const Folder folder;
    const Cube cube = sampleCube(2, 2, {400, 410, 430});
    writeStrips(*createEnvi(folder / "a.img", cube.info), cube);
    const std::string header = bytesOf(folder / "a.hdr");
    for (const char* line :
         {"ENVI\n", "samples = 2\n", "lines = 2\n", "bands = 3\n", "header offset = 0\n",
          "file type = ENVI Standard\n", "data type = 4\n", "interleave = bil\n", "byte order = 0\n",
          "wavelength units = Nanometers\n", "wavelength = {400, 410, 430}\n", "fwhm = {5, 15, 10}\n",
          "band names = {400 nm, 410 nm, 430 nm}\n", "data units = W/(m^2 sr nm)\n"})
        CHECK_THAT(header, Contains(line));
}

TEST_CASE("every interleave, data type and byte order is read") {
    const std::string interleave = GENERATE("bsq", "bil", "bip");
    const int type = GENERATE(1, 2, 3, 4, 5, 12, 13);
    const bool big = GENERATE(false, true);
    const Folder folder;
    writeBytes(folder / "a.dat", "head" + dataBytes(interleave, type, big));
    writeBytes(folder / "a.hdr", headerOf(interleave, type, big, nmHeader + "header offset = 4\n"));
    checkSamples(readBack(folder / "a.hdr"));
    checkSamples(readBack(folder / "a.dat"));
}

TEST_CASE("the data file is found under every usual name, and the header under both of its") {
    const Folder folder;
    const std::string name = GENERATE("a", "a.img", "a.dat", "a.raw", "a.bsq", "a.bil", "a.bip", "a.IMG");
    const bool appended = GENERATE(false, true);
    const std::string header =
        appended ? name + ".hdr" : std::filesystem::path(name).replace_extension(".hdr").string();
    writeBytes(folder / name, dataBytes("bil", 4, false));
    writeBytes(folder / header, headerOf("bil", 4, false, nmHeader));
    checkSamples(readBack(folder / name));
    checkSamples(readBack(folder / header));
    CHECK(looksLikeCube(folder / name));
}

TEST_CASE("wavelengths are read in every unit, and sorted") {
    const Folder folder;
    const auto nm = [&](const std::string& units, const std::string& list) {
        return readFloat(folder, "wavelength units = " + units + "\nwavelength = {" + list +
                                     "}\ndata units = W/m2/sr/nm\n");
    };
    CHECK(nm("Micrometers", "0.4, 0.55").cube.info.wavelengths.nm == std::vector<double>{400, 550});
    CHECK(nm("um", "4.0e-1,\n 5.5E-1").cube.info.wavelengths.nm == std::vector<double>{400, 550});
    CHECK(nm("Angstroms", "4000, 5500").cube.info.wavelengths.nm == std::vector<double>{400, 550});
    CHECK(nm("nanometers", " 400 , 550 ").cube.info.wavelengths.nm == std::vector<double>{400, 550});
    const Cube waves = nm("Wavenumber", "10000, 20000").cube;
    CHECK(waves.info.wavelengths.nm == std::vector<double>{500, 1000});
    CHECK(waves.row(0, 0)[0] == static_cast<float>(sample(0, 0, 1)));  // the second band is the shorter wave
    CHECK(nm("GHz", "599584.916, 299792.458").cube.info.wavelengths.nm[1] == Approx(1000).epsilon(1e-15));
}

TEST_CASE("without units of wavelength, nanometres are taken only where nothing else is likely") {
    const Folder folder;
    const auto [cube, notes] = readFloat(folder, "wavelength = {400, 500}\n");
    checkSamples(cube);
    CHECK_THAT(notes, Contains("nanometres") && Contains("does not say what it holds"));
    CHECK_THROWS_WITH(readFloat(folder, "wavelength = {0.4, 0.5}\n"), Contains("micrometres"));
}

TEST_CASE("scale factors, gains, offsets, units and marks of no data are honoured and said") {
    const Folder folder;
    const auto scaled = readFloat(folder, nmHeader + "reflectance scale factor = 200\n");
    CHECK(scaled.cube.info.kind == CubeKind::reflectance);
    CHECK(scaled.cube.row(0, 0)[0] == 1 / 200.0f);
    CHECK_THAT(scaled.notes, Contains("200"));
    const auto gained =
        readFloat(folder, nmHeader + "data gain values = {2, 3}\ndata offset values = {0.5, -1}\n");
    CHECK(gained.cube.row(1, 1)[2] == static_cast<float>(3 * sample(2, 1, 1) - 1));
    CHECK_THAT(gained.notes, Contains("gain"));
    const auto units = readFloat(folder,
                                 "wavelength units = nm\nwavelength = {400, 500}\ndata units = uW/(cm^2 sr "
                                 "nm)\ndata ignore value = 13\n");
    CHECK(units.cube.row(0, 0)[0] == 0.01f);
    CHECK(units.cube.row(1, 0)[2] == 0);
    CHECK_THAT(units.notes, Contains("0.01") && Contains("1 values are marked"));
    CHECK_THAT(readFloat(folder, nmHeader + "bbl = {1, 0}\n").notes, Contains("bad"));
}

TEST_CASE("units of radiance are known in every order and spelling, and others are said") {
    const Folder folder;
    for (const auto& [unit, factor] : {std::pair{"W/(m^2 sr nm)", 1.0},
                                       {"W m-2 sr-1 um-1", 1e-3},
                                       {"mW/(cm^2*um*sr)", 1e-2},
                                       {"mW/cm^2/um/sr", 1e-2},
                                       {"\xc2\xb5W/(cm2 nm sr)", 1e-2},
                                       {"\xce\xbcW cm^-2 sr^-1 nm^-1", 1e-2},
                                       {"\xb5W/cm2/sr/nm", 1e-2},
                                       {"W/(m2 sr \xc2\xb5m)", 1e-3},
                                       {"Watts/(m^2 steradian micrometer)", 1e-3},
                                       {"nW/mm^2/sr/nm", 1e-3}}) {
        INFO(unit);
        const auto read = readFloat(folder, "wavelength units = nm\nwavelength = {400, 500}\ndata units = " +
                                                std::string(unit) + "\n");
        CHECK(read.cube.row(1, 1)[2] == static_cast<float>(factor * sample(2, 1, 1)));
        CHECK_THAT(read.notes, !Contains("are read as"));
    }
    for (const std::string unit :
         {"counts", "W/m2/sr", "mW/(m2 sr cm-1)", "W W/m2/sr/nm", "1000 W/m2/sr/nm"}) {
        INFO(unit);
        CHECK_THAT(
            readFloat(folder, "wavelength units = nm\nwavelength = {400, 500}\ndata units = " + unit + "\n")
                .notes,
            Contains("are read as"));
    }
}

TEST_CASE("an error in an ENVI header names file and line") {
    const Folder folder;
    const auto refused = [&](const std::string& rest, const char* reason) {
        INFO(rest);
        CHECK_THROWS_WITH(readFloat(folder, rest), Contains("a.hdr") && Contains(reason));
    };
    refused("", "no wavelengths");
    refused("wavelength = {400}\nwavelength units = nm\n", ":8: 1 wavelengths for 2 bands");
    refused("wavelength units = angstromers\nwavelength = {400, 500}\n", "'angstromers'");
    refused("wavelength = {400, 400}\nwavelength units = nm\n", "both 400");
    refused("wavelength = {400, x}\nwavelength units = nm\n", "'x'");
    refused("wavelength = {400, -1}\nwavelength units = nm\n", "'-1'");
    refused("wavelength = {400, 500\n", ":8: the list of 'wavelength' is not closed");
    refused("wavelength = {400, 500}\nwavelength units = furlongs\n", ":9: wavelength units 'furlongs'");
    refused(nmHeader + "nonsense\n", ":11: neither");
    refused(nmHeader + "bands = 3\n", "given twice");
    refused(nmHeader + "file type = ENVI Classification\n", "Classification");
    refused(nmHeader + "file compression = 1\n", "compressed");
    refused(nmHeader + "reflectance scale factor = 0\n", "above 0");
    refused(nmHeader + "header offset = -1\n", "-1");
    refused(nmHeader + "spectrad:quantity = colour\n", "colour");
    refused(nmHeader + "data gain values = {1}\n", "1 numbers for 2 bands");
    writeBytes(folder / "a.hdr",
               "ENVI\nsamples = 3\nlines = 2\nbands = 2\ndata type = 6\ninterleave = bil\nbyte order = 0\n");
    Notes notes;
    CHECK_THROWS_WITH(readCube(folder / "a.img", notes), Contains(":5: data type 6"));
}

TEST_CASE("a raster shorter than its header says is refused with both sizes") {
    const Folder folder;
    writeBytes(folder / "a.img", std::string(47, '\0'));
    writeBytes(folder / "a.hdr", headerOf("bil", 4, false, nmHeader));
    Notes notes;
    CHECK_THROWS_WITH(readCube(folder / "a.img", notes), Contains("47") && Contains("48"));
}

TEST_CASE("doubles beyond float and values that are not finite are refused with pixel and band") {
    const Folder folder;
    const double bad = GENERATE(1e39, -1e300, std::numeric_limits<double>::quiet_NaN());
    std::string bytes = dataBytes("bil", 5, false);
    std::memcpy(bytes.data() + 8 * 4, &bad, 8);  // row 0, band 1, x 1
    writeBytes(folder / "a.img", bytes);
    writeBytes(folder / "a.hdr", headerOf("bil", 5, false, nmHeader));
    Notes notes;
    CHECK_THROWS_WITH(readCube(folder / "a.img", notes), Contains("pixel 1,0, band 500 nm"));
}

TEST_CASE("data and header appear together: if one cannot, the other's former file is back") {
    const Folder folder;
    const Cube cube = sampleCube(2, 2, {400});
    const bool former = GENERATE(false, true);
    if (former) writeBytes(folder / "a.img", "before");
    auto writer = createEnvi(folder / "a.img", cube.info);
    std::filesystem::create_directories(folder / "a.hdr/in the way");
    CHECK_THROWS_AS(writeStrips(*writer, cube), MachineError);
    writer.reset();
    CHECK(bytesOf(folder / "a.img") == (former ? "before" : ""));
    CHECK(folder.files() == (former ? 2 : 1));
}

TEST_CASE("an ENVI target may be named by its header") {
    const Folder folder;
    const Cube cube = sampleCube(2, 2, {400});
    writeStrips(*createEnvi(folder / "a.hdr", cube.info), cube);
    CHECK(readBack(folder / "a.img").values == cube.values);
}
