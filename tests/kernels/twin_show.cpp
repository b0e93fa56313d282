#include "kernels/twin.h"

#include <array>
#include <cmath>

namespace spectrad::twin {

std::vector<std::uint32_t> show(const Block& block, const std::vector<float>& colours,
                                const ShownThrough& through) {
    std::vector<std::uint32_t> out;
    for (size_t pixel = 0; pixel < SD_BLOCK; ++pixel) {
        std::array<float, 3> sum{};
        for (size_t t = 0; t < block.term.size(); ++t)
            for (size_t c = 0; c < 3; ++c)
                sum[c] =
                    std::fma(colours[size_t{block.term[t]} * 3 + c], block.g[t * SD_BLOCK + pixel], sum[c]);
        std::uint32_t code = 0;
        bool outside = false;
        for (size_t c = 0; c < 3; ++c) {
            const float* m = through.matrix.data() + 3 * c;
            const float signal = std::fma(m[2], sum[2], std::fma(m[1], sum[1], m[0] * sum[0]));
            outside = outside || signal < -1e-4f || signal > 1.0f + 1e-4f;
            // The number of thresholds that the signal has reached, without the kernel's shortcut.
            std::uint32_t level = 0;
            while (level < 255 && signal >= through.threshold[level])
                ++level;
            code |= level << (8 * c);
        }
        out.push_back(code | (outside ? 254u : 255u) << 24);
    }
    return out;
}

}  // namespace spectrad::twin
