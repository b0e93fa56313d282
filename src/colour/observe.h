// From spectral rows to a detector's channels, and from any detector's channels to XYZ.
#pragma once

#include "colour/colour.h"
#include "colour/detector.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace spectrad {

/// An image of a detector's channels: plane[channel][y * width + x], absolute (XYZ: Y in cd/m²).
struct ChannelImage {
    int width = 0, height = 0;
    std::vector<std::vector<double>> plane;

    ChannelImage() = default;
    ChannelImage(int w, int h, size_t channels)
        : width(w),
          height(h),
          plane(channels, std::vector<double>(static_cast<size_t>(w) * static_cast<size_t>(h))) {}
    [[nodiscard]] size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    /// The first three channels of pixel `i`.
    [[nodiscard]] Triple triple(size_t i) const { return {plane[0][i], plane[1][i], plane[2][i]}; }
};

/// One row of a cube, bands[band * width + x] (EXR's scan-line order), into row y of `image`. Sums in double.
/// Throws InputError that names the first pixel whose sum is not finite (a cube of another program may hold
/// such values).
void observeRow(const DetectorWeights& detector, const float* bands, int y, ChannelImage& image);

/// Planes as float, for files. Throws InputError that names channel and pixel of a value beyond float's
/// range.
[[nodiscard]] std::vector<std::vector<float>> floatPlanes(const ChannelImage& image,
                                                          const std::vector<std::string>& channels);

/// One row for each of X, Y, Z, one column a channel of some detector.
using XyzMatrix = std::array<std::vector<double>, 3>;

/// The matrix that takes a detector's channels to those of `observer`: of all matrices the
/// one whose combined sensitivities lie nearest to the observer's over wavelength (least squares; no training
/// set). Exact for XYZ themselves and, to their published rounding, for cone fundamentals of the same
/// observer; for a camera the usual approximation, whose error is its failure of the Luther condition. A
/// luminous efficiency V alone knows no colour: it becomes a grey of X = Y = Z. Throws InputError unless
/// `observer` is tristimulus, and for a detector with no sensitivity.
[[nodiscard]] XyzMatrix towardsXyz(const Detector& detector, const Detector& observer);
/// Channels to X Y Z by such a matrix.
[[nodiscard]] ChannelImage toXyz(const XyzMatrix& matrix, const ChannelImage& channels);
[[nodiscard]] Triple toXyz(const XyzMatrix& matrix, const std::vector<double>& channels);

/// A detector with its way to XYZ: what looks at a picture.
struct Eye {
    Detector detector;
    XyzMatrix matrix;  ///< towardsXyz of the detector
};
/// CIE 1931, see standardObserver().
[[nodiscard]] Eye standardEye(const Library& library);
/// X Y Z, absolute, of a product of curves; no bands in between.
[[nodiscard]] Triple seenXyz(const Eye& eye, std::span<const Curve* const> product);

}  // namespace spectrad
