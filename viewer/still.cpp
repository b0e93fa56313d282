#include "viewer/still.h"

#include "base/text.h"

#include <fmt/format.h>

#include <limits>

namespace spectrad::view {

Pin Still::measured(int x, int y) {
    Pin pin{x, y, spectrumAt(x, y), {}};
    if (pin.spectrum.empty()) return pin;
    std::vector<double> channels;
    for (const std::vector<double>& weight : weights().weights) {
        double sum = 0;
        for (size_t band = 0; band < pin.spectrum.size(); ++band)
            sum += weight[band] * pin.spectrum[band];
        channels.push_back(sum);
    }
    pin.xyz = toXyz(eye().matrix, channels);
    return pin;
}

std::string pinsAsCsv(const std::vector<Pin>& pins, const Wavelengths& grid, CubeKind kind) {
    std::string text =
        fmt::format("# quantity: {}\n# unit: {}\n", name(kind), unit(kind).empty() ? "1" : unit(kind));
    for (const Pin& pin : pins)
        text += fmt::format("# at {},{}: XYZ {} {} {}\n", pin.x, pin.y, rounded(pin.xyz[0], 6),
                            rounded(pin.xyz[1], 6), rounded(pin.xyz[2], 6));
    text += "wavelength_nm";
    for (const Pin& pin : pins)
        text += fmt::format(",{} at {} {}", columnName(kind), pin.x, pin.y);
    text += '\n';
    for (size_t band = 0; band < grid.size(); ++band) {
        text += shortest(grid.nm[band]);
        for (const Pin& pin : pins)
            text += "," + (band < pin.spectrum.size()
                               ? rounded(pin.spectrum[band], std::numeric_limits<float>::max_digits10)
                               : std::string());
        text += '\n';
    }
    return text;
}

}  // namespace spectrad::view
