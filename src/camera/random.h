// Random numbers by counter: each draw is a function of a seed and of what it is for, so an image's noise
// depends neither on the order of its pixels nor on how many threads there are.
#pragma once

#include <array>
#include <cstdint>

namespace spectrad {

/// Philox4x32-10 (Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11).
[[nodiscard]] std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                                  std::array<std::uint32_t, 2> key);

/// Draws for one use: a pixel's channel and one of its sources of noise.
class Draws {
  public:
    Draws(std::uint64_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t use);
    [[nodiscard]] double uniform();  ///< in (0, 1)
    [[nodiscard]] double normal();   ///< mean 0, variance 1 (Box and Muller)
    /// Whole number of mean and variance `mean`: by inversion up to 50; above, a normal value of that mean
    /// and variance, rounded, which lacks the distribution's skew of 1/√mean.
    [[nodiscard]] double poisson(double mean);

  private:
    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;  ///< x, y, use, draw
};

}  // namespace spectrad
