// Lights and cameras of imported models.
#include "scene/import_assimp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

Vec3 toVec3(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}
bool finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Where n lights or cameras share a name (a library node shown n times), the k-th goes with the k-th node;
/// one that no node claims stands at the root.
class NodeOfName {
  public:
    explicit NodeOfName(const NodeNames& names) : nodes_(names.byName) {}
    std::uint32_t next(const std::string& name) {
        const auto found = nodes_.find(name);
        if (found == nodes_.end()) return 0;
        const size_t k = used_[name]++;
        return found->second[std::min(k, found->second.size() - 1)];
    }

  private:
    const std::unordered_map<std::string, std::vector<std::uint32_t>>& nodes_;
    std::unordered_map<std::string, size_t> used_;
};

/// COLLADA's common profile has one angle, across the cone, and an exponent e. Assimp adds an outer angle of
/// acos(0.1^(1/e)) to it, with e = 1 where the file says 0, the standard's default for a sharp edge: more
/// than 80° for all e up to 1.3. No cone fades that slowly, whereas penumbras that a file states are
/// narrower.
bool inventedPenumbra(const aiLight& from, const FormatTraits& traits) {
    return traits.collada && degrees * (from.mAngleOuterCone - from.mAngleInnerCone) > 80;
}

void setCone(const aiLight& from, const FormatTraits& traits, ImportedLight& to) {
    const double across = traits.halfCones ? 2 : 1;
    double inner = across * degrees * from.mAngleInnerCone;
    double outer = across * degrees * from.mAngleOuterCone;
    if (inventedPenumbra(from, traits)) outer = inner;
    if (!(outer > 0)) outer = inner;
    if (!(outer > 0)) return;  // the default cone
    to.angleDegrees = std::min(outer, across * 180);
    to.blend = std::isfinite(inner) ? std::clamp(1 - inner / outer, 0.0, 1.0) : 0;
}

std::optional<ImportedLight::Type> typeOf(const aiLight& from) {
    switch (from.mType) {
        case aiLightSource_POINT:
        case aiLightSource_AREA:
            return ImportedLight::Type::point;
        case aiLightSource_SPOT:
            return ImportedLight::Type::spot;
        case aiLightSource_DIRECTIONAL:
            return ImportedLight::Type::directional;
        case aiLightSource_AMBIENT:
            return ImportedLight::Type::ambient;
        default:
            return std::nullopt;
    }
}

/// Without a stated aspect the picture will be 16:9, and shows as much from left to right as the file wants.
constexpr double usualAspect = 16.0 / 9;

/// Full vertical angle in degrees. Assimp's horizontal angle is the full one in practice, whatever its header
/// says; for glTF it is the file's vertical angle times the aspect.
double verticalFov(const aiCamera& from, const FormatTraits& traits) {
    const double across = from.mHorizontalFOV;
    if (traits.gltf) return degrees * across / (from.mAspect > 0 ? from.mAspect : 1);
    return degrees * 2 * std::atan(std::tan(across / 2) / (from.mAspect > 0 ? from.mAspect : usualAspect));
}

/// Assimp's default angle of π/4, read as degrees: what it leaves of a COLLADA camera that it did not
/// understand.
bool lostFov(const aiCamera& from, const FormatTraits& traits) {
    return traits.collada && std::abs(degrees * from.mHorizontalFOV - std::numbers::pi / 4) < 1e-4;
}

/// Field of view or height, and aspect. False if the file's cannot be understood.
bool setView(const aiCamera& from, const FormatTraits& traits, const ColladaOptics* optics,
             ImportedCamera& to) {
    const double aspect = optics ? optics->widthByHeight().value_or(0) : from.mAspect;
    if (std::isfinite(aspect) && aspect > 1e-4 && aspect < 1e4) to.aspect = aspect;
    const double otherwise = to.aspect > 0 ? to.aspect : usualAspect;
    if (optics ? optics->orthographic() : from.mOrthographicWidth > 0) {
        const double height = optics ? *optics->height(otherwise) : 2 * from.mOrthographicWidth / otherwise;
        if (!std::isfinite(height)) return false;
        to.orthographicHeight = height;
        return true;
    }
    const double fov = optics ? optics->verticalFov(otherwise).value_or(0) : verticalFov(from, traits);
    if (!(fov > 0 && fov < 180) || (!optics && lostFov(from, traits))) return false;
    to.fovDegrees = fov;
    return true;
}

std::optional<ImportedCamera> convert(const aiCamera& from, const FormatTraits& traits,
                                      const ColladaOptics* optics, std::vector<std::string>& remarks) {
    ImportedCamera to;
    to.name = oneLine(from.mName.C_Str());
    // A glTF camera stands at its node's origin; Assimp repeats the node's translation here.
    const Vec3 position = traits.gltf ? Vec3{} : toVec3(from.mPosition);
    const Vec3 look = toVec3(from.mLookAt), up = toVec3(from.mUp);
    if (!finite(position) || !finite(look) || !finite(up) || length(look) == 0) {
        remarks.push_back("camera '" + to.name + "' looks nowhere: left out");
        return std::nullopt;
    }
    to.toNode = Affine::translation(position) * Affine::lookAt({}, look, length(up) > 0 ? up : Vec3{0, 1, 0});
    if (!setView(from, traits, optics, to))
        remarks.push_back("camera '" + to.name + "': its field of view cannot be read, 40 degrees taken");
    return to;
}

template <typename T>
std::vector<Carried<T>> byName(T* const* list, unsigned count, const NodeNames& names) {
    NodeOfName node(names);
    std::vector<Carried<T>> carried;
    for (unsigned i = 0; i < count; ++i)
        carried.push_back({*list[i], node.next(list[i]->mName.C_Str())});
    return carried;
}

}  // namespace

std::vector<Carried<aiLight>> lightsByName(const aiScene& from, const NodeNames& names) {
    return byName(from.mLights, from.mNumLights, names);
}

std::vector<Carried<aiCamera>> camerasByName(const aiScene& from, const NodeNames& names) {
    return byName(from.mCameras, from.mNumCameras, names);
}

void convertLights(const std::vector<Carried<aiLight>>& from, const FormatTraits& traits, ImportedScene& to) {
    for (const auto& [source, place] : from) {
        ImportedLight light;
        light.name = oneLine(source.mName.C_Str());
        const auto type = typeOf(source);
        if (!type) {
            to.remarks.push_back("light '" + light.name + "' is of no known type: left out");
            continue;
        }
        if (source.mType == aiLightSource_AREA)
            to.remarks.push_back("area light '" + light.name + "' taken as a point");
        light.type = *type;
        const aiColor3D& c =
            *type == ImportedLight::Type::ambient ? source.mColorAmbient : source.mColorDiffuse;
        light.colour = {c.r, c.g, c.b};
        bool bright = false, usable = true;
        for (double& v : light.colour) {
            usable = usable && std::isfinite(v) && v < 1e30;
            v = std::max(v, 0.0);
            bright = bright || v > 0;
        }
        const bool placed = *type == ImportedLight::Type::point || *type == ImportedLight::Type::spot;
        const bool directed = *type == ImportedLight::Type::spot || *type == ImportedLight::Type::directional;
        if (placed) light.position = toVec3(source.mPosition);
        if (directed && length(toVec3(source.mDirection)) > 0)
            light.direction = normalized(toVec3(source.mDirection));
        if (!usable || !bright || !finite(light.position) || !finite(light.direction)) {
            to.remarks.push_back("light '" + light.name + "' gives no light: left out");
            continue;
        }
        if (*type == ImportedLight::Type::spot) setCone(source, traits, light);
        to.nodes[place].lights.push_back(static_cast<std::uint32_t>(to.lights.size()));
        to.lights.push_back(std::move(light));
    }
}

void convertCameras(const std::vector<Carried<aiCamera>>& from, const FormatTraits& traits,
                    const NodeNames& names, const OpticsOfNode& optics, ImportedScene& to) {
    for (const auto& [source, place] : from) {
        const auto own = optics.find(names.id[place]);
        auto camera = convert(source, traits, own == optics.end() ? nullptr : &own->second, to.remarks);
        if (!camera) continue;
        to.nodes[place].cameras.push_back(static_cast<std::uint32_t>(to.cameras.size()));
        to.cameras.push_back(std::move(*camera));
    }
}

}  // namespace spectrad
