// A scene in three numbers a spectrum, as renderers for pictures have it: what a spectral renderer is
// measured against.
#pragma once

#include "colour/colour.h"
#include "colour/detector.h"
#include "scene/scene.h"
#include "spectrum/library.h"

#include <optional>

namespace spectrad {

enum class ThreeChannels {
    rgb,  ///< linear sRGB primaries; a surface has the components of its colour under D65, held in 0…1
    xyz   ///< tristimulus values; a surface has the ratios of its XYZ to white's, under equal-energy light
};

/// The scene with each spectrum replaced by three values, at 400, 500 and 600 nm, to be rendered with point
/// bands there: a product of light and surface is then channel by channel. Coats keep their index at 589.3 nm
/// (its dispersion is lost), metals become surfaces with their colour at normal incidence and Schlick's angle
/// dependence, fluorescence is lost.
struct ThreeChannelScene {
    Scene scene;
    Wavelengths channels;
    DetectorWeights weights;  ///< from the three channels to the observer's X Y Z (Y in cd/m²)
};
/// Nothing if the scene cannot be told in three numbers: it has spectral textures, of surfaces or lights.
/// `observer` is tristimulus.
[[nodiscard]] std::optional<ThreeChannelScene> inThreeChannels(const Scene& scene, ThreeChannels kind,
                                                               const Detector& observer,
                                                               const Library& library);

}  // namespace spectrad
