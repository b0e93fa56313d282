#include "camera/colour_fit.h"

#include "base/cholesky.h"

#include <algorithm>
#include <numeric>

namespace spectrad {

std::vector<double> whiteBalance(const std::vector<double>& white) {
    const double most = *std::max_element(white.begin(), white.end());
    std::vector<double> gains;
    for (const double w : white) {
        if (!(w > 0)) throw InputError("a channel sees nothing of the white: it cannot be balanced");
        gains.push_back(most / w);
    }
    return gains;
}

XyzMatrix fittedMatrix(const Detector& camera, const Detector& observer, const Curve& light,
                       const std::vector<Curve>& chart) {
    const size_t n = camera.size();
    if (chart.size() < n)
        throw InputError("a chart of " + std::to_string(chart.size()) + " patches is too small for " +
                         std::to_string(n) + " channels");
    const Curve perfect = Curve::constant(1);
    const auto seen = [&](const Detector& detector, const Curve& patch) {
        const std::array<const Curve*, 2> product{&light, &patch};
        return respond(detector, product);
    };
    const std::vector<double> white = seen(camera, perfect), whiteXyz = seen(observer, perfect);
    static_cast<void>(whiteBalance(white));
    std::vector<std::vector<double>> gram(n, std::vector<double>(n));
    std::array<std::vector<double>, 3> target;
    target.fill(std::vector<double>(n));
    for (const Curve& patch : chart) {
        std::vector<double> channels = seen(camera, patch);
        const std::vector<double> xyz = seen(observer, patch);
        for (size_t c = 0; c < n; ++c)
            channels[c] /= white[c];
        for (size_t r = 0; r < n; ++r) {
            for (size_t c = 0; c < n; ++c)
                gram[r][c] += channels[r] * channels[c];
            for (size_t k = 0; k < 3; ++k)
                target[k][r] += channels[r] * xyz[k] / whiteXyz[1];
        }
    }
    // Rows m with G m = t − μ 1, where Lagrange's μ brings their sum, which is what they make of the white,
    // to it.
    const Cholesky factor(std::move(gram));
    const std::vector<double> ones = factor.solve(std::vector<double>(n, 1.0));
    const double sumOfOnes = std::accumulate(ones.begin(), ones.end(), 0.0);
    const auto row = [&](size_t k) {
        std::vector<double> m = factor.solve(target[k]);
        const double missing = whiteXyz[k] / whiteXyz[1] - std::accumulate(m.begin(), m.end(), 0.0);
        for (size_t c = 0; c < n; ++c)
            m[c] += missing / sumOfOnes * ones[c];
        return m;
    };
    return {row(0), row(1), row(2)};
}

}  // namespace spectrad
