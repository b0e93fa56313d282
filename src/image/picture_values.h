// A picture's values as they stand in its file, and what the file says of their colours. Maps of classes,
// strengths, directions and heights are no colours and take the values alone.
#pragma once

#include "image/picture.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

struct PictureValues {
    int width = 0, height = 0, channels = 1;  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
    std::uint16_t most = 255;                 ///< white: 255 of 8 bits, 65535 of 16
    std::vector<std::uint16_t> values;        ///< interleaved, row 0 on top
    PictureColour colour{};                   ///< of a PNG
    std::string profile{};                    ///< an ICC profile, byte by byte; none where it is sRGB's own
    std::string misread{};                    ///< what the file says of its colours and cannot be understood
};

/// PNG or JPEG, whichever the first bytes say; `name` is what errors call it. gAMA, sRGB and other chunks
/// about colour change no value, 16 bits stay 16. Palettes become colours, greys of fewer than 8 bits are
/// spread over 0…255; a JPEG of four inks (CMYK) is refused. Throws InputError, also for a file that ends
/// early.
[[nodiscard]] PictureValues decodeValues(std::string_view bytes, const std::string& name);
[[nodiscard]] PictureValues decodeJpeg(std::string_view bytes, const std::string& name);
[[nodiscard]] PictureValues readValues(const std::filesystem::path& path);

}  // namespace spectrad
