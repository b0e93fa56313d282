// Textures that stay on the device: what one pass renders, the next reads, without a way over the host.
#pragma once

#include "opencl/program.h"
#include "spectrum/wavelengths.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace spectrad {

/// Texels in device memory, [(row * width + column) * bands + band], row 0 on top: the values at the nodes of
/// curves that are linear between the wavelengths. Smaller levels follow as in sd_texture.
struct ResidentTexels {
    Device device;
    int width = 0, height = 0;
    std::vector<double> nm;
    DeviceArray<float> values;
    int levels = 1;          ///< 1: the finest alone
    std::uint64_t lost = 0;  ///< reflectances that came out below zero between the bands: set to zero

    /// Floats of the finest levels, that many.
    [[nodiscard]] size_t count(int ofLevels) const;
    /// Copies the finest levels to the host. Throws MachineError.
    [[nodiscard]] std::vector<float> read(int ofLevels) const;
};

/// The image with all its smaller levels, the very bits that addTexels() makes on the host. Nothing where the
/// device has no room for it. Throws MachineError.
[[nodiscard]] std::shared_ptr<const ResidentTexels> withLevels(const ResidentTexels& image);

/// What stepsFor() (texture_nodes.h) finds for such an image. Throws MachineError.
[[nodiscard]] int stepsOn(const ResidentTexels& image, double inside, int power, double tolerance, int most);

/// The largest value of such an image, whose values are not below zero. Throws MachineError.
[[nodiscard]] float largestOn(const ResidentTexels& image);

/// Makes texels of a rendered image, strip by strip (kernels/nodes.cl): the very bits that textureFrom()
/// makes of the same cube.
class TexelStage {
  public:
    /// Room for the whole texture; `aboveZero`: reflectances, which are held there. Throws MachineError where
    /// the device has none (fits() says so before).
    TexelStage(const Device& device, const Wavelengths& grid, int width, int height, bool aboveZero = false);
    /// Whether a device takes such a texture in one piece and keeps as much for another and the strips.
    [[nodiscard]] static bool fits(const DeviceInfo& device, size_t bands, int width, int height);

    /// Rows [firstRow, firstRow + rows) of the texture from a strip [row][band][pitch].
    void add(const cl::Buffer& cube, int pitch, int firstRow, int rows);
    [[nodiscard]] std::shared_ptr<const ResidentTexels> finish();

  private:
    Device device_;
    std::shared_ptr<ResidentTexels> texels_;
    bool points_, aboveZero_;
    Kernel kernel_;
    unsigned items_;
    DeviceArray<double> area_, forward_, off_, inverse_, scratch_;
    DeviceArray<std::uint64_t> lost_;
};

}  // namespace spectrad
