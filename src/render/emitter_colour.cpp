#include "render/emitter_colour.h"

#include "render/texels.h"

#include <algorithm>

namespace spectrad {

Emitter withMeanColour(const Emitter& emitter, TextureLoader& textures) {
    if (!emitter.texture) return emitter;
    SpectralTexture texture = textures.load(*emitter.texture);
    texture.fetch();
    std::vector<double> mean = meanOfTexels(texture.texels, texture.nm.size());
    for (double& value : mean)
        value = std::max(0.0, value);
    Emitter light = emitter;
    light.spectrum.curves = {Curve::table(texture.nm, mean)};
    return light;
}

}  // namespace spectrad
