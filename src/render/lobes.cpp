// Materials as lobes: which reflectances depend on the angle (tables), which on the wavelength (terms), and
// how much of the light each leaves to the next, so that nothing gains energy.
#include "render/coat.h"
#include "render/facets.h"
#include "render/fresnel.h"
#include "render/term_table.h"
#include "scene/pass_needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace spectrad {

namespace {

constexpr double inversePi = 1 / std::numbers::pi;

/// Appends tables of the coefficients of 1 − the function.
void appendMissing(std::vector<std::vector<sd_piece>>& tables, const DirectionFunction& function) {
    for (size_t k = 0; k < function.size(); ++k) {
        const AngleFunction& f = function[k];
        const double unit = k == 0 ? 1 : 0;
        if (function.size() == 1)
            tables.push_back(tabulate([&](double c) { return std::max(0.0, 1 - f(c)); }));
        else
            tables.push_back(tabulate([&](double c) { return unit - f(c); }));
    }
}

void append(std::vector<std::vector<sd_piece>>& tables, std::vector<std::vector<sd_piece>> more) {
    std::move(more.begin(), more.end(), std::back_inserter(tables));
}

Widths widthsOf(const Roughness& roughness) {
    return {roughness.u * roughness.u, roughness.v * roughness.v};
}

const Curve& one() {
    static const Curve curve = Curve::constant(1);
    return curve;
}

}  // namespace

std::vector<std::vector<sd_piece>> TermBuilder::tablesOf(const DirectionFunction& function) {
    std::vector<std::vector<sd_piece>> tables;
    for (const AngleFunction& f : function)
        tables.push_back(tabulate(f));
    return tables;
}

void TermBuilder::addCoatedBase(const Material& material, const Curve& weight, const Coat& coat,
                                Widths widths, bool glows) {
    Base base;
    base.type = coat.through.empty() ? SD_LOBE_DIFFUSE : SD_LOBE_COATED;
    base.widths = widths;
    base.index = coat.index;
    base.glows = glows;
    base.out.meanThrough = coat.meanThrough;
    base.out.inside = coat.inside;
    if (&weight != &one()) base.out.weight = &weight;
    if (material.diffuse && material.diffuse->roughnessDegrees > 0) {
        addRough(material, base, coat.through);
        if (material.fluorescence.empty() || only_ == Only::reflection || !glows) return;
        base.reflects = false;
    }
    if (!coat.through.empty()) base.out.table = addTables(tablesOf(coat.through));
    base.in = base.out;
    addBase(material, base);
}

void TermBuilder::setWidths(sd_lobe& lobe, Widths widths) {
    lobe.alpha = static_cast<float>(widths.u);
    if (!widths.isotropic()) lobe.alpha_v = static_cast<float>(widths.v);
}

void TermBuilder::addFacets(const std::vector<AngleFunction>& fresnel, const std::vector<Curve>& spectra,
                            Widths widths, const std::optional<TextureUse>& reflects) {
    if (reflects) {
        addReflection(*reflects, fresnel, spectra);
        return;
    }
    const FacetAlbedos facets = facetAlbedos(fresnel, widths);
    std::vector<std::vector<sd_piece>> tables;
    appendMissing(tables, facets.white);
    for (const DirectionFunction& f : facets.albedo)
        append(tables, tablesOf(f));
    for (const AngleFunction& f : fresnel)
        tables.push_back(tabulate(f));
    sd_lobe lobe = beginLobe(SD_LOBE_FACETS);
    lobe.table = addTables(tables);
    lobe.functions = static_cast<sd_uint>(fresnel.size());
    lobe.multiple_to = lobe.functions;
    setWidths(lobe, widths);
    const double missing = 1 - facets.whiteMean;
    lobe.multiple = static_cast<float>(missing > 1e-6 ? inversePi / missing : 0);
    for (const Curve& spectrum : spectra)
        addGroupTerms(spectrum);
    // Light that bounces between facets takes the metal's colour once more each time; its mean reflectance is
    // the same sum.
    std::vector<double> means;
    for (const AngleFunction& f : fresnel)
        means.push_back(cosineMean(f));
    const double white = facets.whiteMean;
    addGroupTerms(Curve::combined(spectra, [means, white](std::span<const double> v) {
        double mean = 0;
        for (size_t i = 0; i < means.size(); ++i)
            mean += means[i] * v[i];
        return multipleScattering(std::clamp(mean, 0.0, 1.0), white);
    }));
    endLobe(lobe);
}

void TermBuilder::addGloss(const Material& material) {
    const Curve& ior = material.gloss->ior.curve();
    const Nodes nodes = nodesOfGlass(ior, seenByBands(grid_), anyone_);
    const Widths widths = widthsOf(material.gloss->roughness);
    const bool apart = glowsApart(material, ior);
    for (size_t i = 0; i < nodes.at.size() && !(apart && only_ == Only::fluorescence); ++i) {
        const double n = nodes.at[i];
        const Curve polynomial =
            Curve::combined({ior}, [nodes, i](std::span<const double> v) { return nodes.weight(i, v[0]); });
        const Curve& weight = nodes.at.size() == 1 ? one() : polynomial;
        const Coat coat = coatOver(material, CoatModel::glass, n, widths);
        addCoatedBase(material, weight, coat, widths, !apart);
        if (only_ == Only::fluorescence) continue;
        if (material.gloss->reflects) {
            addReflection(*material.gloss->reflects, {fresnelOf(CoatModel::glass, n)}, {weight});
            continue;
        }
        sd_lobe lobe = beginLobe(SD_LOBE_FACETS);
        std::vector<std::vector<sd_piece>> tables;
        appendMissing(tables, coat.facets.white);
        append(tables, tablesOf(coat.albedo));
        tables.push_back(tabulate(fresnelOf(CoatModel::glass, n)));
        lobe.table = addTables(tables);
        lobe.functions = 1;
        lobe.multiple_to = 0;
        setWidths(lobe, widths);
        lobe.multiple = static_cast<float>(coat.multiple);
        addGroupTerms(weight);
        endLobe(lobe);
    }
    if (apart) addCoatedGlow(material, CoatModel::glass, ior, widths);
}

void TermBuilder::addSpecular(const Material& material) {
    const Curve& r0 = material.specular->reflectance.curve();
    const Nodes nodes = nodesFor(r0, anyone_);
    const Widths widths = widthsOf(material.specular->roughness);
    const bool apart = glowsApart(material, r0);
    for (size_t i = 0; i < nodes.at.size() && !(apart && only_ == Only::fluorescence); ++i) {
        const Curve polynomial =
            Curve::combined({r0}, [nodes, i](std::span<const double> v) { return nodes.weight(i, v[0]); });
        const Curve& weight = nodes.at.size() == 1 ? one() : polynomial;
        addCoatedBase(material, weight, coatOver(material, CoatModel::measured, nodes.at[i], widths), widths,
                      !apart);
    }
    if (apart) addCoatedGlow(material, CoatModel::measured, r0, widths);
    if (only_ == Only::fluorescence) return;
    addFacets(
        {[](double c) { return 1 - fresnelSchlick(c, 0); }, [](double c) { return fresnelSchlick(c, 0); }},
        {r0, one()}, widths, material.specular->reflects);
}

void TermBuilder::addConductor(const Material& material) {
    const Conductor& metal = *material.conductor;
    const Curve &n = metal.ior.curves.at(0), &k = metal.ior.curves.at(1);
    const Widths widths = widthsOf(metal.roughness);
    const auto [from, to] = anyone_;
    if (only_ == Only::fluorescence) return;
    const FresnelBasis basis = metal.schlick ? schlickBasis(n, k) : conductorBasis(n, k, from, to);
    if (metal.schlick)
        notes_.say(fmt::format("material '{}': Schlick's formula is off by up to {:.3f} in reflectance",
                               material.name, schlickError(n, k, from, to)));
    if (!basis.angle.empty()) addFacets(basis.angle, basis.spectrum, widths, metal.reflects);
}

std::uint32_t TermBuilder::add(const Material& material, double emissionFactor) {
    const auto refuse = [&](const char* what) {
        throw InputError(material.where, "material '" + material.name + "': " + what);
    };
    if (material.conductor &&
        (material.diffuse || material.gloss || material.specular || !material.fluorescence.empty()))
        refuse(
            "a <conductor> is opaque and bare: it goes with no <diffuse>, <gloss>, <specular> or "
            "<fluorescence>");
    if (material.gloss && material.specular)
        refuse("<gloss> and <specular> both describe the surface: give one of them");

    const std::uint32_t number = beginMaterial();
    if (material.relief && !groups_.empty()) world_.materials.back().relief = reliefTexture(*material.relief);
    if (material.emission && only_ == Only::everything) {
        if (material.emission->texture)
            addGlowing(*material.emission->texture, emissionFactor);
        else {
            const sd_lobe lobe = beginLobe(SD_LOBE_EMISSION);
            addTerm({{{&material.emission->spectrum.curve()}, emissionFactor}});
            endLobe(lobe);
        }
    }
    if (groups_.empty() && !reflectionOf(material)) return number;
    if (material.conductor)
        addConductor(material);
    else if (material.gloss)
        addGloss(material);
    else if (material.specular)
        addSpecular(material);
    else if (material.diffuse || !material.fluorescence.empty())
        addCoatedBase(material, one(), {}, 0, true);
    return number;
}

}  // namespace spectrad
