#include "base/error.h"
#include "base/files.h"
#include "image/picture.h"
#include "image/png16.h"
#include "image/png_errors.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>

namespace spectrad {

namespace {

constexpr size_t longestKeyword = 79;  // of a PNG text

/// What libpng is given while it writes; its errors jump out of C code, so nothing in here is made or grown
/// on that way but the bytes, whose growth is guarded.
struct PngOutput : PngErrors {
    std::string bytes;
};

void appendBytes(png_structp png, png_bytep data, size_t count) {
    auto& output = *static_cast<PngOutput*>(png_get_io_ptr(png));
    bool appended = true;
    try {
        output.bytes.append(reinterpret_cast<const char*>(data), count);
    } catch (const std::bad_alloc&) {
        appended = false;
    }
    if (!appended) png_error(png, "out of memory");
}

/// Before the picture's own chunks. libpng 1.6 has no name for cICP before 1.6.45, so it goes as unknown.
void markColour(png_structp png, png_infop head, const PictureColour& colour) {
    if (colour.srgb) png_set_sRGB(png, head, PNG_sRGB_INTENT_RELATIVE);
    if (colour.gamma) png_set_gAMA(png, head, 1 / *colour.gamma);
    if (colour.chromaticities) {
        const double* c = colour.chromaticities->data();
        png_set_cHRM(png, head, c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]);
    }
    if (colour.codes) {
        png_byte data[4]{(*colour.codes)[0], (*colour.codes)[1], 0, 1};  // R G B, full range
        png_unknown_chunk chunk{{'c', 'I', 'C', 'P', 0}, data, sizeof data, PNG_HAVE_IHDR};
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, chunk.name, 1);
        png_set_unknown_chunks(png, head, &chunk, 1);
    }
}

struct PngLayout {
    int width, height, channels;
    int bits = 8, significant = 8;  ///< of a value, and how many of them count
};

/// False after an error. Holds no object with a destructor: libpng leaves it by longjmp.
bool encode(png_structp png, png_infop head, const PngLayout& layout, png_bytepp rows, png_textp texts,
            int textCount, const PictureColour& colour) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    const int type = layout.channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : layout.channels == 3 ? PNG_COLOR_TYPE_RGB
                                            : PNG_COLOR_TYPE_RGB_ALPHA;
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(png, head, static_cast<png_uint_32>(layout.width), static_cast<png_uint_32>(layout.height),
                 layout.bits, type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    markColour(png, head, colour);
    if (layout.significant < layout.bits) {
        const auto bits = static_cast<png_byte>(layout.significant);
        const png_color_8 significant{bits, bits, bits, bits, bits};
        png_set_sBIT(png, head, &significant);
    }
    if (textCount > 0) png_set_text(png, head, texts, textCount);
    png_set_rows(png, head, rows);
    const bool swap = layout.bits == 16 && std::endian::native == std::endian::little;
    png_write_png(png, head, swap ? PNG_TRANSFORM_SWAP_ENDIAN : PNG_TRANSFORM_IDENTITY, nullptr);
    return true;
}

bool isAscii(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128; });
}

std::vector<png_text> pngTexts(const std::map<std::string, std::string>& text, const SourceLocation& where) {
    std::vector<png_text> texts;
    for (const auto& [key, value] : text) {
        if (key.empty() || key.size() > longestKeyword || !isAscii(key))
            throw InputError(
                where, fmt::format("'{}' cannot name a text of a PNG (allowed: 1 to {} ASCII characters)",
                                   key, longestKeyword));
        png_text entry{};
        entry.compression = isAscii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        entry.key = const_cast<char*>(key.c_str());  // libpng copies both
        entry.text = const_cast<char*>(value.c_str());
        (isAscii(value) ? entry.text_length : entry.itxt_length) = value.size();
        texts.push_back(entry);
    }
    return texts;
}

void write(const std::filesystem::path& target, const PngLayout& layout, const void* values,
           const std::map<std::string, std::string>& text, const PictureColour& colour) {
    std::vector<png_text> texts = pngTexts(text, {target.string()});
    std::vector<png_bytep> rows;
    const size_t rowBytes = static_cast<size_t>(layout.width) * static_cast<size_t>(layout.channels) *
                            static_cast<size_t>(layout.bits / 8);
    for (int y = 0; y < layout.height; ++y)
        rows.push_back(static_cast<png_bytep>(const_cast<void*>(values)) + static_cast<size_t>(y) * rowBytes);

    PngOutput output;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, static_cast<PngErrors*>(&output),
                                              keepPngError, keepPngWarning);
    png_infop head = png ? png_create_info_struct(png) : nullptr;
    bool encoded = false;
    if (head) {
        png_set_write_fn(png, &output, appendBytes, nullptr);
        encoded =
            encode(png, head, layout, rows.data(), texts.data(), static_cast<int>(texts.size()), colour);
    }
    png_destroy_write_struct(&png, &head);
    if (!encoded)
        throw MachineError("cannot write '" + target.string() +
                           "': " + (output.error.empty() ? "out of memory" : output.error));
    writeFile(target, output.bytes);
}

}  // namespace

void writePng(const std::filesystem::path& target, const Picture8& picture,
              const std::map<std::string, std::string>& text, const PictureColour& colour) {
    const bool channelsFit = picture.channels == 1 || picture.channels == 3 || picture.channels == 4;
    const size_t rowBytes =
        static_cast<size_t>(std::max(picture.width, 0)) * static_cast<size_t>(std::max(picture.channels, 0));
    if (picture.width < 1 || picture.height < 1 || !channelsFit ||
        picture.pixels.size() != rowBytes * static_cast<size_t>(picture.height))
        throw InputError(
            {target.string()},
            fmt::format("no PNG of {}x{} pixels with {} channels from {} bytes (allowed: 1, 3, 4 channels)",
                        picture.width, picture.height, picture.channels, picture.pixels.size()));
    write(target, {picture.width, picture.height, picture.channels}, picture.pixels.data(), text, colour);
}

void writePng16(const std::filesystem::path& target, const Picture16& picture,
                const std::map<std::string, std::string>& text) {
    const size_t values = static_cast<size_t>(std::max(picture.width, 0)) *
                          static_cast<size_t>(std::max(picture.height, 0)) *
                          static_cast<size_t>(std::max(picture.channels, 0));
    if (picture.width < 1 || picture.height < 1 || (picture.channels != 1 && picture.channels != 3) ||
        picture.pixels.size() != values || picture.bits < 1 || picture.bits > 16)
        throw InputError(
            {target.string()},
            fmt::format("no 16-bit PNG of {}x{} pixels with {} channels of {} bits from {} values "
                        "(allowed: 1 or 3 channels)",
                        picture.width, picture.height, picture.channels, picture.bits,
                        picture.pixels.size()));
    write(target, {picture.width, picture.height, picture.channels, 16, picture.bits}, picture.pixels.data(),
          text, {.gamma = 1});
}

}  // namespace spectrad
