#pragma once

#include "image/cube_reader.h"

namespace spectrad {

/// As readCube, readCubeInfo and openCube, for EXR files.
[[nodiscard]] Cube readExr(const std::filesystem::path& path, Notes& notes);
[[nodiscard]] CubeInfo readExrInfo(const std::filesystem::path& path, Notes& notes);
[[nodiscard]] std::unique_ptr<CubeReader> openExr(const std::filesystem::path& path, Notes& notes);
/// True if the first bytes are those of an EXR file.
[[nodiscard]] bool startsLikeExr(const std::filesystem::path& path);

}  // namespace spectrad
