// Oren–Nayar's diffuse surface below a coat: how much of what it scatters gets out at once.
#pragma once

#include "render/facets.h"

namespace spectrad {

/// Of a white base, over the cosine above the coat of a direction below it. Light that is let through is
/// scattered once in the directions that Snell's law makes of those above (`single` of it gets out at once),
/// or more often between the base's own facets (`multiple`); the rest comes `back` from the coat. The three
/// add up to 1.
struct RoughBelow {
    AngleFunction missing;  ///< 1 − albedo of single scattering
    AngleFunction back;
    double escape = 0;                        ///< multiple = missing × this
    double rest = 0;                          ///< 1 / mean of `back` over the directions that get out
    double insideOnce = 0, insideAgain = -1;  ///< what colours light that came back, see texture.h

    /// The share that a base of this reflectance sends up for good.
    [[nodiscard]] double sentBack(double reflectance, double cosine, double whiteMean) const;
    /// Fluorophores absorb of what a Lambertian base would leave: this share of it is no more than this one
    /// leaves.
    [[nodiscard]] double shareOfGlow(double inside, double whiteMean) const;
};

/// `through`: what the coat lets through at a cosine above it; `inside`: its reflectance for diffuse light
/// from below, 0 for a coat that has no index.
[[nodiscard]] RoughBelow roughBelow(const OrenNayar& model, const AngleFunction& through, double index,
                                    double inside);

}  // namespace spectrad
