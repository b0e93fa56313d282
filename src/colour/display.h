// Displays: primaries, white and transfer function; from XYZ relative to display white (Y = 1) to encoded values.
#pragma once

#include "colour/colour.h"

#include <cstdint>
#include <string>

namespace spectrad {

struct Display {
    std::string name;
    Matrix3 toXyz;  ///< linear RGB 0…1 → XYZ, white at Y = 1
    Matrix3 fromXyz;
    Triple white;  ///< XYZ of RGB (1,1,1), Y = 1
    enum class Transfer { srgb, rec2020, gamma } transfer = Transfer::srgb;
    double gamma = 2.2;
};

[[nodiscard]] Display srgbDisplay();
[[nodiscard]] Display p3Display();       ///< Display P3: P3 primaries, D65, sRGB transfer
[[nodiscard]] Display rec2020Display();  ///< ITU-R BT.2020, its transfer function
/// "srgb", "p3", "rec2020", or a text file of chromaticities (docs/format.md); throws UsageError / InputError.
[[nodiscard]] Display displayFor(const std::string& text);
[[nodiscard]] Display displayFromPrimaries(std::array<std::array<double, 2>, 3> primaries, std::array<double, 2> white,
                                           Display::Transfer transfer, double gamma);

/// Linear 0…1 to encoded 0…1, clipped.
[[nodiscard]] double encode(const Display& display, double linear);

}  // namespace spectrad
