// Checks that every cube passes, whatever its file format.
#pragma once

#include "image/cube.h"

#include <cstdint>
#include <filesystem>

namespace spectrad {

/// Size at least 1×1, 1 to 10 000 ascending positive wavelengths. Throws InputError naming `file`.
void checkCubeInfo(const CubeInfo& info, const std::filesystem::path& file);

/// Throws InputError naming pixel and band if one of `rows` rows [row][band][x] from image row `firstRow` on
/// is NaN or infinite.
void checkFinite(const CubeInfo& info, int firstRow, int rows, const float* bands,
                 const std::filesystem::path& file);

/// Index of the first NaN or infinity in values[0…count), or `count`.
[[nodiscard]] size_t firstNonFinite(const float* values, size_t count);

/// "pixel 3,7, band 550 nm", for messages.
[[nodiscard]] std::string placeInCube(const CubeInfo& info, int x, int y, size_t band);

/// Number of values of the whole cube, after checking that they and their floats fit into three quarters of
/// the memory that is available; else throws InputError with both numbers.
[[nodiscard]] size_t checkedValueCount(const CubeInfo& info, const std::filesystem::path& file);

/// Bytes that the machine can give without swapping, as far as the system says.
[[nodiscard]] std::uint64_t availableMemory();

}  // namespace spectrad
