#include "render/material_report.h"

#include "colour/observe.h"
#include "render/coat.h"
#include "render/fresnel.h"
#include "render/term_table.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

namespace spectrad {

namespace {

std::vector<std::string> lobesOf(const Material& m) {
    std::vector<std::string> lobes;
    if (m.diffuse) lobes.emplace_back("diffuse");
    if (m.gloss) lobes.emplace_back("gloss");
    if (m.specular) lobes.emplace_back("specular");
    if (m.conductor) lobes.emplace_back("conductor");
    if (!m.fluorescence.empty()) lobes.emplace_back("fluorescence");
    if (m.emission) lobes.emplace_back("emission");
    return lobes;
}

struct NamedLight {
    std::string text;
    Curve curve;
};

/// The scene's lamps, one a spectrum; D65 for a scene without any.
std::vector<NamedLight> lightsOf(const Scene& scene, const Library& library) {
    std::vector<NamedLight> lights;
    std::set<std::string> seen;
    for (const Light& light : scene.lights)
        if (seen.insert(light.emitter.spectrum.text).second)
            lights.push_back({light.emitter.spectrum.text, light.emitter.spectrum.curve()});
    if (lights.empty())
        if (const auto d65 = library.find("illuminants/D65"))
            lights.push_back({"illuminants/D65", d65->curve()});
    return lights;
}

PeakRadianceFactor peakUnder(const NamedLight& light, const FluorescentBase& base, const Wavelengths& grid) {
    const Curve reflectance = base.reflectance();
    const std::array<const Curve*, 1> alone{&light.curve};
    const std::array<const Curve*, 2> reflected{&light.curve, &reflectance};
    const std::vector<double> white = project(grid, alone);
    std::vector<double> sum = project(grid, reflected);
    for (const Curve& curve : base.reradiation(light.curve)) {
        const std::array<const Curve*, 1> glow{&curve};
        const std::vector<double> bands = project(grid, glow);
        for (size_t j = 0; j < sum.size(); ++j)
            sum[j] += bands[j];
    }
    const double floor = 0.01 * *std::max_element(white.begin(), white.end());
    PeakRadianceFactor peak{light.text, grid.nm.front(), 0};
    for (size_t j = 0; j < sum.size(); ++j)
        if (white[j] > 0 && white[j] >= floor && sum[j] / white[j] > peak.value)
            peak.nm = grid.nm[j], peak.value = sum[j] / white[j];
    return peak;
}

std::optional<FresnelFigures> fresnelOf(const Material& m, const Wavelengths& grid) {
    using Model = FresnelFigures::Model;
    const WavelengthSpan bands = seenByBands(grid), anyone = seenByAnyone(grid);
    const auto [from, to] = anyone;
    if (m.conductor) {
        const Curve &n = m.conductor->ior.curves.at(0), &k = m.conductor->ior.curves.at(1);
        if (m.conductor->schlick) return FresnelFigures{Model::schlick, 2, schlickError(n, k, from, to)};
        const FresnelBasis basis = conductorBasis(n, k, from, to);
        return FresnelFigures{Model::exact, basis.angle.size(), basis.relativeError};
    }
    if (m.gloss) {
        const Curve& ior = m.gloss->ior.curve();
        const Nodes nodes = nodesOfGlass(ior, bands, anyone);
        return FresnelFigures{Model::exact, nodes.at.size(), interpolationError(nodes, ior, bands)};
    }
    return std::nullopt;
}

/// The material alone under equal-energy light, as it is rendered: its tables and terms.
class Furnace {
  public:
    Furnace(const Scene& scene, const Material& material, const Wavelengths& grid, const Library& library) {
        Notes notes;
        TextureLoader textures(scene, library, notes);
        LightGroup equalEnergy;
        equalEnergy.spectrum = Curve::constant(1);
        const Eye eye = standardEye(library);
        TermBuilder builder(grid, eye, {equalEnergy}, Only::reflection, textures, world_, terms_, notes);
        builder.add(material, 0);
    }
    [[nodiscard]] size_t terms() const { return terms_.count(); }
    [[nodiscard]] FurnaceFigures figures() const {
        FurnaceFigures f{1e300, 0, 0};
        for (int i = 0; i <= 64; ++i) {
            const double cosine = (i / 64.0) * (i / 64.0);
            for (double azimuth = 0; azimuth < 1.6; azimuth += brushed() ? 0.1 : 2) {
                for (size_t band = 0; band < terms_.bands; ++band) {
                    const double albedo = sentBack(cosine, azimuth, band);
                    f.least = std::min(f.least, albedo);
                    f.most = std::max(f.most, albedo);
                }
            }
        }
        for (const sd_lobe& lobe : world_.lobes) {
            if (lobe.type != SD_LOBE_FACETS) continue;
            DirectionFunction missing;
            for (size_t k = 0; k < coefficients(lobe); ++k)
                missing.push_back([table = world_.tables.data() + lobe.table + k * SD_CELLS](double c) {
                    return evaluate(table, c);
                });
            f.bouncing = cosineMean(roundMean(missing, widthsOf(lobe)));
        }
        return f;
    }

  private:
    static size_t coefficients(const sd_lobe& lobe) { return lobe.alpha_v != 0 ? SD_AZIMUTHS : 1; }
    static Widths widthsOf(const sd_lobe& lobe) {
        return {double{lobe.alpha}, double{lobe.alpha_v != 0 ? lobe.alpha_v : lobe.alpha}};
    }
    [[nodiscard]] bool brushed() const {
        return std::any_of(world_.lobes.begin(), world_.lobes.end(),
                           [](const sd_lobe& lobe) { return lobe.alpha_v != 0; });
    }
    /// As kernels/lobes.h, uniform_light().
    [[nodiscard]] double sentBack(double cosine, double azimuth, size_t band) const {
        constexpr double pi = std::numbers::pi;
        double sum = 0;
        for (const sd_lobe& lobe : world_.lobes) {
            const auto term = [&](size_t function) {
                return double{terms_.spectra[(lobe.term + function) * terms_.bands + band]};
            };
            const auto function = [&](size_t number) {
                const size_t count = coefficients(lobe);
                const sd_piece* table = world_.tables.data() + lobe.table + number * count * SD_CELLS;
                const double x = count > 1 ? azimuthPlace(widthsOf(lobe), azimuth) : 0;
                double value = 0;
                for (size_t k = count; k-- > 0;)
                    value = value * x + evaluate(table + k * SD_CELLS, cosine);
                return count > 1 && number == 0 ? std::max(value, 0.0) : value;
            };
            const double first = lobe.type == SD_LOBE_DIFFUSE ? 0 : function(0);
            if (lobe.type == SD_LOBE_DIFFUSE) sum += pi * term(0);
            if (lobe.type == SD_LOBE_COATED) sum += pi * term(0) * first * double{lobe.mean_through};
            if (lobe.type == SD_LOBE_ROUGH) sum += pi * (term(0) * (1 - first) + term(1) * first);
            if (lobe.type == SD_LOBE_ROUGH_COATED) {
                const sd_piece* own = world_.tables.data() + lobe.table + coefficients(lobe) * SD_CELLS;
                const double multiple = evaluate(own, cosine) * double{lobe.escape},
                             back = evaluate(own + SD_CELLS, cosine);
                sum += pi * first *
                       (term(0) * std::max(0.0, 1 - back - multiple) + term(1) * multiple + term(2) * back);
            }
            if (lobe.type == SD_LOBE_FACETS) {
                for (size_t f = 0; f < lobe.functions; ++f)
                    sum += term(f) * function(1 + f);
                if (lobe.multiple_to == lobe.functions) sum += term(lobe.functions) * first;
            }
        }
        return sum;
    }

    World world_;
    TermTable terms_;
};

MaterialReport report(const Scene& scene, const Material& material, const Wavelengths& grid,
                      const std::vector<NamedLight>& lights, const Library& library) {
    MaterialReport result;
    result.name = material.name;
    result.lobes = lobesOf(material);
    if (!material.fluorescence.empty()) {
        Notes notes;
        const FluorescentBase base(material, 0, notes);
        result.fluorescence = base.figures();
        for (const NamedLight& light : lights)
            result.peaks.push_back(peakUnder(light, base, grid));
    }
    result.fresnel = fresnelOf(material, grid);
    const bool textured = material.diffuse && material.diffuse->texture;
    const bool reflects = material.diffuse || material.gloss || material.specular || material.conductor ||
                          !material.fluorescence.empty();
    if (reflects && !textured) {
        Material bare = material;
        bare.emission.reset();
        const Furnace furnace(scene, bare, grid, library);
        result.terms = furnace.terms();
        if (result.terms > 0) result.furnace = furnace.figures();
    }
    return result;
}

/// Whether a surface names no material, and so is of the built-in grey.
bool wearsDefault(const Scene& scene) {
    const auto isDefault = [](const auto& use) { return use.material == 0; };
    return std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) {
        return std::any_of(node.shapes.begin(), node.shapes.end(), isDefault) ||
               std::any_of(node.meshes.begin(), node.meshes.end(), isDefault);
    });
}

}  // namespace

std::vector<MaterialReport> reportMaterials(const Scene& scene, const Wavelengths& grid,
                                            const Library& library) {
    const std::vector<NamedLight> lights = lightsOf(scene, library);
    std::vector<MaterialReport> reports;
    for (const Material& material : scene.materials) {
        if (&material == scene.materials.data() && !wearsDefault(scene)) continue;
        if (!lobesOf(material).empty()) reports.push_back(report(scene, material, grid, lights, library));
    }
    return reports;
}

}  // namespace spectrad
