// The open device itself; for this room and the renderer only.
#pragma once

#include "opencl/device.h"

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_CL_1_2_DEFAULT_BUILD
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wignored-attributes"
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop

#include <type_traits>
#include <utility>

namespace spectrad {

struct Device::Body {
    DeviceInfo info;
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;  ///< in order

    Body() = default;
    /// Waits: what is queued must not outlive the program that it is part of, whatever ended the work.
    ~Body() {
        if (queue()) clFinish(queue());
    }
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

    /// Lanes of the kernels' vectors (-DVW): CPUs take 16 pixels or samples at once, GPUs one per work-item.
    [[nodiscard]] int vectorWidth() const { return info.type == "gpu" ? 1 : 16; }
};

/// Name of an OpenCL error code: "CL_OUT_OF_RESOURCES".
[[nodiscard]] std::string clErrorName(int code);

/// Runs `call`, turning an OpenCL exception into a MachineError that says what was being done, on which
/// device.
[[noreturn]] void throwMachineError(const cl::Error& error, const std::string& doing,
                                    const Device::Body& device);
template <typename Call>
decltype(auto) checked(const Device::Body& device, const char* doing, Call&& call) {
    try {
        return std::forward<Call>(call)();
    } catch (const cl::Error& error) {
        throwMachineError(error, doing, device);
    }
}

/// A buffer of elements that grows and is kept: the first touch of memory costs several times the kernel that
/// fills it.
template <typename T>
class DeviceArray {
  public:
    /// At least `count` elements; what was in it is lost when it grows. Throws MachineError naming the sizes.
    void reserve(const Device& device, size_t count, const char* what);
    /// Exactly these elements.
    void upload(const Device& device, const T* data, size_t count, const char* what);
    /// Copies `count` elements, from element `from` on, to `data`. Throws MachineError.
    void read(const Device& device, T* data, size_t count, const char* doing, size_t from = 0) const;
    [[nodiscard]] const cl::Buffer& buffer() const { return buffer_; }
    [[nodiscard]] size_t capacity() const { return capacity_; }

  private:
    cl::Buffer buffer_;
    size_t capacity_ = 0;
};

/// Throws MachineError if `bytes` for `what` cannot be had on the device (names the number and the limit).
cl::Buffer allocate(const Device& device, size_t bytes, const char* what);

template <typename T>
void DeviceArray<T>::reserve(const Device& device, size_t count, const char* what) {
    if (count <= capacity_ && capacity_ > 0) return;
    capacity_ = 0;
    const size_t wanted = count > 0 ? count : 1;
    checked(device.body(), what, [&] {
        buffer_ = cl::Buffer();  // give the old one back first
        buffer_ = allocate(device, wanted * sizeof(T), what);
    });
    capacity_ = wanted;
}

template <typename T>
void DeviceArray<T>::upload(const Device& device, const T* data, size_t count, const char* what) {
    static_assert(std::is_trivially_copyable_v<T>);
    reserve(device, count, what);
    if (count == 0) return;
    checked(device.body(), what,
            [&] { device.body().queue.enqueueWriteBuffer(buffer_, CL_TRUE, 0, count * sizeof(T), data); });
}

template <typename T>
void readElements(const Device& device, const cl::Buffer& buffer, size_t from, size_t count, T* data,
                  const char* doing) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count == 0) return;
    checked(device.body(), doing, [&] {
        device.body().queue.enqueueReadBuffer(buffer, CL_TRUE, from * sizeof(T), count * sizeof(T), data);
    });
}

template <typename T>
void DeviceArray<T>::read(const Device& device, T* data, size_t count, const char* doing, size_t from) const {
    readElements(device, buffer_, from, count, data, doing);
}

}  // namespace spectrad
