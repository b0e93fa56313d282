// What a spectrum must be for the place where it is used.
#pragma once

#include "spectrum/resolver.h"

namespace spectrad {

/// Roles that take several curves: a detector's channels, n and k, whatever a definition will be used for.
[[nodiscard]] bool takesChannels(Role role);
/// The channel of a spectrum that bears the role's own name ("excitation", "emission"), if any.
[[nodiscard]] std::optional<size_t> channelFor(Role role, const std::vector<std::string>& channels);

/// Throws InputError if the quantity, the number of curves or a value does not fit; sets what lies outside
/// the curves' range.
[[nodiscard]] Spectrum fitted(Spectrum spectrum, Role role, const SourceLocation& where);

}  // namespace spectrad
