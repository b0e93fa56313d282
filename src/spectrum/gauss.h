// The 4-point Gauss–Legendre rule, exact up to degree 7 (Abramowitz & Stegun, table 25.4).
#pragma once

#include <array>
#include <cmath>

namespace spectrad {

inline constexpr std::array<double, 4> gaussNodes{-0.86113631159405257522, -0.33998104358485626480,
                                                  0.33998104358485626480, 0.86113631159405257522};
inline constexpr std::array<double, 4> gaussWeights{0.34785484513745385737, 0.65214515486254614263,
                                                    0.65214515486254614263, 0.34785484513745385737};

/// Neumaier's compensated sum: the error does not grow with the number of terms.
class CompensatedSum {
  public:
    void add(double term) {
        const double next = sum_ + term;
        carry_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
        sum_ = next;
    }
    [[nodiscard]] double value() const { return sum_ + carry_; }

  private:
    double sum_ = 0, carry_ = 0;
};

}  // namespace spectrad
