// The render graph: which passes a render needs, in an order in which each has what it shows. Made and
// checked before anything renders.
#pragma once

#include "render/plan.h"

#include <optional>
#include <vector>

namespace spectrad {

struct GraphNode {
    Shot shot;
    int generation = 0;       ///< of a pass that repeats, from 0
    RenderSettings settings;  ///< it is rendered with
    Wavelengths grid;
    /// A pass of the shown scene, and the node that renders it; none where a first generation sees itself,
    /// which is black.
    struct Need {
        Index pass;
        std::optional<size_t> node;
    };
    std::vector<Need> needs;
    size_t users = 0;  ///< nodes that need this one
};

/// The last node is what the settings ask for; every other is needed by a later one. Wavelengths of the
/// settings are for all passes that do not state their own. Throws InputError for radiances that are needed
/// at wavelengths where a pass has none; reflectances held beyond theirs are noted.
[[nodiscard]] std::vector<GraphNode> renderGraph(const Scene& scene, const RenderSettings& settings,
                                                 Notes& notes);

}  // namespace spectrad
