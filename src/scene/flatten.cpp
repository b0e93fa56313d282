#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

/// A node after all that it stands in, the root first.
std::vector<Index> pathTo(const Scene& scene, Index node) {
    static constexpr Index none = ~Index{0};
    std::vector<Index> parent(scene.nodes.size(), none);
    for (Index i = 0; i < scene.nodes.size(); ++i)
        for (const Index child : scene.nodes[i].children)
            parent[child] = i;
    std::vector<Index> path;
    for (Index at = node; at != none; at = parent[at])
        path.push_back(at);
    std::reverse(path.begin(), path.end());
    return path;
}

/// From the root on, as a scene is flattened: the same bits.
Affine placeAlong(const Scene& scene, const std::vector<Index>& path) {
    Affine result = scene.nodes[path.front()].local;
    for (size_t i = 1; i < path.size(); ++i)
        result = result * scene.nodes[path[i]].local;
    return result;
}

}  // namespace

Affine placeOf(const Scene& scene, Index node) {
    return placeAlong(scene, pathTo(scene, node));
}

namespace {

void checkTransform(const Node& node, const Affine& toWorld) {
    const double volume = toWorld.determinant();
    if (!toWorld.finite() || !std::isfinite(volume) || volume == 0)
        throw InputError(
            node.where,
            "this node's place in the world is beyond the range of numbers (its ancestors' transforms "
            "multiply to something too large or too small)");
}

}  // namespace

FlatScene flatten(const Scene& scene, std::optional<Index> root) {
    struct Visit {
        Index node;
        Affine toWorld;
        bool throwsShadows;
    };
    FlatScene flat;
    const std::vector<Index> path = pathTo(scene, root.value_or(0));
    const bool throwsShadows =
        std::all_of(path.begin(), path.end(), [&](Index node) { return scene.nodes[node].throwsShadows; });
    std::vector<Visit> waiting{{path.back(), placeAlong(scene, path), throwsShadows}};
    while (!waiting.empty()) {
        const Visit visit = waiting.back();
        waiting.pop_back();
        const Node& node = scene.nodes[visit.node];
        checkTransform(node, visit.toWorld);
        const bool casts = visit.throwsShadows && node.throwsShadows;
        if (!node.shapes.empty() || !node.meshes.empty())
            flat.objects.push_back({&node, visit.toWorld, casts});
        for (const Index light : node.lights)
            flat.lights.push_back({light, visit.toWorld});
        for (const Index camera : node.cameras)
            flat.cameras.push_back({camera, visit.toWorld});
        // An instance shows the other node's content under its own transform, not under that node's.
        if (node.instanceOf) waiting.push_back({*node.instanceOf, visit.toWorld, casts});
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            waiting.push_back({*child, visit.toWorld * scene.nodes[*child].local, casts});
    }
    // A node keeps its lights apart from its children; their indices still tell the order in which they were
    // written.
    const auto byIndex = [](const Placed& a, const Placed& b) { return a.index < b.index; };
    std::stable_sort(flat.lights.begin(), flat.lights.end(), byIndex);
    std::stable_sort(flat.cameras.begin(), flat.cameras.end(), byIndex);
    return flat;
}

FlatScene flatten(const Scene& scene, const Pass& pass) {
    FlatScene flat = flatten(scene, pass.of);
    if (!pass.lights) return flat;
    if (pass.of) flat.lights = flatten(scene).lights;
    std::erase_if(flat.lights, [&](const Placed& light) {
        return std::find(pass.lights->begin(), pass.lights->end(), light.index) == pass.lights->end();
    });
    return flat;
}

}  // namespace spectrad
