// Indices of refraction from dispersion formulae.
#pragma once

#include "spectrum/curve.h"

#include <span>

namespace spectrad {

inline constexpr double sodiumNm = 589.3;  ///< where an index without dispersion is stated

/// n² = 1 + Σ B λ² / (λ² − C), λ in µm, C in µm²; `terms` are B1, C1, B2, C2 … Kept within 1 ≤ n ≤ 6: at its
/// resonances the formula runs to infinity and means nothing. Nothing if there is no such n anywhere from 0.1
/// to 20 µm.
[[nodiscard]] std::optional<Curve> sellmeier(std::span<const double> terms);
/// n = A + B / λ² + C / λ⁴ …, λ in µm; likewise.
[[nodiscard]] std::optional<Curve> cauchy(std::span<const double> terms);

}  // namespace spectrad
