// A light of the colour of a pass: its mean over all pixels.
#pragma once

#include "render/texture.h"
#include "scene/scene.h"

namespace spectrad {

/// The emitter as it is where it names no texture.
[[nodiscard]] Emitter withMeanColour(const Emitter& emitter, TextureLoader& textures);

}  // namespace spectrad
