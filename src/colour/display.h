// Displays: primaries, white and transfer function; from XYZ relative to display white (Y = 1) to encoded
// values.
#pragma once

#include "colour/colour.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace spectrad {

struct Display {
    std::string name;
    Matrix3 toXyz;  ///< linear RGB 0…1 → XYZ, white at Y = 1
    Matrix3 fromXyz;
    Triple white;  ///< XYZ of RGB (1,1,1), Y = 1
    /// rec2020: what a camera of BT.2020 (and BT.709) makes of light, not what a display shows.
    enum class Transfer { srgb, rec2020, gamma } transfer = Transfer::srgb;
    double gamma = 2.2;
};

[[nodiscard]] Display srgbDisplay();  ///< IEC 61966-2-1: Rec. 709 primaries, D65
[[nodiscard]] Display p3Display();    ///< Display P3: P3 primaries, D65, sRGB transfer
/// ITU-R BT.2020, shown as ITU-R BT.1886 has it for a display without black: signals to the power of 2.4.
[[nodiscard]] Display rec2020Display();
/// "srgb", "p3", "rec2020", or a text file of chromaticities (docs/format.md); throws UsageError /
/// InputError.
[[nodiscard]] Display displayFor(const std::string& text);
/// A display's file, one setting a line, `#` starts a comment:
///
///     red   0.680 0.320      chromaticities x y of the primaries, all needed
///     green 0.265 0.690
///     blue  0.150 0.060
///     white 0.3127 0.3290    of equal signals
///     gamma 2.4              or: transfer srgb | rec2020 ; without either, transfer srgb
///
/// `file` is what errors call it.
[[nodiscard]] Display parseDisplay(std::string_view text, const std::string& file);
/// Throws InputError when the primaries lie on a line, or white is not between them.
[[nodiscard]] Display displayFromPrimaries(std::array<std::array<double, 2>, 3> primaries,
                                           std::array<double, 2> white, Display::Transfer transfer,
                                           double gamma);

/// Linear 0…1 to encoded 0…1, clipped.
[[nodiscard]] double encode(const Display& display, double linear);
/// Encoded 0…1 to linear 0…1, clipped.
[[nodiscard]] double decode(const Display& display, double encoded);

/// encode() to whole numbers 0…255, rounded, without a power for each value: thresholds instead. Exact but
/// for values within rounding of the middle between two codes.
class Encoder8 {
  public:
    explicit Encoder8(const Display& display);
    [[nodiscard]] std::uint8_t operator()(double linear) const {
        if (!(linear > 0)) return 0;
        if (linear >= 1) return 255;
        unsigned code = start_[static_cast<size_t>(linear * cells)];
        while (code < 255 && linear >= threshold_[code])
            ++code;
        return static_cast<std::uint8_t>(code);
    }

  private:
    static constexpr double cells = 4096;
    std::array<double, 255> threshold_{};     ///< where code k becomes k + 1
    std::array<std::uint8_t, 4096> start_{};  ///< the code at the start of each cell
};

}  // namespace spectrad
