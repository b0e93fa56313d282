#include "image/png16.h"

#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>
#include <png.h>

namespace spectrad {

void writePng16(const std::filesystem::path& target, const Picture16& picture) {
    const size_t values = static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height) *
                          static_cast<size_t>(picture.channels);
    if (picture.width < 1 || picture.height < 1 || (picture.channels != 1 && picture.channels != 3) ||
        picture.pixels.size() != values)
        throw InputError(
            {target.string()},
            fmt::format(
                "no 16-bit PNG of {}x{} pixels with {} channels from {} values (allowed: 1 or 3 channels)",
                picture.width, picture.height, picture.channels, picture.pixels.size()));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = picture.channels == 1 ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_LINEAR_RGB;
    png_alloc_size_t size = 0;
    std::string bytes;
    bool written = png_image_write_get_memory_size(image, size, 0, picture.pixels.data(), 0, nullptr) != 0;
    if (written) {
        bytes.resize(size);
        written =
            png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr) != 0;
        bytes.resize(size);
    }
    const std::string message = image.message;
    png_image_free(&image);
    if (!written) throw MachineError("cannot write '" + target.string() + "': " + message);
    writeFile(target, bytes);
}

}  // namespace spectrad
