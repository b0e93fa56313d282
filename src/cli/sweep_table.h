// The table of a sweep: the mean of every region in every picture, as colours.
#pragma once

#include "cli/console.h"
#include "cli/observation.h"

#include <cstddef>
#include <string>
#include <vector>

namespace spectrad {

/// A part of the picture: its pixels, row by row from the top left.
struct MeasuredRegion {
    std::string name;
    std::vector<std::size_t> pixels;
};

/// One picture of the sweep: a variant seen by a detector.
struct SweepImage {
    std::string variant, detector;
    const Observation& eye;
    const ChannelImage& channels;
    White white;     ///< for CIELAB, with a luminance
    double metered;  ///< of a film, Observation::metered
};

/// One row: the region's mean channels, XYZ, xy and CIELAB (null where undefined).
[[nodiscard]] Json sweepRow(const SweepImage& image, const MeasuredRegion& region);
/// All rows as CSV.
[[nodiscard]] std::string sweepCsv(const Json& rows);

}  // namespace spectrad
