// Integrals of products of curves, and what is built on them: band values, detector weights, spectra from
// cubes. Everything is integrated segment by segment over the union of the curves' own breaks with a 4-point
// Gauss rule: exact for products of piecewise-linear curves (up to degree 7), with no resampling in between.
#pragma once

#include "spectrum/curve.h"
#include "spectrum/wavelengths.h"

#include <span>
#include <vector>

namespace spectrad {

/// Curves whose product is meant; at most one of them may have lines (throws InputError otherwise).
using Product = std::span<const Curve* const>;

/// ∫ Π curves dλ over [from, to], in the unit of the product times nm; sums are compensated.
[[nodiscard]] double integrate(Product product, double from, double to);
/// The same over the range where the product is not zero; throws InputError if no curve bounds it.
[[nodiscard]] double integrate(Product product);

/// Band values of a product: ∫ Π h_j dλ / ∫ h_j dλ (slit, box), or the value at the wavelength (point, where
/// lines of no width count nothing unless they lie exactly on a wavelength, which is an InputError).
[[nodiscard]] std::vector<double> project(const Wavelengths& grid, Product product);

/// Hat moments ∫ curve h_j dλ for slit and box, and curve(λ_j) × trapezoid width for point.
[[nodiscard]] std::vector<double> moments(const Wavelengths& grid, const Curve& curve);

/// Weights w with Σ_j w_j L_j ≈ ∫ L detector dλ for the band values L_j of a cube. slit: least-squares
/// projection of the detector on the hats (tridiagonal mass matrix); box: the detector's average over the box
/// × its width; point: trapezoid rule.
[[nodiscard]] std::vector<double> detectorWeights(const Wavelengths& grid, const Curve& detector);

/// Undoes the projection of a cube's band values (slit: solves the mass matrix, so that what is linear
/// between the wavelengths comes back exactly; box and point: the values themselves). `values` and the
/// result: one per band.
[[nodiscard]] std::vector<double> nodalValues(const Wavelengths& grid, std::span<const double> values);

}  // namespace spectrad
