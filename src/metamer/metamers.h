// Reflectances that match a given one under some viewings and differ from it under others: bounded and
// smooth.
#pragma once

#include "metamer/viewing.h"

#include <vector>

namespace spectrad {

struct MetamerSettings {
    std::vector<double> nm;  ///< nodes of the reflectances, linear between them
    int count = 5;
    double smoothness = 1;  ///< weight of the second derivative against being different; larger is smoother
    double low = 0, high = 1;  ///< allowed reflectances
};

struct Metamer {
    std::vector<double> value;      ///< at the nodes
    std::vector<double> matched;    ///< ΔE00 to the original under each viewing to match
    std::vector<double> differing;  ///< and under each to differ
    [[nodiscard]] Curve curve(const std::vector<double>& nm) const;
};

/// For k = 0 … count − 1 the reflectance that minimises
///
///     smoothness · ∫ (R″)² dλ − what the differing viewings see of R in direction k,
///
/// subject to equal signals for every viewing to match and low ≤ R ≤ high. Directions are spread over the
/// circle of the opponent signals X − Y and Y − Z of the white (for a camera those of its first and last
/// channels). Throws InputError where the wanted matches leave no reflectance within the bounds.
[[nodiscard]] std::vector<Metamer> makeMetamers(const Curve& original, const std::vector<Viewing>& match,
                                                const std::vector<Viewing>& differ,
                                                const MetamerSettings& settings);

}  // namespace spectrad
