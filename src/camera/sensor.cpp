#include "camera/sensor.h"

#include "camera/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// Counts per electron.
double gainOf(const Sensor& sensor) {
    if (!sensor.bits) return 1;
    if (!sensor.fullWell) throw InputError("counts need a full well: 2^bits - 1 is what it becomes");
    return (std::exp2(*sensor.bits) - 1 - sensor.black) / *sensor.fullWell;
}

}  // namespace

double Shutter::electronsPerSignal() const {
    const double pitch = pitchMicrometres * 1e-6;
    return std::numbers::pi / (4 * fNumber * fNumber) * pitch * pitch * seconds;
}

ChannelImage expose(const ChannelImage& signals, const Sensor& sensor) {
    const double gain = gainOf(sensor), dark = sensor.darkCurrent * sensor.seconds;
    ChannelImage raw(signals.width, signals.height, signals.plane.size());
    for (size_t c = 0; c < signals.plane.size(); ++c)
        for (size_t i = 0; i < signals.pixels(); ++i) {
            const auto width = static_cast<size_t>(signals.width);
            Draws draws(sensor.seed, static_cast<std::uint32_t>(i % width),
                        static_cast<std::uint32_t>(i / width), static_cast<std::uint32_t>(c));
            // A curve of negative lobes may give a negative signal: no electrons.
            const double mean = std::max(0.0, signals.plane[c][i] * sensor.electronsPerSignal) + dark;
            double electrons = sensor.shotNoise ? draws.poisson(mean) : mean;
            if (sensor.fullWell) electrons = std::min(electrons, *sensor.fullWell);
            if (sensor.readNoise > 0) electrons += sensor.readNoise * draws.normal();
            double value = electrons * gain + sensor.black;
            if (sensor.bits) value = std::clamp(std::round(value), 0.0, std::exp2(*sensor.bits) - 1);
            raw.plane[c][i] = value;
        }
    return raw;
}

ChannelImage electronsOf(ChannelImage raw, const Sensor& sensor) {
    const double gain = gainOf(sensor), dark = sensor.darkCurrent * sensor.seconds;
    for (std::vector<double>& plane : raw.plane)
        for (double& value : plane)
            value = (value - sensor.black) / gain - dark;
    return raw;
}

NoiseModel noiseOf(double signal, const Sensor& sensor) {
    const double gain = gainOf(sensor);
    const double electrons = signal * sensor.electronsPerSignal + sensor.darkCurrent * sensor.seconds;
    const double shot = sensor.shotNoise ? electrons : 0, quantisation = sensor.bits ? 1.0 / 12 : 0;
    return {gain * electrons + sensor.black,
            gain * gain * (shot + sensor.readNoise * sensor.readNoise) + quantisation};
}

}  // namespace spectrad
