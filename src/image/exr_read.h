#pragma once

#include "image/cube.h"

namespace spectrad {

/// As readCube and readCubeInfo, for EXR files.
[[nodiscard]] Cube readExr(const std::filesystem::path& path, Notes& notes);
[[nodiscard]] CubeInfo readExrInfo(const std::filesystem::path& path, Notes& notes);
/// True if the first bytes are those of an EXR file.
[[nodiscard]] bool startsLikeExr(const std::filesystem::path& path);

}  // namespace spectrad
