// Rounding of the kernels: what the device computes in float against the same formulae in double, on the same
// float input. Errors are counted in ulps, 2^-23 of the right value.
#include "kernels/oracle.h"

#include "kernels/random_world.h"

#include <algorithm>
#include <cmath>

using namespace spectrad;

namespace {

double ulps(double value, double right) {
    return std::abs(value - right) / (std::abs(right) * 0x1p-23);
}

struct Errors {
    std::vector<double> factors, bands;
};

/// Appends the errors of all factors g and of all bands, each against the oracle of its own stage.
void collect(const Device& device, const Plan& plan, Errors& errors) {
    besideOracle<double>(
        device, plan,
        [&](float value, double right) {
            if (right != 0) errors.factors.push_back(ulps(value, right));
            if (right == 0) CHECK(value == 0);
        },
        [&](float value, double right) {
            if (right != 0) errors.bands.push_back(ulps(value, right));
        });
}

double quantile(std::vector<double> values, double share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

// Factors lose digits where cosines vanish: at silhouettes, and near the horizon of a light (rough lobes
// most: a third of the random world).
TEST_CASE("light factors in float: half within 1 ulp of double precision, 97 % within 48, all within 4e-3") {
    const Device device = Device::open(std::nullopt);
    Errors errors;
    for (unsigned seed = 1; seed <= 4; ++seed)
        collect(device, unbent(randomPlan(seed, 4, seed % 2 == 0, 150, 24)), errors);
    REQUIRE(errors.factors.size() > 10000);
    CHECK(quantile(errors.factors, 0.5) < 1);
    CHECK(quantile(errors.factors, 0.97) < 48);
    CHECK(quantile(errors.factors, 1) < 4e-3 * 0x1p23);
}

TEST_CASE("bands in float stay within 4 ulps of the sum of factors times spectra") {
    const Device device = Device::open(std::nullopt);
    Errors errors;
    collect(device, randomPlan(5, 4, false, 150, 24), errors);
    collect(device, wallPlan(4), errors);
    REQUIRE(errors.bands.size() > 10000);
    CHECK(quantile(errors.bands, 1) < 4);
}
