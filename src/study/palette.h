// The kinds of spectra that a picture is made of.
#pragma once

#include "study/band_choice.h"

namespace spectrad {

/// nm, of hat `band` of a grid of every nanometre: the outermost are one-sided.
[[nodiscard]] double hatArea(size_t band, size_t bands);

/// Of a picture rendered at every nanometre of the detector's fine grid, planes[band][pixel]: the commonest
/// kinds of spectra, 150 at most. Throws InputError for a black one.
[[nodiscard]] Palette paletteOf(const std::vector<std::vector<float>>& planes, const HatDetector& detector);

}  // namespace spectrad
