// A picture's values as they stand in its file: maps of classes, strengths, directions and heights, which
// are no colours and so have no gamma.
#pragma once

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
};

/// PNG or JPEG, whichever the first bytes say; `name` is what errors call it. gAMA, sRGB and other chunks
/// about colour change nothing, 16 bits stay 16. Palettes become colours, greys of fewer than 8 bits are
/// spread over 0…255. Throws InputError, also for a file that ends early.
[[nodiscard]] PictureValues decodeValues(std::string_view bytes, const std::string& name);
[[nodiscard]] PictureValues readValues(const std::filesystem::path& path);

}  // namespace spectrad
