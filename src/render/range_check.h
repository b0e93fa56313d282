// What the wavelengths of an image leave out, and which curves they ask beyond their measurements: said,
// never silent.
#pragma once

#include "render/light_groups.h"
#include "scene/scene.h"

#include <vector>

namespace spectrad {

struct Detector;

/// Warns of each light that sends more than 0.1 % of the observer's response outside the grid, with the range
/// that would do.
void checkRange(const Wavelengths& grid, const std::vector<LightGroup>& groups, const Detector& observer,
                Notes& notes);

/// Says which reflectances and indices are held at their end values because the grid goes further than they
/// were measured.
void noteExtensions(const Wavelengths& grid, const std::vector<const Material*>& materials, Notes& notes);

}  // namespace spectrad
