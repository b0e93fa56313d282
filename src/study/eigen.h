// Eigenvectors of small symmetric matrices.
#pragma once

#include <cstddef>
#include <vector>

namespace spectrad {

/// A symmetric matrix's eigenvalues, largest first, and their orthonormal eigenvectors.
struct Eigen {
    std::vector<double> value;
    std::vector<std::vector<double>> vector;
};

/// Cyclic Jacobi rotations (Golub & Van Loan, Matrix Computations, 8.5) on `size` × `size` numbers, row by
/// row; only what is on and above the diagonal counts.
[[nodiscard]] Eigen eigenOf(std::vector<double> matrix, size_t size);

}  // namespace spectrad
