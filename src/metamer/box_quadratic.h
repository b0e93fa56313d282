// Convex quadratic programmes with equalities and a box, small and dense.
#pragma once

#include "base/cholesky.h"

#include <vector>

namespace spectrad {

struct BoxQuadratic {
    Rows q;                      ///< symmetric, positive semidefinite
    std::vector<double> linear;  ///< minimise ½ xᵀ q x + linearᵀ x
    Rows a;                      ///< subject to a x = b,
    std::vector<double> b;
    double low = 0, high = 1;  ///< and low ≤ x ≤ high
};

struct BoxSolution {
    std::vector<double> x;   ///< inside the box
    double largestMiss = 0;  ///< of a x = b, over the largest |b|
    int steps = 0;
};

/// Alternating direction method of multipliers (Boyd et al. 2011, Found. Trends Mach. Learn. 3, 5.2):
/// minimise on the plane a x = b, project on the box, add up what they disagree by; until they agree to 1e-9,
/// or `mostSteps`.
[[nodiscard]] BoxSolution minimise(const BoxQuadratic& problem, int mostSteps = 20'000);

}  // namespace spectrad
