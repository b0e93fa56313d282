// Passes: one scene rendered several times, each result a texture of the next, or an image that is not plain
// radiance.
#pragma once

#include "opencl/device.h"
#include "render/plan.h"
#include "render/texture.h"

#include <map>
#include <string>
#include <vector>

namespace spectrad {

/// Textures that passes make, rendered when first asked for. Passes that need each other are an InputError
/// with the chain.
class PassTextures : public TextureLoader {
  public:
    PassTextures(const Scene& scene, const Library& library, const Device& device, RenderSettings settings,
                 Notes& notes);

    /// The pass as an image: radiance; reflectance (equal-energy light divided by what a perfect white
    /// diffuser sends back there; 0 where nothing is seen); irradiance, W·m⁻²·nm⁻¹. Throws InputError where a
    /// reflectance would divide by no light, naming the pixel.
    [[nodiscard]] Cube render(const Pass& pass);

  private:
    SpectralTexture loadPass(const Pass& pass, const TextureUse& use) override;
    [[nodiscard]] Cube renderPlain(const Pass& pass, Substitute substitute, bool oneBand);

    Device device_;
    RenderSettings settings_;  ///< of the whole render: wavelengths and samples that every pass follows
                               ///< unless it says its own
    std::vector<std::string> open_;
    std::map<std::string, Cube> done_;
};

}  // namespace spectrad
