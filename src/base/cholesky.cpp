#include "base/cholesky.h"

#include <cmath>

namespace spectrad {

Cholesky::Cholesky(Rows a) : factor_(std::move(a)) {
    constexpr double nothing = 1e-12;
    const size_t n = factor_.size();
    for (size_t j = 0; j < n; ++j) {
        const double before = factor_[j][j];
        double pivot = before;
        for (size_t k = 0; k < j; ++k)
            pivot -= factor_[j][k] * factor_[j][k];
        const bool used = pivot > nothing * before;
        factor_[j][j] = used ? std::sqrt(pivot) : 0;
        for (size_t i = j + 1; i < n; ++i) {
            double sum = factor_[i][j];
            for (size_t k = 0; k < j; ++k)
                sum -= factor_[i][k] * factor_[j][k];
            factor_[i][j] = used ? sum / factor_[j][j] : 0;
        }
    }
}

std::vector<double> Cholesky::solve(std::vector<double> b) const {
    const size_t n = factor_.size();
    for (size_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < i; ++k)
            b[i] -= factor_[i][k] * b[k];
        b[i] = factor_[i][i] > 0 ? b[i] / factor_[i][i] : 0;
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; ++k)
            b[i] -= factor_[k][i] * b[k];
        b[i] = factor_[i][i] > 0 ? b[i] / factor_[i][i] : 0;
    }
    return b;
}

}  // namespace spectrad
