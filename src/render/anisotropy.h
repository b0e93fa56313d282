// Surfaces that are rougher along one axis than along the other: functions of a direction's height and
// azimuth as kernels read them.
#pragma once

#include "render/angle_table.h"

#include <vector>

namespace spectrad {

/// GGX widths (roughness squared) along the texture coordinates' u and across it; both 0: a mirror.
struct Widths {
    double u = 0, v = 0;
    Widths(double both) : u(both), v(both) {}
    Widths(double along, double across) : u(along), v(across) {}
    [[nodiscard]] bool isotropic() const { return u == v; }
};

/// f(cos θ, φ) = Σ_k f[k](cos θ) x(φ)^k: one coefficient where the surface is the same all round, else
/// SD_AZIMUTHS.
using DirectionFunction = std::vector<AngleFunction>;

/// x of an azimuth, radians from u: −1 where the surface is roughest, 1 where it is smoothest, linear in
/// 1 / (α(φ) + 0.15 α_max) with α(φ)² = α_u² cos² φ + α_v² sin² φ. Albedos are nearly straight in it: the
/// polynomial of SD_AZIMUTHS coefficients leaves less than 3e-4 for widths up to 25 to 1.
[[nodiscard]] double azimuthPlace(Widths widths, double azimuth);
/// The azimuths, radians in 0…π/2, where a function has to be known for its coefficients.
[[nodiscard]] std::vector<double> azimuthNodes(Widths widths);
/// Coefficients of the polynomial through values at azimuthNodes().
[[nodiscard]] std::vector<double> azimuthCoefficients(const std::vector<double>& values);
/// Mean over all azimuths.
[[nodiscard]] AngleFunction roundMean(const DirectionFunction& function, Widths widths);

}  // namespace spectrad
