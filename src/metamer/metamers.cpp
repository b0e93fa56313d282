#include "metamer/metamers.h"

#include "base/text.h"
#include "metamer/box_quadratic.h"

#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// qᵢⱼ of ½ rᵀ q r = weight · Σ (second difference)²: that over a grid of uneven steps, in units of 10 nm.
Rows roughness(const std::vector<double>& nm, double weight) {
    const size_t n = nm.size();
    Rows q(n, std::vector<double>(n));
    constexpr double unit = 10;  // nm
    for (size_t j = 1; j + 1 < n; ++j) {
        const double a = (nm[j] - nm[j - 1]) / unit, b = (nm[j + 1] - nm[j]) / unit;
        const std::array<double, 3> d{2 / (a * (a + b)), -2 / (a * b), 2 / (b * (a + b))};
        for (size_t r = 0; r < 3; ++r)
            for (size_t c = 0; c < 3; ++c)
                q[j - 1 + r][j - 1 + c] += 2 * weight * (a + b) / 2 * d[r] * d[c];
    }
    return q;
}

double sumOf(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values)
        sum += v;
    return sum;
}

/// Opponent signals of a viewing, each relative to the white: what is seen in direction `angle`.
std::vector<double> direction(const Viewing& viewing, const std::vector<double>& nm, double angle) {
    const std::vector<std::vector<double>> rows = viewing.weights(nm);
    const std::vector<double>&first = rows.front(), &middle = rows[rows.size() / 2], &last = rows.back();
    std::vector<double> seen(nm.size());
    for (size_t j = 0; j < nm.size(); ++j) {
        const double f = first[j] / sumOf(first), m = middle[j] / sumOf(middle), l = last[j] / sumOf(last);
        seen[j] =
            std::cos(angle) * 2.5 * (f - m) + std::sin(angle) * (m - l);  // as a* and b* stand to each other
    }
    return seen;
}

}  // namespace

Curve Metamer::curve(const std::vector<double>& nm) const {
    return Curve::table(nm, value, Outside::hold);
}

std::vector<Metamer> makeMetamers(const Curve& original, const std::vector<Viewing>& match,
                                  const std::vector<Viewing>& differ, const MetamerSettings& settings) {
    constexpr double missAllowed = 1e-5;  // of the white's signal: some 0.001 ΔE
    constexpr double ease = 2;            // with it, smoothness 1 makes curves that paints could have
    const std::vector<double>& nm = settings.nm;
    BoxQuadratic problem;
    problem.q = roughness(nm, ease * settings.smoothness);
    problem.low = settings.low;
    problem.high = settings.high;
    for (const Viewing& viewing : match) {
        const std::vector<double> wanted = viewing.signals(original);
        for (std::vector<double>& row : viewing.weights(nm))
            problem.a.push_back(std::move(row));
        problem.b.insert(problem.b.end(), wanted.begin(), wanted.end());
    }
    std::vector<Metamer> metamers;
    for (int k = 0; k < settings.count; ++k) {
        const double angle = 2 * std::numbers::pi * k / settings.count;
        problem.linear.assign(nm.size(), 0);
        for (const Viewing& viewing : differ) {
            const std::vector<double> seen = direction(viewing, nm, angle);
            for (size_t j = 0; j < nm.size(); ++j)
                problem.linear[j] -= seen[j] / static_cast<double>(differ.size());
        }
        const BoxSolution solution = minimise(problem);
        if (solution.largestMiss > missAllowed)
            throw InputError(
                "no reflectance from " + shortest(settings.low) + " to " + shortest(settings.high) +
                " matches under all of the viewings (nearest: " + rounded(solution.largestMiss, 2) +
                " of the signal away); ask for fewer matches or wider bounds");
        Metamer metamer{solution.x, {}, {}};
        const Curve curve = metamer.curve(nm);
        for (const Viewing& viewing : match)
            metamer.matched.push_back(difference(viewing, original, curve));
        for (const Viewing& viewing : differ)
            metamer.differing.push_back(difference(viewing, original, curve));
        metamers.push_back(std::move(metamer));
    }
    return metamers;
}

}  // namespace spectrad
