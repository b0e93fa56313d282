#include "scene/import_gltf.h"

#include "base/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string_view>

namespace spectrad {

namespace {

using Json = nlohmann::json;

// ---- JSON that may be anything
// ---------------------------------------------------------------------------------------------------

const Json& member(const Json& object, const char* key) {
    static const Json nothing;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? *found : nothing;
}

std::optional<std::uint32_t> indexIn(const Json& object, const char* key, size_t size) {
    const Json& value = member(object, key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= size) return std::nullopt;
    return value.get<std::uint32_t>();
}

std::vector<std::uint32_t> indicesIn(const Json& object, const char* key, size_t size) {
    std::vector<std::uint32_t> list;
    for (const Json& value : member(object, key))
        if (value.is_number_unsigned() && value.get<std::uint64_t>() < size)
            list.push_back(value.get<std::uint32_t>());
    return list;
}

double number(const Json& object, const char* key, double otherwise) {
    const Json& value = member(object, key);
    return value.is_number() ? value.get<double>() : otherwise;
}

std::string text(const Json& value) {
    return value.is_string() ? value.get<std::string>() : std::string();
}

/// The JSON of a .gltf or, the first chunk, of a .glb.
Json jsonOf(const std::filesystem::path& path) {
    constexpr std::streamsize header = 20;
    std::string start(header, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(start.data(), header);
    if (file.gcount() < header || start.compare(0, 4, "glTF") != 0) return Json::parse(readFile(path));
    std::uint32_t length = 0;
    std::memcpy(&length, start.data() + 12, sizeof length);
    std::error_code error;
    if (length > std::filesystem::file_size(path, error) || error) return Json();
    std::string chunk(length, '\0');
    file.read(chunk.data(), length);
    return Json::parse(chunk);
}

// ---- the parts
// ---------------------------------------------------------------------------------------------------

constexpr const char* punctual = "KHR_lights_punctual";

GltfNumbers numbersOf(const Json& document, const Json& attributes, const char* key) {
    const Json& accessors = member(document, "accessors");
    const auto accessor = indexIn(attributes, key, accessors.size());
    GltfNumbers numbers;
    if (!accessor) return numbers;
    numbers.type =
        static_cast<int>(indexIn(accessors[*accessor], "componentType", 65536).value_or(GltfNumbers::int8));
    const Json& normalized = member(accessors[*accessor], "normalized");
    numbers.isNormalized = normalized.is_boolean() && normalized.get<bool>();
    return numbers;
}

std::vector<std::vector<GltfPrimitive>> meshesOf(const Json& document) {
    std::vector<std::vector<GltfPrimitive>> meshes;
    for (const Json& mesh : member(document, "meshes")) {
        std::vector<GltfPrimitive>& primitives = meshes.emplace_back();
        for (const Json& from : member(mesh, "primitives")) {
            GltfPrimitive& to = primitives.emplace_back();
            const Json& attributes = member(from, "attributes");
            to.material = indexIn(from, "material", member(document, "materials").size());
            to.position = numbersOf(document, attributes, "POSITION");
            to.normal = numbersOf(document, attributes, "NORMAL");
            for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set)
                to.coordinates.push_back(
                    numbersOf(document, attributes, ("TEXCOORD_" + std::to_string(set)).c_str()));
        }
    }
    return meshes;
}

std::vector<aiLight> lightsOf(const Json& document) {
    std::vector<aiLight> lights;
    for (const Json& from : member(member(member(document, "extensions"), punctual), "lights")) {
        aiLight& to = lights.emplace_back();
        const std::string type = text(member(from, "type"));
        to.mType = type == "point"         ? aiLightSource_POINT
                   : type == "spot"        ? aiLightSource_SPOT
                   : type == "directional" ? aiLightSource_DIRECTIONAL
                                           : aiLightSource_UNDEFINED;
        to.mDirection = {0, 0, -1};
        const Json& colour = member(from, "color");
        const auto component = [&](size_t i) {
            const bool stated = colour.is_array() && i < colour.size() && colour[i].is_number();
            return static_cast<ai_real>((stated ? colour[i].get<double>() : 1) *
                                        number(from, "intensity", 1));
        };
        to.mColorDiffuse = {component(0), component(1), component(2)};
        const Json& cone = member(from, "spot");
        to.mAngleInnerCone = static_cast<float>(number(cone, "innerConeAngle", 0));
        to.mAngleOuterCone = static_cast<float>(number(cone, "outerConeAngle", std::numbers::pi / 4));
    }
    return lights;
}

/// As Assimp has them: what verticalFov() and setView() undo.
std::vector<aiCamera> camerasOf(const Json& document) {
    std::vector<aiCamera> cameras;
    for (const Json& from : member(document, "cameras")) {
        aiCamera& to = cameras.emplace_back();
        to.mLookAt = {0, 0, -1};
        const Json &perspective = member(from, "perspective"), &orthographic = member(from, "orthographic");
        if (text(member(from, "type")) == "orthographic") {
            const double x = number(orthographic, "xmag", 0), y = number(orthographic, "ymag", 0);
            to.mOrthographicWidth = static_cast<float>(x);
            to.mAspect = static_cast<float>(y != 0 ? x / y : 1);
        } else {
            to.mAspect = static_cast<float>(number(perspective, "aspectRatio", 0));
            to.mHorizontalFOV =
                static_cast<float>(number(perspective, "yfov", 0)) * (to.mAspect > 0 ? to.mAspect : 1);
        }
    }
    return cameras;
}

std::vector<GltfNode> nodesOf(const Json& document) {
    const Json& list = member(document, "nodes");
    const size_t lights = member(member(member(document, "extensions"), punctual), "lights").size();
    std::vector<GltfNode> nodes;
    for (const Json& from : list) {
        GltfNode& to = nodes.emplace_back();
        to.children = indicesIn(from, "children", list.size());
        to.mesh = indexIn(from, "mesh", member(document, "meshes").size());
        to.camera = indexIn(from, "camera", member(document, "cameras").size());
        to.light = indexIn(member(member(from, "extensions"), punctual), "light", lights);
    }
    return nodes;
}

std::vector<std::uint32_t> rootsOf(const Json& document) {
    const Json& scenes = member(document, "scenes");
    const size_t shown = indexIn(document, "scene", scenes.size()).value_or(0);
    return shown < scenes.size() ? indicesIn(scenes[shown], "nodes", member(document, "nodes").size())
                                 : std::vector<std::uint32_t>();
}

// ---- extensions
// ---------------------------------------------------------------------------------------------------

constexpr const char* emissiveStrength = "KHR_materials_emissive_strength";

/// What is obeyed, what is said elsewhere (pictures that cannot be shown), and what shows nothing.
constexpr std::array<std::string_view, 10> answeredFor{punctual,
                                                       emissiveStrength,
                                                       "KHR_texture_transform",
                                                       "KHR_materials_ior",
                                                       "KHR_materials_pbrSpecularGlossiness",
                                                       "KHR_mesh_quantization",
                                                       "KHR_draco_mesh_compression",
                                                       "KHR_texture_basisu",
                                                       "KHR_xmp",
                                                       "KHR_xmp_json_ld"};

/// Extensions that do nothing unless this member is above zero.
constexpr std::array<std::pair<std::string_view, const char*>, 6> idleAtZero{
    {{"KHR_materials_clearcoat", "clearcoatFactor"},
     {"KHR_materials_transmission", "transmissionFactor"},
     {"KHR_materials_sheen", "sheenColorFactor"},
     {"KHR_materials_iridescence", "iridescenceFactor"},
     {"KHR_materials_anisotropy", "anisotropyStrength"},
     {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"}}};

bool isIdle(const std::string& extension, const Json& content) {
    for (const auto& [name, key] : idleAtZero) {
        if (name != extension) continue;
        const Json& factor = member(content, key);
        const auto none = [](const Json& v) { return !v.is_number() || v.get<double>() == 0; };
        return factor.is_array() ? std::all_of(factor.begin(), factor.end(), none) : none(factor);
    }
    return false;
}

bool isAnsweredFor(const std::string& extension) {
    return std::find(answeredFor.begin(), answeredFor.end(), extension) != answeredFor.end();
}

/// A line for each extension of materials, one for all others together.
std::vector<std::string> extensionRemarks(const Json& document) {
    std::map<std::string, std::vector<std::string>> wearers;
    std::set<std::string> idle;
    const Json& materials = member(document, "materials");
    for (size_t i = 0; i < materials.size(); ++i) {
        const Json& extensions = member(materials[i], "extensions");
        if (!extensions.is_object()) continue;
        const std::string name = oneLine(text(member(materials[i], "name")));
        for (const auto& [extension, content] : extensions.items()) {
            if (isAnsweredFor(extension)) continue;
            if (isIdle(extension, content))
                idle.insert(extension);
            else
                wearers[extension].push_back(name.empty() ? "number " + std::to_string(i) : "'" + name + "'");
        }
    }
    std::vector<std::string> remarks;
    for (const auto& [extension, names] : wearers)
        remarks.push_back(oneLine(extension) + " left out of " +
                          (names.size() > 1 ? "materials " : "material ") + firstOf(names));
    std::vector<std::string> others;
    for (const Json& used : member(document, "extensionsUsed")) {
        const std::string extension = text(used);
        if (!extension.empty() && !isAnsweredFor(extension) && !wearers.contains(extension) &&
            !idle.contains(extension))
            others.push_back(oneLine(extension));
    }
    if (!others.empty())
        remarks.push_back(std::string(others.size() > 1 ? "extensions" : "extension") +
                          " left out: " + firstOf(others));
    return remarks;
}

std::vector<double> emissiveStrengthsOf(const Json& document) {
    std::vector<double> strengths;
    for (const Json& material : member(document, "materials"))
        strengths.push_back(std::clamp(
            number(member(member(material, "extensions"), emissiveStrength), "emissiveStrength", 1), 0.0,
            1e30));
    return strengths;
}

// ---- integers
// ---------------------------------------------------------------------------------------------------

template <typename T>
double numberAt(const char* bytes, size_t k, bool isNormalized) {
    T value{};
    std::memcpy(&value, bytes + k * sizeof(T), sizeof(T));
    const auto number = static_cast<double>(value);
    return isNormalized ? std::max(number / std::numeric_limits<T>::max(), -1.0) : number;
}

/// The numbers whose bytes lie where a vector's floats should.
aiVector3D restored(const aiVector3D& from, const GltfNumbers& numbers, size_t components) {
    static_assert(sizeof(aiVector3D) == 12);
    const auto component = [&](size_t k) -> double {
        if (k >= components) return 0;
        const char* const bytes = reinterpret_cast<const char*>(&from);
        switch (numbers.type) {
            case GltfNumbers::int8:
                return numberAt<std::int8_t>(bytes, k, numbers.isNormalized);
            case GltfNumbers::uint8:
                return numberAt<std::uint8_t>(bytes, k, numbers.isNormalized);
            case GltfNumbers::int16:
                return numberAt<std::int16_t>(bytes, k, numbers.isNormalized);
            default:
                return numberAt<std::uint16_t>(bytes, k, numbers.isNormalized);
        }
    };
    return {static_cast<float>(component(0)), static_cast<float>(component(1)),
            static_cast<float>(component(2))};
}

bool isRestorable(const GltfNumbers& numbers) {
    return numbers.type >= GltfNumbers::int8 && numbers.type <= GltfNumbers::uint16;
}

/// Of an integer's bytes in a row, those of the last float are zero; of coordinates, only the first is not,
/// and the second was turned upside down.
void restore(aiVector3D* list, unsigned count, const GltfNumbers& numbers, bool areCoordinates,
             const std::string& what) {
    if (!list || numbers.type == GltfNumbers::float32) return;
    const auto isRaw = [&](const aiVector3D& v) { return v.z == 0 && (!areCoordinates || v.y == 1); };
    if (!isRestorable(numbers) || !std::all_of(list, list + count, isRaw))
        throw InputError(what + " are stored as integers that cannot be read (componentType " +
                         std::to_string(numbers.type) + ")");
    for (aiVector3D* v = list; v != list + count; ++v) {
        *v = restored(*v, numbers, areCoordinates ? 2 : 3);
        if (areCoordinates) v->y = 1 - v->y;
    }
}

template <typename T>
std::vector<Carried<T>> carried(const NodeNames& names,
                                const std::unordered_map<const aiNode*, std::uint32_t>& of,
                                const std::vector<GltfNode>& nodes, const std::vector<T>& all,
                                std::optional<std::uint32_t> GltfNode::*which) {
    std::vector<Carried<T>> list;
    for (size_t i = 0; i < names.node.size(); ++i) {
        const auto own = of.find(names.node[i]);
        if (own == of.end()) continue;
        const auto number = nodes[own->second].*which;
        if (!number) continue;
        list.push_back({all[*number], static_cast<std::uint32_t>(i)});
        list.back().what.mName = names.node[i]->mName;
    }
    return list;
}

}  // namespace

std::optional<GltfFile> GltfFile::read(const std::filesystem::path& path, const aiScene& scene) {
    GltfFile file;
    try {
        const Json document = jsonOf(path);
        file.meshes_ = meshesOf(document);
        file.emissiveStrengths_ = emissiveStrengthsOf(document);
        file.lights_ = lightsOf(document);
        file.cameras_ = camerasOf(document);
        file.nodes_ = nodesOf(document);
        file.roots_ = rootsOf(document);
        file.remarks_ = extensionRemarks(document);
    } catch (const Json::exception&) {
        return std::nullopt;
    }
    if (!file.match(scene)) return std::nullopt;
    return file;
}

/// Assimp makes a node of each of the file's, in its order, and one above them where the scene has several.
bool GltfFile::match(const aiScene& scene) {
    struct Pair {
        const aiNode* node;
        std::uint32_t number;
    };
    std::vector<Pair> open;
    const auto add = [&](const aiNode& parent, const std::vector<std::uint32_t>& numbers) {
        if (parent.mNumChildren != numbers.size()) return false;
        for (unsigned i = 0; i < parent.mNumChildren; ++i)
            open.push_back({parent.mChildren[i], numbers[i]});
        return true;
    };
    if (roots_.size() == 1)
        open.push_back({scene.mRootNode, roots_[0]});
    else if (!add(*scene.mRootNode, roots_))
        return false;
    while (!open.empty()) {
        const auto [node, number] = open.back();
        open.pop_back();
        nodeOf_[node] = number;
        const GltfNode& own = nodes_[number];
        if (!add(*node, own.children)) return false;
        const size_t primitives = own.mesh ? meshes_[*own.mesh].size() : 0;
        if (node->mNumMeshes != primitives) return false;
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            const GltfPrimitive& primitive = meshes_[*own.mesh][i];
            primitiveOf_[node->mMeshes[i]] = primitive;
            if (primitive.material && node->mMeshes[i] < scene.mNumMeshes)
                materialOf_[scene.mMeshes[node->mMeshes[i]]->mMaterialIndex] = *primitive.material;
        }
    }
    return true;
}

void GltfFile::restoreIntegers(aiScene& scene) const {
    for (const auto& [number, primitive] : primitiveOf_) {
        if (number >= scene.mNumMeshes) continue;
        aiMesh& mesh = *scene.mMeshes[number];
        const std::string of = " of mesh '" + oneLine(mesh.mName.C_Str()) + "'";
        restore(mesh.mVertices, mesh.mNumVertices, primitive.position, false, "positions" + of);
        restore(mesh.mNormals, mesh.mNumVertices, primitive.normal, false, "normals" + of);
        for (size_t set = 0; set < primitive.coordinates.size(); ++set)
            restore(mesh.mTextureCoords[set], mesh.mNumVertices, primitive.coordinates[set], true,
                    "texture coordinates" + of);
    }
}

std::vector<Carried<aiLight>> GltfFile::lights(const NodeNames& names) const {
    return carried(names, nodeOf_, nodes_, lights_, &GltfNode::light);
}

std::vector<Carried<aiCamera>> GltfFile::cameras(const NodeNames& names) const {
    return carried(names, nodeOf_, nodes_, cameras_, &GltfNode::camera);
}

double GltfFile::emissiveStrength(std::uint32_t assimpsMaterial) const {
    const auto own = materialOf_.find(assimpsMaterial);
    return own == materialOf_.end() ? 1 : emissiveStrengths_[own->second];
}

}  // namespace spectrad
