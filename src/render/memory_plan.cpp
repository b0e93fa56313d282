#include "render/memory_plan.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace spectrad {

MemoryPlan planMemory(const Plan& plan, const DeviceInfo& device, int slots) {
    const auto height = static_cast<std::uint64_t>(plan.view.height);
    const std::uint64_t pitch =
        (static_cast<std::uint64_t>(plan.view.width) + SD_BLOCK - 1) / SD_BLOCK * SD_BLOCK;
    const std::uint64_t cubeRow = pitch * (plan.terms.bands + 3) * sizeof(float);
    const std::uint64_t keyRow = pitch * static_cast<std::uint64_t>(slots) * sizeof(std::uint64_t);
    // 96 MB of cube keep a writer's threads busy and the caches of a CPU from thrashing; keys of many rows
    // save passes over the triangles. Both stay far below what small devices have.
    std::uint64_t cubeBytes = 96u << 20, keyBytes = 192u << 20;
    if (plan.stripBytes > 0) cubeBytes = keyBytes = plan.stripBytes / 2;
    cubeBytes = std::min({cubeBytes, device.maxAllocationBytes, device.globalMemoryBytes / 4});
    keyBytes = std::min({keyBytes, device.maxAllocationBytes, device.globalMemoryBytes / 4});
    const std::uint64_t most = std::min(device.maxAllocationBytes, device.globalMemoryBytes / 2);
    if (std::max(cubeRow, keyRow) > most)
        throw MachineError(fmt::format(
            "one row of {} pixels and {} bands takes {} bytes, more than the {} that device {} ({}) gives in "
            "one piece",
            plan.view.width, plan.terms.bands, std::max(cubeRow, keyRow), most, device.number, device.name));
    const auto rowsIn = [height](std::uint64_t bytes, std::uint64_t row) {
        std::uint64_t rows = std::clamp<std::uint64_t>(bytes / row, 1, height);
        // Writers compress chunks of 32 rows.
        if (rows < height && rows > 32) rows = rows / 32 * 32;
        return rows;
    };
    MemoryPlan memory;
    const std::uint64_t cubeRows = rowsIn(cubeBytes, cubeRow);
    std::uint64_t visibilityRows = rowsIn(keyBytes, keyRow);
    if (visibilityRows > cubeRows && visibilityRows < height)
        visibilityRows = visibilityRows / cubeRows * cubeRows;
    memory.visibilityRows = static_cast<int>(visibilityRows);
    memory.cubeRows = static_cast<int>(std::min(cubeRows, visibilityRows));
    memory.bytes = visibilityRows * keyRow + static_cast<std::uint64_t>(memory.cubeRows) * cubeRow;
    return memory;
}

}  // namespace spectrad
