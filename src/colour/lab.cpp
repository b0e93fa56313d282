#include "colour/colour.h"

#include <cmath>

namespace spectrad {

std::optional<std::array<double, 2>> chromaticity(const Triple& xyz) {
    const double sum = xyz[0] + xyz[1] + xyz[2];
    if (!(sum > 0) || !std::isfinite(sum)) return std::nullopt;
    return std::array<double, 2>{xyz[0] / sum, xyz[1] / sum};
}

std::optional<std::array<double, 2>> uvPrime(const Triple& xyz) {
    const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
    if (!(sum > 0) || !std::isfinite(sum)) return std::nullopt;
    return std::array<double, 2>{4 * xyz[0] / sum, 9 * xyz[1] / sum};
}

Triple xyzFromChromaticity(std::array<double, 2> xy, double luminance) {
    return {luminance * xy[0] / xy[1], luminance, luminance * (1 - xy[0] - xy[1]) / xy[1]};
}

Triple lab(const Triple& xyz, const Triple& white) {
    // CIE 015:2018, 8.2.1: the cube root, and below (6/29)³ its tangent, which also takes slightly negative
    // values.
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (841.0 / 108.0) * t + 4.0 / 29.0;
    };
    const double x = f(xyz[0] / white[0]), y = f(xyz[1] / white[1]), z = f(xyz[2] / white[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

}  // namespace spectrad
