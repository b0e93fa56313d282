// How many lumens a watt is to an observer.
#pragma once

#include "spectrum/spectrum.h"

#include <optional>
#include <string>
#include <string_view>

namespace spectrad {

/// K_m of CIE 1931, lm/W: what photometric amounts of light are defined with (FORMAT: Amounts).
inline constexpr double luminousEfficacy = 683.002;

/// A channel as detectors call it: "x_bar", "x-bar", "xbar" and "x" are all X; other names stay as they are.
[[nodiscard]] std::string channelName(std::string_view header);

/// K_m, lm/W, that puts an observer's Y or V into lumens: 683 / V(λ) at 540 THz (CIE S 017, 17-21-092), for
/// the CIE's observers as published. X, Y, Z of other files have 683.002. Nothing for what has neither X, Y,
/// Z nor V.
[[nodiscard]] std::optional<double> efficacyOf(const Spectrum& sensitivity);

}  // namespace spectrad
