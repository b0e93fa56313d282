// Whatever is done to a file, reading it ends with a cube or with one InputError.
#include "image/picture.h"
#include "samples.h"
#include "support/jpeg_bytes.h"
#include "support/read_picture.h"

#include <catch2/catch.hpp>

using namespace spectrad;
using namespace spectrad::test;

namespace {

/// True if the file is read; an InputError is fine, anything else fails the test.
bool readsOrRefuses(const std::filesystem::path& path) {
    Notes notes;
    bool read = false;
    try {
        (void)readCubeInfo(path, notes);
        const Cube cube = readCube(path, notes);
        for (float value : cube.values)
            REQUIRE(std::isfinite(value));
        read = true;
    } catch (const InputError& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        CHECK(std::string(error.what()).find(path.stem().string()) != std::string::npos);
    }
    return read;
}

std::string cubeBytes(const Folder& folder, const char* name, Compression compression) {
    const Cube cube = sampleCube(9, 40, {400, 500, 600});
    writeStrips(*createExr(folder / name, cube.info, {compression, false}), cube);
    return bytesOf(folder / name);
}

}  // namespace

TEST_CASE("a truncated EXR is an error at every length") {
    const Compression compression =
        GENERATE(Compression::none, Compression::zips, Compression::zip, Compression::piz);
    const Folder folder;
    const std::string whole = cubeBytes(folder, "a.exr", compression);
    CHECK(readsOrRefuses(folder / "a.exr"));
    for (size_t length = 0; length < whole.size(); length += length < 1500 ? 7 : 97) {
        INFO(length << " of " << whole.size());
        writeBytes(folder / "a.exr", whole.substr(0, length));
        CHECK_FALSE(readsOrRefuses(folder / "a.exr"));
    }
}

TEST_CASE("an EXR with wrong bytes is a cube or an error") {
    const Compression compression = GENERATE(Compression::none, Compression::zip, Compression::piz);
    const Folder folder;
    const std::string whole = cubeBytes(folder, "a.exr", compression);
    std::mt19937 random(1);
    for (int i = 0; i < 400; ++i) {
        std::string bytes = whole;
        // Half of the damage in the header, where sizes and types are.
        const size_t range = i % 2 ? bytes.size() : std::min<size_t>(bytes.size(), 1400);
        for (int n = 0; n < 1 + i % 4; ++n)
            bytes[random() % range] = static_cast<char>(random());
        writeBytes(folder / "a.exr", bytes);
        readsOrRefuses(folder / "a.exr");
    }
}

TEST_CASE("a header that claims more than its file can hold is refused before memory is taken") {
    const Folder folder;
    std::string bytes = cubeBytes(folder, "a.exr", Compression::none);
    const size_t window = bytes.find("dataWindow");
    REQUIRE(window != std::string::npos);
    const size_t box = window + std::string("dataWindow").size() + 1 + std::string("box2i").size() + 1 + 4;
    bytes.replace(box + 8, 4, std::string("\xff\xff\x0f\x00", 4));   // x to 1048575
    bytes.replace(box + 12, 4, std::string("\x27\x00\x00\x00", 4));  // y to 39
    writeBytes(folder / "a.exr", bytes);
    CHECK_FALSE(readsOrRefuses(folder / "a.exr"));
}

TEST_CASE("an attribute that claims more than the file is refused before memory is taken") {
    const Folder folder;
    std::string bytes = cubeBytes(folder, "a.exr", Compression::none);
    const std::string comments("comments\0string\0", 16);
    REQUIRE(bytes.find(comments) != std::string::npos);
    bytes.replace(bytes.find(comments) + comments.size(), 4, "\xff\xff\xff\x7f");
    writeBytes(folder / "a.exr", bytes);
    Notes notes;
    CHECK_THROWS_WITH(readCubeInfo(folder / "a.exr", notes),
                      Catch::Matchers::Contains("'comments' claims 2147483647 bytes"));
}

TEST_CASE("a truncated or damaged ENVI raster is a cube or an error") {
    const Folder folder;
    const Cube cube = sampleCube(5, 4, {400, 500, 600});
    writeStrips(*createEnvi(folder / "a.img", cube.info), cube);
    const std::string header = bytesOf(folder / "a.hdr"), data = bytesOf(folder / "a.img");
    CHECK(readsOrRefuses(folder / "a.img"));
    for (size_t length = 0; length < data.size(); length += 11) {
        writeBytes(folder / "a.img", data.substr(0, length));
        CHECK_FALSE(readsOrRefuses(folder / "a.img"));
        CHECK_FALSE(readsOrRefuses(folder / "a.hdr"));
    }
    writeBytes(folder / "a.img", data);
    for (size_t length = 0; length < header.size(); ++length) {
        writeBytes(folder / "a.hdr", header.substr(0, length));
        readsOrRefuses(folder / "a.hdr");
        readsOrRefuses(folder / "a.img");
    }
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i) {
        std::string bytes = header;
        for (int n = 0; n < 1 + i % 4; ++n)
            bytes[random() % bytes.size()] = static_cast<char>(random() % 128);
        writeBytes(folder / "a.hdr", bytes);
        readsOrRefuses(folder / "a.img");
    }
}

TEST_CASE("other files, folders and absent ones are refused and not taken for cubes") {
    const Folder folder;
    writeBytes(folder / "a.txt", "no image");
    writeBytes(folder / "empty", "");
    std::filesystem::create_directory(folder / "sub.exr");
    for (const char* name : {"a.txt", "empty", "sub.exr", "absent.exr"}) {
        CHECK_FALSE(looksLikeCube(folder / name));
        Notes notes;
        CHECK_THROWS_AS(readCube(folder / name, notes), InputError);
        CHECK_THROWS_AS(readCubeInfo(folder / name, notes), InputError);
    }
}

TEST_CASE("a truncated PNG is an error at every length") {
    const Folder folder;
    writePng(folder / "a.png", {3, 2, 3, std::vector<std::uint8_t>(18, 7)});
    const std::string whole = bytesOf(folder / "a.png");
    for (size_t length = 0; length + 12 < whole.size();
         ++length) {  // without its last, empty chunk it is readable
        writeBytes(folder / "a.png", whole.substr(0, length));
        CHECK_THROWS_AS(readPicture8(folder / "a.png"), InputError);
    }
}

TEST_CASE("a truncated JPEG is an error at every length, of one line with its name") {
    const std::string whole = jpegOf(24, 16, 3, [](int x, int y, int c) { return 10 * x + 5 * y + 40 * c; });
    CHECK(decodeJpeg(whole, "a.jpg").width == 24);
    for (size_t length = 0; length + 2 < whole.size(); ++length) {  // the last two say that this is the end
        try {
            (void)decodeJpeg(whole.substr(0, length), "a.jpg");
            FAIL("read at " << length << " of " << whole.size() << " bytes");
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).find("a.jpg") == 0);
            CHECK(std::string(error.what()).find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("a JPEG with wrong bytes is a picture or an error") {
    const std::string whole = jpegOf(16, 16, 3, [](int x, int y, int) { return 8 * x + 8 * y; });
    size_t refused = 0;
    for (size_t at = 0; at < whole.size(); ++at) {
        std::string altered = whole;
        altered[at] = static_cast<char>(~altered[at]);
        try {
            (void)decodeJpeg(altered, "a.jpg");
        } catch (const InputError&) {
            ++refused;
        }
    }
    CHECK(refused > 0);
}

TEST_CASE("a JPEG whose header claims more than its file can hold is refused before memory is taken") {
    std::string bytes = jpegOf(16, 16, 1, [](int, int, int) { return 128; });
    const size_t frame = bytes.find("\xff\xc0");
    REQUIRE(frame != std::string::npos);
    for (size_t at : {frame + 5, frame + 6, frame + 7, frame + 8})  // height and width
        bytes[at] = static_cast<char>(0xf0);
    CHECK_THROWS_WITH(decodeJpeg(bytes, "a.jpg"), Catch::Matchers::Contains("cannot be in"));
}
