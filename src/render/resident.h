// Textures that stay on the device: what one pass renders, the next reads, without a way over the host.
#pragma once

#include "opencl/program.h"
#include "spectrum/wavelengths.h"

#include <memory>
#include <vector>

namespace spectrad {

/// Texels in device memory, [(row * width + column) * bands + band], row 0 on top: the values at the nodes of
/// curves that are linear between the wavelengths.
struct ResidentTexels {
    Device device;
    int width = 0, height = 0;
    std::vector<double> nm;
    DeviceArray<float> values;

    [[nodiscard]] size_t count() const {
        return static_cast<size_t>(width) * static_cast<size_t>(height) * nm.size();
    }
    /// Copies them to the host. Throws MachineError.
    [[nodiscard]] std::vector<float> read() const;
};

/// Makes texels of a rendered image, strip by strip (kernels/nodes.cl): the very bits that textureFrom()
/// makes of the same cube.
class TexelStage {
  public:
    /// Room for the whole texture. Throws MachineError where the device has none (fits() says so before).
    TexelStage(const Device& device, const Wavelengths& grid, int width, int height);
    /// Whether a device takes such a texture in one piece and keeps as much for another and the strips.
    [[nodiscard]] static bool fits(const DeviceInfo& device, size_t bands, int width, int height);

    /// Rows [firstRow, firstRow + rows) of the texture from a strip [row][band][pitch].
    void add(const cl::Buffer& cube, int pitch, int firstRow, int rows);
    [[nodiscard]] std::shared_ptr<const ResidentTexels> finish() { return std::move(texels_); }

  private:
    Device device_;
    std::shared_ptr<ResidentTexels> texels_;
    bool points_;
    Kernel kernel_;
    unsigned items_;
    DeviceArray<double> area_, forward_, off_, inverse_, scratch_;
};

}  // namespace spectrad
