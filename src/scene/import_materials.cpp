#include "scene/import_assimp.h"
#include "scene/import_gltf.h"
#include "spectrum/lift.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

std::optional<std::array<double, 3>> colour(const aiMaterial& from, const char* key, unsigned type,
                                            unsigned index) {
    aiColor4D c;
    if (aiGetMaterialColor(&from, key, type, index, &c) != aiReturn_SUCCESS) return std::nullopt;
    if (!std::isfinite(c.r) || !std::isfinite(c.g) || !std::isfinite(c.b)) return std::nullopt;
    return std::array<double, 3>{c.r, c.g, c.b};
}

std::optional<double> number(const aiMaterial& from, const char* key, unsigned type, unsigned index) {
    ai_real value = 0;
    if (aiGetMaterialFloat(&from, key, type, index, &value) != aiReturn_SUCCESS || !std::isfinite(value))
        return std::nullopt;
    return value;
}

/// glTF's colours are linear. Those of all other formats are what authors see on a display, so sRGB-encoded.
std::array<double, 3> reflectance(std::array<double, 3> c, const FormatTraits& traits) {
    for (double& v : c) {
        v = std::clamp(v, 0.0, 1.0);
        if (!traits.gltf) v = linearOfSrgb(v);
    }
    return c;
}

/// Emission may exceed 1, where the sRGB curve has no meaning: the part above counts as it stands.
std::array<double, 3> emission(std::array<double, 3> c, const FormatTraits& traits, double strength) {
    for (double& v : c) {
        v = std::max(v, 0.0);
        if (!traits.gltf && v < 1) v = linearOfSrgb(v);
        v = std::min(v * strength, 1e30);
    }
    return c;
}

/// Whether the file's shading model has a mirror-like part at all. Several importers fill in a specular
/// colour that no file stated (COLLADA's lambert, PLY).
bool statesSpecular(const aiMaterial& from) {
    int model = 0;
    if (from.Get(AI_MATKEY_SHADING_MODEL, model) != aiReturn_SUCCESS)
        return number(from, AI_MATKEY_SHININESS).value_or(0) > 0;
    return model == aiShadingMode_Phong || model == aiShadingMode_Blinn ||
           model == aiShadingMode_CookTorrance || model == aiShadingMode_Fresnel ||
           model == aiShadingMode_PBR_BRDF;
}

/// Blinn–Phong exponent n to GGX roughness: the lobes are equally wide for alpha² = 2 / (n + 2) (Walter et
/// al. 2007).
double roughnessOfShininess(double n) {
    return std::pow(2 / (std::max(n, 0.0) + 2), 0.25);
}

void setMetallicRoughness(const aiMaterial& from, ImportedMaterial& to, std::vector<std::string>& remarks) {
    to.roughness = std::clamp(number(from, AI_MATKEY_ROUGHNESS_FACTOR).value_or(1), 0.0, 1.0);
    const double metalness = std::clamp(number(from, AI_MATKEY_METALLIC_FACTOR).value_or(1), 0.0, 1.0);
    if (metalness > 0 && metalness < 1)
        remarks.push_back("material '" + to.name + "': a surface is a metal or none: metallicFactor " +
                          (metalness < 0.5 ? "taken as 0" : "taken as 1"));
    if (metalness >= 0.5)
        to.metal = to.diffuse;
    else
        to.ior = 1.5;  // glTF's own, unless an extension says otherwise
}

/// KHR_materials_pbrSpecularGlossiness: a specular colour at normal incidence over a diffuse one. Where a
/// picture scales it, it says nothing of how strong that is.
void setSpecularGlossiness(const aiMaterial& from, ImportedMaterial& to) {
    to.roughness = 1 - std::clamp(number(from, AI_MATKEY_GLOSSINESS_FACTOR).value_or(1), 0.0, 1.0);
    const auto specular = colour(from, AI_MATKEY_COLOR_SPECULAR).value_or(std::array<double, 3>{1, 1, 1});
    if (isBlack(specular)) return;
    const bool hasPicture = from.GetTextureCount(aiTextureType_SPECULAR) > 0;
    const double most = std::clamp(*std::max_element(specular.begin(), specular.end()), 0.0, 1.0);
    constexpr double ofGlass = 0.2;  // more is a metal's: an index of 2.6
    if (isBlack(to.diffuse) && from.GetTextureCount(aiTextureType_DIFFUSE) == 0 && most > ofGlass) {
        to.metal = specular;
        for (double& v : *to.metal)
            v = std::clamp(v, 0.0, 1.0);
        return;
    }
    const double root = std::sqrt(most);
    to.ior = hasPicture || most > ofGlass ? 1.5 : (1 + root) / (1 - root);
}

/// Strength of the highlight has no physical reading; that there is one is taken as a dielectric coat.
void setCoat(const aiMaterial& from, ImportedMaterial& to) {
    const auto specular = colour(from, AI_MATKEY_COLOR_SPECULAR);
    if (!specular || isBlack(*specular) || !statesSpecular(from)) return;
    to.ior = 1.5;
    if (const auto glossiness = number(from, AI_MATKEY_GLOSSINESS_FACTOR))
        to.roughness = 1 - std::clamp(*glossiness, 0.0, 1.0);
    else
        to.roughness = roughnessOfShininess(number(from, AI_MATKEY_SHININESS).value_or(0));
}

/// The material that Assimp invents for meshes without one (glTF: always the last); it is a plain grey then,
/// like a scene's own default.
bool inventedByAssimp(const aiMaterial& from, bool last, const FormatTraits& traits) {
    if (traits.gltf) return last;
    if (std::string(from.GetName().C_Str()) != AI_DEFAULT_MATERIAL_NAME) return false;
    const auto c = colour(from, AI_MATKEY_COLOR_DIFFUSE);
    return !c || isAssimpsGrey(*c);
}

ImportedMaterial convert(const aiMaterial& from, bool last, const FormatTraits& traits, double strength,
                         std::vector<std::string>& remarks) {
    ImportedMaterial to;
    to.name = oneLine(from.GetName().C_Str());
    if (inventedByAssimp(from, last, traits)) return to;

    const bool specularGlossiness = isSpecularGlossiness(from, traits);
    const auto base = traits.gltf && !specularGlossiness ? colour(from, AI_MATKEY_BASE_COLOR) : std::nullopt;
    const auto diffuse = base ? base : colour(from, AI_MATKEY_COLOR_DIFFUSE);
    if (diffuse) to.diffuse = reflectance(*diffuse, traits);
    const bool metallicRoughness = base && number(from, AI_MATKEY_METALLIC_FACTOR).has_value();
    if (metallicRoughness)
        setMetallicRoughness(from, to, remarks);
    else if (specularGlossiness)
        setSpecularGlossiness(from, to);
    else
        setCoat(from, to);
    const auto ior = number(from, AI_MATKEY_REFRACTI);
    if (to.ior && ior && *ior > 1 && *ior <= 4 && !specularGlossiness) to.ior = *ior;
    if (traits.gltf && ior == 1) to.ior.reset();  // elsewhere 1 is what files say that mean nothing by it

    if (const auto emissive = colour(from, AI_MATKEY_COLOR_EMISSIVE))
        to.emissive = emission(
            *emissive, traits,
            strength * std::clamp(number(from, AI_MATKEY_EMISSIVE_INTENSITY).value_or(1), 0.0, 1e30));
    return to;
}

/// Whether something shows through, in whole or in parts.
bool transparent(const aiMaterial& from) {
    aiString mode;
    if (from.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS)
        return std::string_view(mode.C_Str()) != "OPAQUE";
    return number(from, AI_MATKEY_OPACITY).value_or(1) < 1;
}

}  // namespace

bool isBlack(const std::array<double, 3>& c) {
    return c[0] <= 0 && c[1] <= 0 && c[2] <= 0;
}

bool isSpecularGlossiness(const aiMaterial& from, const FormatTraits& traits) {
    return traits.gltf && number(from, AI_MATKEY_GLOSSINESS_FACTOR).has_value();
}

bool isAssimpsGrey(const std::array<double, 3>& c) {
    return std::all_of(c.begin(), c.end(), [](double v) { return std::abs(v - 0.6) < 1e-6; });
}

void convertMaterials(const aiScene& from, const FormatTraits& traits, const GltfFile* gltf,
                      ImportedScene& to) {
    MaterialPictures pictures(from, traits, to);
    size_t seenThrough = 0;
    for (unsigned i = 0; i < from.mNumMaterials; ++i) {
        const aiMaterial& source = *from.mMaterials[i];
        to.materials.push_back(convert(source, i + 1 == from.mNumMaterials, traits,
                                       gltf ? gltf->emissiveStrength(i) : 1, to.remarks));
        pictures.add(source, to.materials.back().diffuse, to.materials.back());
        if (transparent(source)) ++seenThrough;
    }
    if (to.materials.empty()) to.materials.emplace_back();
    pictures.remark();
    if (seenThrough > 0)
        to.remarks.push_back("opacity ignored in " + std::to_string(seenThrough) + " materials");
}

}  // namespace spectrad
