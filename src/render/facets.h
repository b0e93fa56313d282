// Energy of rough surfaces: directional albedos of GGX microfacets and of Oren–Nayar's, the numbers that keep
// lobes in balance.
#pragma once

#include "render/anisotropy.h"

#include <vector>

namespace spectrad {

/// Single-scattering directional albedos of GGX (Smith, height-correlated), for facets that reflect
/// fresnel[i](cosine between view and facet), and for perfect mirrors.
struct FacetAlbedos {
    std::vector<DirectionFunction> albedo;  ///< one per Fresnel function
    DirectionFunction white;
    double whiteMean = 1;  ///< cosine-weighted mean of `white`
};
[[nodiscard]] FacetAlbedos facetAlbedos(const std::vector<AngleFunction>& fresnel, Widths widths);

/// Reflectance of light that bounces between facets, given their mean Fresnel reflectance: the geometric
/// series of Kulla & Conty 2017, F² E / (1 − F (1 − E)).
[[nodiscard]] double multipleScattering(double meanFresnel, double whiteMean);

/// Oren & Nayar's A and B for a roughness σ in degrees.
struct OrenNayar {
    double a = 1, b = 0;
    AngleFunction albedo;  ///< directional albedo of single scattering at reflectance 1
    double mean = 1;
};
/// With B/A of 1994 and A such that no energy is gained (Fujii's form, as Portsmouth, Kutz & Hill 2024 use
/// it).
[[nodiscard]] OrenNayar orenNayar(double sigmaDegrees);

}  // namespace spectrad
