// Scalar C++ twins of the kernels, sample by sample and term by term, in the same arithmetic: float where
// they use float, fused where they fuse. What they compute must agree with the devices bit for bit.
#pragma once

#include "render/plan.h"
#include "render/samples.h"
#include "render/stages.h"
#include "verify/scalar_geometry.h"

#include <cstdint>
#include <vector>

namespace spectrad::twin {

using Vertices = scalar::VerticesOf<float>;
inline Vertices transform(const World& world, const sd_frame& frame) {
    return scalar::transform<float>(world, frame);
}
using scalar::frameOf;

/// Keys of all samples, [row][x < pitch][slot], of pixels x < width (the padding stays empty).
std::vector<std::uint64_t> cover(const World& world, const Vertices& vertices, const sd_frame& frame,
                                 const LanePattern& lanes);

/// g of one pixel: one float per term of the pixel's block, in the block's order of terms.
template <typename Real>
struct BlockOf {
    std::vector<std::uint32_t> term;
    std::vector<Real> g;  // [term][SD_BLOCK]
};
using Block = BlockOf<float>;
/// `vectorWidth` decides the order in which samples are added (pairwise within 16 lanes, or one after
/// another). Real: float for the twin; double, on the same float input, is the oracle of its rounding.
template <typename Real>
BlockOf<Real> light(const Plan& plan, const Vertices& vertices, const sd_frame& frame,
                    const LanePattern& lanes, const std::vector<std::uint64_t>& keys, int row,
                    int blockColumn, int vectorWidth);

/// Codes of a block's pixels, 0xAABBGGRR.
std::vector<std::uint32_t> show(const Block& block, const std::vector<float>& colours,
                                const ShownThrough& through);

/// [band][SD_BLOCK]
std::vector<float> expand(const Block& block, const std::vector<float>& spectra, size_t bands);

}  // namespace spectrad::twin
