#include "samples.h"

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <half.h>

using namespace spectrad;
using namespace spectrad::test;

namespace {

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void checkRoundTrip(const Cube& cube, const WriteOptions& options = {},
                    const std::vector<int>& strips = {3, 1, 7}) {
    const Folder folder;
    const auto path = folder / "cube.exr";
    writeStrips(*createExr(path, cube.info, options), cube, strips);
    const Cube back = readBack(path);
    CHECK(back.info.width == cube.info.width);
    CHECK(back.info.height == cube.info.height);
    CHECK(back.info.wavelengths == cube.info.wavelengths);
    CHECK(back.info.kind == cube.info.kind);
    CHECK(back.info.projectionStated);
    CHECK(sameBits(back.values, cube.values));
    CHECK(folder.files() == 1);
}

std::string text(const Imf::Header& header, const char* name) {
    const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
    return attribute ? attribute->value() : "(none)";
}

}  // namespace

TEST_CASE("every compression gives back the same bits, whatever the strips") {
    const Compression compression =
        GENERATE(Compression::none, Compression::zips, Compression::zip, Compression::piz);
    const Cube cube = sampleCube(37, 131, ascending(380, 5, 21));
    for (const auto& strips :
         {std::vector<int>{1}, std::vector<int>{131}, std::vector<int>{32}, std::vector<int>{3, 40, 1, 64}})
        checkRoundTrip(cube, {compression, false}, strips);
}

TEST_CASE("extreme values survive: denormals, zeros of both signs, the largest float") {
    Cube cube = sampleCube(5, 3, {400, 500});
    cube.values[0] = 1e-45f;
    cube.values[1] = -0.0f;
    cube.values[2] = std::numeric_limits<float>::max();
    cube.values[3] = std::numeric_limits<float>::min();
    cube.values[4] = -1e30f;
    checkRoundTrip(cube);
}

TEST_CASE("odd sizes and grids come back with identical wavelengths") {
    checkRoundTrip(sampleCube(1, 1, {550}));
    checkRoundTrip(sampleCube(2, 2, {632.8}));
    checkRoundTrip(sampleCube(3, 2, {380.1234567890123, 401, 555.5, 1000, 2500.25}));
    checkRoundTrip(sampleCube(4, 2, ascending(500, 1e-9, 12)));
    checkRoundTrip(sampleCube(3, 3, ascending(400, 0.1, 400)));
    checkRoundTrip(sampleCube(3, 3, ascending(900, 5, 41)));
    checkRoundTrip(sampleCube(3000, 2, {400, 500, 600}));
}

TEST_CASE("ten thousand bands come back") {
    checkRoundTrip(sampleCube(3, 2, ascending(380, 0.04, 10000)));
}

TEST_CASE("projection, step, quantity and attributes come back") {
    const Folder folder;
    Cube cube = sampleCube(2, 2, {500});
    cube.info.wavelengths.step = 0.1;
    cube.info.attributes = {{"white", "illuminants/D65"},
                            {"scene", "a\nline — and λ"},
                            {"comments", "ours"},
                            {"empty", ""},
                            {"lensTransmission", "500nm:0.9;400nm:0.8;"}};
    const Projection projection = GENERATE(Projection::slit, Projection::box, Projection::point);
    const CubeKind kind =
        GENERATE(CubeKind::radiance, CubeKind::irradiance, CubeKind::reflectance, CubeKind::transmittance);
    cube.info.wavelengths.projection = projection;
    cube.info.kind = kind;
    writeStrips(*createExr(folder / "a.exr", cube.info, {}), cube);
    const CubeInfo info = readBack(folder / "a.exr").info;
    CHECK(info.wavelengths == cube.info.wavelengths);
    CHECK(info.kind == kind);
    for (const char* key : {"white", "scene", "comments", "empty"})
        CHECK(info.attributes.at(key) == cube.info.attributes[key]);
    CHECK(info.attributes.at("lensTransmission") == "400nm:0.8;500nm:0.9;500nm:0.9");
    CHECK(info.attributes.at("software") == "Spectrad");
    CHECK(info.attributes.size() == cube.info.attributes.size() + 1);
    Notes notes;
    CHECK(readCubeInfo(folder / "a.exr", notes).attributes == info.attributes);
    CHECK(notes.lines().empty());
}

TEST_CASE("a file has the header that every known reader of the layout takes") {
    const Folder folder;
    const Cube cube = sampleCube(4, 3, {380, 385, 390});
    const bool asHalf = GENERATE(false, true);
    Cube small = sampleCube(4, 3, {380, 385, 390}, 100);
    writeStrips(*createExr(folder / "a.exr", cube.info, {Compression::piz, asHalf}), asHalf ? small : cube);
    Imf::InputFile file((folder / "a.exr").c_str());
    const Imf::Header& header = file.header();
    CHECK(text(header, "spectralLayoutVersion") == "1.0");
    CHECK(text(header, "emissiveUnits") == "W.m^-2.sr^-1");
    CHECK(text(header, "spectralRadianceUnits") == "W.m^-2.sr^-1.nm^-1");
    CHECK(text(header, "spectrad:projection") == "slit");
    CHECK(text(header, "spectrad:wavelengths") == "(none)");  // the names hold them exactly
    REQUIRE(header.findTypedAttribute<Imf::FloatAttribute>("EV"));
    CHECK(header.findTypedAttribute<Imf::FloatAttribute>("EV")->value() == 0);
    CHECK(Imf::hasChromaticities(header));
    CHECK(header.lineOrder() == Imf::INCREASING_Y);
    CHECK(header.dataWindow() == header.displayWindow());
    CHECK(header.dataWindow().min == Imath::V2i(0, 0));
    CHECK_FALSE((file.version() & 0x400));  // no long names
    int channels = 0;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it, ++channels)
        CHECK(it.channel().type == (asHalf ? Imf::HALF : Imf::FLOAT));
    CHECK(channels == 6);
    CHECK(header.channels().findChannel("S0.385,000000nm"));
    CHECK(header.channels().findChannel("R"));
}

TEST_CASE("a reflectance file has T channels and no units of emission") {
    const Folder folder;
    Cube cube = sampleCube(2, 2, {400, 500});
    cube.info.kind = CubeKind::reflectance;
    writeStrips(*createExr(folder / "a.exr", cube.info, {}), cube);
    Imf::InputFile file((folder / "a.exr").c_str());
    CHECK(text(file.header(), "emissiveUnits") == "(none)");
    CHECK(file.header().channels().findChannel("T.400,000000nm"));
}

TEST_CASE("the preview is in the file, held at the largest value where it is beyond the type") {
    const Folder folder;
    const bool asHalf = GENERATE(false, true);
    const float largest = asHalf ? 65504.0f : std::numeric_limits<float>::max();
    const Cube cube = sampleCube(1, 1, {400}, 1);
    auto writer = createExr(folder / "a.exr", cube.info, {Compression::zip, asHalf});
    const float preview[3] = {1.5f, std::numeric_limits<float>::infinity(), -0.25f};
    writer->write(1, cube.values.data(), preview);
    CHECK(writer->finish().previewClamped == 1);
    Imf::InputFile file((folder / "a.exr").c_str());
    float rgb[3];
    Imf::FrameBuffer frame;
    const char* names[3] = {"R", "G", "B"};
    if (asHalf) {
        ::half halves[3];
        for (int c = 0; c < 3; ++c)
            frame.insert(names[c], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(halves + c), 2, 2));
        file.setFrameBuffer(frame);
        file.readPixels(0);
        std::copy(halves, halves + 3, rgb);
    } else {
        for (int c = 0; c < 3; ++c)
            frame.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(rgb + c), 4, 4));
        file.setFrameBuffer(frame);
        file.readPixels(0);
    }
    CHECK(rgb[0] == 1.5f);
    CHECK(rgb[1] == largest);
    CHECK(rgb[2] == -0.25f);
}

TEST_CASE("half files hold the nearest half, and count what became zero") {
    const Folder folder;
    Cube cube = sampleCube(33, 70, {400, 500, 600}, 60000);
    cube.values[5] = 1e-9f;
    cube.values[6] = 0;
    cube.values[7] = -1e-30f;
    cube.values[8] = 65504;
    const auto report = writeStrips(*createExr(folder / "a.exr", cube.info, {Compression::piz, true}), cube);
    CHECK(report.underflows == 2);
    const Cube back = readBack(folder / "a.exr");
    for (size_t i = 0; i < cube.values.size(); ++i)
        REQUIRE(back.values[i] == static_cast<float>(half(cube.values[i])));
}

TEST_CASE("the same cube gives the same bytes, whatever the strips") {
    const Folder folder;
    const Cube cube = sampleCube(40, 100, ascending(400, 10, 8));
    writeStrips(*createExr(folder / "a.exr", cube.info, {}), cube, {100});
    writeStrips(*createExr(folder / "b.exr", cube.info, {}), cube, {1, 2, 33});
    CHECK(bytesOf(folder / "a.exr") == bytesOf(folder / "b.exr"));
}
