// Attributes of a spectral EXR: the layout's, the standard's and ours.
#pragma once

#include "image/cube.h"

#include <ImfHeader.h>

#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

namespace exr {

inline constexpr std::string_view ourPrefix = "spectrad:";
inline constexpr const char* layoutVersion = "spectralLayoutVersion";
inline constexpr const char* emissiveUnits = "emissiveUnits";
/// Ours; the full names are ourPrefix + these.
inline constexpr const char* projection = "projection";
inline constexpr const char* step = "step";
inline constexpr const char* wavelengths = "wavelengths";
inline constexpr const char* quantity = "quantity";

}  // namespace exr

/// The header of a cube: bands called `bands` and R, G, B of one pixel type. Throws InputError naming `file`
/// for an attribute that cannot be written.
[[nodiscard]] Imf::Header cubeHeader(const CubeInfo& info, const WriteOptions& options,
                                     const std::vector<std::string>& bands,
                                     const std::filesystem::path& file);

/// Adds a string attribute. Throws InputError naming `file` where its name is empty, beyond EXR's 31 bytes or
/// taken.
void addText(Imf::Header& header, const std::string& name, const std::string& value,
             const std::filesystem::path& file);

/// Kind, wavelengths (with `fromNames` in ascending order), projection and attributes of a header. Doubts go
/// into `notes`.
[[nodiscard]] CubeInfo cubeInfoFrom(const Imf::Header& header, bool emissive, std::vector<double> fromNames,
                                    const std::filesystem::path& file, Notes& notes);

}  // namespace spectrad
