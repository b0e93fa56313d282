#include "image/cube_check.h"

#include "base/limits.h"
#include "base/machine.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

namespace spectrad {

void checkCubeInfo(const CubeInfo& info, const std::filesystem::path& file) {
    const SourceLocation where{file.string()};
    if (info.width < 1 || info.height < 1)
        throw InputError(
            where, fmt::format("a size of {}x{} pixels (allowed: at least 1x1)", info.width, info.height));
    const std::vector<double>& nm = info.wavelengths.nm;
    if (nm.empty() || nm.size() > maxBands)
        throw InputError(where, fmt::format("{} bands (allowed: 1 to {})", nm.size(), maxBands));
    for (size_t j = 0; j < nm.size(); ++j) {
        if (!std::isfinite(nm[j]) || nm[j] <= 0)
            throw InputError(where, fmt::format("a wavelength of {} nm (allowed: above 0)", shortest(nm[j])));
        if (j > 0 && nm[j] <= nm[j - 1])
            throw InputError(where, fmt::format("wavelength {} nm after {} nm (allowed: ascending ones)",
                                                shortest(nm[j]), shortest(nm[j - 1])));
    }
}

size_t firstNonFinite(const float* values, size_t count) {
    constexpr std::uint32_t exponent = 0x7f800000;  // all ones in a NaN or infinity
    constexpr size_t block = 1024;                  // without a branch inside, so that it is vectorised
    for (size_t from = 0; from < count; from += block) {
        const size_t to = std::min(count, from + block);
        std::uint32_t bad = 0;
        for (size_t i = from; i < to; ++i)
            bad |=
                static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(values[i]) & exponent) == exponent);
        if (bad == 0) continue;
        for (size_t i = from; i < to; ++i)
            if (!std::isfinite(values[i])) return i;
    }
    return count;
}

std::string placeInCube(const CubeInfo& info, int x, int y, size_t band) {
    return fmt::format("pixel {},{}, band {} nm", x, y, shortest(info.wavelengths.nm[band]));
}

void checkFinite(const CubeInfo& info, int firstRow, int rows, const float* bands,
                 const std::filesystem::path& file) {
    const size_t width = static_cast<size_t>(info.width), bandCount = info.wavelengths.size();
    const size_t count = static_cast<size_t>(rows) * bandCount * width;
    const size_t bad = firstNonFinite(bands, count);
    if (bad == count) return;
    const int x = static_cast<int>(bad % width);
    const int y = firstRow + static_cast<int>(bad / width / bandCount);
    throw InputError({file.string()},
                     fmt::format("{} is {} (allowed: finite values)",
                                 placeInCube(info, x, y, bad / width % bandCount), bands[bad]));
}

std::uint64_t availableMemory() {
    std::ifstream file("/proc/meminfo");
    for (std::string line; std::getline(file, line);) {
        if (!startsWith(line, "MemAvailable:")) continue;
        const auto parts = words(line);
        if (const auto kilobytes = parts.size() > 1 ? parseInteger(parts[1]) : std::nullopt)
            return static_cast<std::uint64_t>(*kilobytes) * 1024;
    }
    return memoryOfMachine();
}

size_t checkedValueCount(const CubeInfo& info, const std::filesystem::path& file) {
    // At most 2^31 · 2^31 · 10^4 values: beyond 64 bits, so in double first.
    const double bytes = static_cast<double>(info.width) * info.height *
                         static_cast<double>(info.wavelengths.size()) * sizeof(float);
    const double limit = 0.75 * static_cast<double>(availableMemory());
    if (bytes > limit)
        throw InputError(
            {file.string()},
            fmt::format("{}x{} pixels in {} bands need {:.0f} MB of memory, more than the limit of {:.0f} MB "
                        "(three quarters of what is free)",
                        info.width, info.height, info.wavelengths.size(), bytes / 1e6, limit / 1e6));
    return static_cast<size_t>(info.width) * static_cast<size_t>(info.height) * info.wavelengths.size();
}

}  // namespace spectrad
