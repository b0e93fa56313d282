// Pictures that are no colours: shares of measured reflectances, strengths.
#pragma once

#include "render/texture.h"

namespace spectrad {

/// A grey picture as 0…1: its values as they stand, not as brightness on a display. Throws InputError for
/// colours.
[[nodiscard]] Texels strengthMap(const TextureUse& use);

/// For each texel the share of each choice, in the order of `select.choices`. Throws InputError naming the
/// pixel whose value no choice has.
[[nodiscard]] Texels shareMap(const Select& select);

}  // namespace spectrad
