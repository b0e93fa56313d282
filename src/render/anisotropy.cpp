#include "render/anisotropy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

constexpr double pi = std::numbers::pi;

/// 1 / (α + shift) runs from `least` to `most`.
struct Scale {
    double shift, least, most;
    explicit Scale(Widths widths)
        : shift(0.15 * std::max(widths.u, widths.v)),
          least(1 / (std::max(widths.u, widths.v) + shift)),
          most(1 / (std::min(widths.u, widths.v) + shift)) {}
};

/// Chebyshev's extrema, the ends included.
double node(size_t i) {
    return std::cos(pi * static_cast<double>(i) / (SD_AZIMUTHS - 1));
}

}  // namespace

double azimuthPlace(Widths widths, double azimuth) {
    const Scale scale(widths);
    const double width = std::hypot(widths.u * std::cos(azimuth), widths.v * std::sin(azimuth));
    return (2 / (width + scale.shift) - (scale.most + scale.least)) / (scale.most - scale.least);
}

std::vector<double> azimuthNodes(Widths widths) {
    if (widths.isotropic()) return {0};
    const Scale scale(widths);
    std::vector<double> azimuths;
    for (size_t i = 0; i < SD_AZIMUTHS; ++i) {
        const double inverse = 0.5 * (node(i) * (scale.most - scale.least) + scale.most + scale.least);
        const double width = 1 / inverse - scale.shift, v2 = widths.v * widths.v;
        const double cos2 = (width * width - v2) / (widths.u * widths.u - v2);
        azimuths.push_back(std::acos(std::sqrt(std::clamp(cos2, 0.0, 1.0))));
    }
    return azimuths;
}

std::vector<double> azimuthCoefficients(const std::vector<double>& values) {
    std::vector<double> sum(values.size(), 0.0);
    for (size_t i = 0; i < values.size(); ++i) {
        // Lagrange's polynomial of node i, multiplied out.
        std::vector<double> product(values.size(), 0.0);
        product[0] = values[i];
        for (size_t k = 0; k < values.size(); ++k) {
            if (k == i) continue;
            const double inverse = 1 / (node(i) - node(k));
            for (size_t d = values.size(); d-- > 0;)
                product[d] = ((d > 0 ? product[d - 1] : 0.0) - node(k) * product[d]) * inverse;
        }
        for (size_t d = 0; d < values.size(); ++d)
            sum[d] += product[d];
    }
    return sum;
}

AngleFunction roundMean(const DirectionFunction& function, Widths widths) {
    if (function.size() == 1) return function.front();
    constexpr int steps = 256;  // midpoints of a periodic function
    std::vector<double> mean(function.size(), 0.0);
    for (int i = 0; i < steps; ++i) {
        const double x = azimuthPlace(widths, 0.5 * pi * (i + 0.5) / steps);
        double power = 1;
        for (double& m : mean) {
            m += power / steps;
            power *= x;
        }
    }
    return [function, mean](double cosine) {
        double sum = 0;
        for (size_t k = 0; k < function.size(); ++k)
            sum += mean[k] * function[k](cosine);
        return sum;
    };
}

}  // namespace spectrad
