// From a camera's raw channels to colours: white balance, and a matrix fitted to a chart.
#pragma once

#include "colour/colour.h"
#include "colour/observe.h"

#include <vector>

namespace spectrad {

/// Factors that make the channels of a white alike, none below 1. Throws InputError for a channel that sees
/// nothing of it.
[[nodiscard]] std::vector<double> whiteBalance(const std::vector<double>& white);

/// The matrix from balanced channels (white is 1 in each) to XYZ (white at Y = 1) that takes the white to
/// itself, so that greys stay grey, and whose squared error over the patches of a chart under a light is
/// least among those; patches are reflectances. Throws InputError for fewer patches than channels.
[[nodiscard]] XyzMatrix fittedMatrix(const Detector& camera, const Detector& observer, const Curve& light,
                                     const std::vector<Curve>& chart);

}  // namespace spectrad
