#include "camera/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
    constexpr std::uint64_t first = 0xD2511F53, second = 0xCD9E8D57;
    constexpr std::uint32_t golden = 0x9E3779B9, root3 = 0xBB67AE85;
    constexpr int rounds = 10;
    for (int round = 0; round < rounds; ++round) {
        const std::uint64_t a = first * counter[0], b = second * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
        key = {key[0] + golden, key[1] + root3};
    }
    return counter;
}

Draws::Draws(std::uint64_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t use)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{x, y, use, 0} {}

double Draws::uniform() {
    const std::array<std::uint32_t, 4> bits = philox(counter_, key_);
    ++counter_[3];
    const std::uint64_t wide = (static_cast<std::uint64_t>(bits[0]) << 32 | bits[1]) >> 11;  // 53 bits
    return (static_cast<double>(wide) + 0.5) * 0x1p-53;
}

double Draws::normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
}

double Draws::poisson(double mean) {
    constexpr double many = 50;
    if (!(mean > 0)) return 0;
    if (mean > many) return std::max(0.0, std::round(mean + std::sqrt(mean) * normal()));
    double share = std::exp(-mean), left = uniform();
    int count = 0;
    constexpr int most = 1000;  // beyond what a mean of 50 reaches
    while (left > share && count < most) {
        left -= share;
        ++count;
        share *= mean / count;
    }
    return count;
}

}  // namespace spectrad
