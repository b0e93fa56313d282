#include "render/passes.h"

#include "render/renderer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

PassTextures::PassTextures(const Scene& scene, const Library& library, const Device& device,
                           RenderSettings settings, Notes& notes)
    : TextureLoader(scene, library, notes), device_(device), settings_(std::move(settings)) {}

Cube PassTextures::renderPlain(const Pass& pass, Substitute substitute, bool oneBand) {
    RenderSettings settings;
    settings.pass = pass.name;
    // Wavelengths and samples of the command line are for the whole render; a pass that states its own keeps
    // them.
    if (!pass.wavelengths) settings.wavelengths = settings_.wavelengths;
    settings.projection = settings_.projection;
    if (!pass.samples) settings.samples = settings_.samples;
    settings.substitute = substitute;
    if (oneBand) settings.wavelengths = Wavelengths{{550}, Projection::point, 5};
    const Plan plan = makePlan(scene(), settings, library(), *this, notes());
    Cube cube;
    cube.info.width = plan.view.width;
    cube.info.height = plan.view.height;
    cube.info.wavelengths = plan.wavelengths;
    cube.info.projectionStated = true;
    Renderer renderer(device_, plan);
    renderer.render([&](int, int rows, const float* bands, const float*) {
        cube.values.insert(
            cube.values.end(), bands,
            bands + static_cast<size_t>(rows) * plan.terms.bands * static_cast<size_t>(plan.view.width));
    });
    return cube;
}

Cube PassTextures::render(const Pass& pass) {
    switch (pass.as) {
        case PassKind::radiance:
            return renderPlain(pass, Substitute::none, false);
        case PassKind::irradiance: {
            // What a white Lambertian surface sends back is the irradiance over π, lamp by lamp.
            Cube cube = renderPlain(pass, Substitute::whiteDiffuser, false);
            for (float& value : cube.values)
                value *= std::numbers::pi_v<float>;
            cube.info.kind = CubeKind::irradiance;
            return cube;
        }
        case PassKind::transmittance:
            throw InputError(pass.where, "pass '" + pass.name + "': as=\"transmittance\" is not there yet");
        case PassKind::reflectance:
            break;
    }
    Cube cube = renderPlain(pass, Substitute::equalEnergy, false);
    const Cube white = renderPlain(pass, Substitute::whiteDiffuser, true);
    // Only where nothing is seen may there be nothing to divide by.
    const Cube seen = renderPlain(pass, Substitute::coverage, true);
    cube.info.kind = CubeKind::reflectance;
    const auto width = static_cast<size_t>(cube.info.width);
    const size_t bands = cube.info.wavelengths.size();
    for (int row = 0; row < cube.info.height; ++row) {
        for (size_t x = 0; x < width; ++x) {
            const double diffuser = white.row(row, 0)[x];
            if (!(diffuser > 0) && seen.row(row, 0)[x] > 0)
                throw InputError(
                    pass.where,
                    fmt::format("pass '{}': no light arrives at pixel {},{}, so it has no reflectance",
                                pass.name, x, row));
            if (!(diffuser > 0)) continue;
            for (size_t band = 0; band < bands; ++band) {
                float& value = cube.values[(static_cast<size_t>(row) * bands + band) * width + x];
                value = static_cast<float>(value / diffuser);
            }
        }
    }
    return cube;
}

SpectralTexture PassTextures::loadPass(const Pass& pass, const TextureUse& use) {
    if (pass.as != PassKind::reflectance)
        throw InputError(use.where, "pass '" + pass.name +
                                        "' is not as=\"reflectance\", so it cannot be a <diffuse> texture");
    if (std::find(open_.begin(), open_.end(), pass.name) != open_.end())
        throw InputError(
            use.where, fmt::format("passes need each other: {} -> {}", fmt::join(open_, " -> "), pass.name));
    auto found = done_.find(pass.name);
    if (found == done_.end()) {
        open_.push_back(pass.name);
        found = done_.emplace(pass.name, render(pass)).first;
        open_.pop_back();
    }
    SpectralTexture texture = textureFrom(found->second, "pass:" + pass.name, notes());
    texture.nearest = use.nearest;
    return texture;
}

}  // namespace spectrad
