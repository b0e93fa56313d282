// Instances: none may contain itself, and all together may not show more than fits.
#include "scene/reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace spectrad {

namespace {

enum class State : std::uint8_t { unseen, open, done };

struct Frame {
    Index node;
    size_t next = 0;  ///< children first, then the node that it is an instance of
};

/// The node that `frame` leads to next, or nothing.
std::optional<Index> step(const Scene& scene, Frame& frame) {
    const Node& node = scene.nodes[frame.node];
    const size_t at = frame.next++;
    if (at < node.children.size()) return node.children[at];
    if (at == node.children.size()) return node.instanceOf;
    return std::nullopt;
}

[[noreturn]] void failCycle(const Scene& scene, const std::vector<Frame>& open, Index target) {
    std::vector<std::string> names;
    bool inside = false;
    for (const Frame& frame : open) {
        inside = inside || frame.node == target;
        const std::string& name = scene.nodes[frame.node].name;
        if (inside && !name.empty()) names.push_back(name);
    }
    names.push_back(scene.nodes[target].name);
    throw InputError(scene.nodes[open.back().node].where,
                     fmt::format("instance contains itself: {}", fmt::join(names, " -> ")));
}

}  // namespace

void checkInstances(const Scene& scene) {
    std::vector<State> state(scene.nodes.size(), State::unseen);
    std::vector<double> placements(scene.nodes.size(), 1);
    std::vector<Frame> open{{0}};
    state[0] = State::open;
    while (!open.empty()) {
        Frame& frame = open.back();
        const size_t before = frame.next;
        const auto target = step(scene, frame);
        if (!target) {
            const Node& node = scene.nodes[frame.node];
            if (before <= node.children.size()) continue;  // no instance here: one more step ends the node
            for (const Index child : node.children)
                placements[frame.node] += placements[child];
            if (node.instanceOf) placements[frame.node] += placements[*node.instanceOf];
            if (placements[frame.node] > maxPlacements)
                throw InputError(node.where, fmt::format("instances expand to more than {} nodes (the limit)",
                                                         maxPlacements));
            state[frame.node] = State::done;
            open.pop_back();
        } else if (state[*target] == State::open) {
            failCycle(scene, open, *target);
        } else if (state[*target] == State::unseen) {
            state[*target] = State::open;
            open.push_back({*target});
        }
    }
}

}  // namespace spectrad
