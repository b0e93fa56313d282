#include "render/facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

double multipleScattering(double meanFresnel, double whiteMean) {
    return meanFresnel * meanFresnel * whiteMean / (1 - meanFresnel * (1 - whiteMean));
}

OrenNayar orenNayar(double sigmaDegrees) {
    constexpr double pi = std::numbers::pi;
    const double s2 = std::pow(sigmaDegrees * pi / 180, 2);
    const double ratio = 0.45 * s2 / (s2 + 0.09) / (1 - 0.5 * s2 / (s2 + 0.33));
    OrenNayar model;
    model.a = 1 / (1 + (0.5 - 2 / (3 * pi)) * ratio);
    model.b = model.a * ratio;
    const double a = model.a;
    model.albedo = [a, ratio](double cosine) {
        // ∫ over the hemisphere of the shape 1 + (B/A) s/t: closed form (Portsmouth, Kutz & Hill 2024, eq.
        // 17).
        const double c = std::clamp(cosine, 0.0, 1.0), sine = std::sqrt(1 - c * c), theta = std::acos(c);
        const double g = sine * (theta - sine * c) +
                         (2.0 / 3.0) * ((c > 1e-7 ? sine / c * (1 - sine * sine * sine) : 0.0) - sine);
        return a * (1 + ratio * g / pi);
    };
    model.mean = cosineMean(model.albedo);
    return model;
}

}  // namespace spectrad
