// What a PNG for a display says about its numbers.
#pragma once

#include "colour/display.h"
#include "image/picture.h"

namespace spectrad {

/// sRGB by its name; Display P3 by the codes of ITU-T H.273; every other display by its primaries and white,
/// where a PNG can hold them (0…1). A gamma only where it is the display's own, or sRGB's 2.2 for its curve
/// (as the PNG standard has it): BT.2020's camera curve is no power, and H.273 has no code for its display.
[[nodiscard]] PictureColour pictureColour(const Display& display);

}  // namespace spectrad
