#include "colour/develop.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

double DevelopedPicture::clippedShare() const {
    return rgb.empty() ? 0 : static_cast<double>(clipped) / (static_cast<double>(rgb.size()) / 3);
}

double quantile(std::vector<double>& values, double p) {
    const double rank = p * static_cast<double>(values.size() - 1);
    const auto below = static_cast<size_t>(rank);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
    std::nth_element(values.begin(), at, values.end());
    if (below + 1 == values.size()) return *at;
    const double next = *std::min_element(at + 1, values.end());
    return std::lerp(*at, next, rank - static_cast<double>(below));
}

double displayWhiteLuminance(const ChannelImage& xyz, const DevelopSettings& settings) {
    double luminance = settings.white.xyz[1];
    if (!settings.white.hasLuminance || settings.exposure.automatic) {
        std::vector<double> y = xyz.plane[1];
        luminance = y.empty() ? 0 : quantile(y, exposedQuantile);
        if (!(luminance > 0) && !y.empty()) luminance = *std::max_element(y.begin(), y.end());
        if (!(luminance > 0)) luminance = 1;
    }
    return std::clamp(luminance * std::exp2(-settings.exposure.ev), 1e-300, 1e300);
}

Matrix3 developMatrix(const DevelopSettings& settings, double whiteLuminance) {
    const double scale = 1 / whiteLuminance;
    const Matrix3 adapted = adaptation(settings.adaptation, settings.white.xyz, settings.display.white);
    return settings.display.fromXyz * adapted * diagonal({scale, scale, scale});
}

DevelopedPicture develop(const ChannelImage& xyz, const DevelopSettings& settings) {
    DevelopedPicture picture;
    picture.width = xyz.width;
    picture.height = xyz.height;
    picture.whiteLuminance = displayWhiteLuminance(xyz, settings);
    picture.rgb.resize(3 * xyz.pixels());
    const Matrix3 toSignals = developMatrix(settings, picture.whiteLuminance);
    const Encoder8 encoder(settings.display);
    for (size_t i = 0; i < xyz.pixels(); ++i) {
        const Triple signal = toSignals * xyz.triple(i);
        bool outside = false;
        for (size_t c = 0; c < 3; ++c) {
            outside = outside || signal[c] < -signalTolerance || signal[c] > 1 + signalTolerance;
            picture.rgb[3 * i + c] = encoder(signal[c]);
        }
        if (outside) ++picture.clipped;
    }
    return picture;
}

}  // namespace spectrad
