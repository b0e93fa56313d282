// Assimp's scene in our plain form. Runs in the child process of importModel() only: Assimp may crash on what
// it reads.
#pragma once

#include "scene/import.h"
#include "scene/import_collada.h"

#include <assimp/scene.h>

#include <array>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

namespace spectrad {

/// What a format's colours, lengths and angles mean; Assimp hands them on as they stand in the file.
struct FormatTraits {
    bool gltf = false;       ///< linear colours; cd, lx and cd/m²; metres; cones by half their angle
    bool halfCones = false;  ///< a spot's angles are measured from its axis (glTF, X3D), not across the cone
    bool collada = false;
    bool fbx = false;
    bool obj = false;
};
[[nodiscard]] FormatTraits traitsOf(const std::string& importerName);

/// Reads the file and converts all of it. Throws InputError with Assimp's message, in one line and without
/// the file's name.
[[nodiscard]] ImportedScene importWithAssimp(const std::filesystem::path& path, bool restricted);

// ---- the parts (import_materials.cpp, import_placed.cpp)
// ------------------------------------------------------------------

/// "" of a file that has no such text; control characters as blanks, at most a few hundred bytes.
[[nodiscard]] std::string oneLine(std::string_view text);

[[nodiscard]] bool isBlack(const std::array<double, 3>& c);
/// Whether a glTF material is stated by KHR_materials_pbrSpecularGlossiness.
[[nodiscard]] bool isSpecularGlossiness(const aiMaterial& from, const FormatTraits& traits);
/// The colour that Assimp puts where a file states none.
[[nodiscard]] bool isAssimpsGrey(const std::array<double, 3>& c);
/// The first three, and how many more there are.
[[nodiscard]] std::string firstOf(const std::vector<std::string>& names);

class GltfFile;
/// Sets the scene's materials and pictures. `gltf`: what the file says itself, or nullptr.
void convertMaterials(const aiScene& from, const FormatTraits& traits, const GltfFile* gltf,
                      ImportedScene& to);

/// The pictures that a scene's materials name: those that a material here can show become part of it, others
/// are counted by what they are of.
class MaterialPictures {
  public:
    MaterialPictures(const aiScene& from, const FormatTraits& traits, ImportedScene& to)
        : from_(from), traits_(traits), to_(to), embedded_(from.mNumTextures) {}

    /// `stated`: the colour that the file gives beside the picture.
    void add(const aiMaterial& from, const std::array<double, 3>& stated, ImportedMaterial& to);
    /// Says what was left out.
    void remark() const;

  private:
    [[nodiscard]] std::optional<ImportedPicture> read(const aiMaterial& from, aiTextureType type);
    [[nodiscard]] std::optional<std::uint32_t> embedded(const aiTexture& texture);
    void leaveOut(const std::string& what, const std::string& name);
    void dropGlow(const aiMaterial& from, ImportedMaterial& to);

    const aiScene& from_;
    const FormatTraits& traits_;
    ImportedScene& to_;
    std::vector<std::optional<std::uint32_t>> embedded_;  ///< where each of Assimp's went
    std::vector<std::pair<std::string, std::vector<std::string>>> leftOut_;
    std::vector<std::string> dark_;  ///< materials that would glow
};

struct NodeNames {
    std::unordered_map<std::string, std::vector<std::uint32_t>>
        byName;                       ///< all nodes of a name, in document order
    std::vector<std::string> id;      ///< of each node: its COLLADA id, else its name
    std::vector<const aiNode*> node;  ///< Assimp's
};
/// A light or camera and the node that it stands in.
template <typename T>
struct Carried {
    T what;
    std::uint32_t node = 0;
};
/// Assimp ties them to nodes by name alone.
[[nodiscard]] std::vector<Carried<aiLight>> lightsByName(const aiScene& from, const NodeNames& names);
[[nodiscard]] std::vector<Carried<aiCamera>> camerasByName(const aiScene& from, const NodeNames& names);

using OpticsOfNode = std::unordered_map<std::string, ColladaOptics>;
void convertLights(const std::vector<Carried<aiLight>>& from, const FormatTraits& traits, ImportedScene& to);
/// `optics`: what the file itself says, by the node's id; goes before what Assimp says.
void convertCameras(const std::vector<Carried<aiCamera>>& from, const FormatTraits& traits,
                    const NodeNames& names, const OpticsOfNode& optics, ImportedScene& to);

}  // namespace spectrad
