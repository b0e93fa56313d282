// A detector written as a product: sensor × lens × filters, with a filter a channel. Any number of channels.
#pragma once

#include "spectrum/resolver.h"

#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

/// One curve of a product, as the user names it.
struct DetectorFactor {
    std::string text;
    bool quantum = false;  ///< a quantum efficiency, electrons per photon, at most 1: counts times λ/hc,
                           ///< photons per joule
    SourceLocation where;
};

/// Channel i = common factors × its own. Without channels the product has those of its sensor.
struct DetectorProduct {
    struct Channel {
        std::string name;
        std::vector<DetectorFactor> factors;
    };
    std::vector<DetectorFactor> common;
    std::vector<Channel> channels;
};

/// Whether `text` is written as a product: it holds a `*`, or begins with "qe:".
[[nodiscard]] bool isDetectorProduct(std::string_view text);
/// "qe:sensors/ccd * filters/ir-cut * (R = filters/red, G = filters/green)": factors between `*`, one of them
/// perhaps a list of channels in parentheses. Throws InputError with the form that is meant.
[[nodiscard]] DetectorProduct parseDetectorProduct(std::string_view text, const SourceLocation& where);
/// The product as a sensitivity of one curve a channel, called `text`. Outside its range a transmittance is
/// held and a sensor is blind. It counts electrons where each channel has one quantum efficiency. Throws
/// InputError for a factor that is no sensitivity or transmittance, for a quantum efficiency above 1, for
/// more than one factor of several channels, and without a sensor.
[[nodiscard]] Spectrum multiplied(const DetectorProduct& product, const std::string& text,
                                  const SpectrumResolver& resolver, const SourceLocation& where);

/// A detector by any of its texts: a name, a file, a product.
[[nodiscard]] Spectrum detectorSpectrum(const std::string& text, const SpectrumResolver& resolver,
                                        const SourceLocation& where);

}  // namespace spectrad
