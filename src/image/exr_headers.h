// The headers of an EXR file, checked before OpenEXR makes tables as large as they claim.
#pragma once

#include <ImfHeader.h>

#include <filesystem>
#include <vector>

namespace spectrad {

/// One header a part. Throws InputError if the file cannot be opened or is too short for its own table of
/// chunks, and what OpenEXR throws for a damaged header.
[[nodiscard]] std::vector<Imf::Header> readExrHeaders(const std::filesystem::path& path);

}  // namespace spectrad
