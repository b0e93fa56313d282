// Which pixels of a picture show a node: for regions that sweeps measure.
#pragma once

#include "scene/scene.h"
#include "spectrum/wavelengths.h"

#include <span>

namespace spectrad {

/// The same shapes from the same place, all black but the nodes given: node i glows with radiance 1 at
/// wavelength i + 1 nm and nowhere else. Rendered on coverWavelengths() as points, "band" i of a pixel is the
/// share of it that shows node i or what stands inside it, whatever hides it in front; instances of the node
/// elsewhere do not count. Nothing of passes and textures is left.
[[nodiscard]] Scene coverScene(const Scene& scene, std::span<const Index> nodes);
[[nodiscard]] Wavelengths coverWavelengths(size_t nodes);

}  // namespace spectrad
