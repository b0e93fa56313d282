#include "render/node_cover.h"

#include <algorithm>
#include <map>
#include <set>

namespace spectrad {

namespace {

using Tags = std::set<size_t>;  // numbers of the nodes that a surface belongs to

/// Radiance 1 at the nodes of the tags, 0 at all other whole wavelengths.
Material glowing(const Tags& tags) {
    std::vector<double> nm, value;
    for (const size_t tag : tags)
        for (const double step : {0.0, 1.0, 2.0}) {
            const double at = static_cast<double>(tag) + step;
            const double height = step == 1 ? 1 : 0;
            if (!nm.empty() && nm.back() >= at) {  // a neighbour's foot
                if (nm.back() == at) value.back() = std::max(value.back(), height);
                continue;
            }
            nm.push_back(at);
            value.push_back(height);
        }
    Spectrum spectrum;
    spectrum.text = "cover";
    spectrum.quantity = Quantity::radiance;
    spectrum.curves = {Curve::table(std::move(nm), std::move(value))};
    Material material;
    material.name = "cover";
    material.emission = Emitter{std::move(spectrum), std::nullopt, 1, {}};
    return material;
}

class Cover {
  public:
    Cover(const Scene& scene, std::span<const Index> nodes) : scene_(scene), nodes_(nodes) {
        scene_.materials.assign(1, {});
        Diffuse black;
        black.reflectance.emplace();
        black.reflectance->text = "black";
        black.reflectance->quantity = Quantity::reflectance;
        black.reflectance->curves = {Curve::constant(0)};
        scene_.materials[0].name = "black";
        scene_.materials[0].diffuse = std::move(black);
        scene_.lights.clear();
        scene_.background.reset();
        for (Pass& pass : scene_.passes)
            pass.lights.reset();
        for (Node& node : scene_.nodes) {
            node.lights.clear();
            wear(node, 0);
        }
        black_ = scene_.nodes;
    }

    Scene scene() {
        // The nodes keep their places, so that passes still find them; instances of them go on showing what
        // stood there, black.
        std::map<Index, Index> unmarked;
        for (const Index node : nodes_)
            if (!unmarked.contains(node)) {
                unmarked[node] = static_cast<Index>(scene_.nodes.size());
                scene_.nodes.push_back(black_[node]);
            }
        for (Node& node : scene_.nodes)
            if (node.instanceOf && unmarked.contains(*node.instanceOf))
                node.instanceOf = unmarked.at(*node.instanceOf);
        for (const auto& [node, old] : unmarked)
            scene_.nodes[node] = scene_.nodes[marked(node)];
        return std::move(scene_);
    }

  private:
    static void wear(Node& node, Index material) {
        for (ShapeUse& shape : node.shapes)
            shape.material = material;
        for (MeshUse& mesh : node.meshes)
            mesh.material = material;
    }

    Index materialOf(const Tags& tags) {
        const auto [known, isNew] = materials_.try_emplace(tags, static_cast<Index>(scene_.materials.size()));
        if (isNew) scene_.materials.push_back(glowing(tags));
        return known->second;
    }

    /// Copies of a node and of all that it shows, marked with the numbers of the nodes on the way down;
    /// without recursion. Nodes met inside an instance are not themselves.
    Index marked(Index root) {
        struct Work {
            Index to;
            Tags tags;
            bool inInstance;
        };
        std::vector<Work> waiting;
        const auto copyOf = [&](Index from, Tags tags, bool inInstance) {
            const auto to = static_cast<Index>(scene_.nodes.size());
            for (size_t i = 0; i < nodes_.size() && !inInstance; ++i)
                if (nodes_[i] == from) tags.insert(i);
            scene_.nodes.push_back(black_[from]);
            waiting.push_back({to, std::move(tags), inInstance});
            return to;
        };
        const Index first = copyOf(root, {}, false);
        while (!waiting.empty()) {
            const Work work = std::move(waiting.back());
            waiting.pop_back();
            Node node = scene_.nodes[work.to];
            wear(node, materialOf(work.tags));
            for (Index& child : node.children)
                child = copyOf(child, work.tags, work.inInstance);
            if (node.instanceOf) node.instanceOf = copyOf(*node.instanceOf, work.tags, true);
            scene_.nodes[work.to] = std::move(node);
        }
        return first;
    }

    Scene scene_;
    std::vector<Node> black_;  ///< as they were written, without lights
    std::span<const Index> nodes_;
    std::map<Tags, Index> materials_;
};

}  // namespace

Scene coverScene(const Scene& scene, std::span<const Index> nodes) {
    return Cover(scene, nodes).scene();
}

Wavelengths coverWavelengths(size_t nodes) {
    Wavelengths wavelengths;
    wavelengths.projection = Projection::point;
    for (size_t i = 0; i < nodes; ++i)
        wavelengths.nm.push_back(static_cast<double>(i + 1));
    return wavelengths;
}

}  // namespace spectrad
