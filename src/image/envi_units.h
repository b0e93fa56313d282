// Units of radiance as ENVI headers write them.
#pragma once

#include <optional>
#include <string_view>

namespace spectrad {

/// What turns values of a unit into W·m⁻²·sr⁻¹·nm⁻¹: "uW/(cm^2 sr nm)" is 0.01. Power, area, steradian and
/// wavelength may stand in any order and spelling ("W m-2 um-1 sr-1", "µW/cm2/nm/sr"). Nothing for what is
/// no spectral radiance per wavelength.
[[nodiscard]] std::optional<double> radianceUnit(std::string_view text);

}  // namespace spectrad
