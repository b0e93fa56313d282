#include "study/feature_cost.h"

#include "colour/develop.h"
#include "colour/difference.h"
#include "render/fresnel.h"
#include "render/picture_maps.h"
#include "render/renderer.h"
#include "render/texture.h"
#include "scene/pass_needs.h"
#include "spectrum/dispersion.h"
#include "study/trial.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace spectrad {

namespace {

Spectrum plain(Curve curve, const std::string& text) {
    Spectrum spectrum;
    spectrum.text = text;
    spectrum.quantity = Quantity::reflectance;
    spectrum.curves = {std::move(curve)};
    return spectrum;
}

/// The mean of all texels.
Spectrum meanOf(const TextureUse& use, TextureLoader& textures) {
    SpectralTexture texture = textures.load(use);
    texture.fetch();
    std::vector<double> mean = meanOfTexels(texture.texels, texture.nm.size());
    for (double& value : mean)
        value = std::clamp(value, 0.0, 1.0);
    return plain(Curve::table(texture.nm, mean, Outside::hold), "mean of " + use.source);
}

/// All choices by their share of the map.
Spectrum meanOf(const Select& select) {
    const Texels shares = shareMap(select);
    const std::vector<double> share = meanOfTexels(shares.texels, static_cast<size_t>(shares.bands));
    std::vector<Curve> curves;
    for (const Select::Choice& choice : select.choices)
        curves.push_back(choice.reflectance.curve());
    return plain(Curve::combined(curves,
                                 [share](std::span<const double> v) {
                                     double sum = 0;
                                     for (size_t i = 0; i < v.size(); ++i)
                                         sum += share[i] * v[i];
                                     return std::min(sum, 1.0);
                                 }),
                 "mean of " + select.map.source);
}

Spectrum normalReflectance(const Spectrum& ior) {
    return plain(Curve::combined({ior.curves.at(0), ior.curves.at(1)},
                                 [](std::span<const double> v) { return fresnelConductor(1, v[0], v[1]); }),
                 "metal at normal incidence");
}

Scene withEachMaterial(const Scene& scene, const std::function<void(Material&)>& change) {
    Scene changed = scene;
    for (Material& material : changed.materials)
        change(material);
    return changed;
}

Scene withoutLights(const Scene& scene, LightType type) {
    Scene changed = scene;
    for (Node& node : changed.nodes)
        std::erase_if(node.lights, [&](Index light) { return scene.lights[light].type == type; });
    return changed;
}

void makeMatt(Material& material) {
    if (!material.conductor) return;
    material.diffuse.emplace();
    material.diffuse->reflectance = normalReflectance(material.conductor->ior);
    material.conductor.reset();
}

}  // namespace

std::vector<Simpler> simplerScenes(const Scene& scene, const Plan& plan, TextureLoader& textures) {
    std::vector<Simpler> out;
    const auto has = [&](const char* feature) {
        return std::find(plan.features.begin(), plan.features.end(), feature) != plan.features.end();
    };
    const auto offer = [&](const char* feature, const char* instead,
                           const std::function<void(Material&)>& change) {
        if (has(feature)) out.push_back({feature, instead, withEachMaterial(scene, change)});
    };
    offer("fluorescence", "reflects only", [](Material& m) { m.fluorescence.clear(); });
    offer("mask", "fluorescent all over", [](Material& m) {
        for (Fluorescence& part : m.fluorescence)
            part.mask.reset();
    });
    offer("gloss", "no coat", [](Material& m) { m.gloss.reset(); });
    offer("specular", "no coat", [](Material& m) { m.specular.reset(); });
    offer("conductor", "matt, of the reflectance at normal incidence", makeMatt);
    offer("reflects", "mirrors without a picture", [](Material& m) {
        if (m.gloss) m.gloss->reflects.reset();
        if (m.specular) m.specular->reflects.reset();
        if (m.conductor) m.conductor->reflects.reset();
    });
    offer("diffuse roughness", "Lambert", [](Material& m) {
        if (m.diffuse) m.diffuse->roughnessDegrees = 0;
    });
    offer("select", "the mean of its choices", [](Material& m) {
        if (!m.diffuse || !m.diffuse->select) return;
        m.diffuse->reflectance = meanOf(*m.diffuse->select);
        m.diffuse->select.reset();
    });
    offer("texture", "the mean of its texels", [&](Material& m) {
        if (!m.diffuse || !m.diffuse->texture) return;
        m.diffuse->reflectance = meanOf(*m.diffuse->texture, textures);
        m.diffuse->texture.reset();
    });
    for (const char* relief : {"normal", "bump"})
        offer(relief, "smooth", [&](Material& m) {
            if (m.relief && m.relief->heights == (std::string_view(relief) == "bump")) m.relief.reset();
        });
    offer("emission", "does not glow", [](Material& m) { m.emission.reset(); });
    for (const auto& [feature, type] :
         {std::pair{"point", LightType::point}, std::pair{"spot", LightType::spot},
          std::pair{"directional", LightType::directional}, std::pair{"ambient", LightType::ambient}})
        if (has(feature)) out.push_back({feature, "no such lights", withoutLights(scene, type)});
    if (has("shadows")) {
        Scene changed = scene;
        for (Light& light : changed.lights)
            light.shadows = false;
        out.push_back({"shadows", "light goes through everything", std::move(changed)});
    }
    if (has("background")) {
        Scene changed = scene;
        changed.background.reset();
        out.push_back({"background", "black", std::move(changed)});
    }
    const auto metal = [](const Material& m) { return m.conductor && !m.conductor->schlick; };
    if (has("conductor") && std::any_of(scene.materials.begin(), scene.materials.end(), metal))
        out.push_back({"conductor fresnel", "Schlick's formula", withEachMaterial(scene, [](Material& m) {
                           if (m.conductor) m.conductor->schlick = true;
                       })});
    const auto disperses = [](const Material& m) { return m.gloss && !m.gloss->ior.curve().isConstant(); };
    if (has("gloss") && std::any_of(scene.materials.begin(), scene.materials.end(), disperses))
        out.push_back({"gloss dispersion", "the index at 589.3 nm", withEachMaterial(scene, [&](Material& m) {
                           if (disperses(m))
                               m.gloss->ior.curves = {Curve::constant(m.gloss->ior.curve().at(sodiumNm))};
                       })});
    return out;
}

TimeDifference timeDifference(const std::vector<double>& with, const std::vector<double>& without) {
    std::vector<double> difference, off;
    for (size_t i = 0; i < with.size(); ++i)
        difference.push_back(with[i] - without[i]);
    TimeDifference out;
    out.seconds = quantile(difference, 0.5);
    for (double d : difference)
        off.push_back(std::abs(d - out.seconds));
    // Of a median of n: 1.253 σ/√n, σ by the median deviation (of a normal distribution 1.483 of it).
    const double sigma = 1.483 * quantile(off, 0.5);
    out.uncertainty = 2 * 1.253 * sigma / std::sqrt(static_cast<double>(difference.size()));
    if (std::abs(out.seconds) <= out.uncertainty) out.seconds = 0;
    return out;
}

namespace {

/// Both in turn, so that what else the machine does meets both; the first round wakes the device.
TimeDifference timedInPairs(const Device& device, const Plan& with, const Plan& without) {
    Renderer first(device, with), second(device, without);
    const auto seconds = [](Renderer& renderer) {
        const double before = renderer.times().render;
        renderer.render([](int, int, const float*, const float*) {});
        return renderer.times().render - before;
    };
    std::vector<double> a, b;
    constexpr int rounds = 9;
    for (int round = 0; round <= rounds; ++round) {
        const double x = seconds(first), y = seconds(second);
        if (round == 0) continue;
        a.push_back(x);
        b.push_back(y);
    }
    return timeDifference(a, b);
}

}  // namespace

CostReport costOf(const Scene& scene, const RenderSettings& settings, const Detector& observer,
                  const Library& library, const Device& device, const Planner& planner,
                  TextureLoader& textures) {
    CostReport report;
    struct Measured {
        Plan plan;
        Trial trial;
    };
    const auto measure = [&](const Scene& of, int rounds) {
        Entry entry{planner(of, settings), {}};
        entry.weights = weightsOn(entry.plan.wavelengths, observer);
        Trial trial = tryOut(device, entry, {}, {rounds, false, {}});
        return Measured{std::move(entry.plan), std::move(trial)};
    };
    const Measured full = measure(scene, 3);
    if (full.plan.as != PassKind::radiance || full.plan.faces != 1)
        throw InputError(scene.file + ": costs are told of radiance seen by one camera");
    report.seconds = full.trial.renderSeconds;
    report.stripBytes = full.trial.stripBytes;
    report.width = full.plan.view.width;
    report.height = full.plan.view.height;
    const std::vector<double>& y = full.trial.xyz.plane[1];
    report.white =
        defaultWhite(scene, settings, observer, library, device, *std::max_element(y.begin(), y.end()));
    for (const Simpler& simpler : simplerScenes(scene, full.plan, textures)) {
        try {
            const Measured without = measure(simpler.scene, 1);
            const ColourDifference d = colourDifference(full.trial.xyz, without.trial.xyz, report.white.xyz);
            const auto less = [](std::uint64_t a, std::uint64_t b) {
                return static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b);
            };
            report.features.push_back(
                {simpler.feature, simpler.instead, timedInPairs(device, full.plan, without.plan),
                 less(full.trial.stripBytes, without.trial.stripBytes),
                 less(full.plan.triangles(), without.plan.triangles()),
                 less(full.plan.terms.count(), without.plan.terms.count()), d.mean, d.p99, d.max});
        } catch (const InputError& error) {
            report.leftOut.push_back(simpler.feature + ": " + error.what());
        }
    }
    return report;
}

}  // namespace spectrad
