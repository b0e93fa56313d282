// OpenCL devices as the user counts them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

struct DeviceInfo {
    int number = 0;  ///< of --device
    std::string name, platform, vendor, driver, version;
    std::string type;  ///< "cpu", "gpu", "accelerator"
    unsigned computeUnits = 0;
    std::uint64_t globalMemoryBytes = 0, maxAllocationBytes = 0;
    bool fp64 = false, atomics64 = false;
};

/// All devices of all platforms; empty when there is no OpenCL.
[[nodiscard]] std::vector<DeviceInfo> listDevices();

/// An open device: context and queue. Copies share them.
class Device {
  public:
    /// Throws UsageError if that number is not there, MachineError if there is no OpenCL at all. Without a
    /// number: the first GPU, else the first device.
    static Device open(std::optional<int> number);

    /// The same context with a queue of its own: for another thread, which can use the same buffers.
    [[nodiscard]] Device withOwnQueue() const;

    [[nodiscard]] const DeviceInfo& info() const;

    struct Body;
    [[nodiscard]] Body& body() const { return *body_; }

  private:
    std::shared_ptr<Body> body_;
};

}  // namespace spectrad
