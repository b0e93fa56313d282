// Pictures that are no colours: shares of measured reflectances, strengths, directions and slopes.
#pragma once

#include "render/texture.h"

namespace spectrad {

/// A grey picture as 0…1: its values as they stand, not as brightness on a display. Throws InputError for
/// colours.
[[nodiscard]] Texels strengthMap(const TextureUse& use);

/// For each texel the share of each choice, in the order of `select.choices`. Throws InputError naming the
/// pixel whose value no choice has.
[[nodiscard]] Texels shareMap(const Select& select);

/// A normal map's unit vectors (3 bands), or a height map's slopes along u and v (2 bands), metres per unit
/// of the image's coordinates.
[[nodiscard]] Texels reliefMap(const Relief& relief);

}  // namespace spectrad
