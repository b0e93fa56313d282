#include "scenes/glowing.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace spectrad::test {

Mesh meshOf(const std::vector<Vec3>& corners, const std::vector<std::uint32_t>& index) {
    Mesh mesh;
    for (const Vec3& c : corners)
        mesh.position.push_back({static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)});
    mesh.index = index;
    return mesh;
}

Mesh turned(const Mesh& mesh, Vec3 axis, double degrees) {
    const Affine turn = Affine::rotation(axis, degrees);
    Mesh result = mesh;
    result.normal.clear();
    for (auto& p : result.position) {
        const Vec3 q = turn.point(mesh.origin + Vec3{p[0], p[1], p[2]});
        p = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
    }
    result.origin = {};
    return result;
}

Image GlowingScene::image(const std::vector<Mesh>& glowing, const std::vector<Mesh>& black) const {
    const double fov = 2 * std::atan(height / 2 / 5) * 180 / std::numbers::pi;
    Scene scene =
        sceneFrom(fmt::format("<scene version=\"1\"><wavelengths>550</wavelengths><material "
                              "name=\"glow\"><emission spectrum=\"constant:1\" scale=\"1\"/></material>"
                              "<material name=\"black\"><diffuse reflectance=\"constant:0\"/></material>"
                              // Both materials are worn by something that no one sees.
                              "<node translate=\"0 0 99\"><disc radius=\"1\" material=\"glow\"/><disc "
                              "radius=\"1\" material=\"black\"/></node>"
                              "<light type=\"ambient\" spectrum=\"constant:1\" scale=\"1\"/>{}"
                              "<camera {} look-from=\"0 0 5\" look-at=\"0 0 0\" size=\"{}x{}\"/></scene>",
                              glowingBackground ? "<background spectrum=\"constant:1\" scale=\"1\"/>" : "",
                              orthographic ? fmt::format("type=\"orthographic\" height=\"{}\"", height)
                                           : fmt::format("type=\"perspective\" fov=\"{}\"", fov),
                              width, rows));
    Index number[2] = {0, 0};
    for (size_t m = 0; m < scene.materials.size(); ++m) {
        if (scene.materials[m].name == "glow") number[0] = static_cast<Index>(m);
        if (scene.materials[m].name == "black") number[1] = static_cast<Index>(m);
    }
    for (const Mesh& mesh : glowing)
        scene.nodes[0].meshes.push_back({std::make_shared<Mesh>(mesh), number[0]});
    for (const Mesh& mesh : black)
        scene.nodes[0].meshes.push_back({std::make_shared<Mesh>(mesh), number[1]});
    RenderSettings settings;
    settings.samples = samples;
    return imageOf(scene, settings);
}

}  // namespace spectrad::test
