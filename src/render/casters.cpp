#include "render/casters.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <limits>

namespace spectrad {

namespace {

using Middle = std::array<float, 3>;

/// Of each triangle that casts, in camera space: three times the middle of its corners.
std::vector<Middle> middlesOf(const World& world) {
    std::vector<Middle> middles(world.index.size() / 3);
    for (const std::uint32_t t : world.casters) {
        std::array<double, 3> sum{};
        for (size_t k = 0; k < 3; ++k) {
            const size_t v = world.index[3 * size_t{t} + k];
            const double* m = world.draws[world.vertexDraw[v]].to_camera;
            const float* p = world.position.data() + 3 * v;
            for (size_t row = 0; row < 3; ++row)
                sum[row] +=
                    m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2] + m[4 * row + 3];
        }
        for (size_t axis = 0; axis < 3; ++axis)
            middles[t][axis] = static_cast<float>(sum[axis]);
    }
    return middles;
}

size_t longestAxis(const std::vector<Middle>& middles, const std::uint32_t* from, const std::uint32_t* end) {
    Middle low, high;
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
    for (const std::uint32_t* t = from; t != end; ++t)
        for (size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], middles[*t][axis]);
            high[axis] = std::max(high[axis], middles[*t][axis]);
        }
    size_t longest = 0;
    for (size_t axis = 1; axis < 3; ++axis)
        if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
    return longest;
}

}  // namespace

bool throwShadows(const std::vector<sd_light>& lights) {
    return std::any_of(lights.begin(), lights.end(),
                       [](const sd_light& light) { return light.shadows != 0; });
}

std::uint32_t leavesOf(size_t casters) {
    if (casters == 0) return 0;
    std::uint32_t leaves = 1;
    while (size_t{leaves} * SD_LEAF_CASTERS < casters)
        leaves *= 2;
    return leaves;
}

void orderCasters(World& world) {
    const std::uint32_t leaves = leavesOf(world.casters.size());
    if (leaves <= 1) return;
    const std::vector<Middle> middles = middlesOf(world);
    const size_t casters = world.casters.size();
    for (std::uint32_t nodes = 1; nodes < leaves; nodes *= 2)
        inParallel(nodes, [&](size_t node) {
            const auto at = [&](size_t part) {  // of 2 · nodes
                return world.casters.data() + part * (leaves / (2 * nodes)) * casters / leaves;
            };
            std::uint32_t *const from = at(2 * node), *const middle = at(2 * node + 1),
                                 *const end = at(2 * node + 2);
            const size_t axis = longestAxis(middles, from, end);
            // Triangles without a place (not a number) come last; numbers keep the order whole.
            std::nth_element(from, middle, end, [&](std::uint32_t a, std::uint32_t b) {
                const float x = middles[a][axis], y = middles[b][axis];
                const bool placedX = x == x, placedY = y == y;
                if (placedX != placedY) return placedX;
                return placedX && x != y ? x < y : a < b;
            });
        });
}

}  // namespace spectrad
