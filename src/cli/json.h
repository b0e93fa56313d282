// Values that may be missing, in JSON.
#pragma once

#include "cli/console.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace spectrad {

template <class T>
[[nodiscard]] Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

}  // namespace spectrad
