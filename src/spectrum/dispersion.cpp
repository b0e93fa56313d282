#include "spectrum/dispersion.h"

#include "spectrum/curve_body.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

constexpr double smallestIndex = 1, largestIndex = 6;

/// Steps of ten percent, from 1 nm on; between them cut where the formula bends.
void dispersionBreaks(const std::function<double(double)>& index, double from, double to,
                      std::vector<double>& out) {
    constexpr double ratio = 1.1, shortestNm = 1;
    for (double a = from; a < to;) {
        const double b = std::min(std::max(a, shortestNm) * ratio, to);
        appendSmoothBreaks(index, a, b, out);
        if (b < to) out.push_back(b);
        a = b;
    }
}

bool isPossible(double n) {
    return n >= smallestIndex && n <= largestIndex;
}

/// `raw` may be anything at a resonance, not a number included.
std::optional<Curve> indexCurve(const std::function<double(double)>& raw) {
    bool possible = false;
    for (double nm = 100; nm <= 20'000 && !possible; nm *= 1.005)
        possible = isPossible(raw(nm));
    if (!possible) return std::nullopt;
    const std::function<double(double)> index = [raw](double nm) {
        const double n = raw(nm);
        return n > smallestIndex ? std::min(n, largestIndex) : smallestIndex;
    };
    return Curve::formula(index, [index](double from, double to, std::vector<double>& out) {
        dispersionBreaks(index, from, to, out);
    });
}

}  // namespace

std::optional<Curve> sellmeier(std::span<const double> terms) {
    return indexCurve([all = std::vector<double>(terms.begin(), terms.end())](double nm) {
        const double square = nm * nm * 1e-6;  // µm²
        double n2 = 1;
        for (size_t i = 0; i + 1 < all.size(); i += 2)
            n2 += all[i] * square / (square - all[i + 1]);
        return std::sqrt(n2);
    });
}

std::optional<Curve> cauchy(std::span<const double> terms) {
    return indexCurve([all = std::vector<double>(terms.begin(), terms.end())](double nm) {
        const double square = nm * nm * 1e-6;
        double n = 0;
        for (size_t i = all.size(); i-- > 0;)
            n = n / square + all[i];
        return n;
    });
}

}  // namespace spectrad
