// Small dense systems of linear equations.
#pragma once

#include <vector>

namespace spectrad {

using Rows = std::vector<std::vector<double>>;

/// Cholesky's factor of a symmetric positive semidefinite matrix, for many right-hand sides.
class Cholesky {
  public:
    /// `a` by rows. Directions of no more than rounding (1e-12 of their own diagonal value: rows that repeat
    /// each other) are left out: their solution is 0.
    explicit Cholesky(Rows a);
    [[nodiscard]] std::vector<double> solve(std::vector<double> b) const;

  private:
    Rows factor_;  ///< lower triangle
};

}  // namespace spectrad
