#include "render/fresnel.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

// Both in forms without differences of nearly equal numbers: indices near 1 keep all digits of their
// reflectance.
double fresnelDielectric(double c, double n) {
    if (n == 1) return 0;  // there is no surface, not even edge-on, where the limit of n > 1 is 1
    const double square = (n - 1) * (n + 1) + c * c;
    if (square < 0) return 1;
    const double g = std::sqrt(square), sum = g + c;
    const double a = (n - 1) * (n + 1) / (sum * sum);  // (g − c) / (g + c)
    const double b = (c * sum - 1) / (c * (g - c) + 1);
    return std::min(0.5 * a * a * (1 + b * b), 1.0);
}

double fresnelConductor(double c, double n, double k) {
    if (n == 1 && k == 0) return 0;
    // Born & Wolf, 13.4: (a + i b)² = (n + i k)² − sin²θ; the larger of a and b by a sum, the other from a b
    // = n k.
    const double c2 = c * c, s2 = 1 - c2, excess = (n - 1) * (n + 1) - k * k;  // of n² − k² over 1
    const double t0 = excess + c2, length = std::hypot(t0, 2 * n * k);
    const double larger = std::sqrt(0.5 * (length + std::abs(t0))), smaller = larger > 0 ? n * k / larger : 0;
    const double a = t0 < 0 ? smaller : larger, b = t0 < 0 ? larger : smaller, b2 = b * b;
    if (a + c == 0) return 1;                                   // edge-on, total reflection
    const double less = (b2 + excess) / (a + c), more = a + c;  // a − c, a + c
    const double rs = (less * less + b2) / (more * more + b2);
    const double down = a * c - s2, up = a * c + s2, side = b2 * c2;
    const double rp = up * up + side > 0 ? rs * (down * down + side) / (up * up + side) : rs;
    return std::clamp(0.5 * (rs + rp), 0.0, 1.0);
}

double fresnelSchlick(double c, double r0) {
    const double m = 1 - c, m2 = m * m;
    return r0 + (1 - r0) * m2 * m2 * m;
}

namespace {

/// Wavelengths between which n and k are linear, each interval cut into `parts`, thinned to at most a
/// thousand.
std::vector<double> wavelengthsOf(const Curve& n, const Curve& k, double from, double to, int parts) {
    std::vector<double> knots{from, to};
    n.appendBreaks(from, to, knots);
    k.appendBreaks(from, to, knots);
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    std::vector<double> result;
    for (size_t i = 0; i + 1 < knots.size(); ++i)
        for (int p = 0; p < parts; ++p)
            result.push_back(knots[i] + (knots[i + 1] - knots[i]) * p / parts);
    result.push_back(to);
    constexpr size_t most = 1000;
    if (result.size() <= most) return result;
    std::vector<double> thinned;
    for (size_t i = 0; i < most; ++i)
        thinned.push_back(result[i * (result.size() - 1) / (most - 1)]);
    return thinned;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// Reflectance of all wavelengths at one angle, relative to normal incidence so that dark wavelengths count
/// as much as bright ones.
struct Spectra {
    std::vector<double> n, k, weight;
    Spectra(const Curve& nCurve, const Curve& kCurve, const std::vector<double>& wavelengths) {
        for (double w : wavelengths) {
            n.push_back(nCurve.at(w));
            k.push_back(kCurve.at(w));
            weight.push_back(1 / std::max(fresnelConductor(1, n.back(), k.back()), 1e-4));
        }
    }
    [[nodiscard]] std::vector<double> at(double cosine) const {
        std::vector<double> row;
        for (size_t i = 0; i < n.size(); ++i)
            row.push_back(weight[i] * fresnelConductor(cosine, n[i], k[i]));
        return row;
    }
};

/// The chosen angles' spectra, orthonormalized: gives the coefficients of any angle's spectrum in terms of
/// the chosen ones.
struct Basis {
    std::vector<std::vector<double>> q;  ///< orthonormal
    std::vector<std::vector<double>> r;  ///< r[j][i] = q[i] · chosen[j], i ≤ j

    /// Coefficients on q; leaves the residual in `row`.
    std::vector<double> reduce(std::vector<double>& row) const {
        std::vector<double> coefficients(q.size(), 0.0);
        for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Kahan)
            for (size_t i = 0; i < q.size(); ++i) {
                const double d = dot(q[i], row);
                coefficients[i] += d;
                for (size_t j = 0; j < row.size(); ++j)
                    row[j] -= d * q[i][j];
            }
        }
        return coefficients;
    }
    void add(std::vector<double> row) {
        std::vector<double> coefficients = reduce(row);
        const double length = std::sqrt(dot(row, row));
        for (double& v : row)
            v /= length;
        coefficients.push_back(length);
        q.push_back(std::move(row));
        r.push_back(std::move(coefficients));
    }
    /// Weights of the chosen spectra that come nearest to `row`.
    [[nodiscard]] std::vector<double> weights(std::vector<double> row) const {
        std::vector<double> c = reduce(row);
        for (size_t i = c.size(); i-- > 0;) {
            c[i] /= r[i][i];
            for (size_t j = 0; j < i; ++j)
                c[j] -= r[i][j] * c[i];
        }
        return c;
    }
};

double largest(const std::vector<double>& row) {
    double m = 0;
    for (double v : row)
        m = std::max(m, std::abs(v));
    return m;
}

}  // namespace

FresnelBasis conductorBasis(const Curve& n, const Curve& k, double from, double to) {
    constexpr int angles = 192;
    constexpr size_t mostTerms = 12;
    constexpr double wanted = 2e-7;  // on the coarse grid; what the fine grid finds is reported
    const Spectra spectra(n, k, wavelengthsOf(n, k, from, to, 2));
    std::vector<std::vector<double>> left;
    for (int i = 0; i <= angles; ++i) {
        const double root = static_cast<double>(i) / angles;
        left.push_back(spectra.at(root * root));
    }
    Basis basis;
    std::vector<double> cosines;
    while (basis.q.size() < mostTerms) {
        size_t worst = 0;
        for (size_t i = 0; i < left.size(); ++i)
            if (largest(left[i]) > largest(left[worst])) worst = i;
        if (!basis.q.empty() && largest(left[worst]) < wanted) break;
        if (basis.q.empty()) worst = angles;   // normal incidence first
        if (largest(left[worst]) == 0) break;  // nothing is reflected at all
        const double root = static_cast<double>(worst) / angles;
        cosines.push_back(root * root);
        basis.add(spectra.at(root * root));
        for (auto& row : left) {
            const double d = dot(basis.q.back(), row);
            for (size_t j = 0; j < row.size(); ++j)
                row[j] -= d * basis.q.back()[j];
        }
    }
    FresnelBasis result;
    // Where tabulate() asks, these are the weights themselves; between, a cubic through them.
    constexpr int nodes = 3 * SD_CELLS;
    std::vector<std::vector<double>> weightsAt(cosines.size());
    for (int i = 0; i <= nodes; ++i) {
        const double root = static_cast<double>(i) / nodes;
        const std::vector<double> weights = basis.weights(spectra.at(root * root));
        for (size_t c = 0; c < weights.size(); ++c)
            weightsAt[c].push_back(weights[c]);
    }
    for (size_t i = 0; i < cosines.size(); ++i) {
        const double cosine = cosines[i];
        result.spectrum.push_back(Curve::combined(
            {n, k}, [cosine](std::span<const double> v) { return fresnelConductor(cosine, v[0], v[1]); }));
        result.angle.push_back(interpolated(std::move(weightsAt[i])));
    }
    const Spectra fine(n, k, wavelengthsOf(n, k, from, to, 3));
    for (int a = 0; a <= 400 && !cosines.empty(); ++a) {
        const double cosine = (a / 400.0) * (a / 400.0);
        const std::vector<double> exact = fine.at(cosine);
        std::vector<double> weights;
        for (const AngleFunction& f : result.angle)
            weights.push_back(f(cosine));
        for (size_t j = 0; j < exact.size(); ++j) {
            double sum = 0;
            for (size_t i = 0; i < weights.size(); ++i)
                sum += weights[i] * fine.weight[j] * fresnelConductor(cosines[i], fine.n[j], fine.k[j]);
            if (exact[j] > 0)
                result.relativeError = std::max(result.relativeError, std::abs(sum - exact[j]) / exact[j]);
        }
    }
    return result;
}

FresnelBasis schlickBasis(const Curve& n, const Curve& k) {
    FresnelBasis basis;
    basis.angle = {[](double c) { return 1 - fresnelSchlick(c, 0); },
                   [](double c) { return fresnelSchlick(c, 0); }};
    basis.spectrum = {
        Curve::combined({n, k}, [](std::span<const double> v) { return fresnelConductor(1, v[0], v[1]); }),
        Curve::constant(1)};
    return basis;
}

double schlickError(const Curve& n, const Curve& k, double from, double to) {
    double error = 0;
    for (double w : wavelengthsOf(n, k, from, to, 1)) {
        const double nw = n.at(w), kw = k.at(w), r0 = fresnelConductor(1, nw, kw);
        for (int a = 0; a <= 90; ++a) {
            const double cosine = std::cos(a * 3.14159265358979324 / 180);
            error = std::max(error, std::abs(fresnelSchlick(cosine, r0) - fresnelConductor(cosine, nw, kw)));
        }
    }
    return error;
}

}  // namespace spectrad
