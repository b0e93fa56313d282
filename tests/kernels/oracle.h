// What the device computes in float beside the same formulae in a wider arithmetic, on the same float input.
#pragma once

#include "kernels/read_back.h"
#include "kernels/twin.h"
#include "render/stages.h"

#include <catch2/catch.hpp>

namespace spectrad {

/// Calls factor(value, right) for every light factor g of the plan's picture and band(value, right) for every
/// pixel's band: each stage against its own oracle in Real, double or long double, on what the device made of
/// the stages before.
template <typename Real, typename Factor, typename Band>
void besideOracle(const Device& device, const Plan& plan, const Factor& factor, const Band& band) {
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
    const int blocksX = frame.pitch / SD_BLOCK;
    for (size_t number = 0; number < stages.terms().blocks; ++number) {
        const int row = static_cast<int>(number) / blocksX, column = static_cast<int>(number) % blocksX;
        const auto block =
            twin::light<Real>(plan, vertices, frame, lanes, keys, row, column, device.body().vectorWidth());
        const float* ours = g.data() + size_t{first[number]} * SD_BLOCK;
        for (size_t i = 0; i < block.g.size(); ++i)
            factor(ours[i], block.g[i]);
        for (size_t b = 0; b < bands; ++b)
            for (size_t x = 0; x < SD_BLOCK; ++x) {
                Real sum = 0;
                for (size_t t = 0; t < block.term.size(); ++t)
                    sum += Real{plan.terms.spectra[block.term[t] * bands + b]} * ours[t * SD_BLOCK + x];
                band(radiance[(static_cast<size_t>(row) * bands + b) * pitch +
                              static_cast<size_t>(column) * SD_BLOCK + x],
                     sum);
            }
    }
}

}  // namespace spectrad
