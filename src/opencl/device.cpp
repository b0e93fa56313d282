#include "base/error.h"
#include "opencl/device_body.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

struct Found {
    cl::Platform platform;
    cl::Device device;
    DeviceInfo info;
};

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device, int number) {
    DeviceInfo info;
    info.number = number;
    info.name = device.getInfo<CL_DEVICE_NAME>();
    info.platform = platform.getInfo<CL_PLATFORM_NAME>();
    info.vendor = device.getInfo<CL_DEVICE_VENDOR>();
    info.driver = device.getInfo<CL_DRIVER_VERSION>();
    info.version = device.getInfo<CL_DEVICE_VERSION>();
    const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
    info.type = (type & CL_DEVICE_TYPE_GPU) ? "gpu" : (type & CL_DEVICE_TYPE_CPU) ? "cpu" : "accelerator";
    info.computeUnits = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.globalMemoryBytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.maxAllocationBytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    const std::string extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
    info.fp64 = extensions.find("cl_khr_fp64") != std::string::npos;
    info.atomics64 = extensions.find("cl_khr_int64_extended_atomics") != std::string::npos;
    return info;
}

/// `failure`: what a driver answered instead of its devices, if one did not answer as it should.
std::vector<Found> findDevices(std::string* failure = nullptr) {
    std::vector<Found> found;
    const auto note = [&](const cl::Error& error) {
        constexpr int noPlatform = -1001;  // CL_PLATFORM_NOT_FOUND_KHR of the loader
        if (failure && failure->empty() && error.err() != noPlatform && error.err() != CL_DEVICE_NOT_FOUND)
            *failure = fmt::format("{} in {}", clErrorName(error.err()), error.what());
    };
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error& error) {
        note(error);
        return found;  // no platform at all is an error in some loaders, an empty list in others
    }
    for (const cl::Platform& platform : platforms) {
        std::vector<cl::Device> devices;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
            for (const cl::Device& device : devices)
                found.push_back(
                    {platform, device, describe(platform, device, static_cast<int>(found.size()))});
        } catch (const cl::Error& error) {
            note(error);
            continue;  // a platform without devices
        }
    }
    return found;
}

/// Why there may be none. PoCL does not start without a folder for its own cache, and does not say so.
std::string whyNone(const std::string& failure) {
    if (!failure.empty()) return "no OpenCL device: a driver failed with " + failure;
    const char* own = std::getenv("POCL_CACHE_DIR");
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    fs::path folder;
    if (own && *own)
        folder = own;
    else if (cache && *cache)
        folder = cache;
    else if (home && *home)
        folder = fs::path(home) / ".cache";
    std::error_code error;
    if (!folder.empty()) fs::create_directories(folder, error);
    if (error)
        return fmt::format(
            "no OpenCL device: PoCL does not start without a folder for its cache, and '{}' cannot be made "
            "({}); "
            "POCL_CACHE_DIR or XDG_CACHE_HOME names another",
            folder.string(), error.message());
    return "no OpenCL device: install an OpenCL driver (on Debian: apt-get install pocl-opencl-icd)";
}

}  // namespace

std::vector<DeviceInfo> listDevices() {
    std::vector<DeviceInfo> list;
    for (const Found& found : findDevices())
        list.push_back(found.info);
    return list;
}

Device Device::open(std::optional<int> number) {
    std::string failure;
    const std::vector<Found> found = findDevices(&failure);
    if (found.empty()) throw MachineError(whyNone(failure));
    const Found* chosen = &found.front();
    if (number) {
        if (*number < 0 || static_cast<size_t>(*number) >= found.size())
            throw UsageError(fmt::format("there is no device {} (spectrad devices lists 0…{})", *number,
                                         found.size() - 1));
        chosen = &found[static_cast<size_t>(*number)];
    } else {
        for (const Found& candidate : found) {
            if (candidate.info.type == "gpu") {
                chosen = &candidate;
                break;
            }
        }
    }
    if (!chosen->info.atomics64)
        throw MachineError(fmt::format("device {} ({}) lacks 64-bit atomics (cl_khr_int64_extended_atomics)",
                                       chosen->info.number, chosen->info.name));
    if (!chosen->info.fp64)
        throw MachineError(fmt::format("device {} ({}) lacks double precision (cl_khr_fp64)",
                                       chosen->info.number, chosen->info.name));
    Device device;
    device.body_ = std::make_shared<Body>();
    device.body_->info = chosen->info;
    checked(*device.body_, "open", [&] {
        device.body_->device = cl::Device(chosen->device);
        device.body_->context = cl::Context(chosen->device);
        device.body_->queue = cl::CommandQueue(device.body_->context, chosen->device);
    });
    return device;
}

Device Device::withOwnQueue() const {
    Device device;
    device.body_ = std::make_shared<Body>();
    device.body_->info = body_->info;
    // Copied, then moved: the bindings' assignment releases what it failed to retain.
    checked(*body_, "opening another queue", [&] {
        device.body_->device = cl::Device(body_->device);
        device.body_->context = cl::Context(body_->context);
        device.body_->queue = cl::CommandQueue(body_->context, body_->device);
    });
    return device;
}

const DeviceInfo& Device::info() const {
    return body_->info;
}

void throwMachineError(const cl::Error& error, const std::string& doing, const Device::Body& device) {
    // What was queued before still uses kernels and buffers that unwinding is about to give back.
    if (device.queue()) clFinish(device.queue());
    throw MachineError(fmt::format("OpenCL: {} failed with {} in {} on {}", doing, clErrorName(error.err()),
                                   error.what(), device.info.name));
}

cl::Buffer allocate(const Device& device, size_t bytes, const char* what) {
    const DeviceInfo& info = device.info();
    if (bytes > info.maxAllocationBytes)
        throw MachineError(
            fmt::format("{} needs {} bytes in one piece, more than the {} that device {} ({}) gives", what,
                        bytes, info.maxAllocationBytes, info.number, info.name));
    return checked(device.body(), what, [&] {
        return cl::Buffer(device.body().context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, bytes);
    });
}

std::string clErrorName(int code) {
    switch (code) {
        case CL_DEVICE_NOT_FOUND:
            return "CL_DEVICE_NOT_FOUND";
        case CL_DEVICE_NOT_AVAILABLE:
            return "CL_DEVICE_NOT_AVAILABLE";
        case CL_COMPILER_NOT_AVAILABLE:
            return "CL_COMPILER_NOT_AVAILABLE";
        case CL_MEM_OBJECT_ALLOCATION_FAILURE:
            return "CL_MEM_OBJECT_ALLOCATION_FAILURE";
        case CL_OUT_OF_RESOURCES:
            return "CL_OUT_OF_RESOURCES";
        case CL_OUT_OF_HOST_MEMORY:
            return "CL_OUT_OF_HOST_MEMORY";
        case CL_BUILD_PROGRAM_FAILURE:
            return "CL_BUILD_PROGRAM_FAILURE";
        case CL_INVALID_VALUE:
            return "CL_INVALID_VALUE";
        case CL_INVALID_DEVICE:
            return "CL_INVALID_DEVICE";
        case CL_INVALID_CONTEXT:
            return "CL_INVALID_CONTEXT";
        case CL_INVALID_BINARY:
            return "CL_INVALID_BINARY";
        case CL_INVALID_KERNEL_NAME:
            return "CL_INVALID_KERNEL_NAME";
        case CL_INVALID_ARG_INDEX:
            return "CL_INVALID_ARG_INDEX";
        case CL_INVALID_ARG_VALUE:
            return "CL_INVALID_ARG_VALUE";
        case CL_INVALID_ARG_SIZE:
            return "CL_INVALID_ARG_SIZE";
        case CL_INVALID_KERNEL_ARGS:
            return "CL_INVALID_KERNEL_ARGS";
        case CL_INVALID_WORK_GROUP_SIZE:
            return "CL_INVALID_WORK_GROUP_SIZE";
        case CL_INVALID_BUFFER_SIZE:
            return "CL_INVALID_BUFFER_SIZE";
        default:
            return "error " + std::to_string(code);
    }
}

}  // namespace spectrad
