// Pictures that a model's materials name: colours and normal maps, with how they lie on the surface.
#include "scene/import_assimp.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

constexpr int nearestOfGltf = 9728;  // GL_NEAREST

/// Pictures of other things than colours and normals, by what Assimp calls them.
struct Unused {
    aiTextureType type;
    const char* what;
};
constexpr std::array unusedTypes{
    Unused{aiTextureType_METALNESS, "metalness and roughness"},
    Unused{aiTextureType_DIFFUSE_ROUGHNESS, "metalness and roughness"},
    Unused{aiTextureType_SHININESS, "metalness and roughness"},
    Unused{aiTextureType_SPECULAR, "specular strength"},
    Unused{aiTextureType_EMISSIVE, "emission"},
    Unused{aiTextureType_EMISSION_COLOR, "emission"},
    Unused{aiTextureType_HEIGHT, "heights (they state no depth)"},
    Unused{aiTextureType_DISPLACEMENT, "heights (they state no depth)"},
    Unused{aiTextureType_OPACITY, "opacity"},
    Unused{aiTextureType_AMBIENT_OCCLUSION, "baked light"},
    Unused{aiTextureType_LIGHTMAP, "baked light"},
    Unused{aiTextureType_REFLECTION, "surroundings"},
};

/// glTF states v downwards, and turns about the picture's upper left corner. Assimp turns its own about the
/// picture's middle, and for glTF moves the picture so that it comes to the same: here that is taken back.
void placeLikeGltf(const aiUVTransform& t, ImportedPicture& to) {
    const double angle = -t.mRotation, c = std::cos(angle), s = std::sin(angle);
    const double sx = t.mScaling.x, sy = t.mScaling.y;
    const double offsetU = t.mTranslation.x - 0.5 * sx * (1 - c + s);
    const double offsetV = 0.5 * sy * (s + c - 1) + 1 - sy - t.mTranslation.y;
    // (u, 1 − v) ↦ offset + turn · scale · (u, 1 − v), seen with v upwards: the same angle from u to v.
    to.scale = {sx, sy};
    to.rotateDegrees = angle * 180 / std::numbers::pi;
    to.offset = {offsetU + s * sy, 1 - offsetV - c * sy};
}

/// Scaled, turned about the middle, moved.
void placeLikeAssimp(const aiUVTransform& t, ImportedPicture& to) {
    const double c = std::cos(t.mRotation), s = std::sin(t.mRotation);
    to.scale = {t.mScaling.x, t.mScaling.y};
    to.rotateDegrees = t.mRotation * 180 / std::numbers::pi;
    to.offset = {t.mTranslation.x + 0.5 - 0.5 * (c - s), t.mTranslation.y + 0.5 - 0.5 * (s + c)};
}

bool usable(const ImportedPicture& picture) {
    const auto finite = [](double v) { return std::isfinite(v) && std::abs(v) < 1e6; };
    return finite(picture.offset[0]) && finite(picture.offset[1]) && finite(picture.scale[0]) &&
           finite(picture.scale[1]) && picture.scale[0] != 0 && picture.scale[1] != 0 &&
           finite(picture.rotateDegrees);
}

/// Whether an OBJ's material names its colour.
bool statesColour(const aiMaterial& from) {
    aiColor3D c;
    return from.Get(AI_MATKEY_COLOR_DIFFUSE, c) == aiReturn_SUCCESS && !isAssimpsGrey({c.r, c.g, c.b});
}

}  // namespace

void MaterialPictures::leaveOut(const std::string& what, const std::string& name) {
    auto kind =
        std::find_if(leftOut_.begin(), leftOut_.end(), [&](const auto& k) { return k.first == what; });
    if (kind == leftOut_.end()) kind = leftOut_.insert(kind, {what, {}});
    if (std::find(kind->second.begin(), kind->second.end(), name) == kind->second.end())
        kind->second.push_back(name);
}

std::optional<std::uint32_t> MaterialPictures::embedded(const aiTexture& texture) {
    const size_t number = static_cast<size_t>(
        std::find(from_.mTextures, from_.mTextures + from_.mNumTextures, &texture) - from_.mTextures);
    if (number >= embedded_.size() || !texture.pcData || texture.mWidth == 0) return std::nullopt;
    if (texture.mHeight != 0) return std::nullopt;  // texels, not a file
    if (!embedded_[number]) {
        embedded_[number] = static_cast<std::uint32_t>(to_.pictures.size());
        to_.pictures.emplace_back(reinterpret_cast<const char*>(texture.pcData), texture.mWidth);
    }
    return embedded_[number];
}

std::optional<ImportedPicture> MaterialPictures::read(const aiMaterial& from, aiTextureType type) {
    aiString path;
    if (from.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0) return std::nullopt;
    ImportedPicture to;
    to.name = oneLine(path.C_Str());
    const auto whole = [&](const char* key, unsigned of, unsigned index, int otherwise) {
        int value = otherwise;
        return aiGetMaterialInteger(&from, key, of, index, &value) == aiReturn_SUCCESS ? value : otherwise;
    };
    if (whole(AI_MATKEY_MAPPING(type, 0), aiTextureMapping_UV) != aiTextureMapping_UV) {
        leaveOut("a projection, not of texture coordinates,", to.name);
        return std::nullopt;
    }
    if (const aiTexture* inside = from_.GetEmbeddedTexture(path.C_Str())) {
        to.embedded = embedded(*inside);
        if (!to.embedded) {
            leaveOut("texels that are no picture file", to.name);
            return std::nullopt;
        }
        const std::string own = oneLine(inside->mFilename.C_Str());
        to.name = own.empty() ? "picture " + std::to_string(*to.embedded) : own;
    }
    const int u = whole(AI_MATKEY_MAPPINGMODE_U(type, 0), aiTextureMapMode_Wrap),
              v = whole(AI_MATKEY_MAPPINGMODE_V(type, 0), aiTextureMapMode_Wrap);
    const auto holds = [](int mode) {
        return mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal;
    };
    to.isPlainSrgb = traits_.gltf;
    to.repeat = !(holds(u) && holds(v));
    if (to.repeat && (u != aiTextureMapMode_Wrap || v != aiTextureMapMode_Wrap))
        to_.remarks.push_back("picture '" + to.name +
                              "' is mirrored beyond its border, or repeated along one side "
                              "only: taken as repeated");
    to.nearest = whole(AI_MATKEY_GLTF_MAPPINGFILTER_MAG(type, 0), 0) == nearestOfGltf;
    to.coordinates = static_cast<std::uint32_t>(
        std::clamp(whole(AI_MATKEY_UVWSRC(type, 0), 0), 0, AI_MAX_NUMBER_OF_TEXTURECOORDS - 1));
    aiUVTransform transform;
    if (from.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS) {
        if (traits_.gltf)
            placeLikeGltf(transform, to);
        else
            placeLikeAssimp(transform, to);
    }
    if (!usable(to)) {
        leaveOut("no place (its transform is not finite, or flat)", to.name);
        return std::nullopt;
    }
    return to;
}

void MaterialPictures::add(const aiMaterial& from, const std::array<double, 3>& stated,
                           ImportedMaterial& to) {
    if (!isSpecularGlossiness(from, traits_)) to.colours = read(from, aiTextureType_BASE_COLOR);
    if (!to.colours) to.colours = read(from, aiTextureType_DIFFUSE);
    // glTF and OBJ multiply a picture by the colour beside it; elsewhere it takes the colour's place.
    if (to.colours && (traits_.gltf || (traits_.obj && statesColour(from)))) {
        if (isBlack(stated))
            to_.remarks.push_back("material '" + to.name + "': black times a picture: the picture is taken");
        else
            to.tint = stated;
    }
    // What COLLADA calls bump may be heights.
    if (traits_.collada) {
        aiString path;
        if (from.GetTexture(aiTextureType_NORMALS, 0, &path) == aiReturn_SUCCESS)
            leaveOut("bumps", oneLine(path.C_Str()));
    } else {
        to.normals = read(from, aiTextureType_NORMALS);
    }
    if (to.normals && to.colours && to.normals->coordinates != to.colours->coordinates) {
        leaveOut("normals on other texture coordinates than the colours'", to.normals->name);
        to.normals.reset();
    }
    if (to.normals) {
        ai_real strength = 1;
        if (from.Get(AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0), strength) == aiReturn_SUCCESS &&
            std::isfinite(strength))
            to.normals->amount = std::clamp<double>(strength, 0, 1e6);
    }
    for (const Unused& unused : unusedTypes) {
        aiString path;
        if (from.GetTexture(unused.type, 0, &path) == aiReturn_SUCCESS && path.length > 0)
            leaveOut(unused.what, oneLine(path.C_Str()));
    }
    dropGlow(from, to);
    aiString metallicRoughness;  // Assimp's place for glTF's
    if (traits_.gltf && from.GetTexture(AI_MATKEY_GLTF_PBRMETALLICROUGHNESS_METALLICROUGHNESS_TEXTURE,
                                        &metallicRoughness) == aiReturn_SUCCESS)
        leaveOut("metalness and roughness", oneLine(metallicRoughness.C_Str()));
}

/// A picture says where a surface glows: without it all of it would.
void MaterialPictures::dropGlow(const aiMaterial& from, ImportedMaterial& to) {
    const bool isShaped = from.GetTextureCount(aiTextureType_EMISSIVE) > 0 ||
                          from.GetTextureCount(aiTextureType_EMISSION_COLOR) > 0;
    if (!isShaped || isBlack(to.emissive)) return;
    to.emissive = {0, 0, 0};
    dark_.push_back("'" + to.name + "'");
}

void MaterialPictures::remark() const {
    for (const auto& [what, names] : leftOut_)
        to_.remarks.push_back("pictures of " + what + " ignored: " + firstOf(names));
    if (!dark_.empty())
        to_.remarks.push_back("emission left out where a picture shapes it: material " + firstOf(dark_));
}

}  // namespace spectrad
