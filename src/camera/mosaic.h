// A colour filter mosaic: one channel a pixel, and the others filled in.
#pragma once

#include "colour/observe.h"

#include <string>
#include <vector>

namespace spectrad {

/// Which channel each pixel of a repeating tile sees: "RGGB" is R G over G B. `names`: the detector's
/// channels, each one letter. Throws UsageError for a pattern that is not square, or holds another letter, or
/// lacks a channel.
struct Mosaic {
    Mosaic(const std::string& pattern, const std::vector<std::string>& names);
    [[nodiscard]] size_t channelAt(int x, int y) const;

    int side = 1;
    std::vector<size_t> tile;
    size_t channels = 0;
};

/// What each pixel sees of its channels: one plane.
[[nodiscard]] ChannelImage sampled(const ChannelImage& full, const Mosaic& mosaic);
/// All channels of every pixel: its own as it was seen, the others interpolated from the same channel's
/// pixels nearby, weighed by a pyramid that reaches as far as the tile: bilinear for RGGB, exact wherever a
/// channel is linear. (Ours, since the libraries that do it read camera files or bring a computer-vision
/// system, for these thirty lines.)
[[nodiscard]] ChannelImage demosaiced(const ChannelImage& raw, const Mosaic& mosaic);

}  // namespace spectrad
