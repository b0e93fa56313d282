#include "render/coat.h"

#include "colour/detector.h"
#include "render/fresnel.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace spectrad {

double Nodes::weight(size_t i, double value) const {
    double w = 1;
    value = std::clamp(value, least, most);
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

namespace {

/// Least and largest value.
std::pair<double, double> valuesOf(const Curve& curve, WavelengthSpan span) {
    double low = curve.at(span.from), high = low;
    for (double place : placesOn(curve, span)) {
        low = std::min(low, curve.at(place));
        high = std::max(high, curve.at(place));
    }
    return {low, high};
}

bool areOne(double low, double high) {
    return high - low <= 1e-9 * std::max(std::abs(high), 1e-30);
}

Nodes chebyshev(double low, double high, int count) {
    Nodes nodes{{}, low, high};
    for (int i = 0; i < count; ++i)
        nodes.at.push_back(0.5 * (low + high) +
                           0.5 * (high - low) * std::cos(std::numbers::pi * (i + 0.5) / count));
    return nodes;
}

}  // namespace

Nodes nodesFor(const Curve& curve, WavelengthSpan span) {
    const auto [low, high] = valuesOf(curve, span);
    if (areOne(low, high)) return {{0.5 * (low + high)}, low, high};
    // Chebyshev nodes: four leave less than 1e-6 of the reflectance of any glass. Measured reflectances from
    // dark to bright need more: light that bounces between rough facets is a geometric series in them.
    const int count = high - low <= 0.1 ? 4 : high - low <= 0.4 ? 6 : 9;
    return chebyshev(low, high, count);
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

namespace {

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

}  // namespace

AngleFunction fresnelOf(CoatModel model, double value) {
    if (model == CoatModel::glass) return [value](double c) { return fresnelDielectric(c, value); };
    return [value](double c) { return fresnelSchlick(c, value); };
}

Coat coatOf(CoatModel model, double value, Widths widths) {
    Coat coat = coatOf(fresnelOf(model, value), widths);
    if (model == CoatModel::glass) {
        coat.index = value;
        // What a diffuse base sends up is let through as what comes down, per solid angle inside (n² of it):
        // 1 − r_inside = (1 − r_outside) / n², from the reciprocity of transmission.
        coat.inside = std::max(0.0, 1 - coat.meanThrough / (value * value));
    }
    return coat;
}

Coat coatOver(const Material& material, CoatModel model, double value, Widths widths) {
    Coat coat = coatOf(model, value, widths);
    if (material.diffuse && material.diffuse->isSeenThroughCoat) {
        coat.inside = 0;
        coat.index = 1;
    }
    return coat;
}

Nodes nodesForWay(Way way, CoatModel model, const Curve& number, WavelengthSpan span, Widths widths) {
    const auto [low, high] = valuesOf(number, span);
    const double middle = 0.5 * (low + high);
    if (areOne(low, high)) return {{middle}, low, high};
    const double white = facetAlbedos({fresnelOf(model, middle)}, widths).whiteMean;
    constexpr std::array<double, 7> cosines{1, 0.8, 0.6, 0.45, 0.3, 0.2, 0.1};
    using Row = std::array<double, cosines.size()>;
    // As coatOf(), but for how a rough coat's single scattering depends on the angle, which is linear in F.
    const auto passed = [&](double value) {
        const AngleFunction f = fresnelOf(model, value);
        const double mean = cosineMean(f), again = (1 - white) * multipleScattering(mean, white);
        const double all = std::max(1 - mean * white - again, 1e-12);
        const double inside = model == CoatModel::glass ? std::max(0.0, 1 - all / (value * value)) : 0;
        // Between coat and a bright base light goes to and fro.
        const double factor = (way == Way::in ? 1 : (1 - inside) / all) / (1 - 0.9 * inside);
        Row row;
        for (size_t i = 0; i < row.size(); ++i)
            row[i] = factor * (1 - f(cosines[i]) * white - again);
        return row;
    };
    constexpr int places = 24, mostNodes = 9;
    constexpr double tolerance = 2e-5;  // of what is passed at normal incidence
    std::vector<Row> wanted;
    for (int i = 0; i <= places; ++i)
        wanted.push_back(passed(low + (high - low) * i / places));
    const auto suffice = [&](const Nodes& nodes) {
        std::vector<Row> known;
        for (double value : nodes.at)
            known.push_back(passed(value));
        for (size_t p = 0; p < wanted.size(); ++p)
            for (size_t c = 0; c < cosines.size(); ++c) {
                double sum = 0;
                for (size_t k = 0; k < known.size(); ++k)
                    sum +=
                        nodes.weight(k, low + (high - low) * static_cast<double>(p) / places) * known[k][c];
                if (!(std::abs(sum - wanted[p][c]) <= tolerance * wanted[p][0])) return false;
            }
        return true;
    };
    int count = 1;
    while (count < mostNodes && !suffice(chebyshev(low, high, count)))
        ++count;
    return chebyshev(low, high, count);
}

}  // namespace spectrad
