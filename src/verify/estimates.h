// What a random share of an image's pixels tells about all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace spectrad {

/// A figure of the whole image, estimated; it lies within low…high with the stated confidence. No bound where
/// the sample is too small for one.
struct Estimate {
    double value = 0;
    std::optional<double> low, high;
};

/// Figures of a quantity that is never negative.
struct Estimates {
    Estimate mean, p95, p99;
    double largest = 0;  ///< found; the image's own is at least that
    /// With the stated confidence no more than this share of the pixels lies beyond `largest`.
    double shareBeyond = 0;
};

/// Values that a mean must rest on, (Σ v)² ÷ Σ v², for an upper end.
inline constexpr double fewestCarriers = 10;

/// `values`: of pixels drawn at random without repetition from `population` pixels.
///
/// Mean: normal approximation with the correction for a finite population; its upper end has z²/2
/// more pixels like the largest found (as Agresti & Coull 1998 have it for shares), since rare large values
/// that no sample has seen make the plain interval too short; none where fewer than fewestCarriers values
/// make the mean. It holds as long as no pixels that were not drawn are far beyond the largest found, of
/// which there may be a share of `shareBeyond`. Quantiles: order statistics (binomial), exact
/// whatever the distribution. `shareBeyond`: 1 − (1 − confidence)^(1/n). A sample of all pixels leaves no
/// doubt.
[[nodiscard]] Estimates estimate(std::vector<double> values, size_t population, double confidence);

/// The share `p` of the pixels lies at or below a bound: the largest bound that a sample of `count` supports
/// is its order statistic of this rank (from 0); nothing if the sample is too small. `confidence` one-sided.
[[nodiscard]] std::optional<size_t> upperRank(size_t count, double p, double confidence);

/// `count` different numbers below `population`, ascending: a function of the seed alone (Philox).
[[nodiscard]] std::vector<std::uint64_t> drawn(std::uint64_t population, std::uint64_t count,
                                               std::uint64_t seed);

}  // namespace spectrad
