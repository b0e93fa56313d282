// Kernels: built for one device with the switches of a plan, cached on disk, called with arguments bound by
// name.
#pragma once

#include "opencl/device_body.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

/// A kernel of a program. Arguments are set by the names they have in the .cl file; run() refuses to start
/// while one is missing.
class Kernel {
  public:
    Kernel(const Device& device, const cl::Program& program, const char* name);

    Kernel& set(std::string_view argument, const cl::Buffer& buffer);
    template <typename T>
    Kernel& set(std::string_view argument, const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        setBytes(argument, sizeof(T), &value);
        return *this;
    }
    /// `items` work-items in groups of `group` (the kernel's reqd_work_group_size); rounded up to whole
    /// groups.
    void run(size_t items, size_t group = 1);

  private:
    void setBytes(std::string_view argument, size_t size, const void* value);
    unsigned indexOf(std::string_view argument) const;

    Device device_;
    std::string name_;
    cl::Kernel kernel_;
    std::map<std::string, unsigned, std::less<>> arguments_;
    std::vector<bool> isSet_;
};

/// "VW=16": the lanes of the device's vectors.
[[nodiscard]] std::string vectorDefine(const Device& device);
/// A kernel of one file that has no other switch. Throws MachineError.
[[nodiscard]] Kernel vectorKernel(const Device& device, const char* file, const char* name);

/// One program of one or more .cl files of kernels/ (named without folder), compiled with `defines`
/// ("HAS_GLOSS", "SAMPLES=16"). "CONTRACT" (a·b + c may be fused) and "FAST_MATH" (the compiler's fast
/// relaxed mathematics) loosen the arithmetic, for studies of it.
class Program {
  public:
    /// Throws MachineError with the compiler's log. `cacheFolder` empty: no disk cache.
    Program(const Device& device, const std::vector<std::string>& files,
            const std::vector<std::string>& defines, const std::string& cacheFolder = defaultCacheFolder());
    [[nodiscard]] Kernel kernel(const char* name) const { return {device_, program_, name}; }

    /// The text that is compiled: defines on top, files and what they include in order, with #line marks.
    [[nodiscard]] static std::string source(const std::vector<std::string>& files,
                                            const std::vector<std::string>& defines);
    /// $XDG_CACHE_HOME/spectrad or ~/.cache/spectrad; empty if neither is known.
    [[nodiscard]] static std::string defaultCacheFolder();

  private:
    Device device_;
    cl::Program program_;
};

}  // namespace spectrad
