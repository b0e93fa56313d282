// The reference's own visibility against the kernels' rules, sample by sample.
#include "verify/visibility.h"

#include "kernels/random_world.h"
#include "kernels/twin.h"

#include <catch2/catch.hpp>

using namespace spectrad;

namespace {

/// Samples that the two see differently.
size_t differences(const Plan& plan, size_t& samples) {
    const sd_frame frame = scalar::frameOf(plan);
    const LanePattern lanes = lanePattern(plan.samples, 1);
    const auto keys = twin::cover(plan.world, twin::transform(plan.world, frame), frame, lanes);
    const auto vertices = scalar::transform<double>(plan.world, frame);
    std::vector<PixelPlace> places;
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            places.push_back({x, y});
    const SamplePattern pattern = samplePattern(plan.samples);
    const auto seen = trianglesSeen(plan.world, vertices, frame, pattern, places);
    size_t off = 0;
    for (size_t i = 0; i < places.size(); ++i)
        for (size_t k = 0; k < pattern.x.size(); ++k, ++samples) {
            const size_t cell = (static_cast<size_t>(places[i].y) * static_cast<size_t>(frame.pitch) +
                                 static_cast<size_t>(places[i].x)) *
                                    lanes.slotX.size() +
                                k;
            off += static_cast<std::uint32_t>(keys[cell]) != seen[i * pattern.x.size() + k];
        }
    return off;
}

}  // namespace

TEST_CASE("visibility in double agrees with the kernels' but where depths are nearly alike") {
    size_t samples = 0, off = 0;
    for (unsigned seed = 1; seed <= 4; ++seed)
        off += differences(randomPlan(seed, 4, seed % 2 == 0, 150, 24), samples);
    CHECK(samples > 10000);
    CHECK(static_cast<double>(off) < 1e-4 * static_cast<double>(samples));
}
