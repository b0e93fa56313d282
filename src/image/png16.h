// 16-bit PNG of linear values: a camera's raw counts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace spectrad {

struct Picture16 {
    int width = 0, height = 0, channels = 1;  ///< 1 grey, 3 RGB
    std::vector<std::uint16_t> pixels;        ///< interleaved, row 0 on top
    int bits = 16;                            ///< that count (sBIT)
};

/// Whole or not at all; marked as linear (gAMA 1), of no known primaries. Throws InputError for sizes that do
/// not fit, MachineError.
void writePng16(const std::filesystem::path& target, const Picture16& picture,
                const std::map<std::string, std::string>& text = {});

}  // namespace spectrad
