#include "viewer/still.h"

#include "base/text.h"

#include <fmt/format.h>

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

std::string pinsAsCsv(const std::vector<Pin>& pins, const Wavelengths& grid, const std::string& quantity,
                      const std::string& unit) {
    std::string text = fmt::format("# quantity: {}\n# unit: {}\n", quantity, unit.empty() ? "1" : unit);
    for (const Pin& pin : pins)
        text += fmt::format("# at {},{}: XYZ {} {} {}\n", pin.x, pin.y, rounded(pin.xyz[0], 6),
                            rounded(pin.xyz[1], 6), rounded(pin.xyz[2], 6));
    const std::string column = quantity == "radiance"     ? "radiance_W_m2_sr_nm"
                               : quantity == "irradiance" ? "irradiance_W_m2_nm"
                                                          : quantity;
    text += "wavelength_nm";
    for (const Pin& pin : pins)
        text += fmt::format(",{} at {} {}", column, pin.x, pin.y);
    text += '\n';
    constexpr int floatDigits = 9;  // enough to read the same float back
    for (size_t band = 0; band < grid.size(); ++band) {
        text += shortest(grid.nm[band]);
        for (const Pin& pin : pins)
            text +=
                "," + (band < pin.spectrum.size() ? rounded(pin.spectrum[band], floatDigits) : std::string());
        text += '\n';
    }
    return text;
}

}  // namespace spectrad::view
