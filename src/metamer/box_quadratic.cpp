#include "metamer/box_quadratic.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

double product(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// argmin ½ xᵀ (q + ρ) x − vᵀ x on a x = b.
class OnPlane {
  public:
    OnPlane(const BoxQuadratic& problem, double rho)
        : problem_(problem), quadratic_(shifted(problem.q, rho)), schur_(schurOf()) {}

    [[nodiscard]] std::vector<double> at(const std::vector<double>& v) const {
        std::vector<double> x = quadratic_.solve(v);
        std::vector<double> miss;
        for (size_t r = 0; r < problem_.a.size(); ++r)
            miss.push_back(product(problem_.a[r], x) - problem_.b[r]);
        const std::vector<double> multiplier = schur_.solve(std::move(miss));
        for (size_t r = 0; r < columns_.size(); ++r)
            for (size_t i = 0; i < x.size(); ++i)
                x[i] -= columns_[r][i] * multiplier[r];
        return x;
    }

  private:
    static Rows shifted(Rows q, double rho) {
        for (size_t i = 0; i < q.size(); ++i)
            q[i][i] += rho;
        return q;
    }
    /// a (q + ρ)⁻¹ aᵀ; keeps (q + ρ)⁻¹ aᵀ.
    Rows schurOf() {
        for (const std::vector<double>& row : problem_.a)
            columns_.push_back(quadratic_.solve(row));
        Rows schur(columns_.size(), std::vector<double>(columns_.size()));
        for (size_t r = 0; r < columns_.size(); ++r)
            for (size_t c = 0; c < columns_.size(); ++c)
                schur[r][c] = product(problem_.a[r], columns_[c]);
        return schur;
    }

    const BoxQuadratic& problem_;
    Cholesky quadratic_;
    Rows columns_;
    Cholesky schur_;
};

}  // namespace

BoxSolution minimise(const BoxQuadratic& problem, int mostSteps) {
    constexpr double agreed = 1e-9;
    const size_t n = problem.linear.size();
    double trace = 0;
    for (size_t i = 0; i < n; ++i)
        trace += problem.q[i][i];
    const double rho = std::max(0.02 * trace / static_cast<double>(n), 1e-9);
    const OnPlane plane(problem, rho);

    std::vector<double> z(n, (problem.low + problem.high) / 2), dual(n, 0.0), v(n);
    BoxSolution solution;
    for (solution.steps = 1; solution.steps <= mostSteps; ++solution.steps) {
        for (size_t i = 0; i < n; ++i)
            v[i] = rho * (z[i] - dual[i]) - problem.linear[i];
        const std::vector<double> x = plane.at(v);
        double apart = 0;
        for (size_t i = 0; i < n; ++i) {
            const double next = std::clamp(x[i] + dual[i], problem.low, problem.high);
            apart = std::max({apart, std::abs(x[i] - next), std::abs(next - z[i])});
            dual[i] += x[i] - next;
            z[i] = next;
        }
        if (apart < agreed) break;
    }
    double scale = 0;
    for (const double b : problem.b)
        scale = std::max(scale, std::abs(b));
    for (size_t r = 0; r < problem.a.size(); ++r)
        solution.largestMiss =
            std::max(solution.largestMiss,
                     std::abs(product(problem.a[r], z) - problem.b[r]) / (scale > 0 ? scale : 1));
    solution.x = std::move(z);
    return solution;
}

}  // namespace spectrad
