#include "render/term_table.h"

#include "base/text.h"
#include "colour/detector.h"
#include "colour/display.h"
#include "render/coat_albedo.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

constexpr double inversePi = 1 / std::numbers::pi;

/// Indices at which a dispersive coat is evaluated: the coat's response, smooth in n, is a polynomial through them.
struct IndexNodes {
    std::vector<double> n;
    /// Lagrange weight of node i at index `at`.
    [[nodiscard]] double weight(size_t i, double at) const {
        double w = 1;
        for (size_t k = 0; k < n.size(); ++k)
            if (k != i) w *= (at - n[k]) / (n[i] - n[k]);
        return w;
    }
};

IndexNodes indexNodes(const Curve& ior) {
    const auto [low, high] = ior.bounds();
    if (high - low < 1e-9 * high) return {{0.5 * (low + high)}};
    // Chebyshev nodes; four of them leave less than 1e-6 of the reflectance for any glass.
    constexpr int count = 4;
    IndexNodes nodes;
    for (int i = 0; i < count; ++i)
        nodes.n.push_back(0.5 * (low + high) + 0.5 * (high - low) * std::cos(std::numbers::pi * (i + 0.5) / count));
    return nodes;
}

}  // namespace

TermBuilder::TermBuilder(const Wavelengths& grid, const Detector& observer, std::vector<LightGroup> groups, World& world,
                         TermTable& terms)
    : grid_(grid), observer_(observer), groups_(std::move(groups)), world_(world), terms_(terms) {
    terms_.bands = grid.size();
}

void TermBuilder::addTerm(std::vector<const Curve*> product, double factor) {
    const auto toFloat = [](double value, const char* what) {
        const auto f = static_cast<float>(value);
        if (!std::isfinite(f))
            throw InputError(std::string(what) + " " + shortest(value) + " is beyond the range of float (3.4e38)");
        return f;
    };
    for (double value : project(grid_, product)) terms_.spectra.push_back(toFloat(value * factor, "a light's radiance"));
    static const Display rec709 = srgbDisplay();
    Triple xyz{};
    const std::vector<double> channels = respond(observer_, product);
    // The layout's convention for previews: ∫ L x̄ dλ and so on, without 683 lm/W.
    for (size_t c = 0; c < 3; ++c) xyz[c] = channels[c] * factor / luminousEfficacy;
    for (double value : rec709.fromXyz * xyz) terms_.preview.push_back(toFloat(value, "a light's colour"));
}

void TermBuilder::addGroupTerms(const Curve& response) {
    for (const LightGroup& group : groups_) addTerm({&group.spectrum, &response}, group.factor);
}

std::uint32_t TermBuilder::beginMaterial() {
    sd_material m{};
    m.first_lobe = static_cast<sd_uint>(world_.lobes.size());
    m.first_term = static_cast<sd_uint>(terms_.count());
    world_.materials.push_back(m);
    return static_cast<std::uint32_t>(world_.materials.size() - 1);
}

sd_lobe TermBuilder::beginLobe(int type) const {
    sd_lobe lobe{};
    lobe.type = type;
    lobe.term = static_cast<sd_uint>(terms_.count()) - world_.materials.back().first_term;
    lobe.mean_through = 1;
    lobe.weight = 1;
    return lobe;
}

void TermBuilder::endLobe(const sd_lobe& lobe) {
    world_.lobes.push_back(lobe);
    sd_material& m = world_.materials.back();
    m.lobes = static_cast<sd_uint>(world_.lobes.size()) - m.first_lobe;
    m.terms = static_cast<sd_uint>(terms_.count()) - m.first_term;
}

void TermBuilder::addBackground(const Emitter* background, double factor) {
    beginMaterial();
    if (!background) return;
    const sd_lobe lobe = beginLobe(SD_LOBE_EMISSION);
    addTerm({&background->spectrum.curve()}, factor);
    endLobe(lobe);
}

void TermBuilder::addCoat(const Gloss& gloss, const Curve& base) {
    const Curve& ior = gloss.ior.curve();
    const IndexNodes nodes = indexNodes(ior);
    const double alpha = gloss.roughness * gloss.roughness;
    for (size_t i = 0; i < nodes.n.size(); ++i) {
        const CoatAlbedo coat = coatAlbedo(nodes.n[i], alpha);
        const auto table = static_cast<sd_uint>(world_.tables.size());
        world_.tables.insert(world_.tables.end(), coat.table.begin(), coat.table.end());

        sd_lobe below = beginLobe(SD_LOBE_COATED);
        below.table = table;
        below.mean_through = static_cast<float>(coat.meanThrough);
        // The base sees what comes through, again and again: ρ (1 − r) / (1 − ρ r), r the coat's reflectance from inside.
        const double r = coat.insideReflectance, through = std::max(coat.meanThrough, 1e-12);
        addGroupTerms(Curve::combined({base, ior}, [=](std::span<const double> v) {
            return nodes.weight(i, v[1]) * inversePi * v[0] * (1 - r) / ((1 - v[0] * r) * through);
        }));
        endLobe(below);

        sd_lobe above = beginLobe(SD_LOBE_COAT);
        above.table = table;
        above.alpha = static_cast<float>(alpha);
        above.ior = static_cast<float>(nodes.n[i]);
        above.multiple = static_cast<float>(coat.multiple);
        addGroupTerms(Curve::combined({ior}, [=](std::span<const double> v) { return nodes.weight(i, v[0]); }));
        endLobe(above);
    }
}

std::uint32_t TermBuilder::add(const Material& material, double emissionFactor) {
    const auto refuse = [&](const char* what) {
        throw InputError(material.where, "material '" + material.name + "': " + what + " is not there yet");
    };
    if (material.conductor) refuse("<conductor>");
    if (material.specular) refuse("<specular>");
    if (!material.fluorescence.empty()) refuse("<fluorescence>");
    if (material.diffuse && material.diffuse->texture) refuse("texture=");
    if (material.diffuse && material.diffuse->roughnessDegrees != 0) refuse("roughness= of <diffuse>");

    const std::uint32_t number = beginMaterial();
    if (material.emission) {
        const sd_lobe lobe = beginLobe(SD_LOBE_EMISSION);
        addTerm({&material.emission->spectrum.curve()}, emissionFactor);
        endLobe(lobe);
    }
    if (groups_.empty()) return number;
    const Curve black = Curve::constant(0);
    const Curve& base = material.diffuse ? material.diffuse->reflectance->curve() : black;
    if (material.gloss) {
        addCoat(*material.gloss, base);
    } else if (material.diffuse) {
        const sd_lobe lobe = beginLobe(SD_LOBE_DIFFUSE);
        for (const LightGroup& group : groups_) addTerm({&group.spectrum, &base}, group.factor * inversePi);
        endLobe(lobe);
    }
    return number;
}

}  // namespace spectrad
