#include "render/render_graph.h"

#include "base/text.h"
#include "scene/pass_needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace spectrad {

namespace {

/// What the settings of the whole render leave to a pass that is not their target.
RenderSettings settingsOf(const Pass& pass, const RenderSettings& whole) {
    RenderSettings settings;
    if (!pass.wavelengths) {
        settings.wavelengths = whole.wavelengths;
        settings.projection = whole.projection;
    }
    if (!pass.samples) settings.samples = whole.samples;
    settings.stripBytes = whole.stripBytes;
    return settings;
}

void checkBands(const GraphNode& user, const GraphNode& made, const TextureUse& use, Notes& notes) {
    const std::vector<double>&want = user.grid.nm, &have = made.grid.nm;
    if (want == have || (have.front() <= want.front() && want.back() <= have.back())) return;
    const std::string ranges =
        fmt::format("pass '{}' has bands from {} to {} nm, but {} is rendered from {} to {} nm",
                    use.passName(), shortest(have.front()), shortest(have.back()),
                    user.shot.pass ? "pass '" + user.shot.pass->name + "', which shows it," : "the scene",
                    shortest(want.front()), shortest(want.back()));
    if (use.role == TextureRole::radiance)
        throw InputError(use.where, ranges + " (wavelengths= of the pass sets them)");
    notes.warn(use.where, ranges + ": its end values are held");
}

/// A planar mirror's image belongs to one picture, pixel by pixel.
void checkMirror(const GraphNode& user, const GraphNode& made, const TextureUse& use) {
    if (!made.shot.pass->mirror || use.mapping != TextureMapping::picture) return;
    if (user.shot.camera != made.shot.camera || user.shot.scene != made.shot.scene)
        throw InputError(use.where,
                         fmt::format("pass '{}' shows a mirror to another camera than the picture's "
                                     "(camera=)",
                                     made.shot.pass->name));
    const auto [width, height] = sizeOf(user.shot, user.settings);
    const auto [mirrorWidth, mirrorHeight] = sizeOf(made.shot, made.settings);
    if (std::int64_t{width} * mirrorHeight != std::int64_t{mirrorWidth} * height)
        throw InputError(
            use.where, fmt::format("pass '{}' shows a mirror in {}x{} pixels, the picture has {}x{}: another "
                                   "shape (size=)",
                                   made.shot.pass->name, mirrorWidth, mirrorHeight, width, height));
}

/// What the surfaces of a node wear, and what lights them.
std::vector<PassNeed> neededToBake(const Scene& scene, const Bake& bake) {
    Pass alone;
    for (size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].name == bake.node) alone.of = static_cast<Index>(i);
    alone.lights.emplace();
    for (size_t i = 0; i < scene.lights.size(); ++i)
        alone.lights->push_back(static_cast<Index>(i));
    return passesNeeded(scene, &alone, true);
}

using Key = std::pair<const Pass*, int>;  ///< and its generation

int lastGeneration(const Pass& pass) {
    return std::max(pass.repeat, 1) - 1;
}

}  // namespace

std::vector<GraphNode> renderGraph(const Scene& scene, const RenderSettings& settings, Notes& notes) {
    struct Frame {
        GraphNode node;
        std::vector<PassNeed> uses;
        size_t next = 0;
    };
    const auto frameOf = [](const Shot& shot, int generation, const RenderSettings& with) {
        Frame frame;
        frame.node.shot = shot;
        frame.node.generation = generation;
        frame.node.settings = with;
        frame.node.grid = gridOf(shot, with);
        frame.uses = with.bake ? neededToBake(*shot.scene, *with.bake) : passesNeeded(*shot.scene, shot.pass);
        return frame;
    };
    std::vector<GraphNode> order;
    std::map<Key, size_t> made;
    const Shot target = chooseShot(scene, settings);
    // Depth first, on a stack of our own. That passes never need each other was checked when they were read.
    std::vector<Frame> open;
    open.push_back(frameOf(target, target.pass ? lastGeneration(*target.pass) : 0, settings));
    while (!open.empty()) {
        Frame& frame = open.back();
        if (frame.next < frame.uses.size()) {
            const PassNeed& need = frame.uses[frame.next];
            const Shot& user = frame.node.shot;
            const bool itself = user.number && *user.number == need.pass;
            if (itself && frame.node.generation == 0) {
                frame.node.needs.push_back({need.pass, std::nullopt});
                ++frame.next;
                continue;
            }
            const Pass& pass = itself ? *user.pass : user.scene->passes[need.pass];
            const int generation = itself ? frame.node.generation - 1 : lastGeneration(pass);
            const auto found = made.find({&pass, generation});
            if (found == made.end()) {
                // Each generation is rendered as the last one is.
                const RenderSettings with = itself ? frame.node.settings : settingsOf(pass, settings);
                const Shot shot = itself ? user : shotOf(*user.scene, pass);
                open.push_back(frameOf(shot, generation, with));
                continue;
            }
            checkMirror(frame.node, order[found->second], *need.use);
            checkBands(frame.node, order[found->second], *need.use, notes);
            frame.node.needs.push_back({need.pass, found->second});
            ++order[found->second].users;
            ++frame.next;
            continue;
        }
        made[{frame.node.shot.pass, frame.node.generation}] = order.size();
        order.push_back(std::move(frame.node));
        open.pop_back();
    }
    return order;
}

}  // namespace spectrad
