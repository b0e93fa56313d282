// What a glTF file says itself where Assimp (5.2) loses or misreads it: the nodes that carry a lamp or a
// camera (Assimp keeps one node's name of each), vectors stored as integers, extensions of materials.
#pragma once

#include "scene/import_assimp.h"

#include <assimp/scene.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace spectrad {

/// How an accessor's numbers are stored.
struct GltfNumbers {
    static constexpr int int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, float32 = 5126;
    int type = float32;
    bool isNormalized = false;
};
struct GltfPrimitive {
    std::optional<std::uint32_t> material;
    GltfNumbers position, normal;
    std::vector<GltfNumbers> coordinates;  ///< of each set, TEXCOORD_0 first
};
struct GltfNode {
    std::vector<std::uint32_t> children;
    std::optional<std::uint32_t> mesh, light, camera;
};

/// All indices are within their lists.
class GltfFile {
  public:
    /// Nothing if the JSON is none, of another shape than `scene`, or damaged.
    [[nodiscard]] static std::optional<GltfFile> read(const std::filesystem::path& path,
                                                      const aiScene& scene);

    /// Assimp copies the bytes of integers into its floats: makes numbers of them. Throws InputError where
    /// that is not what it did.
    void restoreIntegers(aiScene& scene) const;
    /// In the order of the nodes; an object that several nodes carry is there several times.
    [[nodiscard]] std::vector<Carried<aiLight>> lights(const NodeNames& names) const;
    [[nodiscard]] std::vector<Carried<aiCamera>> cameras(const NodeNames& names) const;
    /// What multiplies a material's emission; 1 if nothing is said.
    [[nodiscard]] double emissiveStrength(std::uint32_t assimpsMaterial) const;
    /// Extensions that change what is seen and that nothing here knows.
    [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

  private:
    [[nodiscard]] bool match(const aiScene& scene);

    std::vector<std::vector<GltfPrimitive>> meshes_;
    std::vector<double> emissiveStrengths_;
    std::vector<aiLight> lights_;
    std::vector<aiCamera> cameras_;
    std::vector<GltfNode> nodes_;
    std::vector<std::uint32_t> roots_;
    std::vector<std::string> remarks_;
    // Assimp's objects as the file's.
    std::unordered_map<const aiNode*, std::uint32_t> nodeOf_;
    std::unordered_map<std::uint32_t, GltfPrimitive> primitiveOf_;
    std::unordered_map<std::uint32_t, std::uint32_t> materialOf_;
};

}  // namespace spectrad
