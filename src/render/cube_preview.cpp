#include "render/cube_preview.h"

#include "colour/detector.h"
#include "colour/display.h"
#include "spectrum/projection.h"

#include <array>

namespace spectrad {

std::vector<float> previewOf(const Cube& cube, const Library& library) {
    const Detector observer = standardObserver(library);
    const Wavelengths& grid = cube.info.wavelengths;
    DetectorWeights weights = weightsOn(grid, observer);
    for (auto& channel : weights.weights)
        for (double& w : channel)
            w /= luminousEfficacy;
    const bool factor = cube.info.kind == CubeKind::reflectance || cube.info.kind == CubeKind::transmittance;
    if (const auto d65 = factor ? library.find("illuminants/D65") : std::nullopt) {
        const std::array<const Curve*, 1> light{&d65->curve()};
        const std::vector<double> bands = project(grid, light);
        double white = 0;
        for (size_t j = 0; j < bands.size(); ++j)
            white += weights.weights[1][j] * bands[j];
        for (auto& channel : weights.weights)
            for (size_t j = 0; j < bands.size(); ++j)
                channel[j] *= white > 0 ? bands[j] / white : 0;
    }
    const Display rec709 = srgbDisplay();
    const auto width = static_cast<size_t>(cube.info.width);
    std::vector<float> preview(static_cast<size_t>(cube.info.height) * 3 * width);
    for (int y = 0; y < cube.info.height; ++y) {
        for (size_t x = 0; x < width; ++x) {
            Triple xyz{};
            for (size_t band = 0; band < grid.size(); ++band) {
                const double value = cube.row(y, band)[x];
                for (size_t c = 0; c < 3; ++c)
                    xyz[c] += weights.weights[c][band] * value;
            }
            const Triple rgb = rec709.fromXyz * xyz;
            for (size_t c = 0; c < 3; ++c)
                preview[(static_cast<size_t>(y) * 3 + c) * width + x] = static_cast<float>(rgb[c]);
        }
    }
    return preview;
}

}  // namespace spectrad
