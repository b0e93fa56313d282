// Running integrals of a product with a light, exact at every wavelength.
#pragma once

#include "spectrum/curve.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace spectrad {

/// G(λ) = ∫ from the range's start to λ of Π weights · light dλ', spectral lines included (a line counts from
/// its own wavelength on). Integrated with the Gauss rule of projection.h between the curves' breaks.
class Cumulative {
  public:
    /// Over `range`, or the light's own where that is narrower; throws InputError if neither has an end.
    Cumulative(std::vector<Curve> weights, const Curve& light,
               std::optional<std::pair<double, double>> range);

    [[nodiscard]] double upTo(double nm) const;
    [[nodiscard]] double total() const;
    void appendBreaks(double from, double to, std::vector<double>& out) const;

  private:
    struct Body {
        std::vector<Curve> factors;
        std::vector<double> knots, sums;               ///< sums[i]: up to knots[i], lines not counted
        std::vector<std::pair<double, double>> lines;  ///< wavelength, cumulative power
        double from = 0, to = 0;
    };
    std::shared_ptr<const Body> body_;
};

}  // namespace spectrad
