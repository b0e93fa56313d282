// A picture of 8 bits that the program wrote, its values as they stand in the file.
#pragma once

#include "image/picture_values.h"

#include <filesystem>

namespace spectrad {

inline Picture8 readPicture8(const std::filesystem::path& path) {
    const PictureValues read = readValues(path);
    Picture8 picture{read.width, read.height, read.channels, {}};
    for (const std::uint16_t value : read.values)
        picture.pixels.push_back(static_cast<std::uint8_t>(value));
    return picture;
}

}  // namespace spectrad
