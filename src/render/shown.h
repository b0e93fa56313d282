// A picture between a scene and an eye: taken by a detector, shown by a display.
#pragma once

#include "image/cube.h"
#include "scene/scene.h"
#include "spectrum/library.h"

namespace spectrad {

/// Radiances as the display shows them: detector's channels → XYZ (towardsXyz) → drives of the three
/// primaries that make that XYZ, held within 0…1 (counted in the notes) → their radiances. Colours are
/// absolute: what the display cannot reach in luminance is clipped. Throws InputError for primaries without
/// three different colours.
[[nodiscard]] Cube shownOn(const Screen& screen, Cube cube, const Library& library, Notes& notes);

}  // namespace spectrad
