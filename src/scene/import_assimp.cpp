#include "scene/import_assimp.h"

#include "base/files.h"
#include "base/text.h"
#include "scene/import_gltf.h"

#include <assimp/ColladaMetaData.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

// ---- files
// -----------------------------------------------------------------------------------------------------------

/// Reads only; keeps a list of what was read; with a folder given, nothing outside it exists (symbolic links
/// resolved).
class WatchedFiles : public Assimp::DefaultIOSystem {
  public:
    WatchedFiles(std::optional<fs::path> folder, std::vector<std::string>& read)
        : folder_(std::move(folder)), read_(read) {}

    bool Exists(const char* file) const override { return allowed(file) && DefaultIOSystem::Exists(file); }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos || !allowed(file))
            return nullptr;
        Assimp::IOStream* stream = DefaultIOSystem::Open(file, "rb");
        if (stream && std::find(read_.begin(), read_.end(), file) == read_.end()) read_.emplace_back(file);
        return stream;
    }

  private:
    [[nodiscard]] bool allowed(const char* file) const {
        if (!isFile(file)) return false;  // a device or a pipe could block
        if (!folder_) return true;
        std::error_code error;
        const fs::path whole = fs::canonical(file, error);
        if (error) return false;
        return std::mismatch(folder_->begin(), folder_->end(), whole.begin(), whole.end()).first ==
               folder_->end();
    }
    std::optional<fs::path> folder_;
    std::vector<std::string>& read_;
};

// ---- meshes
// ----------------------------------------------------------------------------------------------------------

struct Dropped {
    size_t points = 0, lines = 0, broken = 0, colours = 0, skins = 0, morphs = 0;
};

bool finite(const aiVector3D& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Triangles whose corners exist and are finite.
std::vector<std::uint32_t> usableTriangles(const aiMesh& from, Dropped& dropped) {
    std::vector<std::uint32_t> index;
    index.reserve(3 * size_t{from.mNumFaces});
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
        const aiFace& face = from.mFaces[f];
        dropped.points += face.mNumIndices == 1;
        dropped.lines += face.mNumIndices == 2;
        if (face.mNumIndices < 3) continue;
        bool usable = face.mNumIndices == 3;  // Assimp leaves polygons that it cannot cut
        for (unsigned k = 0; k < 3 && usable; ++k)
            usable = face.mIndices[k] < from.mNumVertices && finite(from.mVertices[face.mIndices[k]]);
        if (usable)
            index.insert(index.end(), face.mIndices, face.mIndices + 3);
        else
            ++dropped.broken;
    }
    return index;
}

/// Centre of the box around the vertices that triangles use.
Vec3 centreOf(const aiMesh& from, const std::vector<std::uint32_t>& index) {
    constexpr double far = std::numeric_limits<double>::max();
    Vec3 low{far, far, far}, high{-far, -far, -far};
    for (const std::uint32_t i : index) {
        const aiVector3D& p = from.mVertices[i];
        low = {std::min<double>(low.x, p.x), std::min<double>(low.y, p.y), std::min<double>(low.z, p.z)};
        high = {std::max<double>(high.x, p.x), std::max<double>(high.y, p.y), std::max<double>(high.z, p.z)};
    }
    return (low + high) * 0.5;
}

/// Which of a mesh's sets of texture coordinates its material's pictures lie on.
unsigned coordinatesOf(const ImportedMaterial& material) {
    if (material.colours) return material.colours->coordinates;
    return material.normals ? material.normals->coordinates : 0;
}

/// nullptr if no triangle is left.
std::shared_ptr<const Mesh> convertMesh(const aiMesh& from, const FormatTraits& traits, unsigned coordinates,
                                        Dropped& dropped) {
    auto mesh = std::make_shared<Mesh>();
    mesh->index = usableTriangles(from, dropped);
    if (mesh->index.empty()) return nullptr;
    dropped.colours += from.HasVertexColors(0);
    dropped.skins += from.mNumBones > 0;
    dropped.morphs += from.mNumAnimMeshes > 0;
    mesh->name = oneLine(from.mName.C_Str());
    mesh->origin = centreOf(from, mesh->index);
    mesh->position.resize(from.mNumVertices);
    const bool normals = from.mNormals != nullptr, uvs = from.HasTextureCoords(coordinates);
    if (normals) mesh->normal.resize(from.mNumVertices);
    if (uvs) mesh->uv.resize(from.mNumVertices);
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        const aiVector3D& p = from.mVertices[i];
        if (finite(p))
            mesh->position[i] = {static_cast<float>(p.x - mesh->origin.x),
                                 static_cast<float>(p.y - mesh->origin.y),
                                 static_cast<float>(p.z - mesh->origin.z)};
        // A normal of zero length stands for "none": withNormals() puts the smooth one there.
        if (normals && finite(from.mNormals[i]))
            mesh->normal[i] = {from.mNormals[i].x, from.mNormals[i].y, from.mNormals[i].z};
        if (uvs && finite(from.mTextureCoords[coordinates][i]))
            mesh->uv[i] = {from.mTextureCoords[coordinates][i].x, from.mTextureCoords[coordinates][i].y};
    }
    // Most formats arrive as three vertices a triangle. Assimp's own joining compares with a tolerance that
    // is a length in the file's unit, so it would eat the detail of small models: only what is equal is
    // joined here.
    weldIdentical(*mesh);
    // Meshes without normals are flat: glTF 2.0, 3.7.2.1.
    if (traits.gltf && !normals) return std::make_shared<Mesh>(withNormals(*mesh, Normals::flat));
    return mesh;
}

// ---- nodes
// -----------------------------------------------------------------------------------------------------------

Affine toAffine(const aiMatrix4x4& m, const aiNode& node) {
    const Affine a{{m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4}};
    if (!a.finite())
        throw InputError("the transform of node '" + oneLine(node.mName.C_Str()) + "' is not finite");
    return a;
}

/// Document order, without recursion: files may nest deeper than a stack.
NodeNames convertNodes(const aiScene& from, const std::vector<std::optional<std::uint32_t>>& meshNumber,
                       ImportedScene& to) {
    struct Open {
        const aiNode* node;
        std::optional<std::uint32_t> parent;
    };
    NodeNames names;
    std::vector<Open> open{{from.mRootNode, std::nullopt}};
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        const auto number = static_cast<std::uint32_t>(to.nodes.size());
        if (next.parent) to.nodes[*next.parent].children.push_back(number);
        names.byName[next.node->mName.C_Str()].push_back(number);
        aiString id = next.node->mName;
        if (next.node->mMetaData) next.node->mMetaData->Get(AI_METADATA_COLLADA_ID, id);
        names.id.emplace_back(id.C_Str());
        names.node.push_back(next.node);
        ImportedNode node;
        node.name = oneLine(next.node->mName.C_Str());
        node.local = toAffine(next.node->mTransformation, *next.node);
        for (unsigned i = 0; i < next.node->mNumMeshes; ++i) {
            const unsigned mesh = next.node->mMeshes[i];
            if (mesh < meshNumber.size() && meshNumber[mesh]) node.meshes.push_back(*meshNumber[mesh]);
        }
        to.nodes.push_back(std::move(node));
        for (unsigned i = next.node->mNumChildren; i > 0; --i)
            open.push_back({next.node->mChildren[i - 1], number});
    }
    return names;
}

/// FBX states centimetres per unit and which axis is up; Assimp only passes it on. (COLLADA's unit and axis
/// are in the root's transform already, glTF has but one of each.)
Affine fbxToMetresYUp(const aiScene& from) {
    Affine turn;
    double centimetres = 1;
    if (!from.mMetaData) return Affine::scaling({0.01, 0.01, 0.01});
    float single = 0;
    if (!from.mMetaData->Get("UnitScaleFactor", centimetres) &&
        from.mMetaData->Get("UnitScaleFactor", single))
        centimetres = single;
    if (!(centimetres > 0) || !std::isfinite(centimetres)) centimetres = 1;
    std::int32_t up = 1, sign = 1;
    if (from.mMetaData->Get("UpAxis", up) && from.mMetaData->Get("UpAxisSign", sign) && up == 2 && sign > 0)
        turn = Affine::rotation({1, 0, 0}, -90);
    const double metres = centimetres / 100;
    return Affine::scaling({metres, metres, metres}) * turn;
}

void say(std::vector<std::string>& remarks, size_t count, const std::string& what) {
    if (count > 0) remarks.push_back(std::to_string(count) + " " + what);
}

std::string nothingIn(const ImportedScene& scene) {
    std::string text = "holds no triangles, lights or cameras";
    for (size_t i = 0; i < scene.remarks.size(); ++i)
        text += (i == 0 ? " (" : "; ") + scene.remarks[i];
    return scene.remarks.empty() ? text : text + ")";
}

std::string errorText(const Assimp::Importer& importer) {
    std::string text = oneLine(importer.GetErrorString());
    if (text.find("bad_alloc") != std::string::npos) return "import ran out of memory";
    if (startsWith(text, "No suitable reader found")) return "no importer knows this kind of file";
    while (!text.empty() && text.back() == '.')
        text.pop_back();
    return text.empty() ? "cannot be imported" : text;
}

}  // namespace

std::string oneLine(std::string_view text) {
    constexpr size_t most = 400;
    std::string line;
    for (const char c : text.substr(0, most)) {
        const bool blank = static_cast<unsigned char>(c) <= ' ' || c == 127;
        if (!blank)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (!line.empty() && line.back() == ' ')
        line.pop_back();
    return line;
}

std::string firstOf(const std::vector<std::string>& names) {
    constexpr size_t most = 3;
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), most); ++i)
        text += (i > 0 ? ", " : "") + names[i];
    if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
    return text;
}

FormatTraits traitsOf(const std::string& importerName) {
    FormatTraits traits;
    const auto named = [&](std::string_view word) { return importerName.find(word) != std::string::npos; };
    traits.gltf = named("glTF2");
    traits.collada = named("Collada");
    traits.fbx = named("FBX");
    traits.obj = named("Wavefront Object");
    traits.halfCones = traits.gltf || named("X3D");
    return traits;
}

ImportedScene importWithAssimp(const fs::path& path, bool restricted) {
    ImportedScene scene;
    // Never destroyed: this process ends without it, and Assimp's destructors recurse as deep as the file
    // nests.
    auto& importer = *new Assimp::Importer;
    std::optional<fs::path> folder;
    if (restricted) folder = fs::canonical(path).parent_path();
    importer.SetIOHandler(new WatchedFiles(std::move(folder), scene.filesRead));
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
    // No joining (above), no generated normals (withNormals() makes them), no flattening: the hierarchy and
    // its instances stay.
    const aiScene* read = importer.ReadFile(path.string(), aiProcess_Triangulate);
    if (!read || !read->mRootNode) throw InputError(errorText(importer));
    const aiImporterDesc* format =
        importer.GetImporterInfo(static_cast<size_t>(importer.GetPropertyInteger("importerIndex", 0)));
    const FormatTraits traits = traitsOf(format ? format->mName : "");
    scene.inMetres = traits.gltf || traits.collada || traits.fbx;
    scene.photometric = traits.gltf;

    const std::unique_ptr<aiScene> from(importer.GetOrphanedScene());
    std::optional<GltfFile> gltf;
    if (traits.gltf) gltf = GltfFile::read(path, *from);
    if (gltf) {
        gltf->restoreIntegers(*from);
        scene.remarks = gltf->remarks();
    } else if (traits.gltf) {
        scene.remarks.emplace_back(
            "its JSON cannot be followed: lights and cameras that several nodes share may be lost");
    }

    Dropped dropped;
    convertMaterials(*from, traits, gltf ? &*gltf : nullptr, scene);
    std::vector<std::optional<std::uint32_t>> meshNumber(from->mNumMeshes);
    for (unsigned i = 0; i < from->mNumMeshes; ++i) {
        const aiMesh& source = *from->mMeshes[i];
        const std::uint32_t material =
            source.mMaterialIndex < scene.materials.size() ? source.mMaterialIndex : 0;
        auto mesh = convertMesh(source, traits, coordinatesOf(scene.materials[material]), dropped);
        if (!mesh) continue;
        meshNumber[i] = static_cast<std::uint32_t>(scene.meshes.size());
        scene.meshes.push_back(std::move(mesh));
        scene.meshMaterial.push_back(material);
    }
    const NodeNames names = convertNodes(*from, meshNumber, scene);
    if (traits.fbx) scene.nodes[0].local = fbxToMetresYUp(*from) * scene.nodes[0].local;
    convertLights(gltf ? gltf->lights(names) : lightsByName(*from, names), traits, scene);
    convertCameras(gltf ? gltf->cameras(names) : camerasByName(*from, names), traits, names,
                   traits.collada ? colladaOptics(path) : OpticsOfNode(), scene);
    say(scene.remarks, dropped.points, "points left out");
    say(scene.remarks, dropped.lines, "lines left out");
    say(scene.remarks, dropped.broken, "triangles left out: a corner is missing or not finite");
    if (scene.meshes.empty() && scene.lights.empty() && scene.cameras.empty())
        throw InputError(nothingIn(scene));
    if (scene.meshes.empty()) scene.remarks.push_back("holds no triangles");
    say(scene.remarks, dropped.colours, "meshes have colours at their vertices: ignored");
    say(scene.remarks, dropped.skins,
        "meshes have bones: shown as they are stored, without the pose that the bones give them");
    say(scene.remarks, dropped.morphs, "meshes have morph targets: left out, whatever their weights");
    say(scene.remarks, from->mNumAnimations, "animations ignored");
    return scene;
}

}  // namespace spectrad
