// Few wavelengths, well chosen: Gaussian quadrature for an observer.
#pragma once

#include "colour/detector.h"

#include <vector>

namespace spectrad {

/// Channel c of a spectrum is about Σ_k weights.weights[c][k] · L(nm[k]).
struct QuadratureRule {
    std::vector<double> nm;
    DetectorWeights weights;
};

/// `count` wavelengths, the nodes of the Gauss rule whose weight function is the sum of the observer's
/// channels, each taken as its absolute value (Meyer 1988, "Wavelength selection for synthetic image
/// generation", took the channels A, C1, C2 of an opponent space); each channel's weights then make
/// polynomials of degree below `count` exact.
[[nodiscard]] QuadratureRule gaussRule(const Detector& observer, int count);

}  // namespace spectrad
