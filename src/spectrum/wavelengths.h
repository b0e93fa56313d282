// The wavelengths of an image and what a band value means (docs/design.md, "What a band value means").
#pragma once

#include "base/error.h"

#include <string_view>
#include <vector>

namespace spectrad {

/// How a curve becomes a band value: average under a hat (a triangular slit function), under a box, or the
/// value there.
enum class Projection { slit, box, point };

[[nodiscard]] std::string_view name(Projection projection);
[[nodiscard]] Projection parseProjection(std::string_view text, const SourceLocation& where);

/// Ascending band wavelengths in nm, 1 to 10 000 of them, and their projection.
struct Wavelengths {
    std::vector<double> nm;
    Projection projection = Projection::slit;
    double step = 5;  ///< nm; half-width of the hat when there is one band only

    [[nodiscard]] size_t size() const { return nm.size(); }
    friend bool operator==(const Wavelengths&, const Wavelengths&) = default;
};

/// "380:780:5" or "400,405.2,410" (also blanks between). Throws InputError at `where` for anything else: not
/// ascending, not positive, not finite, more than 10 000.
[[nodiscard]] Wavelengths parseWavelengths(std::string_view text, const SourceLocation& where);
/// from, from+step, … up to `to` (reached when within 1e-9 of a step). Throws as above.
[[nodiscard]] Wavelengths regularWavelengths(double from, double to, double step,
                                             const SourceLocation& where);

/// The weight function of one band: linear from (from, atFrom) over the peak at (nm, 1) to (to, atTo). A hat
/// has 0 at its far ends, a box 1. One-sided bands have from == nm or nm == to.
struct Band {
    double from, nm, to;
    double atFrom, atTo;
    [[nodiscard]] double weight(double lambda) const;
    [[nodiscard]] double area() const;  ///< ∫ weight dλ, nm; 0 for point bands
};
[[nodiscard]] Band band(const Wavelengths& grid, size_t j);

/// The same band values as text: "0.380000" style decimals, six, or as many as tell all bands apart.
[[nodiscard]] int decimalsToTellApart(const Wavelengths& grid);

}  // namespace spectrad
