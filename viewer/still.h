// A picture that stays measurable as it was painted while the next one is being made, and the places measured
// in it.
#pragma once

#include "colour/observe.h"
#include "image/cube.h"
#include "spectrum/wavelengths.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace spectrad::view {

/// A place that stays, with what was measured there.
struct Pin {
    int x = 0, y = 0;
    std::vector<double> spectrum;
    Triple xyz{};
};

/// Used by one thread, not necessarily the one that painted.
class Still {
  public:
    explicit Still(std::shared_ptr<const Eye> eye) : eye_(std::move(eye)) {}
    virtual ~Still() = default;
    Still(const Still&) = delete;
    Still& operator=(const Still&) = delete;

    /// Band values of a pixel; empty outside the picture.
    [[nodiscard]] virtual std::vector<double> spectrumAt(int x, int y) = 0;
    /// What makes X Y Z of such a spectrum: weights of the eye's detector (with its light on a ratio).
    [[nodiscard]] virtual DetectorWeights weights() const = 0;

    /// Without a spectrum outside the picture.
    [[nodiscard]] Pin measured(int x, int y);

  protected:
    [[nodiscard]] const Eye& eye() const { return *eye_; }

  private:
    std::shared_ptr<const Eye> eye_;
};

/// CSV of the pins, as `spectrad measure` prints it. `kind`: of the spectra.
[[nodiscard]] std::string pinsAsCsv(const std::vector<Pin>& pins, const Wavelengths& grid, CubeKind kind);

}  // namespace spectrad::view
