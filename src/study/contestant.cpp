#include "study/contestant.h"

#include "base/text.h"
#include "study/adaptive.h"
#include "study/linear_model.h"
#include "study/quadrature.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace spectrad {

namespace {

Contestant bands(const Wavelengths& range, double step, Projection projection, int samples) {
    Contestant c;
    c.wavelengths = regularWavelengths(range.nm.front(), range.nm.back(), step, {});
    c.wavelengths.projection = projection;
    c.samples = samples;
    c.key = fmt::format("{}-{}nm", name(projection), shortest(step));
    c.what = fmt::format("{} bands, {} every {} nm", c.wavelengths.size(), name(projection), shortest(step));
    return c;
}

Contestant varied(Contestant c, Knob knob, const std::string& key, const std::string& what) {
    c.knob = knob;
    c.key = key;
    c.what = what;
    return c;
}

void addBaselines(const Contestant& base, std::vector<Contestant>& out) {
    Contestant c =
        varied(base, Knob::baseline, "rgb", "linear sRGB: light times surface, channel by channel");
    c.method = Method::rgb;
    out.push_back(c);
    c = varied(base, Knob::baseline, "xyz", "tristimulus products: XYZ of light times ratios of the surface");
    c.method = Method::xyz;
    out.push_back(c);
    for (int nodes : {4, 6, 8, 10}) {
        c = varied(base, Knob::baseline, fmt::format("gauss-{}", nodes),
                   fmt::format("Gaussian quadrature with {} wavelengths (after Meyer 1988)", nodes));
        c.method = Method::quadrature;
        c.order = nodes;
        out.push_back(c);
    }
    for (int nodes : {10, 20, 40}) {
        c = varied(base, Knob::baseline, fmt::format("adaptive-{}", nodes),
                   fmt::format("{} point wavelengths placed by adaptive integration of the lights (after "
                               "Deville 1994, Rougeron and Péroche 1997)",
                               nodes));
        c.method = Method::adaptive;
        c.order = nodes;
        out.push_back(c);
    }
    for (int components : {3, 4, 6, 8}) {
        c = varied(base, Knob::baseline, fmt::format("linear-{}", components),
                   fmt::format("linear model with {} components of this scene's spectra (after Peercy 1993)",
                               components));
        c.method = Method::linearModel;
        c.order = components;
        out.push_back(c);
    }
}

/// All that a material looks up, for changing.
std::vector<TextureUse*> textureUses(Material& material) {
    std::vector<TextureUse*> uses;
    if (material.diffuse && material.diffuse->texture) uses.push_back(&*material.diffuse->texture);
    if (material.diffuse && material.diffuse->select) uses.push_back(&material.diffuse->select->map);
    if (material.emission && material.emission->texture) uses.push_back(&*material.emission->texture);
    for (Fluorescence& part : material.fluorescence)
        if (part.mask) uses.push_back(&*part.mask);
    if (material.relief) uses.push_back(&material.relief->map);
    return uses;
}

void addTextureFilters(const Scene& scene, const Contestant& base, std::vector<Contestant>& out) {
    std::vector<TextureFilter> own;
    for (Material material : scene.materials)
        for (const TextureUse* use : textureUses(material))
            own.push_back(use->filter);
    for (const auto& [filter, called, what] :
         {std::tuple{TextureFilter::nearest, "nearest", "textures: the nearest texel"},
          {TextureFilter::bilinear, "bilinear", "textures: bilinear"},
          {TextureFilter::mip, "mip", "textures: a pyramid of means (mip)"}}) {
        // What the scene does already is another row.
        if (std::all_of(own.begin(), own.end(), [f = filter](TextureFilter o) { return o == f; })) continue;
        Contestant c = varied(base, Knob::texture, fmt::format("texture-{}", called), what);
        c.filter = filter;
        out.push_back(c);
    }
}

void addArithmetic(const Contestant& base, std::vector<Contestant>& out) {
    Contestant c = varied(base, Knob::arithmetic, "contracted",
                          "kernels whose a*b + c may be fused (FP_CONTRACT ON, -cl-mad-enable)");
    c.switches = {"CONTRACT"};
    out.push_back(c);
    c = varied(base, Knob::arithmetic, "fast-math", "kernels built with -cl-fast-relaxed-math");
    c.switches = {"CONTRACT", "FAST_MATH"};
    out.push_back(c);
}

Scene withFilter(const Scene& scene, TextureFilter filter) {
    Scene changed = scene;
    for (Material& material : changed.materials)
        for (TextureUse* use : textureUses(material))
            use->filter = filter;
    return changed;
}

}  // namespace

std::string_view name(Knob knob) {
    switch (knob) {
        case Knob::bands:
            return "bands";
        case Knob::samples:
            return "samples";
        case Knob::fresnel:
            return "fresnel";
        case Knob::texture:
            return "texture";
        case Knob::arithmetic:
            return "arithmetic";
        case Knob::output:
            return "output";
        case Knob::baseline:
            break;
    }
    return "baseline";
}

Wavelengths referenceGrid() {
    return regularWavelengths(360, 830, 1, {});
}

std::vector<Contestant> contestants(const Scene& scene, const Wavelengths& grid, int samples) {
    const double span = grid.nm.back() - grid.nm.front();
    std::vector<Contestant> out;
    const auto addBands = [&](double step, Projection projection) {
        if (step <= span / 2) out.push_back(bands(grid, step, projection, samples));
    };
    const Contestant base = bands(grid, std::min(5.0, std::max(span / 4, 1e-3)), Projection::slit, samples);
    for (double step : {5.0, 10.0, 20.0})
        for (Projection projection : {Projection::slit, Projection::point})
            addBands(step, projection);
    addBaselines(base, out);
    for (int count : {1, 4, 16}) {
        Contestant c = varied(base, Knob::samples, fmt::format("samples-{}", count),
                              fmt::format("{} sample{} a pixel", count, count == 1 ? "" : "s"));
        c.samples = count;
        out.push_back(c);
    }
    const bool exactMetals =
        std::any_of(scene.materials.begin(), scene.materials.end(),
                    [](const Material& m) { return m.conductor && !m.conductor->schlick; });
    if (exactMetals) {
        Contestant c = varied(base, Knob::fresnel, "schlick", "metals by Schlick's formula");
        c.schlick = true;
        out.push_back(c);
    }
    addTextureFilters(scene, base, out);
    addArithmetic(base, out);
    Contestant half = varied(base, Knob::output, "half", "bands kept as half floats (11 bits)");
    half.output.half = true;
    out.push_back(half);
    for (int bits : {12, 16, 20}) {
        Contestant c = varied(base, Knob::output, fmt::format("bits-{}", bits),
                              fmt::format("{} significant bits of each float kept", bits));
        c.output.mantissaBits = bits;
        out.push_back(c);
    }
    for (Compression compression : {Compression::none, Compression::zips, Compression::zip}) {
        const std::string called(name(compression));
        Contestant c =
            varied(base, Knob::output, "exr-" + called, "EXR compression " + called + " (the others: piz)");
        c.output.compression = compression;
        out.push_back(c);
    }
    for (double step : {1.0, 2.0, 5.0, 10.0, 20.0, 40.0})
        for (Projection projection : {Projection::slit, Projection::box, Projection::point})
            if (projection == Projection::box || step < 5 || step > 20) addBands(step, projection);
    for (int count : {2, 8, 32, 64}) {
        Contestant c = varied(base, Knob::samples, fmt::format("samples-{}", count),
                              fmt::format("{} samples a pixel", count));
        c.samples = count;
        out.push_back(c);
    }
    return out;
}

Scene withSchlick(const Scene& scene) {
    Scene changed = scene;
    for (Material& material : changed.materials)
        if (material.conductor) material.conductor->schlick = true;
    return changed;
}

std::optional<Entry> prepare(const Contestant& contestant, const Scene& scene, const RenderSettings& settings,
                             const Detector& observer, const Library& library, const Planner& planner) {
    RenderSettings asked = settings;
    asked.samples = contestant.samples;
    asked.wavelengths = contestant.wavelengths;
    asked.projection.reset();
    Entry entry;
    switch (contestant.method) {
        case Method::rgb:
        case Method::xyz: {
            auto told = inThreeChannels(
                scene, contestant.method == Method::rgb ? ThreeChannels::rgb : ThreeChannels::xyz, observer,
                library);
            if (!told) return std::nullopt;
            asked.wavelengths = told->channels;
            entry.plan = planner(told->scene, asked);
            entry.weights = told->weights;
            return entry;
        }
        case Method::quadrature: {
            const QuadratureRule rule = gaussRule(observer, contestant.order);
            asked.wavelengths = Wavelengths{rule.nm, Projection::point};
            entry.plan = planner(scene, asked);
            entry.weights = rule.weights;
            return entry;
        }
        case Method::adaptive:
            asked.wavelengths =
                Wavelengths{adaptiveWavelengths(scene, observer, contestant.order), Projection::point};
            entry.plan = planner(scene, asked);
            entry.weights = weightsOn(entry.plan.wavelengths, observer);
            return entry;
        case Method::linearModel: {
            asked.wavelengths = referenceGrid();
            Plan plan = planner(scene, asked);
            const DetectorWeights weights = weightsOn(plan.wavelengths, observer);
            LinearModel model = inPrincipalComponents(std::move(plan), weights, contestant.order);
            return Entry{std::move(model.plan), std::move(model.weights)};
        }
        case Method::spectral:
            break;
    }
    if (contestant.schlick)
        entry.plan = planner(withSchlick(scene), asked);
    else
        entry.plan = planner(contestant.filter ? withFilter(scene, *contestant.filter) : scene, asked);
    entry.plan.defines.insert(entry.plan.defines.end(), contestant.switches.begin(),
                              contestant.switches.end());
    entry.weights = weightsOn(entry.plan.wavelengths, observer);
    return entry;
}

}  // namespace spectrad
