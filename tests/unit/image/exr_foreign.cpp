// Files as other programs write them, made with OpenEXR itself.
#include "samples.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>
#include <catch2/catch.hpp>

#include <deque>
#include <half.h>

using namespace spectrad;
using namespace spectrad::test;
using Catch::Matchers::Contains;

namespace {

/// An image whose channels each have one value (+ x·0.5 + y), of any pixel type.
class ForeignFile {
  public:
    explicit ForeignFile(Imath::Box2i window = {{0, 0}, {3, 2}}) : header_(window, window), window_(window) {}

    ForeignFile& add(const std::string& name, float value, Imf::PixelType type = Imf::FLOAT) {
        header_.channels().insert(name, Imf::Channel(type));
        const int width = window_.max.x - window_.min.x + 1, height = window_.max.y - window_.min.y + 1;
        std::vector<char>& pixels = planes_.emplace_back(static_cast<size_t>(width * height) * 4);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float v = value + 0.5f * static_cast<float>(x) + static_cast<float>(y);
                char* at = pixels.data() + 4 * (y * width + x);
                if (type == Imf::FLOAT) *reinterpret_cast<float*>(at) = v;
                if (type == Imf::HALF) *reinterpret_cast<half*>(at) = half(v);
                if (type == Imf::UINT) *reinterpret_cast<unsigned*>(at) = static_cast<unsigned>(v);
            }
        frame_.insert(name,
                      Imf::Slice::Make(type, pixels.data(), window_, 4, 4 * static_cast<size_t>(width)));
        return *this;
    }
    ForeignFile& attribute(const char* name, const char* value) {
        header_.insert(name, Imf::StringAttribute(value));
        return *this;
    }
    Imf::Header& header() { return header_; }

    void write(const std::filesystem::path& path) {
        Imf::OutputFile file(path.c_str(), header_);
        file.setFrameBuffer(frame_);
        file.writePixels(window_.max.y - window_.min.y + 1);
    }
    void writeTiled(const std::filesystem::path& path) {
        header_.setTileDescription(Imf::TileDescription(2, 2, Imf::ONE_LEVEL));
        Imf::TiledOutputFile file(path.c_str(), header_);
        file.setFrameBuffer(frame_);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    }
    [[nodiscard]] const Imf::FrameBuffer& frame() const { return frame_; }

  private:
    Imf::Header header_;
    Imath::Box2i window_;
    std::deque<std::vector<char>> planes_;
    Imf::FrameBuffer frame_;
};

struct ReadCube {
    Cube cube;
    std::string notes;
};

ReadCube read(const std::filesystem::path& path) {
    Notes notes;
    ReadCube result{readCube(path, notes), {}};
    for (const std::string& line : notes.lines())
        result.notes += line + "\n";
    return result;
}

}  // namespace

TEST_CASE("bands are sorted by wavelength, whatever their names' order, unit and pixel type") {
    const Folder folder;
    ForeignFile file;
    file.add("S0.599,584916THz", 5)
        .add("S0.1000nm", 10, Imf::UINT)
        .add("S0.0,9um", 9, Imf::HALF)
        .add("S0.400,125nm", 4);
    file.add("R", 1).add("G", 1, Imf::HALF).add("A", 1).add("Z", 3).add("S1.nm", 2);
    file.attribute("spectralLayoutVersion", "1.0").attribute("emissiveUnits", "W.m^-2.sr^-1.nm^-1");
    const bool tiled = GENERATE(false, true);
    tiled ? file.writeTiled(folder / "a.exr") : file.write(folder / "a.exr");
    const auto [cube, notes] = read(folder / "a.exr");
    REQUIRE(cube.info.wavelengths.size() == 4);
    CHECK(cube.info.wavelengths.nm[0] == 400.125);
    CHECK(cube.info.wavelengths.nm[1] == Approx(500).epsilon(1e-15));
    CHECK(cube.info.wavelengths.nm[2] == 900);
    CHECK(cube.info.wavelengths.nm[3] == 1000);
    CHECK(cube.info.wavelengths.projection == Projection::point);
    CHECK_FALSE(cube.info.projectionStated);
    CHECK(cube.info.kind == CubeKind::radiance);
    for (size_t b = 0; b < 3; ++b)
        CHECK(cube.row(2, b)[3] == std::vector<float>{4, 5, 9}[b] + 3.5f);
    CHECK(cube.row(2, 3)[3] == 13);  // uint dropped the half
    CHECK(notes.empty());
}

TEST_CASE("absent version and unknown units are noted, and the file is read") {
    const Folder folder;
    ForeignFile().add("S0.500nm", 5).attribute("emissiveUnits", "J.m^-2").write(folder / "a.exr");
    const auto [cube, notes] = read(folder / "a.exr");
    CHECK(cube.row(0, 0)[0] == 5);
    CHECK_THAT(notes, Contains("spectralLayoutVersion") && Contains("J.m^-2"));
}

TEST_CASE("the data window's pixels are the image, wherever it lies") {
    const Folder folder;
    ForeignFile file({{-3, 5}, {-1, 9}});
    file.add("T.500nm", 5).attribute("spectralLayoutVersion", "1.0");
    file.header().displayWindow() = {{0, 0}, {9, 9}};
    const bool tiled = GENERATE(false, true);
    if (!tiled) file.header().lineOrder() = Imf::DECREASING_Y;
    tiled ? file.writeTiled(folder / "a.exr") : file.write(folder / "a.exr");
    const auto [cube, notes] = read(folder / "a.exr");
    CHECK(cube.info.width == 3);
    CHECK(cube.info.height == 5);
    CHECK(cube.info.kind == CubeKind::reflectance);
    CHECK(cube.row(4, 0)[2] == 10);
    CHECK_THAT(notes, Contains("data window"));
}

TEST_CASE("of several quantities S0 is read, and what is left aside is said") {
    const Folder folder;
    ForeignFile file;
    file.add("S0.500nm", 5).add("T.500nm", 1).add("S1.500nm", 2).add("S2.500nm", 2).add("S3.500nm", 2);
    file.add("T.400nm.500nm", 7).add("S0.500.0nm", 8);
    file.attribute("spectralLayoutVersion", "1.0").attribute("emissiveUnits", "W.m^-2.sr^-1");
    file.write(folder / "a.exr");
    const auto [cube, notes] = read(folder / "a.exr");
    CHECK(cube.info.wavelengths.nm == std::vector<double>{500});
    CHECK(cube.row(0, 0)[0] == 5);
    CHECK_THAT(notes, Contains("S0 is read") && Contains("Stokes") && Contains("reradiation") &&
                          Contains("S0.500.0nm"));
}

TEST_CASE("bands in a group are read where the file has no others") {
    const Folder folder;
    ForeignFile().add("left.S0.500nm", 5).add("right.S0.500nm", 6).add("R", 1).write(folder / "a.exr");
    const auto [cube, notes] = read(folder / "a.exr");
    CHECK(cube.row(0, 0)[0] == 5);
    CHECK_THAT(notes, Contains("'left'") && Contains("2 spectral groups"));
}

TEST_CASE("the part with bands is read, wherever it is among the parts") {
    const Folder folder;
    ForeignFile preview, bands;
    preview.add("R", 1).add("G", 1).add("B", 1);
    bands.add("S0.500nm", 5);
    std::vector<Imf::Header> headers{preview.header(), bands.header()};
    for (size_t i = 0; i < 2; ++i) {
        headers[i].setName(std::to_string(i));
        headers[i].setType(Imf::SCANLINEIMAGE);
    }
    {
        Imf::MultiPartOutputFile file((folder / "a.exr").c_str(), headers.data(), 2);
        Imf::OutputPart first(file, 0), second(file, 1);
        first.setFrameBuffer(preview.frame());
        first.writePixels(3);
        second.setFrameBuffer(bands.frame());
        second.writePixels(3);
    }
    CHECK(read(folder / "a.exr").cube.row(2, 0)[3] == 8.5f);
}

TEST_CASE("what cannot be a cube is refused in one line") {
    const Folder folder;
    const auto refused = [&](ForeignFile file, const char* reason) {
        file.write(folder / "a.exr");
        Notes notes;
        CHECK_THROWS_WITH(readCube(folder / "a.exr", notes), Contains(reason) && !Contains("\n"));
        CHECK_THROWS_AS(readCubeInfo(folder / "a.exr", notes), InputError);
    };
    refused(ForeignFile().add("S0.500nm", 1).add("S0.599,584916THz", 2), "both 500");
    refused(ForeignFile().add("S0.500nm", 1).add("S0.0500,0nm", 2), "S0.0500,0nm");
    refused(ForeignFile().add("S0.0nm", 1), "S0.0nm");
    refused(ForeignFile().add("S0.0THz", 1), "S0.0THz");
    refused(ForeignFile().add("S0.1e99999nm", 1), "S0.1e99999nm");
    refused(ForeignFile().add("R", 1).add("S0.nm", 1), "no spectral channels");
    refused(ForeignFile().add("S1.500nm", 1), "no spectral channels");
    refused(ForeignFile().add("S0.500nm", 1).attribute("spectrad:projection", "hat"), "hat");
    refused(ForeignFile().add("S0.500nm", 1).attribute("spectrad:step", "-5"), "-5");
    refused(ForeignFile().add("S0.500nm", 1).attribute("spectrad:quantity", "reflectance"), "reflectance");
}

TEST_CASE("values that are not finite are refused on reading, with pixel and band") {
    const Folder folder;
    ForeignFile().add("S0.500nm", std::numeric_limits<float>::quiet_NaN()).write(folder / "a.exr");
    Notes notes;
    CHECK_THROWS_WITH(readCube(folder / "a.exr", notes), Contains("pixel 0,0, band 500 nm"));
}

TEST_CASE("exact wavelengths that no longer belong to the channels give way to the names") {
    const Folder folder;
    ForeignFile file;
    file.add("S0.500,000000nm", 1).add("S0.600,000000nm", 2);
    const char* list = GENERATE("500", "500 600 700", "500.1 600", "600 500", "words", "");
    file.attribute("spectrad:wavelengths", list).write(folder / "a.exr");
    const auto [cube, notes] = read(folder / "a.exr");
    CHECK(cube.info.wavelengths.nm == std::vector<double>{500, 600});
    CHECK_THAT(notes, Contains("spectrad:wavelengths"));
}
