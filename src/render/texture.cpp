#include "render/texture.h"

#include "base/text.h"
#include "image/picture.h"
#include "render/lifted_picture.h"
#include "render/plan.h"
#include "render/resident.h"
#include "spectrum/mass_matrix.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace spectrad {

void SpectralTexture::fetch() {
    if (!resident) return;
    texels = resident->read(1);
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

namespace {

void noteLost(const TextureUse& use, std::uint64_t lost, size_t of, Notes& notes) {
    if (lost > 0)
        notes.say(fmt::format("{}: {} of {} reflectances came out below zero between the bands: set to zero",
                              use.source, lost, of));
}

void noteMissed(const TextureUse& use, const LiftedPicture& lifted, Notes& notes) {
    if (lifted.missed > 0)
        notes.say(
            fmt::format("{}: {} of {} colours are none that a reflectance can have: near ones are shown, "
                        "at most {} away in CIE Lab",
                        use.source, lifted.missed, lifted.colours, rounded(lifted.farthest, 3)));
}

}  // namespace

SpectralTexture textureFrom(const Cube& cube, const TextureUse& use, Notes& notes) {
    const CubeInfo& info = cube.info;
    constexpr double reached = 1e-3;  // of a white diffuser, through its bands and back
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
    size_t clipped = 0, above = 0;
    double most = 0;
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
                if (reflectance && node > 1 + reached) ++above, most = std::max(most, node);
                texels[x * bands + band] = static_cast<float>(reflectance ? std::max(node, 0.0) : node);
            }
    }
    if (above > 0 && !use.isPass())
        notes.warn(use.where,
                   fmt::format("{}: {} of {} reflectances lie above 1, up to {}{}: they count as they are",
                               use.source, above, cube.values.size(), rounded(most, 4),
                               most > 1.5 && most <= 150 ? " (percent? divide them by 100)" : ""));
    noteLost(use, clipped, cube.values.size(), notes);
    return texture;
}

SpectralTexture textureFrom(std::shared_ptr<const ResidentTexels> image, const TextureUse& use,
                            Notes& notes) {
    SpectralTexture texture;
    texture.width = image->width;
    texture.height = image->height;
    texture.nm = image->nm;
    noteLost(use, image->lost, image->count(1), notes);
    texture.resident = std::move(image);
    return texture;
}

bool isPicture(const TextureUse& use) {
    return use.bytes || isPictureName(use.source);
}

PictureValues valuesOf(const TextureUse& use) {
    return use.bytes ? decodeValues(*use.bytes, use.source) : readValues(use.source);
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

/// A file's fault is told where the scene names the file.
template <typename Read>
static auto atUse(const TextureUse& use, Read read) {
    try {
        return read();
    } catch (const InputError& error) {
        throw InputError(use.where, error.what());
    }
}

SpectralTexture TextureLoader::load(const TextureUse& use) {
    if (use.isPass()) {
        for (const Pass& pass : scene_.passes)
            if (pass.name == use.passName()) return loadPass(pass, use);
        throw InputError(use.where, "there is no pass '" + use.passName() + "'");
    }
    SpectralTexture texture;
    if (isPicture(use)) {
        if (use.role == TextureRole::radiance)
            throw InputError(use.where,
                             use.source +
                                 ": a picture has no radiances, so it cannot glow (a spectral cube or "
                                 "a pass can)");
        const PictureValues picture = atUse(use, [&] { return valuesOf(use); });
        checkFits(use, picture.width, picture.height, liftedBands);
        const PictureLight light =
            use.isPlainSrgb ? PictureLight() : PictureLight(picture, use.source, use.where, notes_);
        LiftedPicture lifted = atUse(use, [&] { return liftPicture(picture, light, use.tint, library_); });
        noteMissed(use, lifted, notes_);
        texture = std::move(lifted.texture);
    } else {
        Notes saidWhenRead;
        const CubeInfo info = atUse(use, [&] { return readCubeInfo(use.source, saidWhenRead); });
        checkFits(use, info.width, info.height, info.wavelengths.size());
        texture = textureFrom(atUse(use, [&] { return readCube(use.source, notes_); }), use, notes_);
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
