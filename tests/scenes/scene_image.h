// From the text of a scene to its pixels, within the test's process: reader, plan, kernels, strips.
#pragma once

#include "opencl/device.h"
#include "render/plan.h"
#include "scene/load.h"
#include "spectrum/library.h"

#include <limits>
#include <string>
#include <vector>

namespace spectrad::test {

/// False, and said, where no OpenCL device is: what renders is skipped then.
[[nodiscard]] bool haveDevice();
[[nodiscard]] const Device& device();
[[nodiscard]] const Library& library();

struct Image {
    int width = 0, height = 0;
    Wavelengths wavelengths;
    std::vector<float> values;   ///< [row][band][x]
    std::vector<float> preview;  ///< [row][3][x]

    [[nodiscard]] float at(int x, int y, size_t band = 0) const {
        return values[(static_cast<size_t>(y) * wavelengths.size() + band) * static_cast<size_t>(width) +
                      static_cast<size_t>(x)];
    }
};

/// Reads `text` as a scene file in a folder of its own.
[[nodiscard]] Scene sceneFrom(const std::string& text);
/// Without the passes that its textures come from.
[[nodiscard]] Plan planOf(const Scene& scene, const RenderSettings& settings = {});
[[nodiscard]] Image imageOf(const Plan& plan);
[[nodiscard]] Image imageOf(const Scene& scene, const RenderSettings& settings = {});
[[nodiscard]] Image imageOf(const std::string& text, const RenderSettings& settings = {});

/// The largest difference from what is expected and where it is: one CHECK for a whole image.
struct Worst {
    double error = 0;  ///< NaN if a value is
    int x = -1, y = -1;
    size_t band = 0;
    double got = 0, expected = 0;

    /// |got − expected| ÷ scale.
    void add(double value, double want, double scale, int column, int row, size_t which = 0);
    [[nodiscard]] std::string str() const;
};

}  // namespace spectrad::test
