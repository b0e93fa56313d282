// Curves in string attributes of the spectral EXR layout: "400nm:0.92;410nm:0.93;".
#pragma once

#include "base/error.h"

#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

struct CurveSample {
    double nm, value;
};

/// Samples in ascending order of wavelength, from any unit of length or frequency with an SI prefix, with or
/// without the last ';'. A repeated last sample counts once. Throws InputError at `where` for anything else:
/// no sample, a negative value, two values at one wavelength.
[[nodiscard]] std::vector<CurveSample> parseCurveAttribute(std::string_view text,
                                                           const SourceLocation& where);

/// The form that every known reader takes whole: decimal points, no blanks, no minus, and the last sample
/// twice without a final ';' (the authors' reader drops what no ';' follows, colour-science's raises on a
/// final one).
[[nodiscard]] std::string curveAttribute(const std::vector<CurveSample>& samples);

/// True for the attributes in which the layout keeps a curve: lensTransmission, cameraResponse, an emissive
/// channel's name (that band's sensitivity), and colour-science's X, Y, Z (colour matching functions) and
/// illuminant.
[[nodiscard]] bool isCurveAttribute(std::string_view name);

}  // namespace spectrad
