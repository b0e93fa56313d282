// Smooth reflectance spectra from RGB: a sigmoid of a quadratic in wavelength (Jakob & Hanika 2019, "A Low-Dimensional
// Function Space for Efficient Spectral Upsampling"), fitted to the colour under D65 for the CIE 1931 observer.
#pragma once

#include "spectrum/curve.h"

#include <array>

namespace spectrad {

class Library;

/// S(λ) = ½ + x / (2 √(1 + x²)), x = c[0] t² + c[1] t + c[2], t = (λ − 360 nm) / 470 nm: within 0…1.
struct LiftedColour {
    std::array<double, 3> c{};
    [[nodiscard]] double at(double nm) const;
    [[nodiscard]] Curve curve() const;
};

/// Fits linear sRGB components in 0…1 by Gauss–Newton on the CIE Lab difference under D65.
[[nodiscard]] LiftedColour liftReflectance(std::array<double, 3> linearSrgb, const Library& library);

}  // namespace spectrad
