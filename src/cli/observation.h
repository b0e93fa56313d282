// A cube seen by a detector: what --observer and --white mean, for observe, measure and compare alike.
#pragma once

#include "camera/film.h"
#include "colour/colour.h"
#include "colour/detector.h"
#include "colour/observe.h"
#include "colour/white.h"
#include "image/cube.h"
#include "render/cube_light.h"
#include "spectrum/library.h"
#include "spectrum/resolver.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace spectrad {

struct ObserverArguments {
    std::string observer = "cie1931-2", white;
    double filmStops = 0;               ///< of exposure more, for a film
    std::string projector{}, viewer{};  ///< of a film: lamp and eye instead of its own and of CIE 1931
    /// Where files that `observer` names are looked for, and whether no others may be read.
    std::filesystem::path folder = ".";
    bool restricted = false;
    std::optional<Detector> detector{};  ///< instead of what `observer` names
};
void addObserverOptions(CLI::App& command, ObserverArguments& arguments);

/// Whether a --white names a light: no numbers, and no place in the image.
[[nodiscard]] bool namesLight(const std::string& white);
/// Whether the observer's name means a film.
[[nodiscard]] bool namesFilm(const std::string& observer);

/// A detector in front of a cube. A film's channels are the exposures of its layers; what it shows is its
/// transparency in a projector, the lamp without film at Y = 100. Reflectances and transmittances have no
/// colour by themselves: they are seen as if lit by the light that --white names (else D65), with the perfect
/// diffuser (or no filter) at Y = 100.
class Observation {
  public:
    /// Throws InputError for an observer or a light that cannot be.
    Observation(const ObserverArguments& arguments, const CubeInfo& info, Notes& notes);
    Observation(const Observation&) = delete;
    Observation& operator=(const Observation&) = delete;

    [[nodiscard]] const Detector& detector() const { return detector_; }
    [[nodiscard]] const DetectorWeights& weights() const { return weights_; }
    [[nodiscard]] const std::optional<Spectrum>& light() const { return light_; }
    [[nodiscard]] const SpectrumResolver& resolver() const { return resolver_; }
    [[nodiscard]] const Detector& standard() const { return standard_; }  ///< CIE 1931
    /// This detector's channels of every pixel.
    [[nodiscard]] ChannelImage channels(const Cube& cube) const;
    /// This detector's channels of one spectrum, a value for each band.
    [[nodiscard]] std::vector<double> channels(const std::vector<double>& bands) const;
    /// The same as XYZ: themselves for an observer, the nearest there are for a camera or cones, the
    /// projected picture for a film.
    [[nodiscard]] ChannelImage xyz(ChannelImage channels) const;
    [[nodiscard]] Triple xyz(const std::vector<double>& channels, double metered) const;
    /// What a film's light meter says of an image: the luminance that counts as white, that of --white if it
    /// has one, else the 99th percentile, both through the green layer. 1 for other detectors.
    [[nodiscard]] double metered(const ChannelImage& channels) const;

    /// --white, else the cube's word on its scene's first light, else E. `image`: in XYZ, for "at:X,Y".
    [[nodiscard]] White white(const ChannelImage& image) const;
    /// The chromaticity of a light for this detector; for a film, what its projection's viewer takes for
    /// white.
    [[nodiscard]] White whiteUnder(const std::string& name, const Curve& light) const;

  private:
    [[nodiscard]] Detector wantedDetector(const ObserverArguments& arguments);

    std::string wanted_;  ///< --white
    CubeInfo info_;
    Notes& notes_;
    Library library_;
    SpectrumResolver resolver_;
    Detector standard_;
    std::optional<FilmProjection> film_;
    double filmStops_;
    Detector detector_;
    std::optional<Spectrum> light_;  ///< of a cube that needs one
    DetectorWeights weights_;
    std::string outside_;  ///< what is to be said of light beyond the bands; empty: nothing
    XyzMatrix toXyz_;      ///< of a detector without X, Y, Z
};

/// The largest Y of an XYZ image.
[[nodiscard]] double brightest(const ChannelImage& xyz);

}  // namespace spectrad
