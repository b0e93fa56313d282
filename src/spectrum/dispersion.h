// Indices of refraction from dispersion formulae.
#pragma once

#include "spectrum/curve.h"

#include <span>

namespace spectrad {

/// n² = 1 + Σ B λ² / (λ² − C), λ in µm, C in µm²; `terms` are B1, C1, B2, C2 … Held outside the widest
/// transparent window of 0.1 µm … 1 mm, the one where 1 ≤ n ≤ 6: at its resonances the formula means nothing.
/// Nothing if there is no such window.
[[nodiscard]] std::optional<Curve> sellmeier(std::span<const double> terms);
/// n = A + B / λ² + C / λ⁴ …, λ in µm; likewise.
[[nodiscard]] std::optional<Curve> cauchy(std::span<const double> terms);

}  // namespace spectrad
