#include "image/picture_values.h"

#include "base/error.h"
#include "base/files.h"
#include "image/png_errors.h"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>

namespace spectrad {

namespace {

/// What libpng is given while it reads; its errors jump out of C code, so nothing in here is made or grown on
/// that way but the message.
struct PngInput : PngErrors {
    std::string_view left;
};

void takeBytes(png_structp png, png_bytep data, size_t count) {
    auto& input = *static_cast<PngInput*>(png_get_io_ptr(png));
    if (count > input.left.size()) png_error(png, "the file ends early");
    input.left.copy(reinterpret_cast<char*>(data), count);
    input.left.remove_prefix(count);
}

/// libpng 1.6 knows no cICP before 1.6.45: it comes as an unknown chunk, from later ones as well.
constexpr std::array<png_byte, 5> cicp{'c', 'I', 'C', 'P', 0};

/// False after an error, as readRows(). Both hold no object with a destructor: libpng leaves them by longjmp.
bool readHeader(png_structp png, png_infop head) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, cicp.data(), 1);
    png_read_info(png, head);
    png_set_expand(png);
    if (std::endian::native == std::endian::little) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, head);
    return true;
}

bool readRows(png_structp png, png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
}

/// What chunks before the pixels say.
PictureColour colourOf(png_structp png, png_infop head, std::string& misread) {
    PictureColour colour;
    png_unknown_chunkp unknown = nullptr;
    const int count = png_get_unknown_chunks(png, head, &unknown);
    for (int i = 0; i < count; ++i)
        // Primaries, transfer, then 0: no matrix, and 1: full range.
        if (std::memcmp(unknown[i].name, cicp.data(), cicp.size()) == 0) {
            if (unknown[i].size == 4 && unknown[i].data[2] == 0 && unknown[i].data[3] == 1)
                colour.codes = {unknown[i].data[0], unknown[i].data[1]};
            else
                misread = "cICP: not red, green and blue of full range";
        }
    int intent = 0;
    colour.srgb = png_get_sRGB(png, head, &intent) != 0;
    std::array<double, 8> xy{};
    if (png_get_cHRM(png, head, &xy[0], &xy[1], &xy[2], &xy[3], &xy[4], &xy[5], &xy[6], &xy[7]) != 0)
        colour.chromaticities = xy;
    double signalOfLight = 0;
    if (png_get_gAMA(png, head, &signalOfLight) != 0 && signalOfLight > 0) colour.gamma = 1 / signalOfLight;
    return colour;
}

std::string profileOf(png_structp png, png_infop head) {
    png_charp name = nullptr;
    png_bytep bytes = nullptr;
    png_uint_32 size = 0;
    int compression = 0;
    if (png_get_iCCP(png, head, &name, &compression, &bytes, &size) == 0) return {};
    return {reinterpret_cast<const char*>(bytes), size};
}

PictureValues decodePngValues(std::string_view bytes, const std::string& name) {
    PngInput input;
    input.left = bytes;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, static_cast<PngErrors*>(&input),
                                             keepPngError, keepPngWarning);
    png_infop head = png ? png_create_info_struct(png) : nullptr;
    const auto fail = [&](const std::string& message) {
        png_destroy_read_struct(&png, &head, nullptr);
        throw InputError({name}, message);
    };
    const auto failRead = [&] {
        fail("cannot be read as PNG: " + (input.error.empty() ? "out of memory" : input.error));
    };
    if (!head) failRead();
    png_set_read_fn(png, &input, takeBytes);
    if (!readHeader(png, head)) failRead();
    std::string misread = input.colourWarning;
    const PictureColour colour = colourOf(png, head, misread);
    std::string profile = colour.srgb ? std::string() : profileOf(png, head);
    // libpng also grumbles at profiles that it keeps.
    if (colour.srgb || !profile.empty()) misread.clear();
    PictureValues picture{static_cast<int>(png_get_image_width(png, head)),
                          static_cast<int>(png_get_image_height(png, head)),
                          png_get_channels(png, head),
                          static_cast<std::uint16_t>(png_get_bit_depth(png, head) == 16 ? 65535 : 255),
                          {},
                          colour,
                          std::move(profile),
                          std::move(misread)};
    const size_t rowBytes = png_get_rowbytes(png, head), height = static_cast<size_t>(picture.height);
    // deflate makes at most 1032 bytes of one: a damaged header claims more.
    if (rowBytes * height / 4096 > bytes.size())
        fail(fmt::format("damaged: {}x{} pixels cannot be in {} bytes", picture.width, picture.height,
                         bytes.size()));
    std::vector<png_byte> narrow;
    if (picture.most == 255) narrow.resize(rowBytes * height);
    picture.values.resize(static_cast<size_t>(picture.width) * height *
                          static_cast<size_t>(picture.channels));
    png_bytep first =
        picture.most == 255 ? narrow.data() : reinterpret_cast<png_bytep>(picture.values.data());
    std::vector<png_bytep> rows;
    for (size_t y = 0; y < height; ++y)
        rows.push_back(first + y * rowBytes);
    if (!readRows(png, rows.data())) failRead();
    png_destroy_read_struct(&png, &head, nullptr);
    if (picture.most == 255) picture.values.assign(narrow.begin(), narrow.end());
    return picture;
}

}  // namespace

PictureValues decodeValues(std::string_view bytes, const std::string& name) {
    return bytes.starts_with("\xff\xd8\xff") ? decodeJpeg(bytes, name) : decodePngValues(bytes, name);
}

PictureValues readValues(const std::filesystem::path& path) {
    return decodeValues(readFile(path), path.string());
}

}  // namespace spectrad
