// Amounts of light with their units: "800 cd", "100 W/m2 over 400:700".
#pragma once

#include "scene/scene.h"

#include <span>
#include <string_view>

namespace spectrad {

/// The attributes that state an amount ("intensity", "power", "illuminance" …).
[[nodiscard]] std::span<const std::string_view> amountAttributes();

/// Reads the value of such an attribute. On failure `complaint` says what is wrong (and what is allowed).
[[nodiscard]] std::optional<Amount> parseAmount(std::string_view attribute, std::string_view text,
                                                std::string& complaint);

}  // namespace spectrad
