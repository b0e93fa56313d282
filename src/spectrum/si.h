// Constants that define the SI (its brochure, 9th edition, 2019): exact.
#pragma once

namespace spectrad {

inline constexpr double speedOfLight = 299'792'458;       ///< m/s
inline constexpr double planckConstant = 6.62607015e-34;  ///< J·s
/// c₂ = h c / k of Planck's law, m·K, k = 1.380649e-23 J/K.
inline constexpr double secondRadiation = 1.438776877503933e-2;

}  // namespace spectrad
