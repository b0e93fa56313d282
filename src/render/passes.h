// Passes: one scene rendered several times, each result a texture of the next, or an image that is not plain
// radiance.
#pragma once

#include "opencl/device.h"
#include "render/plan.h"
#include "render/render_graph.h"
#include "render/texture.h"

#include <functional>
#include <memory>

namespace spectrad {

/// Textures that passes make for one render of a scene.
///
///   PassTextures passes(scene, library, device, settings, notes);     // the render graph, checked
///   Plan plan = makePlan(scene, settings, library, passes, notes);    // renders what is needed first
///
/// A pass is rendered once, and forgotten when the last that needs it has it.
class PassTextures : public TextureLoader {
  public:
    /// Told of each finished pass that asks to be saved, with its plan (less geometry and terms); the target
    /// is not among them.
    using Save = std::function<void(const Pass&, const Plan&, const Cube&)>;

    /// Throws InputError as renderGraph() does.
    PassTextures(const Scene& scene, const Library& library, const Device& device,
                 const RenderSettings& settings, Notes& notes, Save save = {});
    ~PassTextures() override;

    /// The target as an image (six faces, one below the other, where its camera looks all around; a baked
    /// texture where the settings ask for one): radiance; reflectance (equal-energy light divided by what a
    /// perfect white diffuser sends back there; 0 where nothing is seen); irradiance, W·m⁻²·nm⁻¹. Throws
    /// InputError where a reflectance would divide by no light, naming the pixel.
    [[nodiscard]] Cube render();
    /// All that is rendered, in order; the last is the target.
    [[nodiscard]] const std::vector<GraphNode>& graph() const;

  private:
    SpectralTexture loadPass(const Pass& pass, const TextureUse& use) override;

    struct Body;
    std::unique_ptr<Body> body_;
};

}  // namespace spectrad
