#include "render/samples.h"

#include <algorithm>
#include <numeric>

namespace spectrad {

namespace {

/// Smallest squared distance (in 1/n² of a pixel) between points (k, k g mod n) of the tiled lattice.
long spread(int n, int g) {
    long best = 2L * n * n;
    for (int k = 1; k < n; ++k) {
        const long dx = std::min(k, n - k), y = static_cast<long>(k) * g % n, dy = std::min<long>(y, n - y);
        best = std::min(best, dx * dx + dy * dy);
    }
    return best;
}

}  // namespace

SamplePattern samplePattern(int samples) {
    int generator = 1;
    for (int g = 1; g < samples; ++g)
        if (std::gcd(g, samples) == 1 && spread(samples, g) > spread(samples, generator)) generator = g;
    SamplePattern pattern;
    for (int k = 0; k < samples; ++k) {
        // Cell centres (k + ½)/n in both directions: every row and every column of the n × n grid has one
        // sample.
        const int row = static_cast<int>(static_cast<long>(k) * generator % samples);
        pattern.x.push_back((2 * k + 1) * SD_SUBPIXEL / (2 * samples));
        pattern.y.push_back((2 * row + 1) * SD_SUBPIXEL / (2 * samples));
    }
    return pattern;
}

LanePattern lanePattern(int samples, int vectorWidth) {
    const SamplePattern pattern = samplePattern(samples);
    LanePattern lanes;
    while (lanes.slots < samples)
        lanes.slots *= 2;
    for (int slot = 0; slot < lanes.slots; ++slot) {
        const auto sample = static_cast<size_t>(slot < samples ? slot : 0);
        lanes.slotX.push_back(pattern.x[sample]);
        lanes.slotY.push_back(pattern.y[sample]);
    }
    for (int lane = 0; lane < std::max(lanes.slots, vectorWidth); ++lane) {
        const auto slot = static_cast<size_t>(lane % lanes.slots);
        lanes.laneX.push_back(lanes.slotX[slot] + lane / lanes.slots * SD_SUBPIXEL);
        lanes.laneY.push_back(lanes.slotY[slot]);
        lanes.used.push_back(static_cast<int>(slot) < samples ? -1 : 0);
    }
    return lanes;
}

}  // namespace spectrad
