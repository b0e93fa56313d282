#include "colour/display.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

static constexpr std::array<double, 2> d65{0.3127, 0.3290};  // as the three standards round it

Display displayFromPrimaries(std::array<std::array<double, 2>, 3> primaries, std::array<double, 2> white,
                             Display::Transfer transfer, double gamma) {
    // Columns: X, Y, Z of each primary at unit x + y + z, scaled so that equal signals make the white.
    Matrix3 columns;
    for (size_t p = 0; p < 3; ++p) {
        columns[0][p] = primaries[p][0];
        columns[1][p] = primaries[p][1];
        columns[2][p] = 1 - primaries[p][0] - primaries[p][1];
    }
    if (!(std::abs(determinant(columns)) > 1e-6))
        throw InputError("the primaries of a display must span a triangle of chromaticities");
    Display display;
    display.white = xyzFromChromaticity(white);
    const Triple amount = inverse(columns) * display.white;
    if (!(amount[0] > 0 && amount[1] > 0 && amount[2] > 0))
        throw InputError("the white of a display must lie inside the triangle of its primaries");
    display.toXyz = columns * diagonal(amount);
    display.fromXyz = inverse(display.toXyz);
    display.transfer = transfer;
    display.gamma = gamma;
    return display;
}

static Display named(std::string name, Display display) {
    display.name = std::move(name);
    return display;
}

Display srgbDisplay() {
    return named("srgb", displayFromPrimaries({{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}}, d65,
                                              Display::Transfer::srgb, 2.2));
}
Display p3Display() {
    return named("p3", displayFromPrimaries({{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}}}, d65,
                                            Display::Transfer::srgb, 2.2));
}
Display rec2020Display() {
    return named("rec2020", displayFromPrimaries({{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}}}, d65,
                                                 Display::Transfer::gamma, 2.4));
}

// BT.2020's α and β, to double precision: where the line 4.5 E and the power meet with equal slope.
static constexpr double alpha = 1.09929682680944, beta = 0.018053968510807;

double encode(const Display& display, double linear) {
    const double v = std::isnan(linear) ? 0 : std::clamp(linear, 0.0, 1.0);
    switch (display.transfer) {
        case Display::Transfer::srgb:
            return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        case Display::Transfer::rec2020:
            return v < beta ? 4.5 * v : alpha * std::pow(v, 0.45) - (alpha - 1);
        case Display::Transfer::gamma:
            break;
    }
    return std::pow(v, 1 / display.gamma);
}

double decode(const Display& display, double encoded) {
    const double v = std::isnan(encoded) ? 0 : std::clamp(encoded, 0.0, 1.0);
    switch (display.transfer) {
        case Display::Transfer::srgb:
            return v <= 12.92 * 0.0031308 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        case Display::Transfer::rec2020:
            return v < 4.5 * beta ? v / 4.5 : std::pow((v + (alpha - 1)) / alpha, 1 / 0.45);
        case Display::Transfer::gamma:
            break;
    }
    return std::pow(v, display.gamma);
}

Encoder8::Encoder8(const Display& display) {
    for (size_t k = 0; k < threshold_.size(); ++k)
        threshold_[k] = decode(display, (static_cast<double>(k) + 0.5) / 255);
    unsigned code = 0;
    for (size_t i = 0; i < start_.size(); ++i) {
        while (code < 255 && static_cast<double>(i) / cells >= threshold_[code])
            ++code;
        start_[i] = static_cast<std::uint8_t>(code);
    }
}

}  // namespace spectrad
