// PNG files as libpng writes them, with the chunks about colour that are asked for.
#pragma once

#include <png.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spectrad::test {

struct PngForm {
    int bits = 8;      ///< 8 or 16; 1 of a grey picture
    int channels = 1;  ///< 1 grey, 2 with alpha, 3 RGB, 4 RGBA
    bool interlaced = false;
    std::optional<double> gamma = {};  ///< of a gAMA chunk: the file's exponent, 1 for linear values
    std::optional<std::array<double, 8>> chromaticities = {};  ///< cHRM: x, y of white, red, green, blue
    std::optional<std::array<std::uint8_t, 2>> codes = {};     ///< cICP: primaries and transfer
    std::string profile = {};                                  ///< iCCP
};

/// `value(x, y, channel)`, as it shall stand in the file.
inline std::string pngOf(int width, int height, const PngForm& form,
                         const std::function<int(int, int, int)>& value) {
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop head = png_create_info_struct(png);
    png_set_write_fn(
        png, &bytes,
        [](png_structp out, png_bytep data, size_t count) {
            static_cast<std::string*>(png_get_io_ptr(out))->append(reinterpret_cast<char*>(data), count);
        },
        nullptr);
    const int types[]{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                      PNG_COLOR_TYPE_RGB_ALPHA};
    png_set_IHDR(png, head, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), form.bits,
                 types[form.channels - 1], form.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (form.gamma) png_set_gAMA(png, head, *form.gamma);
    if (const auto& xy = form.chromaticities)
        png_set_cHRM(png, head, (*xy)[0], (*xy)[1], (*xy)[2], (*xy)[3], (*xy)[4], (*xy)[5], (*xy)[6],
                     (*xy)[7]);
    if (!form.profile.empty())
        png_set_iCCP(png, head, "profile", PNG_COMPRESSION_TYPE_BASE,
                     reinterpret_cast<png_const_bytep>(form.profile.data()),
                     static_cast<png_uint_32>(form.profile.size()));
    std::array<png_byte, 4> says{0, 0, 0, 1};
    png_unknown_chunk cicp{{'c', 'I', 'C', 'P', 0}, says.data(), says.size(), PNG_HAVE_IHDR};
    if (form.codes) {
        std::copy(form.codes->begin(), form.codes->end(), says.begin());
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, cicp.name, 1);
        png_set_unknown_chunks(png, head, &cicp, 1);
    }
    std::vector<std::vector<png_byte>> rows;
    for (int y = 0; y < height; ++y) {
        std::vector<png_byte>& row = rows.emplace_back();
        for (int i = 0; i < width * form.channels; ++i) {
            const int v = value(i / form.channels, y, i % form.channels);
            if (form.bits == 16) row.push_back(static_cast<png_byte>(v >> 8));
            if (form.bits >= 8)
                row.push_back(static_cast<png_byte>(v & 255));
            else {
                if (i % 8 == 0) row.push_back(0);
                row.back() = static_cast<png_byte>(row.back() | (v & 1) << (7 - i % 8));
            }
        }
    }
    std::vector<png_bytep> pointers;
    for (std::vector<png_byte>& row : rows)
        pointers.push_back(row.data());
    png_set_rows(png, head, pointers.data());
    png_write_png(png, head, PNG_TRANSFORM_IDENTITY, nullptr);
    png_destroy_write_struct(&png, &head);
    return bytes;
}

}  // namespace spectrad::test
