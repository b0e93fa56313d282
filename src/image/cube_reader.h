// A cube's file read by rows: what is larger than memory can be looked at, too.
#pragma once

#include "image/cube.h"

namespace spectrad {

class CubeReader {
  public:
    CubeReader() = default;
    virtual ~CubeReader() = default;
    CubeReader(const CubeReader&) = delete;
    CubeReader& operator=(const CubeReader&) = delete;

    [[nodiscard]] virtual const CubeInfo& info() const = 0;
    /// `rows` rows from `firstRow` on, in any order of calls: values[(row * bands + band) * width + x].
    /// Throws InputError.
    virtual void read(int firstRow, int rows, float* values) = 0;
};

/// As readCube. The file stays open, so that what replaces it under its name is not mixed into it.
[[nodiscard]] std::unique_ptr<CubeReader> openCube(const std::filesystem::path& path, Notes& notes);

}  // namespace spectrad
