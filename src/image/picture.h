// Pictures for people: 8-bit PNG, and float EXR of a detector's own channels. Reading them is
// picture_values.h.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

struct Picture8 {
    int width = 0, height = 0, channels = 3;  ///< 1 grey, 3 RGB, 4 RGBA
    std::vector<std::uint8_t> pixels;         ///< interleaved, row 0 on top
};

/// What a picture's numbers mean to who shows it: the chunks of a PNG about colour. Nothing set, nothing
/// said. The first that is set counts.
struct PictureColour {
    /// ColourPrimaries and TransferCharacteristics of ITU-T H.273, full range (cICP).
    std::optional<std::array<std::uint8_t, 2>> codes{};
    bool srgb = false;
    std::optional<std::array<double, 8>> chromaticities{};  ///< x, y of white, red, green, blue (cHRM)
    std::optional<double> gamma{};                          ///< light = signal to this power (gAMA)
};

/// Whole or not at all; `text` becomes tEXt chunks (iTXt where it is not ASCII).
void writePng(const std::filesystem::path& target, const Picture8& picture,
              const std::map<std::string, std::string>& text = {},
              const PictureColour& colour = {.srgb = true});
/// Whether a file is a picture by its name: .png, .jpg, .jpeg, in any case.
[[nodiscard]] bool isPictureName(const std::string& name);

/// Float channels, planes[channel][y * width + x], with string attributes; whole or not at all. Throws
/// InputError for a value that is not finite.
void writeChannelsExr(const std::filesystem::path& target, int width, int height,
                      const std::vector<std::string>& names, const std::vector<std::vector<float>>& planes,
                      const std::map<std::string, std::string>& attributes);

}  // namespace spectrad
