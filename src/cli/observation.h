// A cube seen by a detector: what --observer and --white mean, for observe, measure and compare alike.
#pragma once

#include "colour/colour.h"
#include "colour/detector.h"
#include "colour/observe.h"
#include "colour/white.h"
#include "image/cube.h"
#include "spectrum/library.h"
#include "spectrum/resolver.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace spectrad {

/// What render writes into a cube about the white of its scene, and the other commands read from it.
namespace attribute {
inline constexpr const char* white = "white";        ///< the first light's spectrum as the scene names it
inline constexpr const char* whiteXyz = "whiteXYZ";  ///< its X,Y,Z with Y = 1, CIE 1931
}  // namespace attribute

struct ObserverArguments {
    std::string observer = "cie1931-2", white;
};
void addObserverOptions(CLI::App& command, ObserverArguments& arguments);

/// A detector in front of a cube. Reflectances and transmittances have no colour by themselves: they are seen
/// as if lit by the light that --white names (else D65), with the perfect diffuser (or no filter) at Y = 100.
class Observation {
  public:
    /// Throws InputError for an observer or a light that cannot be.
    Observation(const ObserverArguments& arguments, const CubeInfo& info, Notes& notes);
    Observation(const Observation&) = delete;
    Observation& operator=(const Observation&) = delete;

    [[nodiscard]] const Detector& detector() const { return detector_; }
    [[nodiscard]] const std::optional<Spectrum>& light() const { return light_; }
    /// This detector's channels of every pixel.
    [[nodiscard]] ChannelImage channels(const Cube& cube) const;
    /// This detector's channels of one spectrum, a value for each band.
    [[nodiscard]] std::vector<double> channels(const std::vector<double>& bands) const;
    /// The same as XYZ: themselves for an observer, the nearest there are for a camera or cones.
    [[nodiscard]] ChannelImage xyz(ChannelImage channels) const;

    /// --white, else the cube's word on its scene's first light, else E. `image`: in XYZ, for "at:X,Y".
    [[nodiscard]] White white(const ChannelImage& image) const;

  private:
    [[nodiscard]] White statedWhite() const;

    std::string wanted_;  ///< --white
    CubeInfo info_;
    Notes& notes_;
    Library library_;
    SpectrumResolver resolver_;
    Detector standard_;  ///< CIE 1931
    Detector detector_;
    std::optional<Spectrum> light_;  ///< of a cube that needs one
    double lightScale_ = 1;
    DetectorWeights weights_;
    XyzMatrix toXyz_;  ///< of a detector without X, Y, Z
};

/// The largest Y of an XYZ image.
[[nodiscard]] double brightest(const ChannelImage& xyz);

}  // namespace spectrad
