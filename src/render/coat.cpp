#include "render/coat.h"

#include "colour/detector.h"
#include "render/fresnel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

double Nodes::weight(size_t i, double value) const {
    double w = 1;
    for (size_t k = 0; k < at.size(); ++k)
        if (k != i) w *= (value - at[k]) / (at[i] - at[k]);
    return w;
}

namespace {

/// Wavelengths that show all values the curve takes; formulae may bend between their breaks.
std::vector<double> placesOn(const Curve& curve, WavelengthSpan span) {
    const auto [from, to] = span;
    std::vector<double> places{from, to};
    curve.appendBreaks(from, to, places);
    constexpr int steps = 64;
    for (int i = 1; i < steps; ++i)
        places.push_back(from + (to - from) * i / steps);
    return places;
}

}  // namespace

WavelengthSpan seenByBands(const Wavelengths& grid) {
    return {band(grid, 0).from, band(grid, grid.size() - 1).to};
}

WavelengthSpan seenByAnyone(const Wavelengths& grid, const Detector* observer) {
    WavelengthSpan span = seenByBands(grid);
    const auto include = [&](double from, double to) {
        span.from = std::min(span.from, from);
        span.to = std::max(span.to, to);
    };
    include(360, 830);
    if (observer)
        for (const Curve& response : observer->response)
            if (const auto range = response.range()) include(range->first, range->second);
    return span;
}

Nodes nodesFor(const Curve& curve, WavelengthSpan span) {
    double low = curve.at(span.from), high = low;
    for (double place : placesOn(curve, span)) {
        low = std::min(low, curve.at(place));
        high = std::max(high, curve.at(place));
    }
    if (high - low <= 1e-9 * std::max(std::abs(high), 1e-30)) return {{0.5 * (low + high)}};
    // Chebyshev nodes: four leave less than 1e-6 of the reflectance of any glass. Measured reflectances from
    // dark to bright need more: light that bounces between rough facets is a geometric series in them.
    const int count = high - low <= 0.1 ? 4 : high - low <= 0.4 ? 6 : 9;
    Nodes nodes;
    for (int i = 0; i < count; ++i)
        nodes.at.push_back(0.5 * (low + high) +
                           0.5 * (high - low) * std::cos(std::numbers::pi * (i + 0.5) / count));
    return nodes;
}

Nodes nodesOfGlass(const Curve& ior, WavelengthSpan bands, WavelengthSpan anyone) {
    const Nodes all = nodesFor(ior, anyone), own = nodesFor(ior, bands);
    const double tolerated = std::max(1e-4, 2 * interpolationError(own, ior, bands));
    return interpolationError(all, ior, bands) <= tolerated ? all : own;
}

double interpolationError(const Nodes& nodes, const Curve& ior, WavelengthSpan span) {
    double worst = 0;
    for (double place : placesOn(ior, span)) {
        const double n = ior.at(place);
        for (int i = 0; i <= 90; ++i) {
            const double c = std::cos(i * std::numbers::pi / 180), exact = fresnelDielectric(c, n);
            double sum = 0;
            for (size_t k = 0; k < nodes.at.size(); ++k)
                sum += nodes.weight(k, n) * fresnelDielectric(c, nodes.at[k]);
            if (exact > 0) worst = std::max(worst, std::abs(sum - exact) / exact);
        }
    }
    return worst;
}

Coat coatOf(const AngleFunction& fresnel, Widths widths) {
    Coat coat;
    coat.facets = facetAlbedos({fresnel}, widths);
    coat.again = multipleScattering(cosineMean(fresnel), coat.facets.whiteMean);
    // What misses less than a millionth sends nothing round again.
    const double missingMean = 1 - coat.facets.whiteMean;
    coat.multiple = missingMean > 1e-6 ? coat.again * std::numbers::inv_pi / missingMean : 0;
    const double again = missingMean > 1e-6 ? coat.again : 0;
    const DirectionFunction &single = coat.facets.albedo.front(), &white = coat.facets.white;
    if (white.size() == 1) {
        coat.albedo = {[s = single[0], w = white[0], again](double c) {
            return std::clamp(s(c) + (1 - w(c)) * again, 0.0, 1.0);
        }};
        coat.through = {[albedo = coat.albedo[0]](double c) { return 1 - albedo(c); }};
    } else {
        for (size_t k = 0; k < white.size(); ++k) {
            const double unit = k == 0 ? 1 : 0;
            coat.albedo.push_back([s = single[k], w = white[k], again, unit](double c) {
                return s(c) + (unit - w(c)) * again;
            });
            coat.through.push_back([albedo = coat.albedo[k], unit](double c) { return unit - albedo(c); });
        }
    }
    coat.meanThrough = cosineMean(roundMean(coat.through, widths));
    return coat;
}

}  // namespace spectrad
