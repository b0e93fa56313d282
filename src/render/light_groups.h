// Lights of one spectrum share their terms: a group is a spectrum, its lights differ in place and amount
// only.
#pragma once

#include "render/world.h"
#include "scene/scene.h"
#include "types.h"

#include <functional>
#include <vector>

namespace spectrad {

struct Detector;

struct LightGroup {
    Curve spectrum;  ///< as it stands
    double factor =
        1;  ///< spectrum × factor: irradiance per nm that a light of scale 1 gives (point: intensity, at 1 m)
    std::string text;  ///< the spectrum as the user named it
};

/// Factor that makes the emitter's spectrum absolute, in the amount's own unit per nm: amount ÷ the
/// spectrum's integral (a light's power is still to be divided by its solid angle). Throws InputError where
/// the integral is zero, or does not exist (a constant without a range).
[[nodiscard]] double absoluteFactor(const Emitter& emitter, const Detector& observer);

/// Gives an emitter whose spectrum is a pass that spectrum.
using ResolveEmitter = std::function<Emitter(const Emitter&)>;

/// Places the scene's lights for a view and groups them. Lights of no power are kept: they cost little and
/// change nothing. Where no ambient light is, the background comes last, for mirrors to show. `equalEnergy`:
/// every light has a constant spectrum instead of its own; amounts count
/// relative to each other only.
/// `apart`: a group for each light, whose scale is 1: spectrum and amount are in its terms alone.
[[nodiscard]] std::vector<LightGroup> groupLights(const Scene& scene, const FlatScene& flat, const View& view,
                                                  const Detector& observer, const ResolveEmitter& resolved,
                                                  std::vector<sd_light>& lights, bool equalEnergy = false,
                                                  bool apart = false);

/// The same lights from another camera: places and axes only. `lights`: as groupLights made them.
void placeLights(const Scene& scene, const FlatScene& flat, const View& view, std::vector<sd_light>& lights);

}  // namespace spectrad
