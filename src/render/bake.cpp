#include "render/bake.h"

#include <algorithm>

namespace spectrad {

namespace {

float* texelOf(Cube& cube, size_t row, size_t band, size_t x) {
    return cube.values.data() +
           (row * cube.info.wavelengths.size() + band) * static_cast<size_t>(cube.info.width) + x;
}

/// The covered ones among the eight neighbours of a texel.
std::vector<std::pair<size_t, size_t>> coveredAround(const std::vector<float>& coverage, size_t width,
                                                     size_t height, size_t row, size_t x) {
    std::vector<std::pair<size_t, size_t>> found;
    for (size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, height - 1); ++r)
        for (size_t c = x == 0 ? 0 : x - 1; c <= std::min(x + 1, width - 1); ++c)
            if (coverage[r * width + c] > 0) found.emplace_back(r, c);
    return found;
}

}  // namespace

void divideByCoverage(Cube& cube, const std::vector<float>& coverage) {
    const auto width = static_cast<size_t>(cube.info.width);
    const size_t bands = cube.info.wavelengths.size();
    for (size_t row = 0; row < static_cast<size_t>(cube.info.height); ++row)
        for (size_t x = 0; x < width; ++x) {
            const float share = coverage[row * width + x];
            if (!(share > 0) || share == 1) continue;
            for (size_t band = 0; band < bands; ++band)
                *texelOf(cube, row, band, x) /= share;
        }
}

size_t addGutter(Cube& cube, std::vector<float> coverage, int texels) {
    const auto width = static_cast<size_t>(cube.info.width), height = static_cast<size_t>(cube.info.height);
    const size_t bands = cube.info.wavelengths.size();
    const auto covered = static_cast<size_t>(
        std::count_if(coverage.begin(), coverage.end(), [](float share) { return share > 0; }));
    for (int ring = 0; ring < texels; ++ring) {
        std::vector<float> grown = coverage;
        for (size_t row = 0; row < height; ++row)
            for (size_t x = 0; x < width; ++x) {
                if (coverage[row * width + x] > 0) continue;
                const auto inner = coveredAround(coverage, width, height, row, x);
                if (inner.empty()) continue;
                for (size_t band = 0; band < bands; ++band) {
                    double sum = 0;
                    for (const auto& [r, c] : inner)
                        sum += *texelOf(cube, r, band, c);
                    *texelOf(cube, row, band, x) =
                        static_cast<float>(sum / static_cast<double>(inner.size()));
                }
                grown[row * width + x] = 1;
            }
        coverage = std::move(grown);
    }
    return covered;
}

}  // namespace spectrad
