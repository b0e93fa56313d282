// Oren–Nayar's diffuse lobe, bare and under a coat.
#include "render/rough.h"

#include "render/picture_maps.h"
#include "render/term_table.h"
#include "render/texture_nodes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

namespace spectrad {

namespace {

/// ρ (1 − r) / (1 − ρ r)
double leftBy(double inside, double reflectance) {
    return reflectance * (1 - inside) / (1 - reflectance * inside);
}

}  // namespace

double RoughBelow::sentBack(double reflectance, double cosine, double whiteMean) const {
    const double multiple = missing(cosine) * escape, again = back(cosine),
                 returned = leftBy(insideOnce, reflectance) *
                            (insideAgain < 0 ? 1 : leftBy(insideAgain, reflectance));
    return reflectance * (1 - again - multiple) + multipleScattering(reflectance, whiteMean) * multiple +
           returned * again;
}

double RoughBelow::shareOfGlow(double inside, double whiteMean) const {
    double share = 1;
    for (double rho : {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 0.999})
        for (int i = 0; i <= 32; ++i) {
            const double cosine = std::pow(i / 32.0, 2);
            share = std::min(share, (1 - sentBack(rho, cosine, whiteMean)) / (1 - leftBy(inside, rho)));
        }
    return share;
}

RoughBelow roughBelow(const OrenNayar& model, const AngleFunction& through, double index, double inside) {
    const double n2 = index * index, ratio = model.b / model.a;
    const auto refracted = [n2](double cosine) { return std::sqrt(1 - (1 - cosine * cosine) / n2); };
    RoughBelow below;
    below.missing = [albedo = model.albedo, refracted](double cosine) {
        return std::max(0.0, 1 - albedo(refracted(cosine)));
    };
    // Directions that get out, by their cosines c = s² above the coat; 2 c dc / n² there is 2 c' dc' below.
    struct Exit {
        double above, cosine, sine, weight;
    };
    constexpr int count = 512;
    std::vector<Exit> exits;
    for (int i = 0; i < count; ++i) {
        const double s = (i + 0.5) / count, c = s * s;
        exits.push_back(
            {c, refracted(c), std::sqrt(1 - c * c) / index, through(c) * 4 * s * s * s / count / n2});
    }
    double missing = 0;
    for (const Exit& exit : exits)
        missing += exit.weight * below.missing(exit.above);
    below.escape = missing / std::max(1 - model.mean, 1e-12);
    constexpr int cells = 256;
    std::vector<double> back;
    for (int i = 0; i <= cells; ++i) {
        const double c = std::pow(static_cast<double>(i) / cells, 2), cosine = refracted(c),
                     sine = std::sqrt(1 - c * c) / index;
        // Over the azimuth s/t is sin sin' cos φ, divided by the larger cosine on the half where it is above
        // zero.
        double single = 0;
        for (const Exit& exit : exits)
            single += exit.weight * model.a *
                      (1 + ratio * sine * exit.sine * std::numbers::inv_pi *
                               (1 / std::max(cosine, exit.cosine) - 1));
        back.push_back(std::max(0.0, 1 - single - below.missing(c) * below.escape));
    }
    below.back = interpolated(std::move(back));
    double mean = 0;
    for (const Exit& exit : exits)
        mean += exit.weight * below.back(exit.above);
    below.rest = mean > 1e-9 ? 1 / mean : 0;
    // What the coat sends back is diffuse: the base's mean albedo, leftBy(1 − mean, ρ), colours it, and with
    // a known index the bounces between base and coat once more, leftBy(inside, mean albedo).
    below.insideOnce = 1 - model.mean;
    if (inside > 0) {
        below.insideAgain = below.insideOnce;
        below.insideOnce = 1 - model.mean * (1 - inside);
    }
    return below;
}

void TermBuilder::addRough(const Material& material, Base& base, const DirectionFunction& through) {
    const OrenNayar model = orenNayar(material.diffuse->roughnessDegrees);
    const bool coated = base.type == SD_LOBE_COATED;
    sd_lobe lobe = beginLobe(coated ? SD_LOBE_ROUGH_COATED : SD_LOBE_ROUGH);
    lobe.mean_through = static_cast<float>(model.a);
    lobe.multiple = static_cast<float>(1 / std::max(1 - model.mean, 1e-12));
    const double mean = model.mean;
    /// The spectra's functions of the reflectance, a term each: ρ, ρ² of what bounces more than once, and
    /// what comes back from the coat.
    std::vector<std::function<double(std::span<const double>)>> parts{
        [](std::span<const double> v) { return v[0]; },
        [mean](std::span<const double> v) { return multipleScattering(v[0], mean); }};
    double steepest = 1 - mean;
    if (coated) {
        const RoughBelow below =
            roughBelow(model, roundMean(through, base.widths), base.index, base.out.inside);
        std::vector<std::vector<sd_piece>> tables = tablesOf(through);
        tables.push_back(tabulate(below.missing));
        tables.push_back(tabulate(below.back));
        lobe.table = addTables(tables);
        setWidths(lobe, base.widths);
        lobe.ratio = static_cast<float>(model.b / model.a);
        lobe.inv_n2 = static_cast<float>(1 / (base.index * base.index));
        lobe.escape = static_cast<float>(below.escape);
        lobe.rest = static_cast<float>(below.rest);
        const double once = below.insideOnce, again = below.insideAgain;
        parts.emplace_back([once, again](std::span<const double> v) {
            return leftBy(once, v[0]) * (again < 0 ? 1 : leftBy(again, v[0]));
        });
        steepest = once;
        if (material.diffuse->texture) {
            lobe.inside_rest = static_cast<float>(once);
            lobe.second_rest = static_cast<float>(again);
        }
        base.glowShare = below.shareOfGlow(base.out.inside, mean);
    } else {
        lobe.table = addTables({tabulate([&](double c) { return std::max(0.0, 1 - model.albedo(c)); })});
        lobe.alpha = static_cast<float>(model.b / model.a);
    }
    if (only_ == Only::fluorescence) return;
    Base above = base;  // its transmittance stands in the kernel
    above.out.meanThrough = 1;
    const auto addPart = [&](const Curve& curve) {
        for (const LightGroup& group : groups_)
            addBaseTerm(above, group, {curve}, {}, -1);
    };
    if (material.diffuse->texture) {
        const Image image = spectralTexture(*material.diffuse->texture);
        lobe.texture = image.number;
        lobe.inside = static_cast<float>(1 - mean);
        lobe.steps = stepsFor(world_, image.number, steepest, 2);
        for (size_t part = 0; part < parts.size(); ++part) {
            const int steps = part == 0 ? 1 : lobe.steps;
            for (size_t t = 0; t < nodeCount(image.nm, steps); ++t)
                addPart(nodeCurve(image.nm, steps, t));
        }
        endLobe(lobe);
        return;
    }
    std::vector<Curve> reflectances;
    if (material.diffuse->select) {
        lobe.texture = shareTexture(*material.diffuse->select);
        for (const Select::Choice& choice : material.diffuse->select->choices)
            reflectances.push_back(choice.reflectance.curve());
    } else {
        reflectances.push_back(material.diffuse->reflectance->curve());
    }
    for (size_t part = 0; part < parts.size(); ++part)
        for (const Curve& curve : reflectances)
            addPart(part == 0 ? curve : Curve::combined({curve}, parts[part]));
    endLobe(lobe);
}

}  // namespace spectrad
