// A sensor's signal chain: radiance → electrons → noise → full well → counts. Every stage may be left out.
#pragma once

#include "colour/observe.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace spectrad {

/// Lens and shutter: electrons = ∫ L(λ) QE λ/hc dλ · π/(4 N²) · pitch² · time, the image's irradiance of a
/// distant object through a lens without losses of its own (those belong to the detector's product).
struct Shutter {
    double fNumber = 4;
    double seconds = 0.01;
    double pitchMicrometres = 4;
    /// Electrons for a channel value of 1 electron·J⁻¹·W·m⁻²·sr⁻¹, as a detector with a quantum efficiency
    /// has it.
    [[nodiscard]] double electronsPerSignal() const;
};

struct Sensor {
    double electronsPerSignal = 1;
    double seconds = 0.01;  ///< for the dark current
    bool shotNoise = true;
    double readNoise = 0;            ///< electrons, root mean square
    double darkCurrent = 0;          ///< electrons per second
    std::optional<double> fullWell;  ///< electrons; what is above is lost
    std::optional<int> bits;  ///< counts of 2^bits − 1 at the full well; without: electrons as they are
    double black = 0;         ///< count of no electrons
    std::uint64_t seed = 1;
};

/// 1 without bits. Throws InputError for bits without a full well.
[[nodiscard]] double countsPerElectron(const Sensor& sensor);

struct RawImage {
    ChannelImage values;
    std::uint64_t fullPixels = 0;  ///< of which a channel at least held all that the well holds
};

/// Raw values of a channel image (a detector's linear channels): counts, or electrons where there are no
/// bits. Channel c of pixel (x, y) draws its noise from (seed, x, y, c) alone. Throws InputError for bits
/// without a full well.
[[nodiscard]] RawImage expose(const ChannelImage& signals, const Sensor& sensor);

/// Raw values back to electrons above black, per count.
[[nodiscard]] ChannelImage electronsOf(ChannelImage raw, const Sensor& sensor);

/// What electronsOf() makes of a full pixel; infinite without a full well.
[[nodiscard]] double fullElectrons(const Sensor& sensor);

/// The mean and variance, in counts, that the chain gives a pixel far from black and full well:
/// gain·(s + d) + black and gain²·(s + d + r²) + 1/12, with s signal, d dark and r read electrons.
struct NoiseModel {
    double mean = 0, variance = 0;
};
[[nodiscard]] NoiseModel noiseOf(double signal, const Sensor& sensor);

}  // namespace spectrad
