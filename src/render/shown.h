// A picture between a scene and an eye: taken by a detector, shown by a display.
#pragma once

#include "image/cube.h"
#include "opencl/program.h"
#include "scene/scene.h"
#include "spectrum/library.h"

#include <cstdint>
#include <string>

namespace spectrad {

/// Radiances as the display shows them: detector's channels → XYZ (towardsXyz) → drives of the three
/// primaries that make that XYZ, held within 0…1 (counted in the notes) → their radiances. Colours are
/// absolute: what the display cannot reach in luminance is clipped. Throws InputError for primaries without
/// three different colours.
[[nodiscard]] Cube shownOn(const Screen& screen, Cube cube, const Library& library, Notes& notes);

/// The same on the device (kernels/screen.cl), strip by strip: the very same bits.
class ScreenStage {
  public:
    /// Throws InputError as shownOn() does, MachineError where the device fails.
    ScreenStage(const Device& device, const Screen& screen, const Wavelengths& grid, const Library& library,
                int width);
    /// A strip [row][band][pitch] of radiances, in place; it begins at row `firstRow` of the picture.
    void show(const cl::Buffer& cube, int pitch, int firstRow, int rows);
    /// Once all rows are shown. Throws InputError for values that are no finite numbers, and notes how many
    /// of so many pixels were clipped.
    void finish(size_t pixels, Notes& notes);

  private:
    Device device_;
    std::string name_;  ///< of the display
    size_t bands_, channels_;
    int width_;
    Kernel kernel_;
    DeviceArray<double> weights_, matrix_, drives_, primaries_;
    DeviceArray<std::uint64_t> bad_, clipped_;
};

}  // namespace spectrad
