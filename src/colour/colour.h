// Colorimetry of tristimulus values. Sources: CIE 015:2018, CIE 224, Li et al. 2017 (CAT16), Ohno 2014 (CCT, Duv),
// Sharma, Wu & Dalal 2005 (CIEDE2000).
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
[[nodiscard]] Matrix3 inverse(const Matrix3& m);

/// x, y; nothing for black.
[[nodiscard]] std::optional<std::array<double, 2>> chromaticity(const Triple& xyz);
[[nodiscard]] std::optional<std::array<double, 2>> uvPrime(const Triple& xyz);  ///< u′, v′ (CIE 1976)
/// Correlated colour temperature, K, and Duv (positive above the Planckian locus), CIE 1931; nothing for black or where
/// |Duv| > 0.05 makes it undefined (CIE 015:2018, 9.4).
struct Cct {
    double kelvin, duv;
};
[[nodiscard]] std::optional<Cct> correlatedColourTemperature(const Triple& xyz);

/// CIE L* a* b* (1976) relative to `white`, which carries its luminance in Y.
[[nodiscard]] Triple lab(const Triple& xyz, const Triple& white);
[[nodiscard]] double deltaE76(const Triple& lab1, const Triple& lab2);
[[nodiscard]] double deltaE00(const Triple& lab1, const Triple& lab2);

enum class Adaptation { cat16, bradford, vonKries, none };
[[nodiscard]] Adaptation parseAdaptation(std::string_view text);
/// Matrix that takes XYZ seen under `from` to the corresponding XYZ under `to`: complete adaptation, chromatic only (both
/// whites scaled to Y = 1; luminance ratios stay).
[[nodiscard]] Matrix3 adaptation(Adaptation method, const Triple& from, const Triple& to);

}  // namespace spectrad
