#include "colour/spectral_display.h"

#include <cmath>

namespace spectrad {

Display SpectralDisplay::seenBy(const Detector& observer) const {
    Display display;
    display.name = name;
    display.transfer = transfer;
    for (size_t p = 0; p < 3; ++p) {
        const std::array<const Curve*, 1> light{&primaries[p]};
        const Triple xyz = respondXyz(observer, light);
        for (size_t k = 0; k < 3; ++k)
            display.toXyz[k][p] = xyz[k];
    }
    const double white = display.toXyz[1][0] + display.toXyz[1][1] + display.toXyz[1][2];
    if (!(white > 0)) throw InputError("'" + observer.name + "' sees no light of the display '" + name + "'");
    display.toXyz = diagonal({1 / white, 1 / white, 1 / white}) * display.toXyz;
    if (!(std::abs(determinant(display.toXyz)) > 1e-9))
        throw InputError("the primaries of '" + name + "' span no triangle of colours for '" + observer.name +
                         "'");
    display.fromXyz = inverse(display.toXyz);
    display.white = display.toXyz * Triple{1, 1, 1};
    return display;
}

SpectralDisplay spectralDisplay(const Spectrum& spectrum) {
    if (spectrum.channels != std::vector<std::string>{"R", "G", "B"})
        throw InputError("'" + spectrum.text +
                         "' is no display: it needs the spectra of its primaries in columns R, G, B");
    SpectralDisplay display{spectrum.text, {}, Display::Transfer::srgb};
    for (const Curve& curve : spectrum.curves)
        display.primaries.push_back(curve.withOutside(Outside::zero));
    return display;
}

ColourDifference displayMetamerism(const ChannelImage& signals, const Display& seenBySecond,
                                   const ChannelImage& own) {
    ChannelImage shown(signals.width, signals.height, 3);
    for (size_t i = 0; i < signals.pixels(); ++i) {
        const Triple xyz = seenBySecond.toXyz * signals.triple(i);
        for (size_t k = 0; k < 3; ++k)
            shown.plane[k][i] = xyz[k];
    }
    return colourDifference(own, shown, seenBySecond.white);
}

}  // namespace spectrad
