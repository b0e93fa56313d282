// Wavelengths placed by adaptive integration.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace spectrad {

struct Detector;

/// `count` wavelengths from 380 to 780 nm for point samples: both ends, and then again and again the middle
/// of the interval whose trapezoid rule is worst for any light of the scene (each scaled alike) seen by the
/// sum of the observer's channels, judged by the integral itself (adaptive integration after Deville,
/// Merzouk, Cazier & Paul 1994 and Rougeron & Péroche 1997, whose error estimates also know the surfaces).
/// Without lights, of equal-energy light.
[[nodiscard]] std::vector<double> adaptiveWavelengths(const Scene& scene, const Detector& observer,
                                                      int count);

}  // namespace spectrad
