// The diffuse part of materials, alone or under a coat: of one reflectance, of a texture's, of those that a
// picture chooses; with fluorophores, which a picture may mask. Everything is linear in what images hold, or
// made so.
#include "base/text.h"
#include "render/fluorescence.h"
#include "render/picture_maps.h"
#include "render/resident.h"
#include "render/term_table.h"
#include "render/texels.h"
#include "render/texture_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// What a light's irradiance counts for a base, where kernels multiply by what a coat lets through.
double passedOn(double meanThrough, const LightGroup& group) {
    return group.factor * std::numbers::inv_pi / std::max(meanThrough, 1e-12);
}

/// Where radiances come from other bands than they go to, the signed values between sharp lines would leave
/// bands below zero.
void holdAboveZero(SpectralTexture& texture, const TextureUse& use, Notes& notes) {
    size_t clipped = 0;
    for (float& value : texture.texels)
        if (value < 0) ++clipped, value = 0;
    if (clipped > 0)
        notes.say(
            fmt::format("{}: {} of {} radiances came out below zero between the bands: set to zero "
                        "(none would on the same wavelengths)",
                        use.source, clipped, texture.texels.size()));
}

sd_uint mappingOf(const TextureUse& use) {
    return use.mapping == TextureMapping::cube      ? SD_MAP_CUBE
           : use.mapping == TextureMapping::picture ? SD_MAP_PICTURE
                                                    : SD_MAP_SURFACE;
}

/// The hat of a band of radiances. A single band says nothing of how wide it is: it counts everywhere.
Curve glowHat(const std::vector<double>& nm, size_t t) {
    const Curve held = nodeCurve(nm, 1, t);
    return nm.size() == 1 ? held : held.withOutside(Outside::zero);
}

std::string keyOf(const char* kind, const TextureUse& use) {
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {}", kind, use.source, use.isPlainSrgb,
                       static_cast<int>(use.filter), use.repeat, use.offset[0], use.offset[1], use.scale[0],
                       use.scale[1], use.rotateDegrees, fmt::join(use.tint, " "));
}

Material withReflectance(const Material& material, Curve reflectance) {
    Material m = material;
    m.diffuse.emplace();
    m.diffuse->reflectance.emplace();
    m.diffuse->reflectance->curves = {std::move(reflectance)};
    return m;
}

}  // namespace

const TermBuilder::Image& TermBuilder::spectralTexture(const TextureUse& use) {
    Image& image = images_[keyOf(use.role == TextureRole::radiance ? "radiance" : "reflectance", use)];
    if (image.number == 0) {
        SpectralTexture texture = textures_.load(use);
        if (use.mapping == TextureMapping::cube && !(texture.width == 1 && texture.height == 1) &&
            texture.height != 6 * texture.width)
            throw InputError(
                use.where, fmt::format("{} has {}x{} pixels; six square faces, one below the other, are six "
                                       "times as high as wide",
                                       use.source, texture.width, texture.height));
        const bool otherBands = use.role == TextureRole::radiance && texture.nm != grid_.nm;
        const bool wantsLevels =
            use.filter == TextureFilter::mip && texture.resident && texture.resident->levels == 1;
        if (otherBands || wantsLevels) texture.fetch();
        if (otherBands) holdAboveZero(texture, use, notes_);
        const int bands = static_cast<int>(texture.nm.size());
        image.number =
            texture.resident
                ? addResident(world_, std::move(texture.resident), use)
                : addTexels(world_, {texture.width, texture.height, bands, std::move(texture.texels)}, use);
        image.nm = std::move(texture.nm);
    }
    return image;
}

std::uint32_t TermBuilder::strengthTexture(const TextureUse& use) {
    Image& image = images_[keyOf("strength", use)];
    if (image.number == 0) image.number = addTexels(world_, strengthMap(use), use);
    return image.number;
}

std::uint32_t TermBuilder::shareTexture(const Select& select) {
    std::string key = keyOf(select.mix ? "mix" : "pick", select.map);
    for (const Select::Choice& choice : select.choices)
        key += fmt::format(" {}", choice.value);
    Image& image = images_[key];
    if (image.number == 0) image.number = addTexels(world_, shareMap(select), select.map);
    return image.number;
}

std::uint32_t TermBuilder::reliefTexture(const Relief& relief) {
    Image& image = images_[keyOf(relief.heights ? "heights" : "normals", relief.map) +
                           fmt::format(" {}", relief.amount)];
    if (image.number == 0) image.number = addTexels(world_, reliefMap(relief), relief.map);
    return image.number;
}

// A surface that glows with an image's radiances: those of the cube on its own hats.
void TermBuilder::addGlowing(const TextureUse& use, double factor) {
    const Image image = spectralTexture(use);
    sd_lobe lobe = beginLobe(SD_LOBE_EMISSION);
    lobe.mapping = mappingOf(use);
    lobe.texture = image.number;
    for (size_t t = 0; t < image.nm.size(); ++t) {
        const Curve hat = glowHat(image.nm, t);
        addTerm({{{&hat}, factor}});
    }
    endLobe(lobe);
}

// What a mirror shows in place of lights: Fresnel's functions of the angle times the image's bands.
void TermBuilder::addReflection(const TextureUse& use, const std::vector<AngleFunction>& fresnel,
                                const std::vector<Curve>& spectra) {
    std::vector<std::vector<sd_piece>> tables;
    for (const AngleFunction& f : fresnel)
        tables.push_back(tabulate(f));
    const Image image = spectralTexture(use);
    sd_lobe lobe = beginLobe(SD_LOBE_REFLECTION);
    lobe.table = addTables(tables);
    lobe.functions = static_cast<sd_uint>(fresnel.size());
    lobe.mapping = mappingOf(use);
    lobe.texture = image.number;
    for (const Curve& spectrum : spectra)
        for (size_t t = 0; t < image.nm.size(); ++t) {
            const Curve hat = glowHat(image.nm, t);
            addTerm({{{&spectrum, &hat}}});
        }
    endLobe(lobe);
}

Entry TermBuilder::entryOf(const Base& base) {
    return {base.in.inside, base.in.weight};
}

sd_lobe TermBuilder::beginBase(const Base& base) const {
    sd_lobe lobe = beginLobe(base.type);
    lobe.table = base.out.table;
    if (base.type == SD_LOBE_COATED) {
        lobe.table_light = base.in.table;
        lobe.mean_through = static_cast<float>(base.in.meanThrough);
        setWidths(lobe, base.widths);
    }
    return lobe;
}

double TermBuilder::glowFactor(const Base& base, const LightGroup& group) {
    return passedOn(base.out.meanThrough, group) * base.glowShare;
}

void TermBuilder::addBaseTerm(const Base& base, const LightGroup& group, const std::vector<Curve>& reflected,
                              const std::vector<Curve>& glow, double sign) {
    const double factor = passedOn(base.out.meanThrough, group);
    std::vector<Summand> sum;
    const auto add = [&](std::vector<const Curve*> product, double f) {
        if (base.out.weight) product.push_back(base.out.weight);
        sum.push_back({std::move(product), f});
    };
    if (only_ != Only::fluorescence)
        for (const Curve& curve : reflected)
            add({&group.spectrum, &curve}, factor);
    const bool glows = only_ != Only::reflection && !glow.empty();
    if (glows)
        for (const Curve& curve : glow)
            add({&curve}, glowFactor(base, group) * sign);
    // A polynomial's weights, and what a texture takes from a glow, are signed by nature; else only noise of
    // a measured matrix is.
    addTerm(sum, !base.out.weight && !base.in.weight && sign > 0, glows);
}

void TermBuilder::addBase(const Material& material, const Base& base) {
    if (material.diffuse && material.diffuse->texture) {
        addTexturedBase(material, base);
        return;
    }
    // Each choice of a picture is a base of its own.
    const Select* select =
        material.diffuse && material.diffuse->select ? &*material.diffuse->select : nullptr;
    std::vector<FluorescentBase> bases;
    if (select)
        for (const Select::Choice& choice : select->choices)
            bases.emplace_back(withReflectance(material, choice.reflectance.curve()), base.out.inside, notes_,
                               entryOf(base));
    else
        bases.emplace_back(material, base.out.inside, notes_, entryOf(base));
    const auto isDark = [&](const FluorescentBase& b) {
        return base.glows ? b.isBlack() : b.reflectsNothing();
    };
    if (std::all_of(bases.begin(), bases.end(), isDark)) return;
    const std::uint32_t texture = select ? shareTexture(*select) : 0;
    std::vector<size_t> everywhere;
    for (size_t i = 0; i < material.fluorescence.size() && base.glows; ++i)
        if (!material.fluorescence[i].mask) everywhere.push_back(i);

    if (base.reflects || !everywhere.empty()) {
        sd_lobe lobe = beginBase(base);
        lobe.texture = texture;
        for (const FluorescentBase& b : bases) {
            const std::vector<Curve> reflected =
                base.reflects ? std::vector{b.reflectance()} : std::vector<Curve>{};
            for (const LightGroup& group : groups_)
                addBaseTerm(base, group, reflected, b.reradiation(group.spectrum, everywhere));
        }
        endLobe(lobe);
    }
    if (only_ == Only::reflection || !base.glows) return;
    for (size_t i = 0; i < material.fluorescence.size(); ++i) {
        if (!material.fluorescence[i].mask) continue;
        const std::uint32_t strength = strengthTexture(*material.fluorescence[i].mask);
        sd_lobe glowing = beginBase(base);
        glowing.texture = texture;
        glowing.strength = strength;
        for (const FluorescentBase& b : bases)
            for (const LightGroup& group : groups_)
                addBaseTerm(base, group, {}, b.reradiation(group.spectrum, std::array{i}));
        endLobe(glowing);
    }
}

// A texel's reflectance is Σ ρ_t hat_t(λ), so light × hat_t is a term for each wavelength t, exact for any
// lamp. Under a coat that sends light back it is no longer linear between the wavelengths: more nodes, with
// polynomials for hats. Fluorophores absorb x (1 − Σ ρ_t hat_t) = x − Σ ρ_t x hat_t: what they send out on a
// black base, less a term for each wavelength that they absorb at.
void TermBuilder::addTexturedBase(const Material& material, const Base& base) {
    if (only_ == Only::fluorescence && material.fluorescence.empty()) return;
    const double inside = std::max(base.in.inside, base.out.inside);
    const Image image = spectralTexture(*material.diffuse->texture);
    // A coat sends light back to the base again and again: above 1 / inside each time would bring more.
    if (inside > 0) {
        const double most = largestTexel(world_, image.number);
        if (most * inside >= 1)
            throw InputError(
                material.diffuse->texture->where,
                fmt::format("{} has a reflectance of {}: under a coat, which sends light back to it, that "
                            "is light without end (allowed: below {})",
                            material.diffuse->texture->source, rounded(most, 4), rounded(1 / inside, 4)));
    }
    const int steps = stepsFor(world_, image.number, inside, 1);
    const size_t nodes = nodeCount(image.nm, steps);
    const bool together = inside <= 0;  // else what glows is not linear in the texel either
    Material black = material;
    black.diffuse.reset();
    const Entry entry = entryOf(base);
    const FluorescentBase onBlack(black, 0, notes_, entry);
    // Matrices do not know the base: only separable fluorophores depend on it.
    Material separable = material;
    std::erase_if(separable.fluorescence, [](const Fluorescence& part) { return !part.matrixFile.empty(); });
    std::vector<FluorescentBase> absorbing;
    if (together && base.glows && !separable.fluorescence.empty()) {
        for (size_t t = 0; t < nodes; ++t) {
            const Curve reflecting = Curve::combined({nodeCurve(image.nm, 1, t)},
                                                     [](std::span<const double> v) { return 1 - v[0]; });
            absorbing.emplace_back(withReflectance(separable, reflecting), 0, notes_, entry);
        }
    }
    const auto numbers = [](const Material& m, auto&& wanted) {
        std::vector<size_t> list;
        for (size_t i = 0; i < m.fluorescence.size(); ++i)
            if (wanted(m.fluorescence[i])) list.push_back(i);
        return list;
    };
    const auto unmasked = [](const Fluorescence& part) { return !part.mask; };

    if (base.reflects || !absorbing.empty()) {
        sd_lobe lobe = beginBase(base);
        lobe.texture = image.number;
        lobe.inside = static_cast<float>(base.out.inside);
        lobe.steps = steps;
        for (size_t t = 0; t < nodes; ++t) {
            const std::vector<Curve> reflected =
                base.reflects ? std::vector{nodeCurve(image.nm, steps, t)} : std::vector<Curve>{};
            for (const LightGroup& group : groups_)
                addBaseTerm(base, group, reflected,
                            absorbing.empty()
                                ? std::vector<Curve>{}
                                : absorbing[t].reradiation(group.spectrum, numbers(separable, unmasked)),
                            -1);
        }
        endLobe(lobe);
    }
    if (only_ == Only::reflection || !base.glows) return;
    if (!together) {
        addTexturedGlow(material, base, image);
        return;
    }
    const std::vector<size_t> everywhere = numbers(material, unmasked);
    if (!everywhere.empty()) {
        const sd_lobe glowing = beginBase(base);
        for (const LightGroup& group : groups_)
            addBaseTerm(base, group, {}, onBlack.reradiation(group.spectrum, everywhere));
        endLobe(glowing);
    }
    size_t nextSeparable = 0;
    for (size_t i = 0; i < material.fluorescence.size(); ++i) {
        const Fluorescence& part = material.fluorescence[i];
        const size_t own = part.matrixFile.empty() ? nextSeparable++ : 0;
        if (!part.mask) continue;
        sd_lobe glowing = beginBase(base);
        glowing.strength = strengthTexture(*part.mask);
        for (const LightGroup& group : groups_)
            addBaseTerm(base, group, {}, onBlack.reradiation(group.spectrum, std::array{i}));
        endLobe(glowing);
        if (!part.matrixFile.empty()) continue;
        sd_lobe taken = beginBase(base);
        taken.strength = glowing.strength;
        taken.texture = image.number;
        for (size_t t = 0; t < nodes; ++t)
            for (const LightGroup& group : groups_)
                addBaseTerm(base, group, {}, absorbing[t].reradiation(group.spectrum, std::array{own}), -1);
        endLobe(taken);
    }
}

}  // namespace spectrad
