// Spectra written as formulae: "blackbody:2856", "gaussian:450,20", "srgb:#c04020" … (docs/format.md,
// "Spectra").
#pragma once

#include "spectrum/lift.h"
#include "spectrum/spectrum.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

/// What stands before the colon of every formula.
[[nodiscard]] const std::vector<std::string>& formulaNames();
/// Whether `text` begins with one of them and a colon.
[[nodiscard]] bool isFormula(std::string_view text);
/// Whether it is a colour, srgb: or rgb:, which means one thing for a surface and another for a lamp.
[[nodiscard]] bool isColourFormula(std::string_view text);

/// Colours' way to spectra; asked for only when a formula is a colour.
struct ColourSource {
    std::function<LiftedColour(std::array<double, 3>)> lift;
    std::function<Curve()> daylight;  ///< illuminants/D65
};

/// `lamp` makes a colour the lifted reflectance times D65, of any brightness. Throws InputError for what is
/// not as the formula wants it, with an example.
[[nodiscard]] Spectrum formulaSpectrum(std::string_view text, bool lamp, const ColourSource& colours,
                                       const SourceLocation& where);

/// The value at every wavelength; for an index of refraction, which may be written as a bare number.
[[nodiscard]] Spectrum constantSpectrum(std::string_view text, double value);

}  // namespace spectrad
