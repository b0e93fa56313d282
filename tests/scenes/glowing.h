// Meshes that glow, put into scenes by hand: what is covered is exactly 1, what shows through a hole is not.
#pragma once

#include "scenes/scene_image.h"

#include <vector>

namespace spectrad::test {

/// A mesh of corners and triples of indices.
[[nodiscard]] Mesh meshOf(const std::vector<Vec3>& corners, const std::vector<std::uint32_t>& index);
/// Every point about `centre`, `degrees` about `axis`.
[[nodiscard]] Mesh turned(const Mesh& mesh, Vec3 axis, double degrees);

/// A black scene of one band with a camera at (0, 0, 5), in which a glowing and a black mesh may stand.
struct GlowingScene {
    bool orthographic = true;
    double height = 2.5;  ///< orthographic; a perspective view is as high at the origin
    int width = 96, rows = 80, samples = 16;
    bool glowingBackground = false;

    [[nodiscard]] Image image(const std::vector<Mesh>& glowing, const std::vector<Mesh>& black) const;
};

}  // namespace spectrad::test
