// How far two images are apart: over their bands, and to an eye.
#pragma once

#include "colour/observe.h"

#include <cstdint>
#include <vector>

namespace spectrad {

struct BandDifference {
    double rmse = 0;  ///< root of the mean of (A − B)² over all pixels and bands, in the cubes' unit
    /// Over the bands, the largest |A − B| of a band ÷ A's largest |value| in that band. A band that is zero
    /// all over in both counts 0; in A alone it makes this infinite.
    double relativeMax = 0;
    size_t relativeMaxBand = 0;  ///< where that is
    /// Goodness of fit, Σ a b / √(Σ a² Σ b²) (Hernández-Andrés et al. 2001), the worst pixel; 1 for equal
    /// shapes.
    double gfcMin = 1;
    double spectralAngleMax = 0;  ///< angle between the two spectra, rad, the worst pixel; 0 for equal shapes
    std::uint64_t blackInBoth = 0,
                  blackInOne = 0;  ///< pixels left out of the last two: a spectrum of zeros has no shape
    std::uint64_t compared = 0;    ///< pixels that count in the last two; with none they are undefined
};

/// Takes two cubes row by row; sums in double.
class BandDifferenceMeter {
  public:
    BandDifferenceMeter(size_t bands, int width);
    /// One row of each, [band][x]. Throws InputError for a value that is not finite.
    void add(const float* a, const float* b);
    [[nodiscard]] BandDifference result() const;
    /// Of each pixel of a row the largest |A − B| of a band ÷ A's largest |value| in that band, over all rows
    /// that were added: appended to `out`.
    void relativeErrors(const float* a, const float* b, std::vector<double>& out) const;

  private:
    void addShapes(const float* a, const float* b, size_t from, size_t count);

    size_t bands_, width_;
    std::vector<double> largestDifference_, largestA_;  // per band
    double squares_ = 0;
    std::uint64_t values_ = 0;
    BandDifference result_;
};

struct ColourDifference {
    double mean = 0, p95 = 0, p99 = 0, max = 0;  ///< ΔE00 over all pixels; p95, p99 as quantile()
    int maxX = 0, maxY = 0;                      ///< the first pixel of the largest
    double mean76 = 0, max76 = 0;                ///< the same by the CIE 1976 formula, for older tolerances
    std::vector<float> map;                      ///< ΔE00 of each pixel, row by row
};

/// ΔE00 pixel by pixel of two XYZ images of the same size, both seen against `white` (XYZ with its luminance,
/// none zero). Throws InputError for different sizes, an image without pixels, or a white that Lab cannot
/// use.
[[nodiscard]] ColourDifference colourDifference(const ChannelImage& a, const ChannelImage& b,
                                                const Triple& white);

/// Values 0…top as colours from dark blue over green to yellow, lightness rising evenly (a map for people):
/// 8-bit sRGB, interleaved. What is above `top` is drawn in the last colour.
[[nodiscard]] std::vector<std::uint8_t> falseColours(const std::vector<float>& values, double top);

}  // namespace spectrad
