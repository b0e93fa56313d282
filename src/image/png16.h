// 16-bit PNG of linear values: a camera's raw counts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace spectrad {

struct Picture16 {
    int width = 0, height = 0, channels = 1;  ///< 1 grey, 3 RGB
    std::vector<std::uint16_t> pixels;        ///< interleaved, row 0 on top
};

/// Whole or not at all; marked as linear (gamma 1). Throws InputError for sizes that do not fit,
/// MachineError.
void writePng16(const std::filesystem::path& target, const Picture16& picture);

}  // namespace spectrad
