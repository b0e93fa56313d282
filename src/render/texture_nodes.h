// Between a texture's wavelengths: hats where what a lobe makes of it is linear there, polynomials through
// more nodes where it is not.
#pragma once

#include "render/world.h"
#include "spectrum/curve.h"

#include <utility>
#include <vector>

namespace spectrad {

/// 1 at one of a texture's nodes and 0 at all others, `steps` nodes to each interval between wavelengths.
/// Beyond the wavelengths the end values go on.
[[nodiscard]] Curve nodeCurve(const std::vector<double>& nm, int steps, size_t node);
[[nodiscard]] inline size_t nodeCount(const std::vector<double>& nm, int steps) {
    return (nm.size() - 1) * static_cast<size_t>(steps) + 1;
}

/// Wavelength of a node, nm, where there are at least two wavelengths.
[[nodiscard]] double nodePlace(const std::vector<double>& nm, int steps, size_t node);
/// Where nodeCurve() is not 0, nm; infinite at the ends.
[[nodiscard]] std::pair<double, double> nodeSupport(const std::vector<double>& nm, int steps, size_t node);

/// How finely a texture's intervals are cut so that rho^power (1 − inside) / (1 − rho inside), which is not
/// linear in them, is off by less than `tolerance` of its value. `texture`: 1 + its number. Throws
/// MachineError.
[[nodiscard]] int stepsFor(const World& world, std::uint32_t texture, double inside, int power,
                           double tolerance = 1e-6);

}  // namespace spectrad
