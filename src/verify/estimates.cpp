#include "verify/estimates.h"

#include "camera/random.h"
#include "colour/develop.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>

namespace spectrad {

namespace {

/// P(at most k of n) for events of probability p.
class Binomial {
  public:
    Binomial(size_t n, double p) : n_(static_cast<double>(n)), logP_(std::log(p)), logQ_(std::log1p(-p)) {}
    [[nodiscard]] double exactly(size_t k) const {
        const auto x = static_cast<double>(k);
        return std::exp(std::lgamma(n_ + 1) - std::lgamma(x + 1) - std::lgamma(n_ - x + 1) + x * logP_ +
                        (n_ - x) * logQ_);
    }

  private:
    double n_, logP_, logQ_;
};

/// Standard normal quantile, by bisection of erfc.
double normalQuantile(double p) {
    double low = -10, high = 10;
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

struct Moments {
    double mean, error;  ///< of the mean
};
/// How many equal values would make the same mean and spread about zero, (Σ v)² ÷ Σ v²: 1 where one value is
/// all there is.
double carriers(const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (double v : values) {
        sum += v;
        squares += v * v;
    }
    return squares > 0 ? sum * sum / squares : 0;
}
Moments momentsOf(const std::vector<double>& values, double finite) {
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (double v : values)
        squares += (v - mean) * (v - mean);
    return {mean, n > 1 ? std::sqrt(squares / (n - 1) / n * finite) : 0};
}

/// Ascending values' rank that lies at or below the quantile p with the confidence.
std::optional<size_t> lowerRank(size_t count, double p, double confidence) {
    // The r-th smallest (from 1) is above the quantile with P(fewer than r at or below it).
    const Binomial below(count, p);
    double sum = 0;
    std::optional<size_t> rank;
    for (size_t k = 0; k < count; ++k) {
        sum += below.exactly(k);
        if (sum > 1 - confidence) break;
        rank = k;
    }
    return rank;
}

Estimate quantileOf(const std::vector<double>& ascending, double p, double confidence) {
    Estimate e;
    std::vector<double> copy = ascending;
    e.value = quantile(copy, p);
    const double oneSided = 0.5 * (1 + confidence);
    if (const auto low = lowerRank(ascending.size(), p, oneSided)) e.low = ascending[*low];
    if (const auto high = upperRank(ascending.size(), p, oneSided)) e.high = ascending[*high];
    return e;
}

}  // namespace

std::optional<size_t> upperRank(size_t count, double p, double confidence) {
    // The r-th smallest (from 1) is below the quantile with P(at least r below it): from above, until that
    // is too likely.
    const Binomial below(count, p);
    double sum = below.exactly(count);
    std::optional<size_t> rank;
    for (size_t r = count; r > 0 && sum <= 1 - confidence; --r) {
        rank = r - 1;
        sum += below.exactly(r - 1);
    }
    return rank;
}

Estimates estimate(std::vector<double> values, size_t population, double confidence) {
    Estimates out;
    if (values.empty()) return out;
    std::sort(values.begin(), values.end());
    const auto n = static_cast<double>(values.size()), all = static_cast<double>(population);
    const double finite = all > 1 ? (all - n) / (all - 1) : 0;
    out.largest = values.back();
    const Moments plain = momentsOf(values, finite);
    out.mean.value = plain.mean;
    if (values.size() >= population) {
        out.mean.low = out.mean.high = plain.mean;
        for (const auto& [figure, p] : {std::pair{&out.p95, 0.95}, std::pair{&out.p99, 0.99}}) {
            std::vector<double> copy = values;
            figure->value = quantile(copy, p);
            figure->low = figure->high = figure->value;
        }
        return out;
    }
    const double reach = normalQuantile(0.5 * (1 + confidence));
    out.mean.low = std::max(plain.mean - reach * plain.error, values.front());
    out.p95 = quantileOf(values, 0.95, confidence);
    out.p99 = quantileOf(values, 0.99, confidence);
    out.shareBeyond = 1 - std::pow(1 - confidence, 1 / n);
    // A mean that a few pixels make has no upper end that this sample knows: there may be more of them.
    if (carriers(values) < fewestCarriers) return out;
    values.insert(values.end(), static_cast<size_t>(std::ceil(0.5 * reach * reach)), out.largest);
    const Moments wary = momentsOf(values, finite);
    out.mean.high = wary.mean + reach * wary.error;
    return out;
}

std::vector<std::uint64_t> drawn(std::uint64_t population, std::uint64_t count, std::uint64_t seed) {
    std::vector<std::uint64_t> out;
    if (count >= population) {
        out.resize(population);
        std::iota(out.begin(), out.end(), std::uint64_t{0});
        return out;
    }
    // Floyd's sampling (Bentley & Floyd 1987): one draw a pixel, whatever the image's size.
    std::unordered_set<std::uint64_t> chosen;
    for (std::uint64_t i = population - count; i < population; ++i) {
        const auto bits = philox({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i >> 32), 0, 0},
                                 {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
        // 53 bits: the bias of rounding is below 10⁻¹¹ for the largest image.
        const double u =
            (static_cast<double>(bits[0]) * 0x1p-32 + static_cast<double>(bits[1] >> 11) * 0x1p-53);
        const std::uint64_t place = std::min(i, static_cast<std::uint64_t>(u * static_cast<double>(i + 1)));
        if (!chosen.insert(place).second) chosen.insert(i);
    }
    out.assign(chosen.begin(), chosen.end());
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace spectrad
