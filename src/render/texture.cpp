#include "render/texture.h"

#include "base/text.h"
#include "image/picture.h"
#include "render/plan.h"
#include "spectrum/lift.h"
#include "spectrum/mass_matrix.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

SpectralTexture textureFrom(const Cube& cube, const TextureUse& use, Notes& notes) {
    const CubeInfo& info = cube.info;
    const bool reflectance = use.role == TextureRole::reflectance;
    if (info.kind != (reflectance ? CubeKind::reflectance : CubeKind::radiance))
        throw InputError(use.where,
                         fmt::format("{} holds {}, but {}", use.source, name(info.kind),
                                     reflectance ? "a <diffuse> texture is a reflectance (channels T.…, or a "
                                                   "pass with as=\"reflectance\")"
                                                 : "what glows is a radiance (channels S0.…, or a pass with "
                                                   "as=\"radiance\")"));
    const Wavelengths& grid = info.wavelengths;
    const size_t bands = grid.size(), width = static_cast<size_t>(info.width);
    SpectralTexture texture;
    texture.width = info.width;
    texture.height = info.height;
    texture.nm = grid.nm;
    texture.texels.resize(cube.values.size());
    std::vector<double> values(bands);
    size_t clipped = 0;
    for (int row = 0; row < info.height; ++row) {
        for (size_t x = 0; x < width; ++x) {
            for (size_t band = 0; band < bands; ++band)
                values[band] = cube.row(row, band)[x];
            const std::vector<double> nodes = nodalValues(grid, values);
            float* texel = texture.texels.data() + (static_cast<size_t>(row) * width + x) * bands;
            for (size_t band = 0; band < bands; ++band) {
                if (reflectance && nodes[band] < 0) ++clipped;
                texel[band] = static_cast<float>(reflectance ? std::max(nodes[band], 0.0) : nodes[band]);
            }
        }
    }
    if (clipped > 0)
        notes.say(fmt::format("{}: {} of {} reflectances came out below zero between the bands: set to zero",
                              use.source, clipped, cube.values.size()));
    return texture;
}

SpectralTexture textureFromPicture(const std::string& file, const Library& library) {
    const Picture8 picture = readPng(file);
    SpectralTexture texture;
    texture.width = picture.width;
    texture.height = picture.height;
    texture.nm = regularWavelengths(380, 780, 10, {file, 0, 0}).nm;
    const ColourLift lift(library);
    std::map<std::array<std::uint8_t, 3>, std::vector<float>> known;  // pictures repeat their colours
    const auto linear = [](std::uint8_t encoded) {
        const double v = encoded / 255.0;
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    for (size_t i = 0; i < picture.pixels.size(); i += static_cast<size_t>(picture.channels)) {
        const std::uint8_t* p = picture.pixels.data() + i;
        const std::array<std::uint8_t, 3> rgb = picture.channels < 3
                                                    ? std::array<std::uint8_t, 3>{p[0], p[0], p[0]}
                                                    : std::array<std::uint8_t, 3>{p[0], p[1], p[2]};
        auto found = known.find(rgb);
        if (found == known.end()) {
            const LiftedColour colour = lift.fit({linear(rgb[0]), linear(rgb[1]), linear(rgb[2])});
            std::vector<float> curve;
            for (double nm : texture.nm)
                curve.push_back(static_cast<float>(colour.at(nm)));
            found = known.emplace(rgb, std::move(curve)).first;
        }
        texture.texels.insert(texture.texels.end(), found->second.begin(), found->second.end());
    }
    return texture;
}

SpectralTexture TextureLoader::load(const TextureUse& use) {
    if (use.isPass()) {
        for (const Pass& pass : scene_.passes)
            if (pass.name == use.passName()) return loadPass(pass, use);
        throw InputError(use.where, "there is no pass '" + use.passName() + "'");
    }
    SpectralTexture texture;
    if (use.source.ends_with(".png")) {
        if (use.role == TextureRole::radiance)
            throw InputError(use.where,
                             use.source +
                                 ": a picture has no radiances, so it cannot glow (a spectral cube or "
                                 "a pass can)");
        texture = textureFromPicture(use.source, library_);
    } else {
        texture = textureFrom(readCube(use.source, notes_), use, notes_);
    }
    return texture;
}

SpectralTexture TextureLoader::loadPass(const Pass& pass, const TextureUse&) {
    SpectralTexture texture;
    texture.width = texture.height = 1;
    texture.nm = gridOf(shotOf(scene_, pass), {}).nm;
    texture.texels.assign(texture.nm.size(), 0.0f);
    return texture;
}

}  // namespace spectrad
