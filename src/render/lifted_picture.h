// Pictures as textures: each colour becomes a smooth reflectance (spectrum/lift.h).
#pragma once

#include "image/picture_light.h"
#include "render/texture.h"

#include <array>

namespace spectrad {

constexpr size_t liftedBands = 41;  ///< 380:780:10 nm

struct LiftedPicture {
    SpectralTexture texture;  ///< on 380:780:10 nm
    size_t colours = 0;       ///< that differ
    size_t missed = 0;    ///< of them by more than 0.5 in CIE Lab: no reflectance is so bright or saturated
    double farthest = 0;  ///< the largest of those differences, ΔE*ab (1976)
};

/// Each colour's linear sRGB components are multiplied by `tint`, then lifted. Throws what the light throws.
[[nodiscard]] LiftedPicture liftPicture(const PictureValues& picture, const PictureLight& light,
                                        const std::array<double, 3>& tint, const Library& library);

}  // namespace spectrad
