// Which passes a pass shows: the edges of the render graph.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace spectrad {

/// All textures that a material looks up.
[[nodiscard]] std::vector<const TextureUse*> texturesOf(const Material& material);
/// What a mirror shows, if the material is one that shows something.
[[nodiscard]] const TextureUse* reflectionOf(const Material& material);

/// The picture behind everything, if there is one; the pass that it is has none behind itself.
[[nodiscard]] const TextureUse* backdropOf(const Scene& scene, const Pass* pass);

/// A pass of the same scene that is seen, and the first place where.
struct PassNeed {
    Index pass;
    const TextureUse* use;
};
/// What must be rendered before this pass of `scene` (null: the whole scene through a camera): each pass that
/// what is shown wears, once; and what is behind it, unless it is to be baked.
[[nodiscard]] std::vector<PassNeed> passesNeeded(const Scene& scene, const Pass* pass, bool baked = false);

/// Throws InputError for passes that need each other, with the chain; a pass may need itself if it repeats,
/// and must if it does.
void checkPasses(const Scene& scene);

}  // namespace spectrad
