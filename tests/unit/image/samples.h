// Cubes and folders for the tests of src/image.
#pragma once

#include "image/cube.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace spectrad::test {

/// A folder of its own, gone with the test.
class Folder {
  public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "spectrad-image-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("no folder for tests");
        path_ = name;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Number of files in it, hidden ones included.
    [[nodiscard]] long files() const {
        return std::distance(std::filesystem::directory_iterator(path_),
                             std::filesystem::directory_iterator());
    }

  private:
    std::filesystem::path path_;
};

inline std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// A cube whose values differ everywhere: positive, over many orders of magnitude.
inline Cube sampleCube(int width, int height, std::vector<double> nm, float largest = 1e30f) {
    Cube cube;
    cube.info.width = width;
    cube.info.height = height;
    cube.info.wavelengths.nm = std::move(nm);
    cube.values.resize(static_cast<size_t>(width) * static_cast<size_t>(height) *
                       cube.info.wavelengths.size());
    std::mt19937 random(7);
    for (float& value : cube.values) {
        const float unit = static_cast<float>(random() >> 8) / 16777216.0f;
        value = largest < 1e5f ? unit * largest
                               : unit * std::pow(10.0f, static_cast<float>(random() % 60) - 30.0f);
    }
    return cube;
}

inline std::vector<double> ascending(double from, double step, size_t count) {
    std::vector<double> nm;
    for (size_t i = 0; i < count; ++i)
        nm.push_back(from + static_cast<double>(i) * step);
    return nm;
}

/// Feeds the cube to `writer` in strips of the given numbers of rows, over and over, and finishes it.
inline WriteReport writeStrips(CubeWriter& writer, const Cube& cube,
                               const std::vector<int>& strips = {3, 1, 7}) {
    const size_t previewRow = 3 * static_cast<size_t>(cube.info.width);
    int y = 0;
    for (size_t i = 0; y < cube.info.height; ++i) {
        const int rows = std::min(strips[i % strips.size()], cube.info.height - y);
        const std::vector<float> preview(previewRow * static_cast<size_t>(rows), 0.25f);
        writer.write(rows, cube.row(y, 0), preview.data());
        y += rows;
    }
    return writer.finish();
}

inline Cube readBack(const std::filesystem::path& path) {
    Notes notes;
    return readCube(path, notes);
}

}  // namespace spectrad::test
