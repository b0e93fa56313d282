// The bispectral part of the spectral EXR layout.
#include "image/bispectral.h"

#include "image/channel_names.h"
#include "support/bispectral_exr.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace spectrad;
using test::writeBispectral;

namespace {

double valueOf(const std::vector<BispectralCell>& cells, double in, double out) {
    for (const BispectralCell& cell : cells)
        if (cell.inNm == in && cell.outNm == out) return cell.value;
    FAIL("no cell " << in << " -> " << out);
    return 0;
}

std::string refusal(const std::filesystem::path& path) {
    try {
        (void)readBispectral(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "not refused";
}

}  // namespace

TEST_CASE("a bispectral EXR comes back cell by cell, in before out, the diagonal under one wavelength") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "m.exr";
    writeBispectral(path, {{400, 400, 0.5}, {400, 420, 0.25}, {420, 420, 0.75}, {420, 400, -0.125}});
    const auto cells = readBispectral(path);
    REQUIRE(cells.size() == 4);
    CHECK(valueOf(cells, 400, 400) == 0.5);
    CHECK(valueOf(cells, 400, 420) == 0.25);
    CHECK(valueOf(cells, 420, 420) == 0.75);
    CHECK(valueOf(cells, 420, 400) == -0.125);
}

TEST_CASE("a patch of many pixels is its mean, so that signed noise goes out") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "m.exr";
    writeBispectral(path, {{400, 400, 0.5}, {400, 420, 0.0078125}}, 64, 0.25F);
    const auto cells = readBispectral(path);
    CHECK(valueOf(cells, 400, 420) == 0.0078125);
}

TEST_CASE("a file without bispectral channels, damaged, or with one cell twice is refused in one line") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "m.exr";
    writeBispectral(path, {{400, 400, 0.5}, {420, 420, 0.5}});
    CHECK_THAT(refusal(path), Catch::Contains("m.exr") && Catch::Contains("no bispectral channels"));
    writeBispectral(path, {{400, 400, 0.5}, {400, 420, std::numeric_limits<double>::infinity()}});
    CHECK_THAT(refusal(path), Catch::Contains("T.400,000000nm.420,000000nm") && Catch::Contains("finite"));
    // 500 nm, once in nanometres and once in micrometres.
    Imf::Header header(1, 1);
    Imf::FrameBuffer frame;
    float value = 0.5F;
    for (const char* name : {"T.500,0nm.600,0nm", "T.0,5um.600,0nm"}) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&value), 4, 4));
    }
    {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(1);
    }
    CHECK_THAT(refusal(path), Catch::Contains("same two wavelengths"));
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
    CHECK_THAT(refusal(path), Catch::Contains("m.exr"));
}
