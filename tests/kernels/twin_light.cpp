#include "kernels/twin.h"
#include "verify/scalar_shade.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace spectrad::twin {

using namespace scalar;

namespace {

template <typename Real>
Real pairwise(const std::vector<Real>& v, size_t from, size_t count) {
    if (count == 1) return v[from];
    return pairwise(v, from, count / 2) + pairwise(v, from + count / 2, count / 2);
}

/// What a pixel's lanes add to a term at once.
template <typename Real>
struct Addend {
    std::uint32_t term;
    bool oneAfterAnother;
    std::vector<Real> g;
    Real sum() const {
        return oneAfterAnother ? std::accumulate(g.begin(), g.end(), Real(0.0)) : pairwise(g, 0, g.size());
    }
};

}  // namespace

template <typename Real>
BlockOf<Real> light(const Plan& plan, const Vertices& vertices, const sd_frame& frame,
                    const LanePattern& lanes, const std::vector<std::uint64_t>& keys, int row,
                    int blockColumn, int vectorWidth) {
    const World& world = plan.world;
    const OccludersOf<Real> occluders(world, vertices);
    const size_t slots = lanes.slotX.size();
    const std::uint64_t* cells = keys.data() + (static_cast<size_t>(row) * static_cast<size_t>(frame.pitch) +
                                                static_cast<size_t>(blockColumn) * SD_BLOCK) *
                                                   slots;
    std::set<std::uint32_t> materials;
    const auto materialOf = [&](std::uint64_t key) {
        const auto id = static_cast<std::uint32_t>(key);
        return id == 0xffffffffu ? 0u : world.triangleMaterial[id];
    };
    for (size_t i = 0; i < SD_BLOCK * slots; ++i)
        materials.insert(materialOf(cells[i]));
    BlockOf<Real> block;
    std::vector<size_t> offset(world.materials.size());
    for (std::uint32_t m : materials) {
        offset[m] = block.term.size();
        for (std::uint32_t t = 0; t < world.materials[m].terms; ++t)
            block.term.push_back(world.materials[m].first_term + t);
    }
    block.g.assign(block.term.size() * SD_BLOCK, Real(0.0));
    const auto lanesAtOnce = static_cast<size_t>(vectorWidth);
    const size_t group = std::min(slots, lanesAtOnce);  // lanes of one pixel that are added pairwise
    for (size_t lane = 0; lane < SD_BLOCK * slots; lane += group) {
        const size_t x = lane / slots;
        // As the kernel: triangle by triangle of the vector, in the order of their first lanes; g of lanes
        // that do not see it is 0.
        const size_t vectorStart = lane / lanesAtOnce * lanesAtOnce;
        std::vector<std::uint32_t> order;
        for (size_t i = vectorStart; i < vectorStart + lanesAtOnce; ++i) {
            const auto id = static_cast<std::uint32_t>(cells[i]);
            if (lanes.used[i % slots] && std::find(order.begin(), order.end(), id) == order.end())
                order.push_back(id);
        }
        for (std::uint32_t id : order) {
            const std::uint32_t m = id == 0xffffffffu ? 0 : world.triangleMaterial[id];
            const sd_material& material = world.materials[m];
            // Each add of the kernel, in its order; lanes left at zero where the sample sees another triangle
            // or no light.
            std::map<size_t, Addend<Real>> adds;
            for (size_t i = 0; i < group; ++i) {
                if (!lanes.used[(lane + i) % slots] || static_cast<std::uint32_t>(cells[lane + i]) != id)
                    continue;
                const auto add = [&](size_t call, std::uint32_t term, Real g, bool wide) {
                    const Addend<Real> none{term, wide, std::vector<Real>(group, Real(0.0))};
                    adds.try_emplace(call, none).first->second.g[i] = g;
                };
                const size_t slot = (lane + i) % slots;
                const int sx = (blockColumn * SD_BLOCK + static_cast<int>(x)) * 256 - frame.width * 128 +
                               lanes.slotX[slot];
                const int sy = row * 256 - frame.height * 128 + lanes.slotY[slot];
                shadeSample<Real>(plan, vertices, occluders, frame, material, id, static_cast<Real>(sx),
                                  static_cast<Real>(sy), add);
            }
            for (const auto& [call, entry] : adds) {
                block.g[(offset[m] + entry.term) * SD_BLOCK + x] += entry.sum();
            }
        }
    }
    const Real inverse = Real(1.0) / static_cast<Real>(frame.samples);
    for (Real& g : block.g)
        g *= inverse;
    return block;
}

template BlockOf<float> light(const Plan&, const Vertices&, const sd_frame&, const LanePattern&,
                              const std::vector<std::uint64_t>&, int, int, int);
template BlockOf<double> light(const Plan&, const Vertices&, const sd_frame&, const LanePattern&,
                               const std::vector<std::uint64_t>&, int, int, int);
template BlockOf<long double> light(const Plan&, const Vertices&, const sd_frame&, const LanePattern&,
                                    const std::vector<std::uint64_t>&, int, int, int);

std::vector<float> expand(const Block& block, const std::vector<float>& spectra, size_t bands) {
    std::vector<float> out(bands * SD_BLOCK, 0.0f);
    for (size_t band = 0; band < bands; ++band)
        for (size_t t = 0; t < block.term.size(); ++t)
            for (size_t x = 0; x < SD_BLOCK; ++x)
                out[band * SD_BLOCK + x] = std::fma(spectra[block.term[t] * bands + band],
                                                    block.g[t * SD_BLOCK + x], out[band * SD_BLOCK + x]);
    return out;
}

}  // namespace spectrad::twin
