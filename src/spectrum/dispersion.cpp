#include "spectrum/dispersion.h"

#include "spectrum/curve_body.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

constexpr double smallestIndex = 1, largestIndex = 6;

/// The widest run of wavelengths (by ratio), in steps of half a percent, where the index is possible; nothing
/// if none is.
std::optional<NmRange> transparentWindow(const std::function<double(double)>& index) {
    constexpr double firstNm = 100, lastNm = 1e6, ratio = 1.005;
    std::optional<NmRange> widest;
    double from = 0, last = 0;
    for (double nm = firstNm; nm <= lastNm; nm *= ratio) {
        const double n = index(nm);
        if (!(n >= smallestIndex && n <= largestIndex)) {
            from = 0;
            continue;
        }
        if (from == 0) from = nm;
        last = nm;
        if (!widest || last / from > widest->second / widest->first) widest = NmRange{from, last};
    }
    return widest;
}

std::optional<Curve> indexCurve(const std::function<double(double)>& index) {
    const auto window = transparentWindow(index);
    if (!window) return std::nullopt;
    const auto breaks = [index](double from, double to, std::vector<double>& out) {
        constexpr double ratio = 1.1;
        for (double a = from; a < to;) {
            const double b = std::min(a * ratio, to);
            appendSmoothBreaks(index, a, b, out);
            if (b < to) out.push_back(b);
            a = b;
        }
    };
    return Curve::formula(index, breaks, *window).withOutside(Outside::hold);
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
