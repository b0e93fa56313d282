// spectrad devices: the OpenCL devices, as --device counts them.
#include "cli/commands.h"
#include "cli/console.h"
#include "opencl/device.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace spectrad {

namespace {

constexpr double gibibyte = 1024.0 * 1024 * 1024;

Json described(const DeviceInfo& device) {
    return {{"number", device.number},
            {"name", device.name},
            {"type", device.type},
            {"platform", device.platform},
            {"vendor", device.vendor},
            {"version", device.version},
            {"driver", device.driver},
            {"compute_units", device.computeUnits},
            {"global_memory_bytes", device.globalMemoryBytes},
            {"max_allocation_bytes", device.maxAllocationBytes},
            {"fp64", device.fp64},
            {"atomics64", device.atomics64}};
}

void printTable(const std::vector<DeviceInfo>& devices) {
    for (const DeviceInfo& device : devices)
        printText(fmt::format(
            "{}: {} ({}, {}; {} compute units; {:.1f} GiB memory, {:.1f} GiB a buffer; {}, driver {})\n",
            device.number, device.name, device.type, device.platform, device.computeUnits,
            static_cast<double>(device.globalMemoryBytes) / gibibyte,
            static_cast<double>(device.maxAllocationBytes) / gibibyte, device.version, device.driver));
}

ExitCode listAll(bool json) {
    const std::vector<DeviceInfo> devices = listDevices();
    if (json) {
        Json list = Json::array();
        for (const DeviceInfo& device : devices)
            list.push_back(described(device));
        printJson(list);
    } else {
        printTable(devices);
    }
    if (devices.empty())
        throw MachineError("no OpenCL device here (a driver such as PoCL makes the CPU one)");
    return ExitCode::ok;
}

}  // namespace

void addDevices(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("devices", "List the OpenCL devices, numbered as --device counts them");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "print an array of objects; memory in bytes");
    command->footer(
        "Memory is in GiB (2^30 bytes); 'a buffer' is the largest single allocation. Exit code 3 if there is "
        "none.\n\n"
        "Examples:\n"
        "  spectrad devices\n"
        "  spectrad render chart.xml --device 1");
    command->final_callback([&action, json] { action = [json] { return listAll(*json); }; });
}

}  // namespace spectrad
