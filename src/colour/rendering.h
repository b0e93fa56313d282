// A picture with all choices: degree of adaptation, tone curve, what becomes of colours that the display
// lacks, and a map of them.
#pragma once

#include "colour/develop.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace spectrad {

/// How relative luminance becomes the display's. `reinhard`: L (1 + L / Lw²) / (1 + L) (Reinhard et al. 2002,
/// eq. 4), with Lw, four times the exposure's white, as the display's; chromaticities stay.
enum class Tone { linear, reinhard };
/// `clip`: each channel to its range. `desaturate`: towards the grey of the same luminance, as far as it
/// takes, then clip.
enum class GamutMapping { clip, desaturate };
[[nodiscard]] Tone parseTone(std::string_view text);                  ///< throws UsageError
[[nodiscard]] GamutMapping parseGamutMapping(std::string_view text);  ///< throws UsageError

struct Rendering {
    DevelopSettings base;
    double degree =
        1;  ///< of adaptation, 0…1: D of CIECAM16; cone responses are scaled by D · complete + 1 − D
    Tone tone = Tone::linear;
    GamutMapping gamut = GamutMapping::clip;
};

struct RenderedPicture {
    DevelopedPicture picture;
    ChannelImage signals;  ///< linear R G B as the display shows them, 0…1
    std::vector<std::uint8_t>
        map;  ///< grey, but where a signal was below 0 (blue), above 1 (red), or both (magenta); 8-bit sRGB
};

/// Linear signals through the tone curve, beyond the display's range as well.
[[nodiscard]] Triple toned(const Triple& signals, const Display& display, Tone tone);

/// What the display shows of linear signals: through the tone curve, then within its range.
struct ShownSignals {
    Triple signals;                     ///< 0…1
    double luminance = 0;               ///< relative to the display's white, before the range
    bool below = false, above = false;  ///< whether a signal left the range, by more than 1e-4
};
[[nodiscard]] ShownSignals shownSignals(Triple signals, const Display& display, Tone tone,
                                        GamutMapping gamut);

/// The matrix from absolute XYZ to linear display signals, before tone and gamut.
[[nodiscard]] Matrix3 renderingMatrix(const Rendering& rendering, double whiteLuminance);
[[nodiscard]] RenderedPicture render(const ChannelImage& xyz, const Rendering& rendering);

}  // namespace spectrad
