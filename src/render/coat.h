// Coats over a base: what they reflect and let through, at one value of the number (index, or reflectance at
// normal incidence) through which they depend on the wavelength.
#pragma once

#include "render/facets.h"
#include "spectrum/curve.h"
#include "spectrum/wavelengths.h"

#include <vector>

namespace spectrad {

struct Detector;
struct Material;

/// Wavelengths from…to, nm.
struct WavelengthSpan {
    double from, to;
};
/// All that any band sees: a single one has a hat that reaches to both sides.
[[nodiscard]] WavelengthSpan seenByBands(const Wavelengths& grid);
/// Those, all that the CIE's observers see (360…830 nm) and all that this one does, if any: previews, terms
/// under another lamp and exact channels have no bands, and integrate over their own wavelengths.
[[nodiscard]] WavelengthSpan seenByAnyone(const Wavelengths& grid, const Detector* observer = nullptr);

/// A coat whose optics depend on the wavelength through one number only (its index, or its reflectance at
/// normal incidence) is evaluated at a few values of that number; at any other it is the polynomial through
/// them.
struct Nodes {
    std::vector<double> at;
    double least, most;  ///< values beyond these count as they do: a polynomial goes anywhere there
    [[nodiscard]] double weight(size_t i, double value) const;
};
/// For the values that the curve takes within the span.
[[nodiscard]] Nodes nodesFor(const Curve& curve, WavelengthSpan span);
/// Of a glass for all wavelengths that somebody sees; but for those of the bands alone where more would make
/// these wrong by more than 1e-4 of a reflectance (a formula with a pole in the visible, for the infrared).
[[nodiscard]] Nodes nodesOfGlass(const Curve& ior, WavelengthSpan bands, WavelengthSpan anyone);
/// Largest error of the polynomial through the nodes of a glass's reflectance, as a share of that
/// reflectance, over all angles and the curve's values within the span.
[[nodiscard]] double interpolationError(const Nodes& nodes, const Curve& ior, WavelengthSpan span);

/// A coat at one value of its number: what it reflects and what it lets through.
struct Coat {
    FacetAlbedos facets;
    double again = 0;                   ///< reflectance of light that bounces between facets
    double multiple = 0;                ///< factor of missing · missing, 1/sr
    DirectionFunction albedo, through;  ///< nothing: no coat
    double meanThrough = 1;
    double inside = 0, index = 1;  ///< reflectance for diffuse light from below; these: not known
};
/// How a coat's reflectance follows from its number.
enum class CoatModel {
    glass,    ///< Fresnel's, by its index
    measured  ///< Schlick's, by its reflectance at normal incidence
};
[[nodiscard]] AngleFunction fresnelOf(CoatModel model, double value);
[[nodiscard]] Coat coatOf(CoatModel model, double value, Widths widths);
/// As the base of this material takes it: one that is stated as seen through the coat knows nothing of what
/// the coat sends back, and leaves what it is stated to.
[[nodiscard]] Coat coatOver(const Material& material, CoatModel model, double value, Widths widths);

/// Light that changes its wavelength below a coat passes it by other values of the coat's number on its way
/// in than on its way out.
enum class Way { in, out };
/// As few nodes as bring the polynomial through what the coat passes on that way within 2e-5 (nine at most).
[[nodiscard]] Nodes nodesForWay(Way way, CoatModel model, const Curve& number, WavelengthSpan span,
                                Widths widths);

}  // namespace spectrad
