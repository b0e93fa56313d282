// Baking: a surface rendered into its own texture's square instead of a camera's picture.
#pragma once

#include "image/cube.h"

#include <vector>

namespace spectrad {

/// Texels that the surface covers in part hold their covered part's mean: divides by the share covered
/// (coverage[row * width + x], 0…1).
void divideByCoverage(Cube& cube, const std::vector<float>& coverage);

/// A border of `texels` around what is covered, each texel the mean of its neighbours further in, so that
/// filters find no black beside the surface. Returns how many texels the surface covers.
size_t addGutter(Cube& cube, std::vector<float> coverage, int texels);

}  // namespace spectrad
