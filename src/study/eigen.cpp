#include "study/eigen.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spectrad {

namespace {

/// Rows and columns p, q of a, and columns p, q of v, turned so that a(p, q) becomes zero.
void rotate(std::vector<double>& a, std::vector<double>& v, size_t size, size_t p, size_t q) {
    const double off = a[p * size + q];
    const double theta = (a[q * size + q] - a[p * size + p]) / (2 * off);
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
    const double c = 1 / std::hypot(t, 1.0), s = t * c;
    const auto turn = [c, s](double& first, double& second) {
        const double x = first, y = second;
        first = c * x - s * y;
        second = s * x + c * y;
    };
    for (size_t k = 0; k < size; ++k)
        turn(a[k * size + p], a[k * size + q]);
    for (size_t k = 0; k < size; ++k)
        turn(a[p * size + k], a[q * size + k]);
    for (size_t k = 0; k < size; ++k)
        turn(v[k * size + p], v[k * size + q]);
}

}  // namespace

Eigen eigenOf(std::vector<double> a, size_t size) {
    double total = 0;
    for (size_t i = 0; i < size; ++i) {
        for (size_t j = 0; j < i; ++j)
            a[i * size + j] = a[j * size + i];
        for (size_t j = 0; j < size; ++j)
            total += a[i * size + j] * a[i * size + j];
    }
    std::vector<double> v(size * size, 0);
    for (size_t i = 0; i < size; ++i)
        v[i * size + i] = 1;
    // Convergence is quadratic: far fewer sweeps than this are enough.
    constexpr int mostSweeps = 50;
    for (int sweep = 0; sweep < mostSweeps; ++sweep) {
        double off = 0;
        for (size_t p = 0; p < size; ++p)
            for (size_t q = p + 1; q < size; ++q)
                off += a[p * size + q] * a[p * size + q];
        if (off <= 1e-30 * total) break;
        for (size_t p = 0; p < size; ++p)
            for (size_t q = p + 1; q < size; ++q)
                if (a[p * size + q] != 0) rotate(a, v, size, p, q);
    }
    std::vector<size_t> order(size);
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(),
              [&](size_t i, size_t j) { return a[i * size + i] > a[j * size + j]; });
    Eigen result;
    for (size_t i : order) {
        result.value.push_back(a[i * size + i]);
        std::vector<double> column;
        for (size_t k = 0; k < size; ++k)
            column.push_back(v[k * size + i]);
        result.vector.push_back(std::move(column));
    }
    return result;
}

}  // namespace spectrad
