// The light that a cube is seen under: what it says of its scene's first light, and for reflectances and
// transmittances, which have no colour by themselves, the lamp that shines on them.
#pragma once

#include "colour/white.h"
#include "image/cube.h"
#include "spectrum/resolver.h"
#include "spectrum/spectrum.h"

#include <optional>

namespace spectrad {

/// What render writes into a cube about the white of its scene.
namespace attribute {
inline constexpr const char* white = "white";        ///< the first light's spectrum as the scene names it
inline constexpr const char* whiteXyz = "whiteXYZ";  ///< its X,Y,Z with Y = 1, CIE 1931
}  // namespace attribute

[[nodiscard]] bool needsLight(CubeKind kind);

/// A detector that looks at a ratio under the light: its channels of the perfect diffuser have Y = diffuserY,
/// as `standard` sees it where the detector is no observer. Throws InputError for a light that it does not
/// see.
[[nodiscard]] Detector litBy(const Spectrum& light, const Detector& detector, const Detector& standard);

/// The spectrum of the cube's scene's first light, where its name means here what it meant there: its
/// chromaticity tells. Nothing for a cube that says nothing, or a light that is not known here.
[[nodiscard]] std::optional<Spectrum> statedLight(const CubeInfo& info, const Detector& standard,
                                                  const SpectrumResolver& resolver);

/// The first light of the cube's scene as the detector sees it; E where the cube says nothing. A light that
/// is in the library is seen by its spectrum, else its CIE 1931 chromaticity must do, with a warning.
[[nodiscard]] White statedWhite(const CubeInfo& info, const Detector& detector, const XyzMatrix& toXyz,
                                const Detector& standard, const SpectrumResolver& resolver, Notes& notes);

}  // namespace spectrad
