// Triangle meshes as they come from files, before any camera.
#pragma once

#include "base/vec.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace spectrad {

/// Indexed triangles. Positions are float relative to `origin` (double, the centre of the bounding box), so
/// that models far from zero keep their detail. normal and uv are empty or one per position.
struct Mesh {
    std::string name;
    Vec3 origin;
    std::vector<std::array<float, 3>> position;
    std::vector<std::array<float, 3>> normal;
    std::vector<std::array<float, 2>> uv;
    std::vector<std::uint32_t> index;  ///< three a triangle, each < position.size()

    [[nodiscard]] size_t triangles() const { return index.size() / 3; }
};

/// smooth: averaged over the faces at a position, weighted by their angle there; flat: the face's own; file:
/// the file's (smooth where the file has none).
enum class Normals { smooth, flat, file };

/// Replaces the normals as asked; triangles and their order stay. Zero-area faces have no say.
[[nodiscard]] Mesh withNormals(const Mesh& mesh, Normals normals);

/// One vertex for all that agree bit for bit in position, normal and uv (−0 counts as 0); vertices that no
/// triangle uses go. Triangles and their order stay.
void weldIdentical(Mesh& mesh);

}  // namespace spectrad
