#include "render/passes.h"

#include "base/stopped.h"
#include "render/bake.h"
#include "render/cube_info.h"
#include "render/divided.h"
#include "render/renderer.h"
#include "render/resident.h"
#include "render/shown.h"
#include "render/stages.h"

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
    [[nodiscard]] bool isSaved(size_t node) const;
    [[nodiscard]] std::shared_ptr<const ResidentTexels> renderResident(size_t node);
    [[nodiscard]] DivisionStage whiteAndCoverage(size_t node);
    [[nodiscard]] RenderSettings settingsFor(size_t node, Substitute substitute) const;
    [[noreturn]] void refuseDark(size_t node, PixelPlace at) const;
    /// Rows of a node's image, its faces one below the other, while they are on the device.
    using Strips =
        std::function<void(const Plan& plan, const cl::Buffer& cube, int pitch, int firstRow, int rows)>;
    void renderStrips(size_t node, Substitute substitute, const Strips& strip, Plan* used = nullptr);
    /// Each face's plan in turn, rendered by `face`.
    void renderFaces(size_t node, RenderSettings settings,
                     const std::function<void(int face, Plan& plan)>& face);
    [[nodiscard]] Cube renderPlain(size_t node, Substitute substitute, Plan* used = nullptr);
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

size_t pixelsOf(const CubeInfo& info) {
    return static_cast<size_t>(info.width) * static_cast<size_t>(info.height);
}

/// What the image is called after; its geometry and textures are not needed any more.
void keepForName(Plan& plan, Plan& used) {
    plan.world = {};
    plan.terms = {};
    used = std::move(plan);
}

/// Rows of a cube from a strip [row][band][pitch] on the device.
void copyRows(const Device& device, const cl::Buffer& strip, int pitch, int firstRow, int rows, Cube& cube) {
    const size_t bands = cube.info.wavelengths.size(), width = static_cast<size_t>(cube.info.width),
                 padded = static_cast<size_t>(pitch), lines = static_cast<size_t>(rows) * bands;
    const MappedFloats map(device, strip, lines * padded);
    float* to = cube.values.data() + static_cast<size_t>(firstRow) * bands * width;
    for (size_t line = 0; line < lines; ++line)
        std::copy_n(map.data() + line * padded, width, to + line * width);
}

/// What a first generation sees of itself.
SpectralTexture darkTexel(const Wavelengths& grid) {
    SpectralTexture texture;
    texture.width = texture.height = 1;
    texture.nm = grid.nm;
    texture.texels.assign(texture.nm.size(), 0.0f);
    return texture;
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
        if (!need.node) return darkTexel(node.grid);
        Rendered& image = *images[*need.node];
        if (!image.resident) return textureFrom(image.cube, use, notes);
        if (use.filter == TextureFilter::mip && image.resident->levels == 1)
            if (auto levels = withLevels(*image.resident)) image.resident = std::move(levels);
        return textureFrom(image.resident, use, notes);
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

/// What other passes look at, small enough to stay beside another one and the strips.
bool PassTextures::Body::staysOnDevice(size_t number) const {
    const GraphNode& node = graph[number];
    const Pass* pass = node.shot.pass;
    if (!pass || (pass->as != PassKind::radiance && pass->as != PassKind::reflectance) || node.settings.bake)
        return false;
    const auto [width, height] = sizeOf(node.shot, node.settings);
    const int faces = node.shot.scene->cameras[node.shot.camera].cube ? 6 : 1;
    return TexelStage::fits(device.info(), node.grid.size(), width, faces * height);
}

bool PassTextures::Body::isSaved(size_t number) const {
    const GraphNode& node = graph[number];
    const Pass* pass = node.shot.pass;
    return save && pass && number + 1 < graph.size() && !pass->save.empty() &&
           node.generation + 1 == std::max(pass->repeat, 1);
}

void PassTextures::Body::renderStrips(size_t number, Substitute substitute, const Strips& strip, Plan* used) {
    renderFaces(number, settingsFor(number, substitute), [&](int face, Plan& plan) {
        Renderer(device, plan).renderOnDevice([&](int row, int rows, const cl::Buffer& bands, int pitch) {
            throwIfStopped(stop);
            strip(plan, bands, pitch, face * plan.view.height + row, rows);
        });
        if (used && face + 1 == plan.faces) keepForName(plan, *used);
    });
}

std::shared_ptr<const ResidentTexels> PassTextures::Body::renderResident(size_t number) {
    const Pass& pass = *graph[number].shot.pass;
    const bool reflectance = pass.as == PassKind::reflectance;
    std::optional<DivisionStage> division;
    if (reflectance) division = whiteAndCoverage(number);
    std::optional<TexelStage> texels;
    std::optional<ScreenStage> screen;
    Cube cube;  // of what is saved as well
    Plan used;
    const auto begin = [&](const Plan& plan) {
        cube.info = cubeInfoOf(plan);
        const auto& [width, height] = std::pair(cube.info.width, cube.info.height);
        texels.emplace(device, plan.wavelengths, width, height, reflectance);
        if (pass.screen) screen.emplace(device, *pass.screen, plan.wavelengths, library, width);
        if (isSaved(number)) cube.values.resize(plan.terms.bands * pixelsOf(cube.info));
    };
    const auto finish = [&](const Plan& plan, const cl::Buffer& strip, int pitch, int row, int rows) {
        if (!texels) begin(plan);
        if (division) division->divide(strip, plan.terms.bands, row, rows);
        if (screen) screen->show(strip, pitch, row, rows);
        texels->add(strip, pitch, row, rows);
        if (!cube.values.empty()) copyRows(device, strip, pitch, row, rows, cube);
    };
    renderStrips(number, reflectance ? Substitute::equalEnergy : Substitute::none, finish, &used);
    if (screen) screen->finish(pixelsOf(cube.info), notes);
    if (isSaved(number)) save(pass, used, cube);
    return texels->finish();
}

/// What a reflectance is divided by. Throws InputError where there is nothing to divide by.
DivisionStage PassTextures::Body::whiteAndCoverage(size_t number) {
    std::optional<DivisionStage> stage;
    for (const Substitute substitute : {Substitute::whiteDiffuser, Substitute::coverage})
        renderStrips(number, substitute,
                     [&](const Plan& plan, const cl::Buffer& strip, int pitch, int row, int rows) {
                         if (!stage)
                             stage.emplace(device, pitch, plan.view.width, plan.view.height * plan.faces);
                         if (substitute == Substitute::coverage)
                             stage->addCoverage(strip, row, rows);
                         else
                             stage->addWhite(strip, row, rows);
                     });
    if (const auto dark = stage->dark()) refuseDark(number, *dark);
    return std::move(*stage);
}

/// A pass's own settings, but for what its materials and lights are replaced by; what a reflectance is
/// divided by has one band.
RenderSettings PassTextures::Body::settingsFor(size_t number, Substitute substitute) const {
    RenderSettings settings = graph[number].settings;
    settings.substitute = substitute;
    if (substitute == Substitute::whiteDiffuser || substitute == Substitute::coverage) {
        settings.wavelengths = Wavelengths{{550}, Projection::point, 5};
        settings.projection.reset();
    }
    return settings;
}

void PassTextures::Body::refuseDark(size_t number, PixelPlace at) const {
    const GraphNode& node = graph[number];
    const std::string name = node.settings.bake ? "node '" + node.settings.bake->node + "'"
                                                : "pass '" + node.shot.pass->name + "'";
    const Pass* pass = node.settings.bake ? nullptr : node.shot.pass;
    const bool lightsElsewhere = pass && pass->of && !pass->lights && !node.shot.scene->lights.empty() &&
                                 flatten(*node.shot.scene, *pass).lights.empty();
    throw InputError(
        pass ? pass->where : SourceLocation{},
        fmt::format(
            "{}: no light arrives at pixel {},{}, so it has no reflectance{}", name, at.x, at.y,
            lightsElsewhere ? " (no light stands in the node that it is of: lights= names others)" : ""));
}

Cube PassTextures::Body::renderPlain(size_t number, Substitute substitute, Plan* used) {
    Cube cube;
    renderFaces(number, settingsFor(number, substitute), [&](int face, Plan& plan) {
        cube.info = cubeInfoOf(plan);
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
        if (used && face + 1 == plan.faces) keepForName(plan, *used);
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
                                  &plan);
    // What a white Lambertian surface sends back is the irradiance over π, lamp by lamp.
    if (as == PassKind::irradiance)
        for (float& value : cube.values)
            value *= std::numbers::pi_v<float>;
    if (as == PassKind::reflectance) cube = divided(number, std::move(cube));
    if (pass && pass->screen) cube = shownOn(*pass->screen, std::move(cube), library, notes);
    if (node.settings.bake) {
        const Cube coverage = renderPlain(number, Substitute::coverage);
        // A ratio of two sums over the same samples needs no dividing by their number.
        if (as != PassKind::reflectance) divideByCoverage(cube, coverage.values);
        if (addGutter(cube, coverage.values, node.settings.bake->gutter) == 0)
            throw InputError(
                "node '" + node.settings.bake->node +
                "' covers nothing of its texture: its coordinates lie outside 0…1, or no texel's "
                "sample is within");
    }
    if (isSaved(number)) save(*pass, plan, cube);
    return cube;
}

/// The share of light from behind that gets past the surfaces to the eye. These are opaque: it is what they
/// leave of the pixel, alike at all wavelengths.
Cube PassTextures::Body::uncovered(size_t number, Plan& used) {
    const Cube covered = renderPlain(number, Substitute::coverage, &used);
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
    const Cube white = renderPlain(number, Substitute::whiteDiffuser);
    // Only where nothing is seen may there be nothing to divide by.
    const Cube seen = renderPlain(number, Substitute::coverage);
    if (const auto dark = divideByWhite(cube, white, seen)) refuseDark(number, *dark);
    return cube;
}

}  // namespace spectrad
