#include "render/texture.h"

#include "base/text.h"
#include "render/plan.h"
#include "render/resident.h"
#include "spectrum/lift.h"
#include "spectrum/mass_matrix.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace spectrad {

void SpectralTexture::fetch() {
    if (!resident) return;
    texels = resident->read();
    resident.reset();
}

std::vector<double> meanOfTexels(const std::vector<float>& texels, size_t bands) {
    std::vector<double> mean(bands, 0.0);
    for (size_t i = 0; i < texels.size(); ++i)
        mean[i % bands] += texels[i];
    for (double& value : mean)
        value = value * static_cast<double>(bands) / static_cast<double>(texels.size());
    return mean;
}

SpectralTexture textureFrom(const Cube& cube, const TextureUse& use, Notes& notes) {
    const CubeInfo& info = cube.info;
    const bool reflectance = use.role == TextureRole::reflectance,
               irradiance = use.role == TextureRole::irradiance;
    const CubeKind wanted = reflectance  ? CubeKind::reflectance
                            : irradiance ? CubeKind::irradiance
                                         : CubeKind::radiance;
    if (info.kind != wanted)
        throw InputError(use.where,
                         fmt::format("{} holds {}, but {}", use.source, name(info.kind),
                                     reflectance ? "a <diffuse> texture is a reflectance (channels T.…, or a "
                                                   "pass with as=\"reflectance\")"
                                     : irradiance ? "a directional light sends an irradiance"
                                                  : "what glows is a radiance (channels S0.…, or a pass with "
                                                    "as=\"radiance\")"));
    const Wavelengths& grid = info.wavelengths;
    const size_t bands = grid.size(), width = static_cast<size_t>(info.width);
    SpectralTexture texture;
    texture.width = info.width;
    texture.height = info.height;
    texture.nm = grid.nm;
    texture.texels.resize(cube.values.size());
    // A row at a time, bands after bands as the cube has them: the solver then runs along the row.
    const bool averages = grid.projection == Projection::slit && bands > 1;
    const std::optional<MassMatrix> mass = averages ? std::optional(MassMatrix(grid.nm)) : std::nullopt;
    std::vector<double> values(bands * width), area(bands, 1.0);
    for (size_t band = 0; averages && band < bands; ++band)
        area[band] = spectrad::band(grid, band).area();
    size_t clipped = 0;
    for (int row = 0; row < info.height; ++row) {
        const float* averagesOfRow = cube.row(row, 0);
        for (size_t band = 0; band < bands; ++band)
            for (size_t x = 0; x < width; ++x)
                values[band * width + x] = averagesOfRow[band * width + x] * area[band];
        if (mass) mass->solveAll(values, width);
        float* texels = texture.texels.data() + static_cast<size_t>(row) * width * bands;
        for (size_t band = 0; band < bands; ++band)
            for (size_t x = 0; x < width; ++x) {
                const double node = values[band * width + x];
                if (reflectance && node < 0) ++clipped;
                texels[x * bands + band] = static_cast<float>(reflectance ? std::max(node, 0.0) : node);
            }
    }
    if (clipped > 0)
        notes.say(fmt::format("{}: {} of {} reflectances came out below zero between the bands: set to zero",
                              use.source, clipped, cube.values.size()));
    return texture;
}

SpectralTexture textureFromPicture(const Picture8& picture, const Library& library) {
    SpectralTexture texture;
    texture.width = picture.width;
    texture.height = picture.height;
    texture.nm = regularWavelengths(380, 780, 10, {}).nm;
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
            // Lines between samples of a curve lie inside its bends, by h² / 12 of the second derivative on
            // average: taken off the samples, so that the colour is right.
            for (double nm : texture.nm) {
                const double here = colour.at(nm), bend = colour.at(nm - 10) - 2 * here + colour.at(nm + 10);
                curve.push_back(static_cast<float>(std::clamp(here - bend / 12, 0.0, 1.0)));
            }
            found = known.emplace(rgb, std::move(curve)).first;
        }
        texture.texels.insert(texture.texels.end(), found->second.begin(), found->second.end());
    }
    return texture;
}

void TextureLoader::checkFits(const TextureUse& use, int width, int height, size_t bands) const {
    if (!device_) return;
    double bytes = double{sizeof(float)} * width * height * static_cast<double>(bands);
    if (use.filter == TextureFilter::mip) bytes *= 4.0 / 3;
    if (bytes > static_cast<double>(device_->maxAllocationBytes))
        throw InputError(
            use.where,
            fmt::format("{}: {} x {} texels of {} bands take {:.0f} bytes, more than the {} that device "
                        "{} ({}) gives in one piece",
                        use.source, width, height, bands, bytes, device_->maxAllocationBytes, device_->number,
                        device_->name));
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
        const Picture8 picture = readPng(use.source);
        constexpr size_t liftedBands = 41;
        checkFits(use, picture.width, picture.height, liftedBands);
        texture = textureFromPicture(picture, library_);
    } else {
        Notes saidWhenRead;
        const CubeInfo info = readCubeInfo(use.source, saidWhenRead);
        checkFits(use, info.width, info.height, info.wavelengths.size());
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
