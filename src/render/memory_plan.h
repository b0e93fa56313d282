// How many rows at a time fit into the memory that a device really has.
#pragma once

#include "opencl/device.h"
#include "render/plan.h"

#include <cstdint>

namespace spectrad {

struct MemoryPlan {
    int visibilityRows = 0;   ///< rows whose samples are resolved together
    int cubeRows = 0;         ///< rows expanded and handed out together; divides visibilityRows or covers it
    std::uint64_t bytes = 0;  ///< of a strip: keys of visibilityRows, cube and preview of cubeRows
};

/// `slots`: sample slots of a pixel. Throws MachineError, naming both numbers, when not even one row fits.
[[nodiscard]] MemoryPlan planMemory(const Plan& plan, const DeviceInfo& device, int slots);

}  // namespace spectrad
