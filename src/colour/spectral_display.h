// Displays by the spectra of their primaries: other eyes see them differently.
#pragma once

#include "colour/detector.h"
#include "colour/difference.h"
#include "colour/display.h"

#include <vector>

namespace spectrad {

struct SpectralDisplay {
    std::string name;
    std::vector<Curve> primaries;  ///< radiance of red, green and blue at full signal
    Display::Transfer transfer = Display::Transfer::srgb;

    /// The display as a tristimulus observer sees it, white at Y = 1. Throws InputError for primaries that
    /// span no triangle.
    [[nodiscard]] Display seenBy(const Detector& observer) const;
};

/// Three curves named R, G, B: "displays/lcd-apple-studio", or a file of the user's. Throws InputError.
[[nodiscard]] SpectralDisplay spectralDisplay(const Spectrum& spectrum);

/// Observer metamerism of a display: `signals` (linear R G B, 0…1) were made to match `own`, the scene in XYZ
/// relative to the display's white as a second observer sees the scene itself; returned is how far what that
/// observer sees on the display is from it, in ΔE00 against the display's white.
[[nodiscard]] ColourDifference displayMetamerism(const ChannelImage& signals, const Display& seenBySecond,
                                                 const ChannelImage& own);

}  // namespace spectrad
