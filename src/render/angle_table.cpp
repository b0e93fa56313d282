#include "render/angle_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

std::vector<sd_piece> tabulate(const AngleFunction& f) {
    std::vector<sd_piece> pieces(SD_CELLS);
    for (int cell = 0; cell < SD_CELLS; ++cell) {
        std::array<double, 4> y{};
        for (int i = 0; i < 4; ++i) {
            const double root = (cell + i / 3.0) / SD_CELLS;
            y[static_cast<size_t>(i)] = f(root * root);
        }
        // The cubic through t = 0, 1/3, 2/3, 1.
        const double d1 = y[1] - y[0], d2 = y[2] - y[0], d3 = y[3] - y[0];
        const std::array<double, 4> c{y[0], 9 * d1 - 4.5 * d2 + d3, -22.5 * d1 + 18 * d2 - 4.5 * d3,
                                      13.5 * d1 - 13.5 * d2 + 4.5 * d3};
        for (size_t i = 0; i < 4; ++i)
            pieces[static_cast<size_t>(cell)].c[i] = static_cast<float>(c[i]);
    }
    return pieces;
}

double evaluate(const sd_piece* table, double cosine) {
    const double at = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * SD_CELLS;
    const int cell = std::min(static_cast<int>(at), SD_CELLS - 1);
    const double t = at - cell;
    const float* c = table[cell].c;
    return double{c[0]} + t * (double{c[1]} + t * (double{c[2]} + t * double{c[3]}));
}

double cosineMean(const AngleFunction& f) {
    // μ = s², dμ = 2 s ds: composite Simpson in s, where table functions are smooth.
    constexpr int steps = 512;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
        const double s = static_cast<double>(i) / steps;
        const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
        sum += weight * f(s * s) * s * s * s;
    }
    return 4 * sum / (3 * steps);
}

AngleFunction interpolated(std::vector<double> values) {
    return [values = std::move(values)](double cosine) {
        const int n = static_cast<int>(values.size()) - 1;
        const double at = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * n;
        const int first = std::clamp(static_cast<int>(at) - 1, 0, n - 3);
        double sum = 0;
        for (int a = first; a < first + 4; ++a) {
            double weight = 1;
            for (int b = first; b < first + 4; ++b)
                if (b != a) weight *= (at - b) / (a - b);
            sum += weight * values[static_cast<size_t>(a)];
        }
        return sum;
    };
}

}  // namespace spectrad
