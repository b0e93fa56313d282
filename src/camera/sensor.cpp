#include "camera/sensor.h"

#include "camera/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spectrad {

double countsPerElectron(const Sensor& sensor) {
    if (!sensor.bits) return 1;
    if (!sensor.fullWell) throw InputError("counts need a full well: 2^bits - 1 is what it becomes");
    return (std::exp2(*sensor.bits) - 1 - sensor.black) / *sensor.fullWell;
}

double Shutter::electronsPerSignal() const {
    const double pitch = pitchMicrometres * 1e-6;
    return std::numbers::pi / (4 * fNumber * fNumber) * pitch * pitch * seconds;
}

RawImage expose(const ChannelImage& signals, const Sensor& sensor) {
    const double gain = countsPerElectron(sensor), dark = sensor.darkCurrent * sensor.seconds;
    RawImage raw{ChannelImage(signals.width, signals.height, signals.plane.size()), 0};
    const auto width = static_cast<size_t>(signals.width);
    for (size_t i = 0; i < signals.pixels(); ++i) {
        bool full = false;
        for (size_t c = 0; c < signals.plane.size(); ++c) {
            Draws draws(sensor.seed, static_cast<std::uint32_t>(i % width),
                        static_cast<std::uint32_t>(i / width), static_cast<std::uint32_t>(c));
            // A curve of negative lobes may give a negative signal: no electrons.
            const double mean = std::max(0.0, signals.plane[c][i] * sensor.electronsPerSignal) + dark;
            double electrons = sensor.shotNoise ? draws.poisson(mean) : mean;
            full = full || (sensor.fullWell && electrons >= *sensor.fullWell);
            if (sensor.fullWell) electrons = std::min(electrons, *sensor.fullWell);
            if (sensor.readNoise > 0) electrons += sensor.readNoise * draws.normal();
            double value = electrons * gain + sensor.black;
            if (sensor.bits) value = std::clamp(std::round(value), 0.0, std::exp2(*sensor.bits) - 1);
            raw.values.plane[c][i] = value;
        }
        raw.fullPixels += full;
    }
    return raw;
}

ChannelImage electronsOf(ChannelImage raw, const Sensor& sensor) {
    const double gain = countsPerElectron(sensor), dark = sensor.darkCurrent * sensor.seconds;
    for (std::vector<double>& plane : raw.plane)
        for (double& value : plane)
            value = (value - sensor.black) / gain - dark;
    return raw;
}

double fullElectrons(const Sensor& sensor) {
    return sensor.fullWell ? *sensor.fullWell - sensor.darkCurrent * sensor.seconds
                           : std::numeric_limits<double>::infinity();
}

NoiseModel noiseOf(double signal, const Sensor& sensor) {
    const double gain = countsPerElectron(sensor);
    const double electrons = signal * sensor.electronsPerSignal + sensor.darkCurrent * sensor.seconds;
    const double shot = sensor.shotNoise ? electrons : 0, quantisation = sensor.bits ? 1.0 / 12 : 0;
    return {gain * electrons + sensor.black,
            gain * gain * (shot + sensor.readNoise * sensor.readNoise) + quantisation};
}

}  // namespace spectrad
