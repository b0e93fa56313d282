// Rounding of the kernels: what the device computes in float against the same formulae in double, on the same
// float input. Errors are counted in ulps, 2^-23 of the right value.
#include "kernels/random_world.h"
#include "kernels/read_back.h"
#include "kernels/twin.h"
#include "render/stages.h"

#include <catch2/catch.hpp>

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
    const LanePattern lanes = lanePattern(plan.samples, device.body().vectorWidth());
    Stages stages(device, plan, lanes);
    stages.transform();
    const int height = plan.view.height;
    REQUIRE(stages.light(0, height));
    const sd_frame frame = twin::frameOf(plan);
    const auto pitch = static_cast<size_t>(frame.pitch), rows = static_cast<size_t>(height),
               bands = plan.terms.bands;
    const auto keys = read<std::uint64_t>(device, stages.keys().buffer(), rows * pitch * lanes.slotX.size());
    const auto first = read<std::uint32_t>(device, stages.terms().first.buffer(), stages.terms().blocks + 1);
    const auto g = read<float>(device, stages.terms().g.buffer(), size_t{first.back()} * SD_BLOCK);
    DeviceArray<float> cube, preview;
    stages.expand(0, height, cube, preview);
    const auto radiance = read<float>(device, cube.buffer(), rows * bands * pitch);
    const twin::Vertices vertices = twin::transform(plan.world, frame);
    for (size_t number = 0; number < stages.terms().blocks; ++number) {
        const int blocksX = frame.pitch / SD_BLOCK, row = static_cast<int>(number) / blocksX,
                  column = static_cast<int>(number) % blocksX;
        const auto block =
            twin::light<double>(plan, vertices, frame, lanes, keys, row, column, device.body().vectorWidth());
        const float* ours = g.data() + size_t{first[number]} * SD_BLOCK;
        for (size_t i = 0; i < block.g.size(); ++i) {
            if (block.g[i] != 0) errors.factors.push_back(ulps(ours[i], block.g[i]));
            if (block.g[i] == 0) CHECK(ours[i] == 0);
        }
        for (size_t band = 0; band < bands; ++band) {
            for (size_t x = 0; x < SD_BLOCK; ++x) {
                double sum = 0;
                for (size_t t = 0; t < block.term.size(); ++t)
                    sum += double{plan.terms.spectra[block.term[t] * bands + band]} * ours[t * SD_BLOCK + x];
                const double value = radiance[(static_cast<size_t>(row) * bands + band) * pitch +
                                              static_cast<size_t>(column) * SD_BLOCK + x];
                if (sum != 0) errors.bands.push_back(ulps(value, sum));
            }
        }
    }
}

/// Without bent normals: the random world's lean so far that they lose more digits than lobes do.
Plan unbent(Plan plan) {
    for (sd_material& material : plan.world.materials)
        material.relief = 0;
    return plan;
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
