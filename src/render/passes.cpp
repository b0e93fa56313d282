#include "render/passes.h"

#include "base/stopped.h"
#include "render/bake.h"
#include "render/renderer.h"
#include "render/resident.h"
#include "render/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// What a node of the graph left for those after it: texels on the device, or a cube on the host.
struct Rendered {
    std::shared_ptr<const ResidentTexels> resident;
    Cube cube;
};

}  // namespace

struct PassTextures::Body {
    Device device;
    const Library& library;
    Notes& notes;
    Save save;
    std::stop_token stop;
    std::vector<GraphNode> graph;
    std::vector<std::optional<Rendered>> images;  ///< of the graph's nodes
    std::vector<size_t> waiting;                  ///< users that a node still has
    bool rendered = false;

    /// Renders everything but the target.
    void renderNeeded();
    [[nodiscard]] Cube render(size_t node);
    [[nodiscard]] bool staysOnDevice(size_t node) const;
    [[nodiscard]] std::shared_ptr<const ResidentTexels> renderResident(size_t node);
    /// Each face's plan in turn, rendered by `face`.
    void renderFaces(size_t node, RenderSettings settings,
                     const std::function<void(int face, Plan& plan)>& face);
    [[nodiscard]] Cube renderPlain(size_t node, Substitute substitute, bool oneBand, Plan* used = nullptr);
    [[nodiscard]] Cube divided(size_t node, Cube cube);
    [[nodiscard]] Cube uncovered(size_t node, Plan& used);
    [[nodiscard]] SpectralTexture texture(size_t user, const Pass& pass, const TextureUse& use);
};

namespace {

/// What a node of the graph sees: the cubes of those rendered before it.
class NodeTextures : public TextureLoader {
  public:
    using Find = std::function<SpectralTexture(const Pass&, const TextureUse&)>;
    NodeTextures(const Scene& scene, const Library& library, Notes& notes, Find find)
        : TextureLoader(scene, library, notes), find_(std::move(find)) {}

  private:
    SpectralTexture loadPass(const Pass& pass, const TextureUse& use) override { return find_(pass, use); }
    Find find_;
};

CubeKind kindOf(PassKind kind) {
    switch (kind) {
        case PassKind::reflectance:
            return CubeKind::reflectance;
        case PassKind::transmittance:
            return CubeKind::transmittance;
        case PassKind::irradiance:
            return CubeKind::irradiance;
        case PassKind::radiance:
            break;
    }
    return CubeKind::radiance;
}

}  // namespace

PassTextures::PassTextures(const Scene& scene, const Library& library, const Device& device,
                           const RenderSettings& settings, Notes& notes, Save save)
    : TextureLoader(*chooseShot(scene, settings).scene, library, notes),
      body_(new Body{device,
                     library,
                     notes,
                     std::move(save),
                     settings.stop,
                     renderGraph(scene, settings, notes),
                     {},
                     {}}) {
    limitTo(device.info());
    for (const GraphNode& node : body_->graph)
        body_->waiting.push_back(node.users);
    body_->images.resize(body_->graph.size());
}

PassTextures::~PassTextures() = default;

const std::vector<GraphNode>& PassTextures::graph() const {
    return body_->graph;
}

Cube PassTextures::render() {
    body_->renderNeeded();
    return body_->render(body_->graph.size() - 1);
}

SpectralTexture PassTextures::loadPass(const Pass& pass, const TextureUse& use) {
    body_->renderNeeded();
    return body_->texture(body_->graph.size() - 1, pass, use);
}

void PassTextures::Body::renderNeeded() {
    if (rendered) return;
    rendered = true;
    for (size_t node = 0; node + 1 < graph.size(); ++node) {
        images[node] =
            staysOnDevice(node) ? Rendered{renderResident(node), {}} : Rendered{nullptr, render(node)};
        // What no later pass needs any more makes room.
        for (const GraphNode::Need& need : graph[node].needs)
            if (need.node && --waiting[*need.node] == 0) images[*need.node].reset();
    }
}

SpectralTexture PassTextures::Body::texture(size_t user, const Pass& pass, const TextureUse& use) {
    const GraphNode& node = graph[user];
    for (const GraphNode::Need& need : node.needs) {
        if (&node.shot.scene->passes[need.pass] != &pass) continue;
        SpectralTexture texture;
        if (need.node && images[*need.node]->resident) {
            texture.resident = images[*need.node]->resident;
            texture.width = texture.resident->width;
            texture.height = texture.resident->height;
            texture.nm = texture.resident->nm;
        } else if (need.node) {
            texture = textureFrom(images[*need.node]->cube, use, notes);
        } else {
            texture.width = texture.height = 1;
            texture.nm = node.grid.nm;
            texture.texels.assign(texture.nm.size(), 0.0f);
        }
        return texture;
    }
    throw InputError(use.where, "pass '" + pass.name + "' is not part of the render graph");
}

void PassTextures::Body::renderFaces(size_t number, RenderSettings settings,
                                     const std::function<void(int face, Plan& plan)>& face) {
    const GraphNode& node = graph[number];
    NodeTextures textures(*node.shot.scene, library, notes, [&](const Pass& pass, const TextureUse& use) {
        return texture(number, pass, use);
    });
    textures.limitTo(device.info());
    for (int side = 0, faces = 1; side < faces; ++side) {
        throwIfStopped(stop);
        settings.cubeFace = side;
        Plan plan = makePlan(node.shot, settings, library, textures, notes);
        faces = plan.faces;
        face(side, plan);
    }
}

/// Radiances that nobody but textures look at, small enough to stay beside another one and the strips.
bool PassTextures::Body::staysOnDevice(size_t number) const {
    const GraphNode& node = graph[number];
    const Pass* pass = node.shot.pass;
    if (!pass || pass->as != PassKind::radiance || pass->screen || node.settings.bake) return false;
    if (save && !pass->save.empty() && node.generation + 1 == std::max(pass->repeat, 1)) return false;
    const auto [width, height] = sizeOf(node.shot, node.settings);
    const int faces = node.shot.scene->cameras[node.shot.camera].cube ? 6 : 1;
    return TexelStage::fits(device.info(), node.grid.size(), width, faces * height);
}

std::shared_ptr<const ResidentTexels> PassTextures::Body::renderResident(size_t number) {
    std::optional<TexelStage> stage;
    renderFaces(number, graph[number].settings, [&](int face, Plan& plan) {
        const int height = plan.view.height;
        if (!stage) stage.emplace(device, plan.wavelengths, plan.view.width, height * plan.faces);
        Renderer(device, plan).renderOnDevice([&](int row, int rows, const cl::Buffer& bands, int pitch) {
            throwIfStopped(stop);
            stage->add(bands, pitch, face * height + row, rows);
        });
    });
    return stage->finish();
}

Cube PassTextures::Body::renderPlain(size_t number, Substitute substitute, bool oneBand, Plan* used) {
    RenderSettings settings = graph[number].settings;
    settings.substitute = substitute;
    if (oneBand) {
        settings.wavelengths = Wavelengths{{550}, Projection::point, 5};
        settings.projection.reset();
    }
    Cube cube;
    cube.info.projectionStated = true;
    renderFaces(number, settings, [&](int face, Plan& plan) {
        cube.info.width = plan.view.width;
        cube.info.height = plan.view.height * plan.faces;
        cube.info.wavelengths = plan.wavelengths;
        const size_t rowValues = plan.terms.bands * static_cast<size_t>(plan.view.width);
        cube.values.resize(rowValues * static_cast<size_t>(cube.info.height));
        float* top = cube.values.data() + rowValues * static_cast<size_t>(face * plan.view.height);
        {
            Renderer renderer(device, plan);
            renderer.render([&](int first, int rows, const float* bands, const float*) {
                throwIfStopped(stop);
                std::copy_n(bands, static_cast<size_t>(rows) * rowValues,
                            top + static_cast<size_t>(first) * rowValues);
            });
        }
        if (used && face + 1 == plan.faces) {
            // What the image is called after; its geometry and textures are not needed any more.
            plan.world = {};
            plan.terms = {};
            *used = std::move(plan);
        }
    });
    return cube;
}

Cube PassTextures::Body::render(size_t number) {
    const GraphNode& node = graph[number];
    const Pass* pass = node.shot.pass;
    const PassKind as = node.settings.bake ? node.settings.bake->as : pass ? pass->as : PassKind::radiance;
    Plan plan;
    Cube cube = as == PassKind::transmittance
                    ? uncovered(number, plan)
                    : renderPlain(number,
                                  as == PassKind::reflectance  ? Substitute::equalEnergy
                                  : as == PassKind::irradiance ? Substitute::irradiance
                                                               : Substitute::none,
                                  false, &plan);
    // What a white Lambertian surface sends back is the irradiance over π, lamp by lamp.
    if (as == PassKind::irradiance)
        for (float& value : cube.values)
            value *= std::numbers::pi_v<float>;
    if (as == PassKind::reflectance) cube = divided(number, std::move(cube));
    if (pass && pass->screen) cube = shownOn(*pass->screen, std::move(cube), library, notes);
    cube.info.kind = kindOf(as);
    if (node.settings.bake) {
        const Cube coverage = renderPlain(number, Substitute::coverage, true);
        // A ratio of two sums over the same samples needs no dividing by their number.
        if (as != PassKind::reflectance) divideByCoverage(cube, coverage.values);
        if (addGutter(cube, coverage.values, node.settings.bake->gutter) == 0)
            throw InputError(
                "node '" + node.settings.bake->node +
                "' covers nothing of its texture: its coordinates lie outside 0…1, or no texel's "
                "sample is within");
    }
    const bool last = number + 1 == graph.size();
    if (save && pass && !last && !pass->save.empty() && node.generation + 1 == std::max(pass->repeat, 1))
        save(*pass, plan, cube);
    return cube;
}

/// The share of light from behind that gets past the surfaces to the eye. These are opaque: it is what they
/// leave of the pixel, alike at all wavelengths.
Cube PassTextures::Body::uncovered(size_t number, Plan& used) {
    const Cube covered = renderPlain(number, Substitute::coverage, true, &used);
    Cube cube;
    cube.info = covered.info;
    cube.info.wavelengths = used.wavelengths = graph[number].grid;
    const auto width = static_cast<size_t>(cube.info.width);
    for (int row = 0; row < cube.info.height; ++row)
        for (size_t band = 0; band < cube.info.wavelengths.size(); ++band)
            for (size_t x = 0; x < width; ++x)
                cube.values.push_back(std::max(0.0f, 1.0f - covered.row(row, 0)[x]));
    return cube;
}

/// Equal-energy light divided by what a perfect white diffuser sends back.
Cube PassTextures::Body::divided(size_t number, Cube cube) {
    const GraphNode& node = graph[number];
    const std::string name = node.settings.bake ? "node '" + node.settings.bake->node + "'"
                                                : "pass '" + node.shot.pass->name + "'";
    const SourceLocation where = node.settings.bake ? SourceLocation{} : node.shot.pass->where;
    const Cube white = renderPlain(number, Substitute::whiteDiffuser, true);
    // Only where nothing is seen may there be nothing to divide by.
    const Cube seen = renderPlain(number, Substitute::coverage, true);
    const auto width = static_cast<size_t>(cube.info.width);
    const size_t bands = cube.info.wavelengths.size();
    for (int row = 0; row < cube.info.height; ++row) {
        for (size_t x = 0; x < width; ++x) {
            const double diffuser = white.row(row, 0)[x];
            if (!(diffuser > 0) && seen.row(row, 0)[x] > 0)
                throw InputError(
                    where, fmt::format("{}: no light arrives at pixel {},{}, so it has no reflectance", name,
                                       x, row));
            if (!(diffuser > 0)) continue;
            for (size_t band = 0; band < bands; ++band) {
                float& value = cube.values[(static_cast<size_t>(row) * bands + band) * width + x];
                value = static_cast<float>(value / diffuser);
            }
        }
    }
    return cube;
}

}  // namespace spectrad
