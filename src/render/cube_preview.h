// The RGB preview of a cube that is already there.
#pragma once

#include "image/cube.h"
#include "spectrum/library.h"

#include <vector>

namespace spectrad {

/// Linear Rec.709 [row][3][x] for the CIE 1931 observer, as renders carry it: ∫ L x̄ dλ without 683 lm/W;
/// reflectances and transmittances lit by D65, so that a perfect one is 1, 1, 1 (the layout's rule).
[[nodiscard]] std::vector<float> previewOf(const Cube& cube, const Library& library);

}  // namespace spectrad
