// How wrong an image is: a random share of its pixels held against the reference.
#pragma once

#include "colour/white.h"
#include "image/cube.h"
#include "verify/estimates.h"
#include "verify/reference.h"

#include <memory>

namespace spectrad {

/// Of the intervals and bounds.
inline constexpr double certificateConfidence = 0.99;
/// Fewer pixels bound no quantile: a share that would be less takes so many, or all.
inline constexpr size_t fewestPixels = 1000;
/// At most so many of them are held against their whole area too.
inline constexpr size_t mostAreaPixels = 4000;

struct Certificate {
    std::string observer;
    White white;  ///< that ΔE00 is seen against, with its luminance
    std::uint64_t seed = 0;
    size_t pixels = 0, population = 0;  ///< judged; of the image
    Estimates colour;                   ///< ΔE00 against the reference
    PixelPlace worst;                   ///< where the largest found is
    /// Of each pixel the largest |image − reference| of a band ÷ the image's largest value in that band.
    Estimates bands;
    std::vector<std::string> taken;   ///< what the reference takes from the renderer
    size_t areaPixels = 0;            ///< of those judged, also with areaSamples a pixel:
    Estimates areaColour, areaBands;  ///< the same two, which the reference's own samples do not flatter
};

/// Draws the pixels of an image and picks their bands out of its rows.
class PixelSample {
  public:
    /// `share` of the pixels, but not fewer than fewestPixels.
    PixelSample(const CubeInfo& info, double share, std::uint64_t seed, const Detector& observer,
                bool asHalf);
    /// Rows from the top, bands[(row * bands + band) * width + x].
    void add(int firstRow, int rows, const float* bands);

    [[nodiscard]] const CubeInfo& info() const { return info_; }
    [[nodiscard]] std::uint64_t seed() const { return seed_; }
    [[nodiscard]] const std::vector<PixelPlace>& places() const { return places_; }
    [[nodiscard]] const std::vector<double>& bandsOf(size_t pixel) const { return bands_[pixel]; }
    [[nodiscard]] Triple xyzOf(size_t pixel) const;
    [[nodiscard]] double brightest() const { return brightest_; }                  ///< Y of all pixels
    [[nodiscard]] const std::vector<double>& largest() const { return largest_; }  ///< of each band

  private:
    CubeInfo info_;
    std::uint64_t seed_;
    DetectorWeights weights_;
    bool asHalf_;
    std::vector<PixelPlace> places_;
    std::vector<std::vector<double>> bands_;
    size_t next_ = 0;
    double brightest_ = 0;
    std::vector<double> largest_;
};

/// The white that colour differences are seen against where nobody says: the chromaticity of the scene's
/// first light that has enough X and Z (Plan::labWhite); the luminance of the image's brightest pixel, but no
/// more than the brightest place would have if every surface were a perfect white diffuser under the scene's
/// lights (a highlight is no white). Throws InputError for an image without light.
[[nodiscard]] White defaultWhite(const Scene& scene, const RenderSettings& settings, const Detector& observer,
                                 const Library& library, const Device& device, double brightest);

/// Throws InputError where the sizes of image and reference differ.
[[nodiscard]] Certificate certify(const PixelSample& sample, const Reference& reference,
                                  const Detector& observer, const White& white,
                                  const Progress& progress = {});

}  // namespace spectrad
