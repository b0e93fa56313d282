#include "render/term_table.h"

#include "base/text.h"
#include "colour/display.h"
#include "colour/observe.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spectrad {

TermBuilder::TermBuilder(const Wavelengths& grid, const Eye& eye, std::vector<LightGroup> groups, Only only,
                         TextureLoader& textures, World& world, TermTable& terms, Notes& notes,
                         const Detector* exact)
    : grid_(grid),
      anyone_(seenByAnyone(grid, &eye.detector)),
      eye_(eye),
      groups_(std::move(groups)),
      only_(only),
      textures_(textures),
      world_(world),
      terms_(terms),
      notes_(notes),
      exact_(exact) {
    if (exact_) {
        const WavelengthSpan measured = seenByAnyone(grid, exact_);
        anyone_ = {std::min(anyone_.from, measured.from), std::max(anyone_.to, measured.to)};
    }
    terms_.bands = grid.size();
}

namespace {

float toFloat(double value) {
    const auto f = static_cast<float>(value);
    if (!std::isfinite(f))
        throw InputError("a light's radiance of " + shortest(value) +
                         " is beyond the range of float (3.4e38)");
    return f;
}

/// The layout's convention for previews: linear Rec.709 of ∫ L x̄ dλ and so on, without 683 lm/W. Summed over
/// wavelengths a radiance within float may go beyond: a preview is then as bright as it can be.
std::array<float, 3> previewFrom(const Triple& xyz) {
    static const Display rec709 = srgbDisplay();
    const Triple rgb = rec709.fromXyz * xyz;
    const auto held = [](double value) {
        constexpr double most = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp(value, -most, most));
    };
    return {held(rgb[0]), held(rgb[1]), held(rgb[2])};
}

Triple added(Triple xyz, const Eye& eye, std::span<const Curve* const> product, double factor) {
    const Triple seen = seenXyz(eye, product);
    for (size_t c = 0; c < 3; ++c)
        xyz[c] += seen[c] * factor / luminousEfficacy;
    return xyz;
}

TermRecipe recipeOf(const std::vector<Summand>& sum, const std::vector<LightGroup>& groups, bool glows) {
    TermRecipe recipe;
    recipe.group = TermRecipe::unknown;
    // What glows under a lamp depends on it by more than a factor.
    if (sum.size() != 1 || glows) return recipe;
    const Summand& part = sum.front();
    std::uint32_t group = TermRecipe::none;
    for (const Curve* curve : part.product) {
        const auto light = std::find_if(groups.begin(), groups.end(),
                                        [&](const LightGroup& g) { return &g.spectrum == curve; });
        if (light == groups.end())
            recipe.response.push_back(*curve);
        else
            group = static_cast<std::uint32_t>(light - groups.begin());
    }
    recipe.factor = part.factor;
    if (group != TermRecipe::none) {
        if (groups[group].factor == 0) return recipe;  // a light that is off hides the factor
        recipe.factor /= groups[group].factor;
    }
    recipe.group = group;
    return recipe;
}

}  // namespace

std::array<float, 3> relit(const TermRecipe& recipe, const LightGroup& group, const Eye& eye) {
    std::vector<const Curve*> product;
    double factor = recipe.factor;
    if (recipe.group != TermRecipe::none) {
        product.push_back(&group.spectrum);
        factor *= group.factor;
    }
    for (const Curve& curve : recipe.response)
        product.push_back(&curve);
    return previewFrom(added({}, eye, product, factor));
}

void TermBuilder::addTerm(const std::vector<Summand>& sum, bool clip, bool glows) {
    std::vector<double> bands(grid_.size(), 0.0);
    Triple xyz{};
    for (const Summand& part : sum) {
        const std::vector<double> values = project(grid_, part.product);
        for (size_t j = 0; j < bands.size(); ++j)
            bands[j] += values[j] * part.factor;
        xyz = added(xyz, eye_, part.product, part.factor);
    }
    if (clip) {
        const auto below = std::count_if(bands.begin(), bands.end(), [](double v) { return v < 0; });
        if (below > 0)
            notes_.say(fmt::format(
                "{} bands of a fluorescent material below zero under one light: set to zero", below));
        for (double& value : bands)
            value = std::max(value, 0.0);
    }
    // What is nothing beside the term's own peak (a Gaussian's tail) is not missed.
    constexpr double negligible = 1e-12;
    double peak = 0;
    for (double value : bands)
        peak = std::max(peak, std::abs(value));
    for (double value : bands) {
        terms_.spectra.push_back(toFloat(value));
        if (terms_.spectra.back() == 0 && std::abs(value) > negligible * peak) ++lost_;
    }
    if (exact_) addExact(sum, bands);
    const std::array<float, 3> preview = previewFrom(xyz);
    terms_.preview.insert(terms_.preview.end(), preview.begin(), preview.end());
    terms_.recipes.push_back(recipeOf(sum, groups_, glows));
}

void TermBuilder::noteLost() const {
    if (lost_ > 0)
        notes_.warn(fmt::format(
            "{} band values of light times surface below the range of float (1.4e-45) became zero", lost_));
}

void TermBuilder::addExact(const std::vector<Summand>& sum, const std::vector<double>& bands) {
    terms_.exactSpectra.insert(terms_.exactSpectra.end(), bands.begin(), bands.end());
    std::vector<double> channels(exact_->size(), 0.0);
    for (const Summand& part : sum) {
        const std::vector<double> seen = respond(*exact_, part.product);
        for (size_t c = 0; c < channels.size(); ++c)
            channels[c] += seen[c] * part.factor;
    }
    terms_.exactChannels.insert(terms_.exactChannels.end(), channels.begin(), channels.end());
}

void TermBuilder::addGroupTerms(const Curve& response, double factor) {
    for (const LightGroup& group : groups_)
        addTerm({{{&group.spectrum, &response}, group.factor * factor}});
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
    lobe.steps = 1;
    return lobe;
}

void TermBuilder::endLobe(const sd_lobe& lobe) {
    world_.lobes.push_back(lobe);
    sd_material& m = world_.materials.back();
    m.lobes = static_cast<sd_uint>(world_.lobes.size()) - m.first_lobe;
    m.terms = static_cast<sd_uint>(terms_.count()) - m.first_term;
}

std::uint32_t TermBuilder::addTables(const std::vector<std::vector<sd_piece>>& tables) {
    const auto first = static_cast<std::uint32_t>(world_.tables.size());
    for (const auto& table : tables)
        world_.tables.insert(world_.tables.end(), table.begin(), table.end());
    return first;
}

void TermBuilder::addBackground(const Emitter* background, double factor) {
    beginMaterial();
    if (!background || only_ != Only::everything) return;
    const sd_lobe lobe = beginLobe(SD_LOBE_EMISSION);
    addTerm({{{&background->spectrum.curve()}, factor}});
    endLobe(lobe);
}

void TermBuilder::addBackdrop(const TextureUse& use, double factor) {
    beginMaterial();
    if (only_ == Only::everything) addGlowing(use, factor);
}

}  // namespace spectrad
