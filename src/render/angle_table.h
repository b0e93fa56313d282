// Functions of a cosine as kernels read them: cubics on cells uniform in the square root of the cosine.
#pragma once

#include "types.h"

#include <functional>
#include <vector>

namespace spectrad {

using AngleFunction = std::function<double(double cosine)>;

/// SD_CELLS pieces, each the cubic through four points of its cell: continuous, error below f⁗ h⁴ / 1900 with
/// h = 1 / SD_CELLS (derivatives with respect to the square root of the cosine).
[[nodiscard]] std::vector<sd_piece> tabulate(const AngleFunction& f);

/// The tabulated function in double, as kernels evaluate it in float.
[[nodiscard]] double evaluate(const sd_piece* table, double cosine);

/// Cosine-weighted mean over the hemisphere, 2 ∫ f(μ) μ dμ.
[[nodiscard]] double cosineMean(const AngleFunction& f);

/// Cubic interpolation of values at cosines (i / n)², i = 0…n, n ≥ 3.
[[nodiscard]] AngleFunction interpolated(std::vector<double> values);

}  // namespace spectrad
