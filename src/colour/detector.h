// Detectors: an eye, a camera, anything linear in the spectrum. Channels are any number.
#pragma once

#include "spectrum/efficacy.h"
#include "spectrum/resolver.h"
#include "spectrum/wavelengths.h"

#include <span>
#include <string>
#include <vector>

namespace spectrad {

/// Channel value = scale · ∫ L(λ) response(λ) dλ, L in W·m⁻²·sr⁻¹·nm⁻¹.
struct Detector {
    std::string name;                   ///< as the user named it
    std::vector<std::string> channels;  ///< "X" "Y" "Z", "L" "M" "S", "R" "G" "B", …
    std::vector<Curve> response;        ///< one per channel, zero outside their range
    double scale =
        1;  ///< K_m, lm/W, of X Y Z and V, so that Y and V are in cd/m² (spectrum/efficacy.h); else 1
    bool tristimulus = false;  ///< channels are X Y Z
    bool luminous = false;     ///< the channel is V, a luminous efficiency
    bool electrons = false;    ///< channels are electrons per joule: quantum efficiencies times λ/hc
    bool relative = false;     ///< of some of its curves only the shape is known

    [[nodiscard]] size_t size() const { return response.size(); }
};

/// A library name, with its folder or without ("observers/cie1931-2", "cie1931-2", "nikon-5100"), a file of
/// the user's, or a product of them (spectrum/detector_product.h); throws InputError.
[[nodiscard]] Detector detectorFor(const std::string& text, const SpectrumResolver& resolver,
                                   const SourceLocation& where);
/// The CIE 1931 observer of the library: what photometric amounts, default whites and colour temperatures are
/// defined with. Throws InputError if the library lacks it.
[[nodiscard]] Detector standardObserver(const Library& library);
/// A sensitivity as a detector. Channels named like "x_bar" or "R" become single capitals; three channels X,
/// Y, Z make it tristimulus, with the scale that puts Y in cd/m².
[[nodiscard]] Detector detectorFrom(const Spectrum& spectrum);

/// Weights on a cube's bands, scale included: channel c = Σ_j weights[c][j] · L_j (see detectorWeights).
struct DetectorWeights {
    std::vector<std::vector<double>> weights;
};
[[nodiscard]] DetectorWeights weightsOn(const Wavelengths& grid, const Detector& detector);

/// Exact channels of a product of curves (light × material …), no bands in between.
[[nodiscard]] std::vector<double> respond(const Detector& detector, std::span<const Curve* const> product);
/// The same for a tristimulus detector; throws InputError for any other.
[[nodiscard]] std::array<double, 3> respondXyz(const Detector& detector,
                                               std::span<const Curve* const> product);

}  // namespace spectrad
