// What OpenEXR can hold and how much memory its compressors take, so that a file is refused before anything
// is rendered.
#pragma once

#include "image/cube.h"

#include <cstddef>
#include <cstdint>

namespace spectrad {

inline constexpr std::size_t previewChannels = 3;  ///< R, G, B, in every cube's file
/// Bytes of a channel's or an attribute's name; a longer one sets the file's "long names" flag.
inline constexpr std::size_t longestName = 31;

/// Rows that the compression packs into one chunk: 1, 16 (zip) or 32 (piz).
[[nodiscard]] int rowsPerChunk(Compression compression);

/// Bytes of one chunk of `channels` channels, uncompressed.
[[nodiscard]] std::uint64_t chunkBytes(int width, std::uint64_t channels, bool half, Compression compression);

/// Threads that may compress chunks of that size at once within 1 GiB; 0 where one chunk, in the caller's own
/// thread, takes more (or there is nothing to compress in parallel).
[[nodiscard]] int threadsWithinMemory(std::uint64_t bytesPerChunk, int available);

/// Throws InputError naming `file` and the numbers if a chunk of the cube is beyond the format's 2^31−1
/// bytes.
void checkChunkSize(const CubeInfo& info, const WriteOptions& options, const std::filesystem::path& file);

}  // namespace spectrad
