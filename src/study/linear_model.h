// Spectra as sums of a few basis functions, fitted to the scene.
#pragma once

#include "colour/detector.h"
#include "render/plan.h"

namespace spectrad {

/// The plan with its terms' spectra projected on the `count` principal components of them all (no mean taken
/// out; Maloney & Wandell 1986, Peercy 1993 for products of light and surface): an image of coefficients
/// instead of bands. `weights`, of the plan's bands, are taken over to the coefficients. Fewer components
/// than asked for where the spectra have no more.
struct LinearModel {
    Plan plan;
    DetectorWeights weights;
};
[[nodiscard]] LinearModel inPrincipalComponents(Plan plan, const DetectorWeights& weights, int count);

}  // namespace spectrad
