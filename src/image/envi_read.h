#pragma once

#include "image/cube_reader.h"

#include <optional>

namespace spectrad {

/// The header of an ENVI raster, given itself or its data file; nothing if there is none.
[[nodiscard]] std::optional<std::filesystem::path> findEnviHeader(const std::filesystem::path& path);

/// Whether a file with such a header is as many bytes long as that calls for, to the byte.
[[nodiscard]] bool isAsLargeAsItsEnviHeaderSays(const std::filesystem::path& path);

/// As readCube, readCubeInfo and openCube, for ENVI rasters; `path` is the data file or the header.
[[nodiscard]] Cube readEnvi(const std::filesystem::path& path, Notes& notes);
[[nodiscard]] CubeInfo readEnviInfo(const std::filesystem::path& path, Notes& notes);
[[nodiscard]] std::unique_ptr<CubeReader> openEnvi(const std::filesystem::path& path, Notes& notes);

}  // namespace spectrad
