// What single samples of single pixels see, in double precision, triangle by triangle.
#pragma once

#include "image/pixel_place.h"
#include "render/samples.h"
#include "verify/scalar_geometry.h"

#include <span>

namespace spectrad {

/// The nearest triangle at each sample of each pixel, [pixel][sample]; scalar::noTriangle where there is
/// none. `pixels` ascend by y, then x. Where corners lie on the screen is defined to 1/256 of a pixel and
/// ties go by the top-left rule, as for every image of ours (docs/design.md); triangles with a corner that is
/// behind the eye or far outside are taken as they are. Depths are those of the triangles' own planes along
/// each sample's ray.
[[nodiscard]] std::vector<std::uint32_t> trianglesSeen(const World& world,
                                                       const scalar::VerticesOf<double>& vertices,
                                                       const sd_frame& frame, const SamplePattern& pattern,
                                                       std::span<const PixelPlace> pixels);

}  // namespace spectrad
