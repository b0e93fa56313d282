// Colour differences between CIE Lab values.
#include "colour/colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

double deltaE76(const Triple& lab1, const Triple& lab2) {
    return std::hypot(lab1[0] - lab2[0], lab1[1] - lab2[1], lab1[2] - lab2[2]);
}

static constexpr double radian = std::numbers::pi / 180;

/// Hue angle in degrees, 0…360; 0 for grey.
static double hue(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double degrees = std::atan2(b, a) / radian;
    return degrees < 0 ? degrees + 360 : degrees;
}

/// C⁷ / (C⁷ + 25⁷), the chroma weighting that CIEDE2000 uses twice; written so that no chroma overflows.
static double seventhPowerShare(double chroma) {
    const double r = 25 / chroma, r3 = r * r * r;
    return 1 / (1 + r3 * r3 * r);
}

// Step numbers and names as in Sharma, Wu & Dalal, "The CIEDE2000 color-difference formula: implementation
// notes, supplementary test data, and mathematical observations", Color Res. Appl. 30 (2005), 21–30.
double deltaE00(const Triple& lab1, const Triple& lab2) {
    // 1. a′, C′, h′
    const double meanChroma = (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2])) / 2;
    const double g = 0.5 * (1 - std::sqrt(seventhPowerShare(meanChroma)));
    const double a1 = (1 + g) * lab1[1], a2 = (1 + g) * lab2[1];
    const double c1 = std::hypot(a1, lab1[2]), c2 = std::hypot(a2, lab2[2]);
    const double h1 = hue(a1, lab1[2]), h2 = hue(a2, lab2[2]);
    const bool grey = c1 * c2 == 0;

    // 2. ΔL′, ΔC′, ΔH′
    const double dL = lab2[0] - lab1[0], dC = c2 - c1;
    double dh = grey ? 0 : h2 - h1;
    if (dh > 180) dh -= 360;
    if (dh < -180) dh += 360;
    const double dH = 2 * std::sqrt(c1 * c2) * std::sin(dh / 2 * radian);

    // 3. weights at the mean of both colours
    const double l = (lab1[0] + lab2[0]) / 2, c = (c1 + c2) / 2;
    double h = h1 + h2;  // one of a grey pair has no hue: the other's counts
    if (!grey) {
        if (std::abs(h1 - h2) > 180) h += h < 360 ? 360 : -360;
        h /= 2;
    }
    const double t = 1 - 0.17 * std::cos((h - 30) * radian) + 0.24 * std::cos(2 * h * radian) +
                     0.32 * std::cos((3 * h + 6) * radian) - 0.20 * std::cos((4 * h - 63) * radian);
    const double fromBlue = (h - 275) / 25;
    const double turn = 30 * std::exp(-fromBlue * fromBlue);
    const double l50 = (l - 50) * (l - 50);
    const double sL = 1 + 0.015 * l50 / std::sqrt(20 + l50);
    const double sC = 1 + 0.045 * c, sH = 1 + 0.015 * c * t;
    const double rT = -std::sin(2 * turn * radian) * 2 * std::sqrt(seventhPowerShare(c));

    const double termL = dL / sL, termC = dC / sC, termH = dH / sH;
    // The rotation term makes this a quadratic form that stays positive; rounding of nothing may not.
    return std::sqrt(std::max(0.0, termL * termL + termC * termC + termH * termH + rT * termC * termH));
}

}  // namespace spectrad
