// Which few wavelengths tell the colours of a scene.
#pragma once

#include "colour/colour.h"
#include "colour/detector.h"
#include "spectrum/wavelengths.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

/// Spectra of a scene's pixels at every nanometre: hat moments, and the share of the pixels that look alike.
struct Palette {
    std::vector<std::vector<double>> moments;
    std::vector<double> share;
    std::vector<Triple> xyz;  ///< absolute
};

/// A detector on hats over any of the wavelengths of a fine grid (all its hats are sums of the fine ones, so
/// nothing is integrated again).
class HatDetector {
  public:
    /// `fine`: slit bands.
    HatDetector(const Wavelengths& fine, const Detector& detector);
    [[nodiscard]] size_t nodes() const { return fine_.size(); }
    /// Weights on the fine hat moments that see what the detector sees of bands over these `nodes` (ascending
    /// indices of fine wavelengths): the detector's least-squares projection, zero outside them.
    [[nodiscard]] std::vector<std::array<double, 3>> weights(const std::vector<size_t>& nodes) const;

  private:
    Wavelengths fine_;
    std::vector<std::array<double, 3>> moments_;
};

/// A set of bands and the ΔE00 that it leaves on a palette.
struct BandSet {
    std::vector<size_t> nodes;  ///< indices of fine wavelengths
    std::string how;            ///< where they come from, in words
    double error = 0;           ///< 99 % of the palette's pixels within, or all
};

/// For each number of bands the best set found, from few to many: by removing, from bands every 5 nm between
/// 380 and 780 nm, again and again the one that is missed least; regular grids where they are better; at the
/// end every 2 nm and every nanometre of the fine grid (1 nm apart, from 360 to 830 nm).
[[nodiscard]] std::vector<BandSet> bandSets(const Wavelengths& fine, const HatDetector& detector,
                                            const Palette& palette, const Triple& white, bool all);

}  // namespace spectrad
