#include "study/quadrature.h"

#include "study/eigen.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

/// A detector on wavelengths 1 nm apart, as [channel][wavelength].
struct Sampled {
    std::vector<double> nm;
    std::vector<std::vector<double>> channel;
    std::vector<double> weight;  ///< Σ |channel|
};

Sampled sampled(const Detector& observer) {
    double from = 1e9, to = 0;
    for (const Curve& curve : observer.response) {
        if (const auto range = curve.range()) {
            from = std::min(from, range->first);
            to = std::max(to, range->second);
        }
    }
    Sampled out;
    for (double nm = from; nm <= to; nm += 1)
        out.nm.push_back(nm);
    out.weight.assign(out.nm.size(), 0);
    for (const Curve& curve : observer.response) {
        std::vector<double> values(out.nm.size());
        curve.values(out.nm, values);
        for (size_t i = 0; i < values.size(); ++i)
            out.weight[i] += std::abs(values[i]);
        out.channel.push_back(std::move(values));
    }
    return out;
}

/// Values of a polynomial at all wavelengths.
using Polynomial = std::vector<double>;

double inner(const Polynomial& a, const Polynomial& b, const std::vector<double>& weight) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += weight[i] * a[i] * b[i];
    return sum;
}

}  // namespace

QuadratureRule gaussRule(const Detector& observer, int count) {
    const Sampled s = sampled(observer);
    const auto n = static_cast<size_t>(count);
    // Stieltjes' procedure: orthonormal polynomials p_j of t in −1…1, and the coefficients of their
    // recurrence, t p_j = β_{j+1} p_{j+1} + α_j p_j + β_j p_{j−1}.
    const double middle = (s.nm.front() + s.nm.back()) / 2, half = (s.nm.back() - s.nm.front()) / 2;
    std::vector<double> t;
    for (double nm : s.nm)
        t.push_back((nm - middle) / half);
    std::vector<Polynomial> p{Polynomial(t.size(), 1)};
    std::vector<double> jacobi(n * n, 0);
    const double norm = std::sqrt(inner(p[0], p[0], s.weight));
    for (double& value : p[0])
        value /= norm;
    for (size_t j = 0; j < n; ++j) {
        Polynomial next(t.size());
        for (size_t i = 0; i < t.size(); ++i)
            next[i] = t[i] * p[j][i];
        jacobi[j * n + j] = inner(next, p[j], s.weight);
        // Against all before it, so that rounding does not spoil the higher ones.
        for (const Polynomial& before : p) {
            const double share = inner(next, before, s.weight);
            for (size_t i = 0; i < t.size(); ++i)
                next[i] -= share * before[i];
        }
        const double beta = std::sqrt(inner(next, next, s.weight));
        if (j + 1 < n) jacobi[j * n + j + 1] = beta;
        for (double& value : next)
            value /= beta;
        p.push_back(std::move(next));
    }
    // Golub & Welsch 1969: nodes are the eigenvalues, and what the polynomials are there the eigenvectors.
    const Eigen eigen = eigenOf(jacobi, n);
    QuadratureRule rule;
    rule.weights.weights.assign(observer.size(), std::vector<double>(n, 0));
    for (size_t k = 0; k < n; ++k) {
        const size_t node = n - 1 - k;  // ascending
        rule.nm.push_back(middle + half * eigen.value[node]);
        // Interpolation at the nodes: p_j there is e_j / (e_0 norm), and the Christoffel number is (e_0
        // norm)².
        const double first = eigen.vector[node][0] * norm;
        for (size_t c = 0; c < observer.size(); ++c) {
            double sum = 0;
            for (size_t j = 0; j < n; ++j) {
                double moment = 0;
                for (size_t i = 0; i < t.size(); ++i)
                    moment += s.channel[c][i] * p[j][i];
                sum += eigen.vector[node][j] * first * moment;
            }
            rule.weights.weights[c][k] = observer.scale * sum;
        }
    }
    return rule;
}

}  // namespace spectrad
