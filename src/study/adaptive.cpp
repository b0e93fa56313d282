#include "study/adaptive.h"

#include "colour/detector.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

namespace {

/// What light and eye are together.
class Seen {
  public:
    Seen(Curve light, const Detector& observer)
        : light_(std::move(light)), sum_(Curve::combined(observer.response, [](std::span<const double> v) {
              double sum = 0;
              for (double value : v)
                  sum += std::abs(value);
              return sum;
          })) {
        total_ = integral(380, 780);
    }
    /// Of the trapezoid rule over an interval, as a share of the whole.
    [[nodiscard]] double error(double from, double to) const {
        if (!(total_ > 0)) return 0;
        const double rule = 0.5 * (to - from) * (at(from) + at(to));
        return std::abs(rule - integral(from, to)) / total_;
    }

  private:
    [[nodiscard]] double at(double nm) const { return light_.at(nm) * sum_.at(nm); }
    [[nodiscard]] double integral(double from, double to) const {
        const std::array<const Curve*, 2> product{&light_, &sum_};
        return integrate(product, from, to);
    }

    Curve light_, sum_;
    double total_ = 0;
};

}  // namespace

std::vector<double> adaptiveWavelengths(const Scene& scene, const Detector& observer, int count) {
    std::vector<Seen> lights;
    for (const Light& light : scene.lights)
        if (!light.emitter.texture) lights.emplace_back(light.emitter.spectrum.curve(), observer);
    if (lights.empty()) lights.emplace_back(Curve::constant(1), observer);
    const auto errorOf = [&](double from, double to) {
        double worst = 0;
        for (const Seen& light : lights)
            worst = std::max(worst, light.error(from, to));
        return worst;
    };
    std::vector<double> nm{380, 780};
    std::vector<double> error{errorOf(380, 780)};  // of the interval that begins at nm[i]
    while (nm.size() < static_cast<size_t>(count)) {
        const auto worst = static_cast<size_t>(std::max_element(error.begin(), error.end()) - error.begin());
        const double middle = 0.5 * (nm[worst] + nm[worst + 1]);
        nm.insert(nm.begin() + static_cast<std::ptrdiff_t>(worst) + 1, middle);
        error[worst] = errorOf(nm[worst], middle);
        error.insert(error.begin() + static_cast<std::ptrdiff_t>(worst) + 1, errorOf(middle, nm[worst + 2]));
    }
    return nm;
}

}  // namespace spectrad
