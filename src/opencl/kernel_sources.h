// The texts of kernels/, embedded by the build.
#pragma once

#include <span>
#include <string_view>

namespace spectrad {

struct KernelSource {
    std::string_view name;  ///< file name: "expand.cl"
    std::string_view text;
};
[[nodiscard]] std::span<const KernelSource> kernelSources();

}  // namespace spectrad
