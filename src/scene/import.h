// Foreign models through Assimp: meshes, node hierarchy, cameras, lights, materials, in plain form. The
// import runs in a child process, so that a file that crashes or hangs Assimp costs one error line.
#pragma once

#include "base/error.h"
#include "scene/mesh.h"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

/// A picture that a material names, and how it lies on the surface's coordinates, whose (0,0) is the lower
/// left corner: they are scaled, then turned, then moved.
struct ImportedPicture {
    std::string name;                       ///< a file, as the model writes it
    std::optional<std::uint32_t> embedded;  ///< instead: index into ImportedScene::pictures
    bool repeat = true;                     ///< beyond 0…1; else the border goes on
    bool nearest = false;
    bool isPlainSrgb =
        false;  ///< whatever the picture's file says of its colours, as glTF 2.0 has it (3.8.3)
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    double rotateDegrees = 0;       ///< from u to v
    double amount = 1;              ///< of a normal map: its strength
    std::uint32_t coordinates = 0;  ///< which of the mesh's sets; Mesh::uv is that of the colours
};
struct ImportedMaterial {
    std::string name;
    std::array<double, 3> diffuse{0.5, 0.5, 0.5};  ///< linear sRGB reflectance, 0…1
    std::optional<ImportedPicture> colours;        ///< instead: sRGB colours …
    std::array<double, 3> tint{1, 1, 1};           ///< … whose linear components are multiplied by this
    std::optional<ImportedPicture> normals;        ///< a normal map as in glTF
    std::optional<std::array<double, 3>> metal;    ///< reflectance at normal incidence; takes diffuse's place
    std::array<double, 3> emissive{0, 0, 0};       ///< linear sRGB, ≥ 0
    std::optional<double> ior;                     ///< a coat, where the file states a specular part
    double roughness = 0.5;                        ///< of that coat or metal, 0…1; GGX alpha = roughness²
};
struct ImportedLight {
    std::string name;
    enum class Type { point, spot, directional, ambient } type = Type::point;
    Vec3 position, direction{0, 0, -1};     ///< in its node's space
    std::array<double, 3> colour{1, 1, 1};  ///< linear sRGB as the file scales it
    double angleDegrees = 45;               ///< spot: full cone
    double blend = 0;
};
struct ImportedCamera {
    std::string name;
    Affine toNode;                  ///< camera space (looks down −z) to its node's space
    double fovDegrees = 40;         ///< vertical
    double aspect = 0;              ///< width / height; 0 if not stated
    double orthographicHeight = 0;  ///< > 0: orthographic
};
struct ImportedNode {
    std::string name;
    Affine local;
    std::vector<std::uint32_t> children;  ///< indices into ImportedScene::nodes
    std::vector<std::uint32_t> meshes;
    std::vector<std::uint32_t> lights, cameras;
};
struct ImportedScene {
    std::vector<std::shared_ptr<const Mesh>>
        meshes;  ///< triangles only, positions finite, normals of the file if it has any
    std::vector<std::uint32_t> meshMaterial;  ///< one per mesh
    std::vector<ImportedMaterial> materials;
    std::vector<std::string> pictures;  ///< files inside the model's own, byte by byte
    std::vector<ImportedLight> lights;
    std::vector<ImportedCamera> cameras;
    std::vector<ImportedNode> nodes;  ///< [0] is the root; parents before children
    bool inMetres =
        false;  ///< the format states its unit (glTF, COLLADA, FBX): the root's transform leads to metres
    bool photometric = false;          ///< colours of lights are in cd or lx, emission is in cd/m² (glTF)
    std::vector<std::string> remarks;  ///< what was dropped (points, lines, triangles with NaN …)
    std::vector<std::string>
        filesRead;  ///< the model and what it refers to (.mtl, .bin), in order of reading
};

/// Throws InputError in one line for whatever Assimp refuses, and for a child that crashed, hung
/// (`timeoutSeconds`) or ran out of memory. `restricted`: Assimp may open only files below the model's own
/// folder.
[[nodiscard]] ImportedScene importModel(const std::filesystem::path& path, bool restricted,
                                        double timeoutSeconds = 60);

}  // namespace spectrad
