#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

Affine placeOf(const Scene& scene, Index node) {
    static constexpr Index none = ~Index{0};
    std::vector<Index> parent(scene.nodes.size(), none);
    for (Index i = 0; i < scene.nodes.size(); ++i)
        for (const Index child : scene.nodes[i].children)
            parent[child] = i;
    Affine result;
    for (Index at = node; at != none; at = parent[at])
        result = scene.nodes[at].local * result;
    return result;
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
    std::vector<Visit> waiting{{root.value_or(0), placeOf(scene, root.value_or(0)), true}};
    while (!waiting.empty()) {
        const Visit visit = waiting.back();
        waiting.pop_back();
        const Node& node = scene.nodes[visit.node];
        checkTransform(node, visit.toWorld);
        const bool throwsShadows = visit.throwsShadows && node.throwsShadows;
        if (!node.shapes.empty() || !node.meshes.empty())
            flat.objects.push_back({&node, visit.toWorld, throwsShadows});
        for (const Index light : node.lights)
            flat.lights.push_back({light, visit.toWorld});
        for (const Index camera : node.cameras)
            flat.cameras.push_back({camera, visit.toWorld});
        // An instance shows the other node's content under its own transform, not under that node's.
        if (node.instanceOf) waiting.push_back({*node.instanceOf, visit.toWorld, throwsShadows});
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            waiting.push_back({*child, visit.toWorld * scene.nodes[*child].local, throwsShadows});
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
