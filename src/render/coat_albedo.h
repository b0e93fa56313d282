// What a rough dielectric coat reflects in all: the numbers that keep the energy of coat and base in balance.
#pragma once

#include "types.h"

#include <vector>

namespace spectrad {

/// Unpolarized Fresnel reflectance of a dielectric of relative index n at the cosine of incidence.
[[nodiscard]] double fresnelDielectric(double cosine, double n);

/// Directional albedos of a GGX dielectric (Smith, height-correlated), multiple scattering after Kulla & Conty 2017 included.
struct CoatAlbedo {
    std::vector<sd_albedo> table;  ///< SD_TABLE_CELLS + 1 entries, uniform in the cosine
    double multiple = 0;           ///< factor of missing(v) · missing(l), 1/sr
    double meanThrough = 1;        ///< 1 − cosine-weighted mean of the albedo
    double insideReflectance = 0;  ///< diffuse light from below that the coat sends back: 1 − meanThrough / n²
};
[[nodiscard]] CoatAlbedo coatAlbedo(double ior, double alpha);

}  // namespace spectrad
