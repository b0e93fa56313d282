// Collects vertices in double and hands them over as a Mesh about its own centre.
#pragma once

#include "scene/mesh.h"

#include <string>
#include <vector>

namespace spectrad {

class MeshBuilder {
  public:
    std::uint32_t vertex(Vec3 position, Vec3 normal, double u, double v);
    /// Counter-clockwise seen from where the normals point. One without area, two of its corners being one,
    /// is left out.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    /// Corners counter-clockwise.
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
    /// A quarter turn about x: what faced up (+y) faces front (+z), what lay in x–z stands in x–y.
    void turnUpToFront();
    /// Triangles of which two corners fall together in float are left out.
    [[nodiscard]] Mesh finish(std::string name) const;

  private:
    std::vector<Vec3> position_, normal_;
    std::vector<std::array<float, 2>> uv_;
    std::vector<std::uint32_t> index_;
};

}  // namespace spectrad
