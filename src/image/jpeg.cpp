#include "base/error.h"
#include "base/files.h"
#include "base/text.h"
#include "image/picture_values.h"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h does not include what it needs
#include <jpeglib.h>
#include <map>
#include <string_view>
#include <vector>

namespace spectrad {

namespace {

/// What libjpeg is given while it reads; its errors jump out of C code, so nothing in here is made or grown
/// on that way.
struct JpegErrors {
    jpeg_error_mgr base{};  // first: libjpeg hands back a pointer to it
    std::jmp_buf back{};
    std::array<char, JMSG_LENGTH_MAX> message{};
};

void leave(j_common_ptr jpeg) {
    auto& errors = *reinterpret_cast<JpegErrors*>(jpeg->err);
    errors.base.format_message(jpeg, errors.message.data());
    std::longjmp(errors.back, 1);
}

void say(j_common_ptr) {}

/// Warnings are of damaged data, which libjpeg would fill up with grey.
void refuse(j_common_ptr jpeg, int level) {
    if (level < 0) leave(jpeg);
}

constexpr int profileMarker = JPEG_APP0 + 2;

/// False after an error. Holds no object with a destructor: libjpeg leaves it by longjmp.
bool readHeader(jpeg_decompress_struct& jpeg, JpegErrors& errors, const unsigned char* bytes, size_t size) {
    if (setjmp(errors.back) != 0) return false;
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, bytes, static_cast<unsigned long>(size));
    jpeg_save_markers(&jpeg, profileMarker, 0xffff);
    jpeg_read_header(&jpeg, TRUE);
    return true;
}

bool readRows(jpeg_decompress_struct& jpeg, JpegErrors& errors, unsigned char* pixels, size_t rowBytes) {
    if (setjmp(errors.back) != 0) return false;
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = pixels + size_t{jpeg.output_scanline} * rowBytes;
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

/// An ICC profile lies in as many markers as it needs, each with its number and how many there are
/// (ICC.1:2022, B.4).
void readProfile(const jpeg_decompress_struct& jpeg, PictureValues& picture) {
    constexpr std::string_view signature("ICC_PROFILE\0", 12);
    std::map<unsigned, std::string_view> parts;
    size_t count = 0;
    for (auto marker = jpeg.marker_list; marker; marker = marker->next) {
        const std::string_view data(reinterpret_cast<const char*>(marker->data), marker->data_length);
        const size_t head = signature.size() + 2;
        if (marker->marker != profileMarker || data.size() < head || !data.starts_with(signature)) continue;
        parts[static_cast<unsigned char>(data[head - 2])] = data.substr(head);
        count = static_cast<unsigned char>(data[head - 1]);
    }
    if (parts.empty()) return;
    if (parts.size() != count || parts.begin()->first != 1 || parts.rbegin()->first != count) {
        picture.misread = "its ICC profile lacks parts";
        return;
    }
    for (const auto& [number, part] : parts)
        picture.profile += part;
}

}  // namespace

PictureValues decodeJpeg(std::string_view bytes, const std::string& name) {
    jpeg_decompress_struct jpeg{};
    JpegErrors errors;
    jpeg.err = jpeg_std_error(&errors.base);
    errors.base.error_exit = leave;
    errors.base.output_message = say;
    errors.base.emit_message = refuse;
    const auto fail = [&](const std::string& message) {
        jpeg_destroy_decompress(&jpeg);
        throw InputError({name}, message);
    };
    if (!readHeader(jpeg, errors, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()))
        fail(fmt::format("cannot be read as JPEG: {}", errors.message.data()));
    if (jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK)
        fail("a JPEG of four inks (CMYK) has no colours without their profile (allowed: grey, RGB)");
    jpeg.out_color_space = jpeg.jpeg_color_space == JCS_GRAYSCALE ? JCS_GRAYSCALE : JCS_RGB;
    jpeg.dct_method = JDCT_ISLOW;  // the exact one: the same pixels on every machine
    PictureValues picture;
    picture.width = static_cast<int>(jpeg.image_width);
    picture.height = static_cast<int>(jpeg.image_height);
    picture.channels = jpeg.out_color_space == JCS_GRAYSCALE ? 1 : 3;
    readProfile(jpeg, picture);
    // A block of 64 pixels takes a bit of a progressive file's scan at the very least: a damaged header
    // claims more.
    const size_t rowBytes = size_t{jpeg.image_width} * static_cast<size_t>(picture.channels);
    if (size_t{jpeg.image_width} * jpeg.image_height / 4096 > bytes.size())
        fail(fmt::format("damaged: {}x{} pixels cannot be in {} bytes", picture.width, picture.height,
                         bytes.size()));
    std::vector<unsigned char> pixels(rowBytes * jpeg.image_height);
    if (!readRows(jpeg, errors, pixels.data(), rowBytes))
        fail(fmt::format("cannot be read as JPEG: {}", errors.message.data()));
    jpeg_destroy_decompress(&jpeg);
    picture.values.assign(pixels.begin(), pixels.end());
    return picture;
}

bool isPictureName(const std::string& name) {
    const std::string extension = extensionOf(name);
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

}  // namespace spectrad
