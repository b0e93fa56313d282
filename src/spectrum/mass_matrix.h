// The mass matrix ∫ h_i h_j dλ of the hats of a grid: what stands between moments of a curve and its nodal
// values.
#pragma once

#include "spectrum/wavelengths.h"

#include <span>
#include <vector>

namespace spectrad {

/// Tridiagonal, symmetric and diagonally dominant; factored once (Thomas), so that each solution costs three
/// passes without a division. For many right-hand sides (a texture's texels) keep one.
class MassMatrix {
  public:
    /// Of the hats over at least two ascending wavelengths; the projection of the grid does not matter.
    explicit MassMatrix(std::span<const double> nm);
    /// Replaces moments ∫ L h_j dλ by the values at the nodes of the piecewise-linear L that has them.
    void solve(std::span<double> moments) const;
    /// The same for `count` curves at once, moments[node * count + curve]; each gets the very bits of
    /// solve().
    void solveAll(std::span<double> moments, size_t count) const;

    [[nodiscard]] std::span<const double> off() const { return off_; }          ///< one fewer than nodes
    [[nodiscard]] std::span<const double> inverse() const { return inverse_; }  ///< of the pivots

  private:
    std::vector<double> off_;      ///< ∫ h_j h_{j+1} = d_j / 6
    std::vector<double> inverse_;  ///< 1 / pivot
};

}  // namespace spectrad
