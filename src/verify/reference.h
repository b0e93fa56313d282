// The reference: single pixels of a scene, scalar, in double precision, with the spectra on their own
// samples. It shares neither kernels nor float arithmetic with the renderer: what triangles a sample sees,
// where it lies, every cosine and lobe is computed anew. What it takes over is what the scene means: its
// triangles, lights and textures, and the factoring into terms (docs/design.md, "Certificates").
#pragma once

#include "colour/colour.h"
#include "colour/detector.h"
#include "opencl/device.h"
#include "render/plan.h"
#include "verify/scalar_shadow.h"
#include "verify/visibility.h"

namespace spectrad {

/// Samples a pixel of the reference: as many as an image can have.
inline constexpr int referenceSamples = maxSamples;
/// Samples a pixel that stand for its whole area: an edge anywhere in it is met within 0.1 %.
inline constexpr int areaSamples = 1024;
/// Wavelengths that passes of a reference are rendered at: every nanometre of the visible and of `grid`.
[[nodiscard]] Wavelengths referenceWavelengths(const Wavelengths& grid);

struct ReferencePixel {
    Triple xyz{};               ///< of the exact spectrum, absolute; bands do not enter
    std::vector<double> bands;  ///< what the image's bands would be
};

class Reference {
  public:
    /// `settings`: what chose the image that is judged; its grid, samples and shortcuts do not count. `grid`:
    /// the image's. Throws InputError that names what cannot be judged: only radiance seen by one camera can,
    /// by an observer with X, Y, Z.
    Reference(const Scene& scene, const RenderSettings& settings, const Wavelengths& grid,
              const Detector& observer, const Library& library, const Device& device);

    [[nodiscard]] int width() const { return wide_.view.width; }
    [[nodiscard]] int height() const { return wide_.view.height; }
    /// `places` ascend by y, then x; with `samples` a pixel, each of which counts. On all cores; each pixel's
    /// sums have one order, so the result is the same on any number of them.
    [[nodiscard]] std::vector<ReferencePixel> at(std::span<const PixelPlace> places,
                                                 int samples = referenceSamples,
                                                 const Progress& progress = {}) const;
    /// What it takes from the renderer instead of computing it itself, one line each: passes.
    [[nodiscard]] const std::vector<std::string>& taken() const { return taken_; }

  private:
    /// What the triangles `seen` by its samples add up to; `g` is scratch.
    [[nodiscard]] ReferencePixel pixelAt(const PixelPlace& place, const SamplePattern& pattern,
                                         const std::uint32_t* seen, std::vector<double>& g) const;
    void shadePixel(const Plan& plan, const PixelPlace& place, const SamplePattern& pattern,
                    const std::uint32_t* seen, std::vector<double>& g) const;

    Plan wide_;       ///< over all that an eye sees: its exact channels count
    Plan own_;        ///< on the image's grid: its bands count
    bool sameLobes_;  ///< both plans have the same factors g
    sd_frame frame_;
    scalar::VerticesOf<double> vertices_;
    scalar::OccludersOf<double> occluders_;
    std::vector<std::string> taken_;
};

}  // namespace spectrad
