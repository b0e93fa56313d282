#include "colour/cct.h"

#include "spectrum/gauss.h"
#include "spectrum/si.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

// Reciprocal temperature is measured in mired, 10⁶/K: perceptibly even, and 0 (an infinite temperature) is an
// ordinary point.
static constexpr double leastMired = 1, mostMired = 1250;  // 1 000 000 K … 800 K
static constexpr double miredStep = 5;
static constexpr size_t tableSize = 252;  // from 0 to one step beyond mostMired
static constexpr double largestDuv = 0.05;

PlanckianLocus::PlanckianLocus(const Detector& observer) {
    if (!observer.tristimulus || observer.size() != 3)
        throw InputError("colour temperatures need an observer with the channels X, Y, Z, not '" +
                         observer.name + "'");
    // The observer's curves are smooth between their breaks: a 4-point Gauss rule there.
    std::vector<double> cuts;
    for (const Curve& curve : observer.response)
        if (const auto range = curve.range()) {
            cuts.push_back(range->first);
            cuts.push_back(range->second);
            curve.appendBreaks(range->first, range->second, cuts);
        }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    for (size_t i = 0; i + 1 < cuts.size(); ++i)
        for (size_t k = 0; k < gaussNodes.size(); ++k) {
            const double half = (cuts[i + 1] - cuts[i]) / 2,
                         nm = (cuts[i] + cuts[i + 1]) / 2 + half * gaussNodes[k];
            const double scale = half * gaussWeights[k] * std::pow(nm / 560, -4);
            nodes_.push_back({nm,
                              {observer.response[0].at(nm) * scale, observer.response[1].at(nm) * scale,
                               observer.response[2].at(nm) * scale}});
        }
    table_.reserve(tableSize);
    for (size_t i = 0; i < tableSize; ++i)
        table_.push_back(point(static_cast<double>(i) * miredStep));
}

PlanckianLocus::Point PlanckianLocus::point(double mired) const {
    // Planck's law but for a factor of the temperature alone: λ⁻⁴ x / (eˣ − 1), x = c₂ / (λ T), which stays
    // finite at x = 0; a mired is 1e-6/K.
    Triple xyz{}, slope{};
    for (const Node& node : nodes_) {
        const double perMired = 1e9 * secondRadiation * 1e-6 / node.nm, x = perMired * mired;
        double value, derivative;
        if (x < 1e-4) {
            value = 1 - x / 2 + x * x / 12;
            derivative = -0.5 + x / 6;
        } else {
            const double e = std::expm1(x);
            value = x / e;
            derivative = (1 - value * (e + 1)) / e;
        }
        derivative *= perMired;
        for (size_t c = 0; c < 3; ++c) {
            xyz[c] += node.weight[c] * value;
            slope[c] += node.weight[c] * derivative;
        }
    }
    const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2], sumSlope = slope[0] + 15 * slope[1] + 3 * slope[2];
    const double u = 4 * xyz[0] / sum, v = 6 * xyz[1] / sum;
    return {u, v, (4 * slope[0] - u * sumSlope) / sum, (6 * slope[1] - v * sumSlope) / sum};
}

std::array<double, 2> PlanckianLocus::at(double kelvin) const {
    const Point p = point(1e6 / kelvin);
    return {p.u, p.v};
}

std::optional<Cct> PlanckianLocus::nearest(const Triple& xyz) const {
    const auto uv = uvPrime(xyz);
    if (!uv) return std::nullopt;
    const double u = (*uv)[0], v = (*uv)[1] * 2 / 3;  // CIE 1960 from 1976

    const auto distance = [&](const Point& p) { return std::hypot(u - p.u, v - p.v); };
    const auto best = std::min_element(table_.begin(), table_.end(), [&](const Point& a, const Point& b) {
        return distance(a) < distance(b);
    });
    const auto index = static_cast<size_t>(best - table_.begin());
    if (index + 1 == table_.size()) return std::nullopt;

    // The nearest point is where the tangent is at right angles to the way there: a zero of `along`, falling
    // through it between the neighbours of the best entry. Regula falsi in the Illinois form keeps the zero
    // bracketed.
    const auto along = [&](const Point& p) { return (u - p.u) * p.du + (v - p.v) * p.dv; };
    const size_t before = index > 0 ? index - 1 : 0;
    double low = static_cast<double>(before) * miredStep, high = static_cast<double>(index + 1) * miredStep;
    double atLow = along(table_[before]), atHigh = along(table_[index + 1]);
    if (!(atLow >= 0 && atHigh <= 0)) return std::nullopt;
    double mired = static_cast<double>(index) * miredStep;
    Point p = *best;
    for (int moved = 0, i = 0; i < 60 && atLow > atHigh; ++i) {
        const double next = (low * atHigh - high * atLow) / (atHigh - atLow);
        if (i > 0 && std::abs(next - mired) <= 1e-13 * mired) break;
        mired = next;
        p = point(mired);
        const double here = along(p);
        if (here == 0) break;
        // An end that stays put twice running counts half, or it would stay for ever.
        if (here > 0) {
            low = mired, atLow = here;
            if (moved == 1) atHigh /= 2;
            moved = 1;
        } else {
            high = mired, atHigh = here;
            if (moved == -1) atLow /= 2;
            moved = -1;
        }
    }
    if (mired < leastMired * (1 - 1e-9) || mired > mostMired * (1 + 1e-9)) return std::nullopt;
    // Towards cooler bodies the locus runs to larger u: what lies to the left of that direction is above it.
    const double left = (v - p.v) * p.du - (u - p.u) * p.dv;
    const double duv = std::copysign(distance(p), left);
    if (std::abs(duv) > largestDuv) return std::nullopt;
    return Cct{1e6 / mired, duv};
}

}  // namespace spectrad
