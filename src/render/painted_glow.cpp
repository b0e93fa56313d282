// Fluorophores in a texture under a coat. With R = ρ (1 − r) / (1 − ρ r), what the coat leaves of a texel's
// reflectance ρ, they absorb x (1 − R), and what they send out is multiplied by 1 + R r / (1 − r) on its way
// through the coat: a product of two functions of the texel, at two wavelengths. It is worked out texel by
// texel, as an image of its own whose bands are the emission's shares at the texture's wavelengths. Between
// these both functions are linear here: at most their values, so that no energy is gained, and the same where
// the texel is flat.
#include "render/cumulative.h"
#include "render/fluorescence.h"
#include "render/term_table.h"
#include "render/texels.h"
#include "render/texture_nodes.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace spectrad {

namespace {

/// Σ weight · value over a texture's nodes.
struct NodeSum {
    std::vector<std::pair<size_t, double>> weights;
    [[nodiscard]] double of(const std::vector<double>& values) const {
        return std::accumulate(weights.begin(), weights.end(), 0.0,
                               [&](double sum, const auto& w) { return sum + w.second * values[w.first]; });
    }
};

/// One band of the image: the texel's amplification where the light goes out times what it took in.
struct GlowBand {
    NodeSum out, in;
    std::vector<Curve> spectrum;  ///< the product of these, times the factor
    double factor = 1;
};

/// A fluorophore under one light: `in` sums 1 − R, or for a matrix the amplification itself.
struct Glow {
    std::vector<GlowBand> bands;
    bool absorbs = true;
};

Curve wavelength() {
    return Curve::formula([](double nm) { return nm; }, [](double, double, std::vector<double>&) {});
}

/// Photons taken in up to a wavelength, as a curve over it.
Curve curveOf(const Cumulative& taken) {
    return Curve::formula(
        [taken](double nm) { return taken.upTo(nm); },
        [taken](double from, double to, std::vector<double>& out) { taken.appendBreaks(from, to, out); });
}

/// What is absorbed at a node below all of another's is known when that one sends out; only where the two
/// overlap does it grow along with the emission, and needs a band of its own.
Glow glowOf(const FluorescentBase::Separable& part, const Curve& light, const std::vector<double>& nm,
            double inside) {
    Glow glow;
    const size_t nodes = nm.size();
    const double factor = part.factor * (1 - inside);
    // What is absorbed and what is sent out beside less than a millionth of all of it counts for nothing.
    constexpr double negligible = 1e-6;
    const std::array<const Curve*, 1> all{&part.emission};
    const double allEmitted = integrate(all);
    double allTaken = 0;
    std::vector<Cumulative> taken;
    const auto excited = part.excitation.range();
    for (size_t t = 0; t < nodes; ++t) {
        auto within = nodeSupport(nm, 1, t);
        if (excited) {
            within.first = std::clamp(within.first, excited->first, excited->second);
            within.second = std::clamp(within.second, excited->first, excited->second);
        }
        const bool ends = std::isfinite(within.first) && std::isfinite(within.second);
        taken.emplace_back(std::vector{part.excitation, nodeCurve(nm, 1, t), wavelength()}, light,
                           ends ? std::optional(within) : std::nullopt);
        allTaken += taken.back().total();
    }
    for (size_t s = 0; s < nodes; ++s) {
        const auto [from, to] = nodeSupport(nm, 1, s);
        const Curve hat = nodeCurve(nm, 1, s);
        const std::array<const Curve*, 2> emitted{&part.emission, &hat};
        if (integrate(emitted) < negligible * allEmitted) continue;
        const NodeSum out{{{s, 1.0}}};
        NodeSum before;
        double most = 0;
        for (size_t t = 0; t < nodes; ++t) {
            const auto [begin, end] = nodeSupport(nm, 1, t);
            const double total = taken[t].total();
            if (total <= negligible * allTaken || (begin >= to && !part.antiStokes)) continue;
            if (end <= from || part.antiStokes) {
                before.weights.emplace_back(t, total);
                most += std::abs(total);
            } else {
                glow.bands.push_back({out, {{{t, 1.0}}}, {part.emission, hat, curveOf(taken[t])}, factor});
            }
        }
        if (before.weights.empty()) continue;
        for (auto& weight : before.weights)
            weight.second /= most;
        glow.bands.push_back({out, before, {part.emission, hat}, factor * most});
    }
    return glow;
}

/// A band for each row of the matrix.
Glow glowOf(const FluorescentBase::Bispectral& part, const Curve& light, const std::vector<double>& nm,
            double inside) {
    Glow glow;
    glow.absorbs = false;
    const size_t nodes = nm.size(), columns = part.bandCentre.size();
    std::vector<Curve> hats;
    for (size_t t = 0; t < nodes; ++t)
        hats.push_back(nodeCurve(nm, 1, t));
    std::vector<std::vector<double>> irradiance(columns);
    for (size_t i = 0; i < columns; ++i)
        for (size_t t = 0; t < nodes; ++t) {
            const std::array<const Curve*, 2> each{&light, &hats[t]};
            irradiance[i].push_back(integrate(each, part.bandFrom[i], part.bandTo[i]) / part.width(i));
        }
    for (size_t row = 0; row < part.emission.size(); ++row) {
        std::vector<double> weights(nodes, 0.0);
        for (size_t i = 0; i < columns; ++i)
            for (size_t t = 0; t < nodes; ++t)
                weights[t] += part.value[row][i] * irradiance[i][t];
        const double most = std::accumulate(weights.begin(), weights.end(), 0.0,
                                            [](double sum, double w) { return sum + std::abs(w); });
        if (most == 0) continue;
        NodeSum in, out;
        for (size_t t = 0; t < nodes; ++t) {
            if (weights[t] != 0) in.weights.emplace_back(t, weights[t] / most);
            const double share = hats[t].at(part.emission[row]);
            if (share != 0) out.weights.emplace_back(t, share);
        }
        std::vector<double> value(part.emission.size(), 0.0);
        value[row] = 1;
        glow.bands.push_back(
            {out, in, {Curve::table(part.emission, std::move(value), Outside::zero)}, most * (1 - inside)});
    }
    return glow;
}

/// The image of a glow over a texture whose texels lie at `texels`.
Texels imageOf(const Glow& glow, const float* texels, const sd_texture& texture, double inside) {
    Texels image{texture.width, texture.height, static_cast<int>(glow.bands.size()), {}};
    const auto bands = static_cast<size_t>(texture.bands);
    std::vector<double> absorbed(bands), amplified(bands);
    const size_t count = static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height);
    image.texels.reserve(count * glow.bands.size());
    for (size_t i = 0; i < count; ++i, texels += bands) {
        for (size_t t = 0; t < bands; ++t) {
            const double rho = texels[t];
            absorbed[t] = std::max(0.0, 1 - rho) / (1 - rho * inside);
            amplified[t] = 1 / (1 - rho * inside);
        }
        for (const GlowBand& band : glow.bands)
            image.texels.push_back(
                static_cast<float>(band.out.of(amplified) * band.in.of(glow.absorbs ? absorbed : amplified)));
    }
    return image;
}

}  // namespace

void TermBuilder::addTexturedGlow(const Material& material, const Base& base, const Image& image) {
    Material black = material;
    black.diffuse.reset();
    const FluorescentBase parts(black, base.inside, notes_);
    const sd_texture texture = world_.textures[image.number - 1];
    const auto add = [&](const LightGroup& group, const Glow& glow, size_t number) {
        if (glow.bands.empty()) return;
        const auto& mask = material.fluorescence[number].mask;
        sd_lobe lobe = beginBase(base);
        if (mask) lobe.strength = strengthTexture(*mask);
        lobe.texture =
            addTexels(world_, imageOf(glow, world_.texels.data() + texture.first, texture, base.inside),
                      *material.diffuse->texture);
        for (const GlowBand& band : glow.bands)
            for (const LightGroup& other : groups_) {
                // An image of what glows belongs to one light.
                if (&other != &group) {
                    addTerm({});
                    continue;
                }
                std::vector<const Curve*> product;
                for (const Curve& curve : band.spectrum)
                    product.push_back(&curve);
                if (base.weight) product.push_back(base.weight);
                addTerm({{std::move(product), band.factor * glowFactor(base, group)}});
            }
        endLobe(lobe);
    };
    for (const LightGroup& group : groups_) {
        for (const auto& part : parts.separable())
            add(group, glowOf(part, group.spectrum, image.nm, base.inside), part.number);
        for (const auto& part : parts.bispectral())
            add(group, glowOf(part, group.spectrum, image.nm, base.inside), part.number);
    }
}

}  // namespace spectrad
