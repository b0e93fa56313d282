#include "image/picture.h"
#include "image/picture_values.h"
#include "samples.h"
#include "support/jpeg_bytes.h"
#include "support/png_bytes.h"
#include "support/read_picture.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <catch2/catch.hpp>

#include <zlib.h>

using namespace spectrad;
using namespace spectrad::test;
using Catch::Matchers::Contains;

TEST_CASE("a PNG comes back with the same pixels, in grey, RGB and RGBA") {
    const int channels = GENERATE(1, 3, 4);
    const Folder folder;
    Picture8 picture{7, 5, channels, std::vector<std::uint8_t>(static_cast<size_t>(35 * channels))};
    for (size_t i = 0; i < picture.pixels.size(); ++i)
        picture.pixels[i] = static_cast<std::uint8_t>(i * 37);
    writePng(folder / "a.png", picture);
    const Picture8 back = readPicture8(folder / "a.png");
    CHECK(back.width == 7);
    CHECK(back.height == 5);
    CHECK(back.channels == channels);
    CHECK(back.pixels == picture.pixels);
    CHECK(folder.files() == 1);
}

TEST_CASE("a JPEG's pixels come back within what its best quality keeps, in grey and RGB") {
    const int channels = GENERATE(1, 3);
    const auto value = [](int x, int y, int c) { return 20 + 6 * x + 3 * y + 20 * c; };
    const PictureValues back = decodeValues(jpegOf(17, 11, channels, value), "a.jpg");
    REQUIRE(back.width == 17);
    REQUIRE(back.height == 11);
    REQUIRE(back.channels == channels);
    int worst = 0;
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 17; ++x)
            for (int c = 0; c < channels; ++c)
                worst = std::max(
                    worst,
                    std::abs(back.values[static_cast<size_t>((y * 17 + x) * channels + c)] - value(x, y, c)));
    CHECK(worst <= 2);
}

TEST_CASE("a JPEG of four inks is refused; a picture is what its name and its bytes say") {
    const std::string inks = jpegOf(8, 8, 4, [](int, int, int) { return 100; });
    CHECK_THROWS_WITH(decodeJpeg(inks, "a.jpg"), Contains("a.jpg") && Contains("CMYK"));
    CHECK(isPictureName("a.PNG"));
    CHECK(isPictureName("b/c.jpeg"));
    CHECK_FALSE(isPictureName("cube.exr"));
    CHECK_FALSE(isPictureName("png"));
}

TEST_CASE("a map's values are those of its file, of 8 or 16 bits, whatever it says about gamma") {
    for (const int bits : {8, 16})
        for (const int channels : {1, 2, 3, 4})
            for (const std::optional<double> gamma : {std::optional<double>{}, {1.0}, {1 / 2.2}, {0.7}}) {
                const auto value = [bits](int x, int y, int c) {
                    return (bits == 8 ? 1 : 257) * (7 + 31 * x + 11 * y + 3 * c) + (bits == 8 ? 0 : x);
                };
                const PngForm form{bits, channels, channels == 3, gamma};
                const PictureValues read = decodeValues(pngOf(7, 3, form, value), "a.png");
                CAPTURE(bits, channels, gamma.value_or(0));
                REQUIRE(read.width == 7);
                REQUIRE(read.height == 3);
                REQUIRE(read.channels == channels);
                CHECK(read.most == (bits == 8 ? 255 : 65535));
                size_t different = 0;
                for (int y = 0; y < 3; ++y)
                    for (int x = 0; x < 7; ++x)
                        for (int c = 0; c < channels; ++c)
                            different += read.values[static_cast<size_t>((y * 7 + x) * channels + c)] !=
                                         value(x, y, c);
                CHECK(different == 0);
            }
    const auto bits = decodeValues(pngOf(9, 1, {1, 1}, [](int x, int, int) { return x % 2; }), "a.png");
    CHECK(bits.values == std::vector<std::uint16_t>{0, 255, 0, 255, 0, 255, 0, 255, 0});
    const PictureValues jpeg = decodeValues(jpegOf(8, 8, 1, [](int, int, int) { return 77; }), "a.jpg");
    CHECK(jpeg.most == 255);
    CHECK(jpeg.values == std::vector<std::uint16_t>(64, 77));
}

TEST_CASE("a map that is damaged is an error at every length, and one of too many pixels") {
    const std::string whole =
        pngOf(3, 2, {16, 3}, [](int x, int y, int c) { return 7919 * (x + 3 * y + c); });
    CHECK(decodeValues(whole, "a.png").width == 3);
    for (size_t length = 0; length < whole.size(); ++length)
        CHECK_THROWS_WITH(decodeValues(whole.substr(0, length), "a.png"), Contains("a.png: cannot be read"));
    // A header of 60000 x 60000 with the sum that belongs to it.
    std::string wide = whole;
    for (const size_t at : {16u, 20u})
        wide.replace(at, 4, std::string("\0\0\xea\x60", 4));
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(wide.data() + 12), 17);
    for (size_t i = 0; i < 4; ++i)
        wide[29 + i] = static_cast<char>(sum >> (24 - 8 * i) & 255);
    CHECK_THROWS_WITH(decodeValues(wide, "a.png"), Contains("cannot be in"));
}

TEST_CASE("what a PNG says of its colours is read beside its values") {
    const auto read = [](const PngForm& form) {
        return decodeValues(pngOf(4, 4, form, [](int, int, int) { return 5; }), "a.png");
    };
    const PictureColour silent = read({8, 3}).colour;
    CHECK((!silent.codes && !silent.srgb && !silent.chromaticities && !silent.gamma));
    CHECK(read({16, 3, false, 1.0}).colour.gamma.value() == Approx(1));
    CHECK(read({8, 1, false, 1 / 1.8}).colour.gamma.value() == Approx(1.8).epsilon(1e-4));
    PngForm form{8, 3};
    form.chromaticities = {{0.3457, 0.3585, 0.7347, 0.2653, 0.1596, 0.8404, 0.0366, 0.0001}};
    form.codes = {{12, 13}};
    const PictureColour all = read(form).colour;
    for (size_t i = 0; i < 8; ++i)
        CHECK(all.chromaticities.value()[i] == Approx((*form.chromaticities)[i]).margin(1e-5));
    CHECK(all.codes.value() == *form.codes);
    CHECK(silent.codes == std::nullopt);
    CHECK(read({8, 3}).misread.empty());
    std::string dark = pngOf(4, 4, {8, 3, false, 1.0}, [](int, int, int) { return 5; });
    const size_t gamma = dark.find("gAMA");
    dark.replace(gamma + 4, 4, std::string(4, '\0'));
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(dark.data() + gamma), 8);
    for (size_t i = 0; i < 4; ++i)
        dark[gamma + 8 + i] = static_cast<char>(sum >> (24 - 8 * i) & 255);
    CHECK_THAT(decodeValues(dark, "a.png").misread, Contains("gAMA"));
    const Folder folder;
    writePng(folder / "s.png", {1, 1, 3, {1, 2, 3}});
    CHECK(readValues(folder / "s.png").colour.srgb);
}

TEST_CASE("a JPEG's ICC profile is read from as many markers as it has, if none is missing") {
    std::string profile(1000, 'p');
    for (size_t i = 0; i < profile.size(); ++i)
        profile[i] = static_cast<char>(i * 7);
    const auto grey = [](int, int, int) { return 77; };
    for (const size_t size : {2000u, 1000u, 400u, 7u})
        CHECK(decodeValues(jpegOf(8, 8, 1, grey, profile, size), "a.jpg").profile == profile);
    CHECK(decodeValues(jpegOf(8, 8, 1, grey), "a.jpg").profile.empty());
    std::string broken = jpegOf(8, 8, 1, grey, profile, 400);
    broken[broken.find("ICC_PROFILE") + 12] = 9;  // the first part calls itself the ninth
    CHECK(decodeValues(broken, "a.jpg").profile.empty());
    CHECK(decodeValues(broken, "a.jpg").misread == "its ICC profile lacks parts");
    CHECK(decodeValues(jpegOf(8, 8, 1, grey), "a.jpg").misread.empty());
}

TEST_CASE("a PNG says that it is sRGB, unless it is not, and holds its texts") {
    const Folder folder;
    const Picture8 picture{1, 1, 3, {1, 2, 3}};
    writePng(folder / "a.png", picture, {{"Software", "Spectrad"}, {"Comment", "λ"}, {"Empty", ""}});
    const std::string bytes = bytesOf(folder / "a.png");
    CHECK_THAT(bytes, Contains("sRGB") && Contains("tEXt") && Contains("iTXt") && Contains("λ"));
    writePng(folder / "b.png", picture, {}, {});
    CHECK_THAT(bytesOf(folder / "b.png"), !Contains("sRGB") && !Contains("tEXt"));
    CHECK(readPicture8(folder / "b.png").pixels == picture.pixels);
}

TEST_CASE("a PNG for another display holds its code points, primaries and gamma before its pixels") {
    const Folder folder;
    const Picture8 picture{1, 1, 3, {1, 2, 3}};
    writePng(folder / "p3.png", picture, {},
             {.codes = {{12, 13}},
              .chromaticities = {{0.3127, 0.329, 0.68, 0.32, 0.265, 0.69, 0.15, 0.06}},
              .gamma = 2.2});
    const std::string bytes = bytesOf(folder / "p3.png");
    CHECK_THAT(bytes, Contains(std::string("\0\0\0\4cICP\x0c\x0d\0\1", 12)) && !Contains("sRGB"));
    CHECK(bytes.find("cICP") < bytes.find("IDAT"));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
    png_image_free(&image);
    const auto number = [&bytes](const char* chunk, size_t i) {  // 4 bytes, in 100000ths
        const auto* p = reinterpret_cast<const unsigned char*>(bytes.data() + bytes.find(chunk) + 4 + 4 * i);
        return (p[0] << 24 | p[1] << 16 | p[2] << 8 | p[3]) / 1e5;
    };
    CHECK(number("gAMA", 0) == Approx(1 / 2.2).margin(1e-5));
    CHECK(number("cHRM", 0) == Approx(0.3127));
    CHECK(number("cHRM", 2) == Approx(0.68));
    CHECK(number("cHRM", 7) == Approx(0.06));
    CHECK(readPicture8(folder / "p3.png").pixels == picture.pixels);
}

TEST_CASE("a picture that is none, or a place that cannot be written, is an error") {
    const Folder folder;
    CHECK_THROWS_AS(writePng(folder / "a.png", {2, 2, 3, std::vector<std::uint8_t>(11)}), InputError);
    CHECK_THROWS_AS(writePng(folder / "a.png", {0, 0, 3, {}}), InputError);
    CHECK_THROWS_AS(writePng(folder / "a.png", {1, 1, 2, {0, 0}}), InputError);
    CHECK_THROWS_AS(writePng(folder / "a.png", {1, 1, 1, {0}}, {{"", "x"}}), InputError);
    CHECK_THROWS_AS(writePng(folder / "none/a.png", {1, 1, 1, {0}}), MachineError);
    CHECK_THROWS_AS(readPicture8(folder / "absent.png"), InputError);
    CHECK(folder.files() == 0);
}

TEST_CASE("a detector's channels come back from their EXR bit by bit, with attributes") {
    const Folder folder;
    const std::vector<std::vector<float>> planes{{1, 2, 3, 4, 5, 6}, {0.5f, -1, 1e30f, 0, 1e-40f, 7}};
    writeChannelsExr(folder / "a.exr", 3, 2, {"X", "Y"}, planes, {{"observer", "CIE 1931"}});
    Imf::InputFile file((folder / "a.exr").c_str());
    std::vector<std::vector<float>> back(2, std::vector<float>(6));
    Imf::FrameBuffer frame;
    frame.insert("X", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(back[0].data()), 4, 12));
    frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(back[1].data()), 4, 12));
    file.setFrameBuffer(frame);
    file.readPixels(0, 1);
    CHECK(back == planes);
    CHECK(file.header().typedAttribute<Imf::StringAttribute>("observer").value() == "CIE 1931");
    CHECK(folder.files() == 1);
}

TEST_CASE("channels that are no image are refused") {
    const Folder folder;
    const std::vector<float> plane(4, 1.0f);
    CHECK_THROWS_AS(writeChannelsExr(folder / "a.exr", 2, 2, {"X"}, {}, {}), InputError);
    CHECK_THROWS_AS(writeChannelsExr(folder / "a.exr", 2, 3, {"X"}, {plane}, {}), InputError);
    CHECK_THROWS_AS(writeChannelsExr(folder / "a.exr", 2, 2, {"X", "X"}, {plane, plane}, {}), InputError);
    const std::vector<float> bad{1, 1, std::numeric_limits<float>::infinity(), 1};
    CHECK_THROWS_WITH(writeChannelsExr(folder / "a.exr", 2, 2, {"X"}, {bad}, {}),
                      Contains("pixel 0,1, channel X"));
    CHECK_THROWS_AS(writeChannelsExr(folder / "a.exr", 2, 2, {"X"}, {plane}, {{"channels", "x"}}),
                    InputError);
    CHECK(folder.files() == 0);
}
