#include "image/exr_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace spectrad {

namespace {

constexpr std::uint64_t largestChunk = std::numeric_limits<std::int32_t>::max();  // readers refuse more
constexpr std::uint64_t memoryBudget = std::uint64_t(1) << 30;
// OpenEXR holds two line buffers a thread, each with a compressor of its own; measured, both take about 2.8
// times the chunk.
constexpr double memoryPerBuffer = 2.8;

constexpr std::array<std::pair<std::string_view, Compression>, 4> compressions{{{"none", Compression::none},
                                                                                {"zips", Compression::zips},
                                                                                {"zip", Compression::zip},
                                                                                {"piz", Compression::piz}}};

bool chunkTooLarge(const CubeInfo& info, const WriteOptions& options) {
    return chunkBytes(info.width, info.wavelengths.size() + previewChannels, options.half,
                      options.compression) > largestChunk;
}

}  // namespace

Compression parseCompression(std::string_view text) {
    for (const auto& [word, compression] : compressions)
        if (word == text) return compression;
    throw UsageError(fmt::format("unknown compression '{}' (allowed: none, zips, zip, piz)", text));
}

std::string_view name(Compression compression) {
    return std::find_if(compressions.begin(), compressions.end(),
                        [&](auto& c) { return c.second == compression; })
        ->first;
}

int rowsPerChunk(Compression compression) {
    switch (compression) {
        case Compression::zip:
            return 16;
        case Compression::piz:
            return 32;
        case Compression::none:
        case Compression::zips:
            break;
    }
    return 1;
}

std::uint64_t chunkBytes(int width, std::uint64_t channels, bool half, Compression compression) {
    return static_cast<std::uint64_t>(width) * channels * (half ? 2 : 4) *
           static_cast<std::uint64_t>(rowsPerChunk(compression));
}

int threadsWithinMemory(std::uint64_t bytesPerChunk, int available) {
    const double perThread =
        2 * memoryPerBuffer * static_cast<double>(std::max<std::uint64_t>(bytesPerChunk, 1));
    return static_cast<int>(std::min<double>(available, static_cast<double>(memoryBudget) / perThread));
}

void checkChunkSize(const CubeInfo& info, const WriteOptions& options, const std::filesystem::path& file) {
    if (!chunkTooLarge(info, options)) return;
    WriteOptions smallest = options;
    smallest.compression = Compression::zips;
    const std::uint64_t channels = info.wavelengths.size() + previewChannels;
    throw InputError(
        {file.string()},
        fmt::format("{} pixels x {} channels x {} bytes x {} rows are {} bytes in one chunk, more than the "
                    "{} of OpenEXR; "
                    "{} would do",
                    info.width, channels, options.half ? 2 : 4, rowsPerChunk(options.compression),
                    chunkBytes(info.width, channels, options.half, options.compression), largestChunk,
                    chunkTooLarge(info, smallest) ? "--format envi" : "--compression zips"));
}

Compression chooseCompression(const CubeInfo& info, const WriteOptions& wanted, bool asked, Notes& notes) {
    if (asked) {
        checkChunkSize(info, wanted, {});
        return wanted.compression;
    }
    const std::uint64_t bytes =
        chunkBytes(info.width, info.wavelengths.size() + previewChannels, wanted.half, wanted.compression);
    if (memoryPerBuffer * static_cast<double>(bytes) <= static_cast<double>(memoryBudget))
        return wanted.compression;
    WriteOptions chosen = wanted;
    chosen.compression = Compression::zips;
    if (rowsPerChunk(wanted.compression) == 1) chosen.compression = wanted.compression;
    checkChunkSize(info, chosen, {});
    if (chosen.compression != wanted.compression)
        notes.say(fmt::format("compression zips instead of {}, whose chunks of {} rows would be {} MB each",
                              name(wanted.compression), rowsPerChunk(wanted.compression), bytes / 1000000));
    return chosen.compression;
}

}  // namespace spectrad
