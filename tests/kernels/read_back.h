// What a device holds, on the host.
#pragma once

#include "opencl/device_body.h"

#include <vector>

namespace spectrad {

template <typename T>
std::vector<T> read(const Device& device, const cl::Buffer& buffer, size_t count) {
    std::vector<T> data(count);
    if (count > 0) device.body().queue.enqueueReadBuffer(buffer, CL_TRUE, 0, count * sizeof(T), data.data());
    return data;
}

}  // namespace spectrad
