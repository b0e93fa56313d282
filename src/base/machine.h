// What machine this runs on.
#pragma once

#include <cstdint>

namespace spectrad {

/// Bytes of memory that the machine has; the largest number if the system does not say.
[[nodiscard]] std::uint64_t memoryOfMachine();

}  // namespace spectrad
