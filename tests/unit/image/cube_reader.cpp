// Cubes read by rows: whatever the order and number of rows, the values are readCube's.
#include "image/cube_reader.h"

#include "samples.h"

#include <catch2/catch.hpp>

using namespace spectrad;
using test::Folder;

namespace {

void checkRows(const std::filesystem::path& path) {
    Notes notes;
    const Cube whole = readCube(path, notes);
    const auto reader = openCube(path, notes);
    CHECK(reader->info().wavelengths == whole.info.wavelengths);
    const size_t rowSize = whole.info.wavelengths.size() * static_cast<size_t>(whole.info.width);
    // From below to above, in strips that divide the height nowhere; the last again.
    for (const auto& [from, rows] : {std::pair{30, 10}, {17, 13}, {1, 16}, {0, 1}, {33, 7}}) {
        std::vector<float> values(rowSize * static_cast<size_t>(rows));
        reader->read(from, rows, values.data());
        CAPTURE(path.string(), from);
        CHECK(std::equal(values.begin(), values.end(), whole.row(from, 0)));
    }
}

}  // namespace

TEST_CASE("rows of an EXR are those of the whole, whatever its compression") {
    const Folder folder;
    const Cube cube = test::sampleCube(19, 40, {400, 500, 600, 700});
    const std::vector<float> preview(static_cast<size_t>(19 * 40 * 3));
    for (const Compression compression :
         {Compression::none, Compression::zips, Compression::zip, Compression::piz}) {
        const auto writer = createExr(folder / "x.exr", cube.info, {compression, false});
        writer->write(40, cube.values.data(), preview.data());
        (void)writer->finish();
        checkRows(folder / "x.exr");
    }
}

TEST_CASE("rows of an ENVI raster are those of the whole, whatever its interleave") {
    const Folder folder;
    for (const char* interleave : {"bsq", "bil", "bip"}) {
        test::writeBytes(folder / "x.hdr",
                         std::string("ENVI\nsamples = 7\nlines = 40\nbands = 3\nheader offset "
                                     "= 5\ndata type = 12\nbyte order = 0\ninterleave = ") +
                             interleave + "\nwavelength units = nm\nwavelength = {600, 500, 400}\n");
        std::string bytes = "ahead";
        for (int i = 0; i < 7 * 40 * 3; ++i) {
            bytes += static_cast<char>(i * 7 % 251);
            bytes += static_cast<char>(i % 13);
        }
        test::writeBytes(folder / "x.img", bytes);
        checkRows(folder / "x.img");
    }
}
