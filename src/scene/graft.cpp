#include "scene/graft.h"

#include "base/limits.h"
#include "base/text.h"
#include "scene/graft_materials.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace spectrad {

namespace {

/// Names of one kind that stay unique: a name that is taken already gets ".2", ".3" …; no name stays none.
class UniqueNames {
  public:
    template <typename Named>
    explicit UniqueNames(const std::vector<Named>& there) {
        for (const Named& item : there)
            next_.try_emplace(item.name, 2);
    }
    std::string unique(const std::string& name) {
        if (name.empty() || next_.try_emplace(name, 2).second) return name;
        while (true) {
            std::string candidate = name + "." + std::to_string(next_[name]++);
            if (next_.try_emplace(candidate, 2).second) return candidate;
        }
    }

  private:
    std::unordered_map<std::string, int> next_;
};

// Files other than glTF state no unit for their lights. One rule for all of them: a white lamp of full
// strength is as bright as a strong lamp, sun or sky is in a studio. As much light falls on a floor below an
// ambient of full strength as from a sun.
constexpr double candelaOfOne = 100;
constexpr double luxOfOne = 1000;
constexpr double luminanceOfOne = luxOfOne / std::numbers::pi;

Amount amountOf(const ImportedLight& light, bool photometric) {
    const double brightness = luminanceShare(light.colour);
    switch (light.type) {
        case ImportedLight::Type::directional:
            return {AmountUnit::lux, brightness * (photometric ? 1 : luxOfOne), std::nullopt};
        case ImportedLight::Type::ambient:
            return {AmountUnit::candelaPerSquareMetre, brightness * (photometric ? 1 : luminanceOfOne),
                    std::nullopt};
        default:
            return {AmountUnit::candela, brightness * (photometric ? 1 : candelaOfOne), std::nullopt};
    }
}

Light lightOf(const ImportedLight& from, bool photometric, const SpectrumResolver& resolver,
              const SourceLocation& where) {
    static constexpr std::array types{LightType::point, LightType::spot, LightType::directional,
                                      LightType::ambient};
    Light light;
    light.type = types[static_cast<size_t>(from.type)];
    light.emitter = {colourOfLamp(from.colour, resolver, where), amountOf(from, photometric), 1, where};
    light.position = from.position;
    light.direction = normalized(from.direction);
    light.angle = from.angleDegrees;
    light.blend = from.blend;
    light.where = where;
    return light;
}

Camera cameraOf(const ImportedCamera& from, const SourceLocation& where) {
    Camera camera;
    camera.orthographic = from.orthographicHeight > 0;
    camera.viewHeight = camera.orthographic ? from.orthographicHeight : 1;
    camera.fovDegrees = from.fovDegrees;
    camera.toNode = from.toNode;
    camera.where = where;
    if (from.aspect > 0)
        camera.width =
            static_cast<int>(std::clamp<double>(std::round(camera.height * from.aspect), 1, largestSide));
    return camera;
}

/// Whether a node stays. One that is scaled to nothing shows nothing, nor does what is below it (modellers
/// hide things so), and its normals would have no direction.
std::vector<bool> shownNodes(const ImportedScene& model, std::vector<std::string>& remarks) {
    std::vector<bool> shown(model.nodes.size(), true);
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        const ImportedNode& node = model.nodes[i];
        if (shown[i] && node.local.determinant() == 0) {
            shown[i] = false;
            remarks.push_back("node '" + node.name + "' is scaled to nothing: left out");
        }
        if (!shown[i])
            for (const std::uint32_t child : node.children)
                shown[child] = false;
    }
    return shown;
}

/// Grafting in progress: what the model's parts became in the scene.
class Graft {
  public:
    Graft(Scene& scene, const ImportedScene& model, const GraftOptions& options,
          const SpectrumResolver& resolver, SourceLocation where)
        : scene_(scene),
          model_(model),
          options_(options),
          resolver_(resolver),
          where_(std::move(where)),
          materials_(scene, model, options, resolver, where_),
          meshes_(model.meshes.size()),
          nodeNames_(scene.nodes),
          lightNames_(scene.lights),
          cameraNames_(scene.cameras) {}

    void below(Index parent, Notes& notes) {
        std::vector<std::string> remarks = model_.remarks;
        const std::vector<bool> shown = shownNodes(model_, remarks);
        std::vector<Index> number(model_.nodes.size());
        for (size_t i = 0; i < model_.nodes.size(); ++i) {
            if (!shown[i]) continue;
            number[i] = static_cast<Index>(scene_.nodes.size());
            scene_.nodes.push_back(content(model_.nodes[i]));
        }
        for (size_t i = 0; i < model_.nodes.size(); ++i) {
            if (!shown[i]) continue;
            for (const std::uint32_t child : model_.nodes[i].children)
                if (shown[child]) scene_.nodes[number[i]].children.push_back(number[child]);
        }
        if (shown[0]) {
            const double metres = model_.inMetres ? 1 : options_.metresPerUnit;
            Node& root = scene_.nodes[number[0]];
            root.local = Affine::scaling({metres, metres, metres}) * root.local;
            scene_.nodes[parent].children.push_back(number[0]);
        }
        for (const std::string& remark : remarks)
            notes.warn(fileLocation(model_), remark);
        materials_.warnOfPictures(notes);
        materials_.warnOfIdleBindings(notes);
    }

    [[nodiscard]] bool lampsOfNoUnit() const { return lampsOfNoUnit_; }

  private:
    Node content(const ImportedNode& from) {
        Node node;
        node.name = nodeNames_.unique(from.name);
        node.where = where_;
        node.local = from.local;
        for (const std::uint32_t m : from.meshes)
            node.meshes.push_back({mesh(m), materials_.of(model_.meshMaterial[m])});
        if (!options_.lightsAndCameras) return node;
        for (const std::uint32_t l : from.lights) {
            node.lights.push_back(static_cast<Index>(scene_.lights.size()));
            scene_.lights.push_back(lightOf(model_.lights[l], model_.photometric, resolver_, where_));
            scene_.lights.back().shadows = scene_.shadows && scene_.lights.back().type != LightType::ambient;
            scene_.lights.back().name = lightNames_.unique(model_.lights[l].name);
            lampsOfNoUnit_ = lampsOfNoUnit_ || !model_.photometric;
        }
        for (const std::uint32_t c : from.cameras) {
            node.cameras.push_back(static_cast<Index>(scene_.cameras.size()));
            scene_.cameras.push_back(cameraOf(model_.cameras[c], where_));
            const std::string& name = model_.cameras[c].name;
            scene_.cameras.back().name = cameraNames_.unique(name.empty() ? "camera" : name);
        }
        return node;
    }

    /// Instances share one mesh.
    std::shared_ptr<const Mesh> mesh(std::uint32_t m) {
        if (!meshes_[m])
            meshes_[m] = std::make_shared<const Mesh>(withNormals(*model_.meshes[m], options_.normals));
        return meshes_[m];
    }

    Scene& scene_;
    const ImportedScene& model_;
    const GraftOptions& options_;
    const SpectrumResolver& resolver_;
    SourceLocation where_;
    GraftedMaterials materials_;
    std::vector<std::shared_ptr<const Mesh>> meshes_;
    UniqueNames nodeNames_, lightNames_, cameraNames_;
    bool lampsOfNoUnit_ = false;
};

}  // namespace

SourceLocation fileLocation(const ImportedScene& model) {
    return {model.filesRead.empty() ? std::string() : model.filesRead.front(), 0, 0};
}

void graft(Scene& scene, Index parent, const ImportedScene& model, const GraftOptions& options,
           const SpectrumResolver& resolver, Notes& notes) {
    SourceLocation where = scene.nodes[parent].where;
    if (where.file.empty()) where = fileLocation(model);
    Graft work(scene, model, options, resolver, std::move(where));
    work.below(parent, notes);
    if (work.lampsOfNoUnit())
        notes.say(fileLocation(model).str() + ": its lights state no unit: colour 1 is taken as " +
                  shortest(candelaOfOne) + " cd (directional " + shortest(luxOfOne) + " lx, ambient " +
                  rounded(luminanceOfOne, 3) + " cd/m2)");
}

}  // namespace spectrad
