// Smooth reflectance spectra from RGB: a sigmoid of a quadratic in wavelength (Jakob & Hanika 2019, "A
// Low-Dimensional Function Space for Efficient Spectral Upsampling"), fitted to the colour under D65 for the
// CIE 1931 observer.
#pragma once

#include "spectrum/curve.h"

#include <array>
#include <vector>

namespace spectrad {

class Library;

/// S(λ) = ½ + x / (2 √(1 + x²)), x = c[0] t² + c[1] t + c[2], t = (λ − 360 nm) / 470 nm: within 0…1. A colour
/// says nothing about ultraviolet and infrared: outside 360…830 nm the end values are held.
struct LiftedColour {
    std::array<double, 3> c{};
    [[nodiscard]] double at(double nm) const;
    [[nodiscard]] Curve curve() const;
};

/// An sRGB component (IEC 61966-2-1), 0…1 as displays take it, to linear light.
[[nodiscard]] double linearOfSrgb(double encoded);

/// Linear sRGB (IEC 61966-2-1) to XYZ, and its white (1, 1, 1).
[[nodiscard]] std::array<double, 3> xyzOfLinearSrgb(const std::array<double, 3>& rgb);

/// What the fit needs of D65 and the observer, gathered once for many colours.
class ColourLift {
  public:
    explicit ColourLift(const Library& library);
    /// For curves that are kept at `nodes` only (nm, ascending, two at least), linear between them and held
    /// beyond: it is their colour that is fitted, not the smooth curve's, and fewer wavelengths are quicker.
    ColourLift(const Library& library, const std::vector<double>& nodes);
    /// Fits linear sRGB components in 0…1 by damped Gauss–Newton on the CIE Lab difference under D65; greys
    /// are exact constants. Throws InputError for components outside 0…1.
    [[nodiscard]] LiftedColour fit(std::array<double, 3> linearSrgb) const;
    struct Nearest {
        LiftedColour colour;
        double missed = 0;  ///< ΔE*ab (CIE Lab 1976) under D65 between what was asked for and what it is
    };
    /// The same of any finite components, since displays and cameras know colours that sRGB lacks: where no
    /// reflectance of that form has the colour, what comes near it.
    [[nodiscard]] Nearest fitNearest(const std::array<double, 3>& linearSrgb) const;

  private:
    struct State;
    [[nodiscard]] State evaluate(const std::array<double, 3>& c,
                                 const std::array<double, 3>& targetLab) const;
    [[nodiscard]] State approach(State start, const std::array<double, 3>& targetLab) const;

    std::vector<double> t_;                       ///< (λ − 360) / 470 at 1 nm steps, or at the nodes
    std::vector<std::array<double, 3>> weights_;  ///< X, Y, Z of D65 under a hat there, relative to the white
};

}  // namespace spectrad
