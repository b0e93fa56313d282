// Fluorophores in a texture under a coat. With R = ρ (1 − r) / (1 − ρ r), what the coat leaves of a texel's
// reflectance ρ, they absorb x (1 − R), and what they send out is multiplied by 1 + R r / (1 − r) on its way
// through the coat: a product of two functions of the texel, at two wavelengths. It is worked out texel by
// texel, as an image of its own whose bands are the emission's shares at the texture's wavelengths, and at as
// many places between them as bring both functions, taken as polynomials through these, within a tolerance.
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

/// Of both functions' values. What a texel takes in and sends out is a product of the two.
constexpr double tolerance = 3e-5;

/// The places between a texture's wavelengths that its texels are known at.
struct Places {
    std::vector<double> nm;  ///< the texture's
    int steps = 1;           ///< of each interval
    [[nodiscard]] size_t count() const { return nodeCount(nm, steps); }
    [[nodiscard]] Curve curve(size_t n) const { return nodeCurve(nm, steps, n); }
    /// Where curve() is not 0, within a range if there is one.
    [[nodiscard]] std::pair<double, double> support(
        size_t n, const std::optional<std::pair<double, double>>& range = {}) const {
        auto [from, to] = nodeSupport(nm, steps, n);
        if (range) {
            from = std::clamp(from, range->first, range->second);
            to = std::clamp(to, range->first, range->second);
        }
        return {from, to};
    }
};

/// Σ weight · value over nodes.
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
Glow glowOf(const FluorescentBase::Separable& part, const Curve& light, const Curve* weightIn,
            const Places& nodes, double inside) {
    Glow glow;
    const double factor = part.factor * (1 - inside);
    // What is absorbed and what is sent out beside less than a billionth of all of it counts for nothing.
    constexpr double negligible = 1e-9;
    const std::array<const Curve*, 1> emission{&part.emission};
    const double allEmitted = integrate(emission);
    const auto emitted = part.emission.range(), excited = part.excitation.range();
    std::vector<Curve> weights{part.excitation, wavelength()};
    const Cumulative everything(weights, light, excited);
    if (weightIn) weights.push_back(*weightIn);
    weights.emplace_back();
    const auto ends = [](const std::pair<double, double>& range) {
        return std::isfinite(range.first) && std::isfinite(range.second);
    };
    std::vector<Cumulative> taken;
    std::vector<bool> takes;
    for (size_t t = 0; t < nodes.count(); ++t) {
        const auto within = nodes.support(t, excited);
        weights.back() = nodes.curve(t);
        taken.emplace_back(weights, light, ends(within) ? std::optional(within) : std::nullopt);
        takes.push_back(everything.upTo(within.second) - everything.upTo(within.first) >
                        negligible * everything.total());
    }
    for (size_t s = 0; s < nodes.count(); ++s) {
        const auto [from, to] = nodes.support(s);
        const auto within = nodes.support(s, emitted);
        if (ends(within) &&
            integrate(emission, within.first, within.second) < negligible * std::abs(allEmitted))
            continue;
        const Curve hat = nodes.curve(s);
        const NodeSum out{{{s, 1.0}}};
        NodeSum before;
        double most = 0;
        for (size_t t = 0; t < nodes.count(); ++t) {
            const auto [begin, end] = nodes.support(t);
            if (!takes[t] || (begin >= to && !part.antiStokes)) continue;
            if (end <= from || part.antiStokes) {
                before.weights.emplace_back(t, taken[t].total());
                most += std::abs(taken[t].total());
            } else {
                glow.bands.push_back({out, {{{t, 1.0}}}, {part.emission, hat, curveOf(taken[t])}, factor});
            }
        }
        if (most == 0) continue;
        for (auto& weight : before.weights)
            weight.second /= most;
        glow.bands.push_back({out, before, {part.emission, hat}, factor * most});
    }
    return glow;
}

/// A band for each row of the matrix and each node within its hat.
Glow glowOf(const FluorescentBase::Bispectral& part, const Curve& light, const Curve* weightIn,
            const Places& nodes, double inside) {
    Glow glow;
    glow.absorbs = false;
    const size_t count = nodes.count(), columns = part.bandCentre.size();
    std::vector<Curve> hats;
    for (size_t t = 0; t < count; ++t)
        hats.push_back(nodes.curve(t));
    std::vector<std::vector<double>> irradiance(columns);
    for (size_t i = 0; i < columns; ++i)
        for (size_t t = 0; t < count; ++t) {
            std::vector<const Curve*> each{&light, &hats[t]};
            if (weightIn) each.push_back(weightIn);
            irradiance[i].push_back(integrate(each, part.bandFrom[i], part.bandTo[i]) / part.width(i));
        }
    for (size_t row = 0; row < part.emission.size(); ++row) {
        std::vector<double> weights(count, 0.0);
        for (size_t i = 0; i < columns; ++i)
            for (size_t t = 0; t < count; ++t)
                weights[t] += part.value[row][i] * irradiance[i][t];
        const double most = std::accumulate(weights.begin(), weights.end(), 0.0,
                                            [](double sum, double w) { return sum + std::abs(w); });
        if (most == 0) continue;
        NodeSum in;
        for (size_t t = 0; t < count; ++t)
            if (weights[t] != 0) in.weights.emplace_back(t, weights[t] / most);
        std::vector<double> value(part.emission.size(), 0.0);
        value[row] = 1;
        const Curve sentOut = Curve::table(part.emission, std::move(value), Outside::zero);
        const double from = part.emission[row > 0 ? row - 1 : row],
                     to = part.emission[row + 1 < part.emission.size() ? row + 1 : row];
        for (size_t t = 0; t < count; ++t) {
            const auto [begin, end] = nodes.support(t);
            if (begin < to && end > from)
                glow.bands.push_back({{{{t, 1.0}}}, in, {sentOut, hats[t]}, most * (1 - inside)});
        }
    }
    return glow;
}

/// The image of a glow over a texture whose texels lie at `texels`, under a coat that reflects `in` of the
/// exciting light from inside and `out` of what is emitted.
Texels imageOf(const Glow& glow, const Places& nodes, const float* texels, const sd_texture& texture,
               double in, double out) {
    Texels image{texture.width, texture.height, static_cast<int>(glow.bands.size()), {}};
    const auto bands = static_cast<size_t>(texture.bands), steps = static_cast<size_t>(nodes.steps);
    std::vector<double> taken(nodes.count()), amplified(nodes.count());
    const size_t count = static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height);
    image.texels.reserve(count * glow.bands.size());
    for (size_t i = 0; i < count; ++i, texels += bands) {
        for (size_t t = 0; t < nodes.count(); ++t) {
            const size_t band = t / steps;
            const double further = static_cast<double>(t % steps) / nodes.steps;
            const double rho =
                further > 0 ? texels[band] * (1 - further) + texels[band + 1] * further : texels[band];
            taken[t] = (glow.absorbs ? std::max(0.0, 1 - rho) : 1) / (1 - rho * in);
            amplified[t] = 1 / (1 - rho * out);
        }
        for (const GlowBand& band : glow.bands)
            image.texels.push_back(static_cast<float>(band.out.of(amplified) * band.in.of(taken)));
    }
    return image;
}

}  // namespace

void TermBuilder::addTexturedGlow(const Material& material, const Base& base, const Image& image) {
    Material black = material;
    black.diffuse.reset();
    const double in = base.in.inside, out = base.out.inside;
    const FluorescentBase parts(black, out, notes_);
    const sd_texture texture = world_.textures[image.number - 1];
    const std::vector<float> reflectances = finestLevel(world_, image.number);
    const Places nodes{image.nm, stepsFor(world_, image.number, std::max(in, out), 0, tolerance)};
    const auto add = [&](const LightGroup& group, const Glow& glow, size_t number) {
        if (glow.bands.empty()) return;
        const auto& mask = material.fluorescence[number].mask;
        sd_lobe lobe = beginBase(base);
        if (mask) lobe.strength = strengthTexture(*mask);
        lobe.texture = addTexels(world_, imageOf(glow, nodes, reflectances.data(), texture, in, out),
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
                if (base.out.weight) product.push_back(base.out.weight);
                addTerm({{std::move(product), band.factor * glowFactor(base, group)}}, false, true);
            }
        endLobe(lobe);
    };
    for (const LightGroup& group : groups_) {
        for (const auto& part : parts.separable())
            add(group, glowOf(part, group.spectrum, base.in.weight, nodes, out), part.number);
        for (const auto& part : parts.bispectral())
            add(group, glowOf(part, group.spectrum, base.in.weight, nodes, out), part.number);
    }
}

}  // namespace spectrad
