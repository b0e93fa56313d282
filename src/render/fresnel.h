// Fresnel reflectance of dielectrics and metals, and its separation into functions of the angle and of the
// wavelength.
#pragma once

#include "render/angle_table.h"
#include "spectrum/curve.h"

#include <vector>

namespace spectrad {

/// Unpolarized reflectance at the cosine of incidence, relative index n; 1 beyond the critical angle.
[[nodiscard]] double fresnelDielectric(double cosine, double n);
/// The same for a complex index n + i k.
[[nodiscard]] double fresnelConductor(double cosine, double n, double k);
/// Schlick 1994: r0 + (1 − r0)(1 − cosine)⁵.
[[nodiscard]] double fresnelSchlick(double cosine, double r0);

/// F(θ, λ) = Σ_i angle[i](cos θ) · spectrum[i](λ). The spectra are the reflectance itself at a few angles, so
/// each is a reflectance in its own right; the angle functions say how to mix them (a rank-revealing cross
/// approximation).
struct FresnelBasis {
    std::vector<AngleFunction> angle;
    std::vector<Curve> spectrum;
    double relativeError =
        0;  ///< largest found on a grid of angles and wavelengths finer than the one it was made on
};

/// The metal's exact reflectance for wavelengths from…to (nm): as many angles as bring the error below 1e-6
/// of the reflectance.
[[nodiscard]] FresnelBasis conductorBasis(const Curve& n, const Curve& k, double from, double to);
/// Two terms, exact for Schlick's formula over the metal's reflectance at normal incidence.
[[nodiscard]] FresnelBasis schlickBasis(const Curve& n, const Curve& k);
/// Largest difference between Schlick's formula and the metal's own reflectance over angles and wavelengths
/// from…to.
[[nodiscard]] double schlickError(const Curve& n, const Curve& k, double from, double to);

}  // namespace spectrad
