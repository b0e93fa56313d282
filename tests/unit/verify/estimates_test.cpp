#include "verify/estimates.h"

#include "camera/random.h"
#include "colour/develop.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

using namespace spectrad;

namespace {

/// Errors as images have them: most pixels nearly right, some edges far off.
std::vector<double> errorsOf(size_t count, double edges) {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < count; ++i) {
        Draws draws(7, i, 0, 0);
        const double u = draws.uniform();
        values.push_back(draws.uniform() < edges ? 4 * u * u : 0.02 * u);
    }
    return values;
}

}  // namespace

TEST_CASE("drawn pixels are different, ascending, a function of the seed, and evenly spread") {
    const auto some = drawn(100000, 2000, 5);
    CHECK(some == drawn(100000, 2000, 5));
    CHECK(some != drawn(100000, 2000, 6));
    CHECK(std::set<std::uint64_t>(some.begin(), some.end()).size() == 2000);
    CHECK(std::is_sorted(some.begin(), some.end()));
    CHECK(some.back() < 100000);
    std::array<int, 10> tenth{};
    for (std::uint64_t place : some)
        ++tenth[place / 10000];
    for (int count : tenth)  // 200 ± 13.4
        CHECK(std::abs(count - 200) < 60);
    CHECK(drawn(10, 50, 1).size() == 10);
}

TEST_CASE("ranks that bound a quantile hold with the binomial probability") {
    // P(all n lie below the 99 % quantile) = 0.99^n: 0.5 % from n = 528 on.
    CHECK_FALSE(upperRank(527, 0.99, 0.995));
    REQUIRE(upperRank(528, 0.99, 0.995));
    CHECK(*upperRank(528, 0.99, 0.995) == 527);
}

TEST_CASE("a sample of all pixels leaves no doubt") {
    const std::vector<double> all = errorsOf(500, 0.1);
    const Estimates e = estimate(all, all.size(), 0.99);
    std::vector<double> copy = all;
    CHECK(e.p99.value == quantile(copy, 0.99));
    CHECK(e.p99.low == e.p99.high);
    CHECK(e.mean.low == e.mean.high);
    CHECK(e.shareBeyond == 0);
}

TEST_CASE("intervals contain the truth in at least 95 % of 200 seeded trials, with few edges or many") {
    for (const double edges : {0.005, 0.02, 0.1, 0.4}) {
        const std::vector<double> all = errorsOf(20000, edges);
        const Estimates truth = estimate(all, all.size(), 0.99);
        int mean = 0, bounded = 0, p95 = 0, p99 = 0, most = 0;
        for (std::uint64_t seed = 1; seed <= 200; ++seed) {
            std::vector<double> values;
            for (std::uint64_t place : drawn(all.size(), 1000, seed))
                values.push_back(all[place]);
            const Estimates e = estimate(values, all.size(), 0.99);
            mean += *e.mean.low <= truth.mean.value && truth.mean.value <= e.mean.high.value_or(1e9);
            bounded += e.mean.high.has_value();
            p95 += e.p95.low.value_or(0) <= truth.p95.value && truth.p95.value <= e.p95.high.value_or(1e9);
            p99 += e.p99.low.value_or(0) <= truth.p99.value && truth.p99.value <= e.p99.high.value_or(1e9);
            const auto beyond =
                std::count_if(all.begin(), all.end(), [&](double v) { return v > e.largest; });
            most += static_cast<double>(beyond) / static_cast<double>(all.size()) <= e.shareBeyond;
        }
        CAPTURE(edges);
        CHECK(mean >= 190);
        if (edges >= 0.05) CHECK(bounded == 200);
        CHECK(p95 >= 190);
        CHECK(p99 >= 190);
        CHECK(most >= 190);
    }
}

TEST_CASE("a mean that a few pixels make has no upper end, and one of nothing neither") {
    // A star of one pixel in a thousand on black: a thousand pixels see none of it, or one, or two.
    std::vector<double> all(40000, 0.0);
    for (size_t i = 0; i < all.size(); i += 1000)
        all[i] = 30 + static_cast<double>(i) / 4000;
    const double truth = estimate(all, all.size(), 0.99).mean.value;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        std::vector<double> values;
        for (std::uint64_t place : drawn(all.size(), 1000, seed))
            values.push_back(all[place]);
        const Estimates e = estimate(values, all.size(), 0.99);
        CHECK_FALSE(e.mean.high);
        CHECK(*e.mean.low <= truth);
    }
}
