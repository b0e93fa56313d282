// Coats over a base: what they reflect and let through, at one value of the number (index, or reflectance at
// normal incidence) through which they depend on the wavelength.
#pragma once

#include "render/facets.h"
#include "spectrum/curve.h"

#include <vector>

namespace spectrad {

/// A coat whose optics depend on the wavelength through one number only (its index, or its reflectance at
/// normal incidence) is evaluated at a few values of that number; at any other it is the polynomial through
/// them.
struct Nodes {
    std::vector<double> at;
    [[nodiscard]] double weight(size_t i, double value) const;
};
/// For the values that the curve takes within from…to, nm.
[[nodiscard]] Nodes nodesFor(const Curve& curve, double from, double to);
/// Largest error of the polynomial through the nodes of a glass's reflectance, as a share of that
/// reflectance, over all angles and the curve's values within from…to.
[[nodiscard]] double interpolationError(const Nodes& nodes, const Curve& ior, double from, double to);

/// A coat at one value of its number: what it reflects and what it lets through.
struct Coat {
    FacetAlbedos facets;
    double again = 0;     ///< reflectance of light that bounces between facets
    double multiple = 0;  ///< factor of missing · missing, 1/sr
    DirectionFunction albedo, through;
    double meanThrough = 1;
};
[[nodiscard]] Coat coatOf(const AngleFunction& fresnel, Widths widths);

}  // namespace spectrad
