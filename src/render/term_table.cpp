#include "render/term_table.h"

#include "base/text.h"
#include "colour/detector.h"
#include "colour/display.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

TermBuilder::TermBuilder(const Wavelengths& grid, const Detector& observer, std::vector<LightGroup> groups,
                         Only only, TextureLoader& textures, World& world, TermTable& terms, Notes& notes)
    : grid_(grid),
      observer_(observer),
      groups_(std::move(groups)),
      only_(only),
      textures_(textures),
      world_(world),
      terms_(terms),
      notes_(notes) {
    terms_.bands = grid.size();
}

void TermBuilder::addTerm(const std::vector<Summand>& sum, bool clip) {
    const auto toFloat = [](double value) {
        const auto f = static_cast<float>(value);
        if (!std::isfinite(f))
            throw InputError("a light's radiance of " + shortest(value) +
                             " is beyond the range of float (3.4e38)");
        return f;
    };
    std::vector<double> bands(grid_.size(), 0.0);
    Triple xyz{};
    for (const Summand& part : sum) {
        const std::vector<double> values = project(grid_, part.product);
        for (size_t j = 0; j < bands.size(); ++j)
            bands[j] += values[j] * part.factor;
        const std::vector<double> channels = respond(observer_, part.product);
        // The layout's convention for previews: ∫ L x̄ dλ and so on, without 683 lm/W.
        for (size_t c = 0; c < 3; ++c)
            xyz[c] += channels[c] * part.factor / luminousEfficacy;
    }
    if (clip) {
        const auto below = std::count_if(bands.begin(), bands.end(), [](double v) { return v < 0; });
        if (below > 0)
            notes_.say(fmt::format(
                "{} bands of a fluorescent material below zero under one light: set to zero", below));
        for (double& value : bands)
            value = std::max(value, 0.0);
    }
    for (double value : bands)
        terms_.spectra.push_back(toFloat(value));
    static const Display rec709 = srgbDisplay();
    for (double value : rec709.fromXyz* xyz)
        terms_.preview.push_back(toFloat(value));
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
