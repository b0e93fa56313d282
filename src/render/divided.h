// Reflectances of passes: an image under equal-energy light divided by what a perfect white diffuser sends
// back.
#pragma once

#include "image/cube.h"
#include "image/pixel_place.h"
#include "opencl/program.h"

#include <optional>

namespace spectrad {

/// Divides `cube` where light arrives. `white`, `coverage`: one band of the same picture. Returns the first
/// pixel, row by row, where something is seen that no light reaches; the cube is of no use then.
[[nodiscard]] std::optional<PixelPlace> divideByWhite(Cube& cube, const Cube& white, const Cube& coverage);

/// The same for images on the device (kernels/division.cl), strip by strip: the very same bits.
class DivisionStage {
  public:
    /// Room for two images of one band, rows padded to `pitch` pixels. Throws MachineError.
    DivisionStage(const Device& device, int pitch, int width, int height);
    /// Rows of the two images from strips [row][1][pitch], from row `firstRow` on.
    void addWhite(const cl::Buffer& strip, int firstRow, int rows);
    void addCoverage(const cl::Buffer& strip, int firstRow, int rows);

    /// Once all of both is there. Throws MachineError.
    [[nodiscard]] std::optional<PixelPlace> dark();
    /// Divides a strip [row][band][pitch] in place.
    void divide(const cl::Buffer& cube, size_t bands, int firstRow, int rows);

  private:
    void addRows(DeviceArray<float>& image, const cl::Buffer& strip, int firstRow, int rows);

    Device device_;
    size_t pitch_;
    int width_, height_;
    DeviceArray<float> white_, coverage_;
    Kernel dark_, divide_;
};

}  // namespace spectrad
