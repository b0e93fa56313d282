#include "image/picture_colour.h"

#include <algorithm>

namespace spectrad {

PictureColour pictureColour(const Display& display) {
    PictureColour colour;
    if (display.name == "srgb") {
        colour.srgb = true;
        return colour;
    }
    if (display.name == "p3") colour.codes = {12, 13};
    std::array<double, 8> xy{};
    for (size_t k = 0; k < 4; ++k) {
        Triple xyz = display.white;
        for (size_t i = 0; i < 3 && k > 0; ++i)
            xyz[i] = display.toXyz[i][k - 1];
        const double sum = xyz[0] + xyz[1] + xyz[2];
        xy[2 * k] = xyz[0] / sum;
        xy[2 * k + 1] = xyz[1] / sum;
    }
    if (std::all_of(xy.begin(), xy.end(), [](double v) { return v >= 0 && v <= 1; }))
        colour.chromaticities = xy;
    if (display.transfer == Display::Transfer::srgb) colour.gamma = 2.2;
    if (display.transfer == Display::Transfer::gamma) colour.gamma = display.gamma;
    return colour;
}

}  // namespace spectrad
