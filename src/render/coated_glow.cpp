// Fluorescence below a coat whose optics depend on the wavelength: light comes in by the coat's figures at
// the exciting wavelengths, and gets out by those at the emitted ones. A sum over pairs of nodes, values of
// the coat's number on the way in and on the way out, each a product of what the two coats pass and a
// spectrum.
#include "render/coat.h"
#include "render/fluorescence.h"
#include "render/rough.h"
#include "render/term_table.h"

#include <algorithm>
#include <limits>

namespace spectrad {

namespace {

using Range = std::optional<std::pair<double, double>>;

/// Hull of ranges; one without ends is as wide as what anyone sees.
class Hull {
  public:
    explicit Hull(WavelengthSpan anyone) : anyone_(anyone) {}
    void include(const Range& range, const Range& within = std::nullopt) {
        const auto [from, to] = range.value_or(std::pair(-infinite, infinite));
        const auto [first, last] = within.value_or(std::pair(-infinite, infinite));
        const double low = std::max(from, first), high = std::min(to, last);
        if (low > high) return;
        from_ = std::min(from_, low > -infinite ? low : std::min(anyone_.from, high));
        to_ = std::max(to_, high < infinite ? high : std::max(anyone_.to, low));
    }
    [[nodiscard]] WavelengthSpan span() const { return from_ <= to_ ? WavelengthSpan{from_, to_} : anyone_; }

  private:
    static constexpr double infinite = std::numeric_limits<double>::infinity();
    WavelengthSpan anyone_;
    double from_ = infinite, to_ = -infinite;
};

struct GlowSpans {
    WavelengthSpan excited, emitted;
};

/// Where fluorophores take light of the groups, and where somebody sees what they send out.
GlowSpans spansOf(const Material& material, const std::vector<LightGroup>& groups, WavelengthSpan anyone) {
    Notes said;  // whoever adds the base says it
    const FluorescentBase base(material, 0, said);
    const Range seen = std::pair(anyone.from, anyone.to);
    Hull excited(anyone), emitted(anyone);
    const auto include = [&](const Range& excitation, const Range& emission) {
        for (const LightGroup& group : groups)
            excited.include(excitation, group.spectrum.range());
        emitted.include(emission, seen);
    };
    for (const auto& part : base.separable())
        include(part.excitation.range(), part.emission.range());
    for (const auto& part : base.bispectral())
        include(std::pair(part.bandFrom.front(), part.bandTo.back()),
                std::pair(part.emission.front(), part.emission.back()));
    return {excited.span(), emitted.span()};
}

/// What of the light belongs to a node; nothing where there is one.
std::optional<Curve> weightOf(const Nodes& nodes, size_t i, const Curve& number) {
    if (nodes.at.size() == 1) return std::nullopt;
    return Curve::combined({number}, [nodes, i](std::span<const double> v) { return nodes.weight(i, v[0]); });
}

}  // namespace

bool TermBuilder::glowsApart(const Material& material, const Curve& number) const {
    if (material.fluorescence.empty() || groups_.empty() || number.isConstant()) return false;
    const auto [excited, emitted] = spansOf(material, groups_, anyone_);
    const WavelengthSpan all{std::min({excited.from, emitted.from, anyone_.from}),
                             std::max({excited.to, emitted.to, anyone_.to})};
    return nodesFor(number, all).at.size() > 1;
}

void TermBuilder::addCoatedGlow(const Material& material, CoatModel model, const Curve& number,
                                Widths widths) {
    if (only_ == Only::reflection) return;
    const auto [excited, emitted] = spansOf(material, groups_, anyone_);
    const Nodes in = nodesForWay(Way::in, model, number, excited, widths),
                out = nodesForWay(Way::out, model, number, emitted, widths);
    std::vector<Passage> exits;
    std::vector<std::optional<Curve>> weights;
    const auto passage = [&](const Coat& coat, const std::optional<Curve>& weight) {
        return Passage{weight ? &*weight : nullptr, addTables(tablesOf(coat.through)), coat.meanThrough,
                       coat.inside};
    };
    for (size_t j = 0; j < out.at.size(); ++j)
        weights.push_back(weightOf(out, j, number));
    for (size_t j = 0; j < out.at.size(); ++j)
        exits.push_back(passage(coatOver(material, model, out.at[j], widths), weights[j]));
    for (size_t i = 0; i < in.at.size(); ++i) {
        const std::optional<Curve> weight = weightOf(in, i, number);
        const Coat coat = coatOver(material, model, in.at[i], widths);
        Base base;
        base.type = SD_LOBE_COATED;
        base.reflects = false;
        base.widths = widths;
        base.index = coat.index;
        base.in = passage(coat, weight);
        if (material.diffuse && material.diffuse->roughnessDegrees > 0) {
            const OrenNayar rough = orenNayar(material.diffuse->roughnessDegrees);
            base.glowShare = roughBelow(rough, roundMean(coat.through, widths), coat.index, coat.inside)
                                 .shareOfGlow(coat.inside, rough.mean);
        }
        for (const Passage& exit : exits) {
            base.out = exit;
            addBase(material, base);
        }
    }
}

}  // namespace spectrad
