// Colorimetry of tristimulus values: chromaticity, CIE Lab, colour differences, chromatic adaptation.
// Correlated colour temperature is in cct.h. Sources: CIE 015:2018; Li et al. 2017 (CAT16); Sharma, Wu &
// Dalal 2005 (CIEDE2000).
#pragma once

#include "base/error.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace spectrad {

using Triple = std::array<double, 3>;
using Matrix3 = std::array<Triple, 3>;  ///< rows

[[nodiscard]] Triple operator*(const Matrix3& m, const Triple& v);
[[nodiscard]] Matrix3 operator*(const Matrix3& a, const Matrix3& b);
/// Determinant by the scalar triple product; 0 for a matrix without an inverse.
[[nodiscard]] double determinant(const Matrix3& m);
/// Inverse of a matrix whose determinant is not zero.
[[nodiscard]] Matrix3 inverse(const Matrix3& m);
[[nodiscard]] Matrix3 diagonal(const Triple& d);

/// x, y; nothing for black.
[[nodiscard]] std::optional<std::array<double, 2>> chromaticity(const Triple& xyz);
[[nodiscard]] std::optional<std::array<double, 2>> uvPrime(const Triple& xyz);  ///< u′, v′ (CIE 1976)
/// X Y Z of chromaticity x, y (y > 0) at luminance Y.
[[nodiscard]] Triple xyzFromChromaticity(std::array<double, 2> xy, double luminance = 1);

/// CIE L* a* b* (1976) relative to `white`, which carries its luminance in Y; all three of white's values are
/// positive.
[[nodiscard]] Triple lab(const Triple& xyz, const Triple& white);
[[nodiscard]] double deltaE76(const Triple& lab1, const Triple& lab2);
/// CIEDE2000 with kL = kC = kH = 1.
[[nodiscard]] double deltaE00(const Triple& lab1, const Triple& lab2);

enum class Adaptation { cat16, bradford, vonKries, none };
/// "cat16", "bradford", "vonkries", "none"; throws UsageError.
[[nodiscard]] Adaptation parseAdaptation(std::string_view text);
/// Matrix that takes XYZ seen under `from` to the corresponding XYZ under `to`: complete adaptation,
/// chromatic only (both whites scaled to Y = 1; luminance ratios stay). Throws InputError for a white without
/// luminance, or one so saturated that the method's cone responses to it are not all positive.
[[nodiscard]] Matrix3 adaptation(Adaptation method, const Triple& from, const Triple& to);

}  // namespace spectrad
