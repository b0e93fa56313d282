#include "study/three_channels.h"

#include "colour/display.h"
#include "render/light_groups.h"
#include "spectrum/dispersion.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>

namespace spectrad {

namespace {

constexpr std::array<double, 3> channelNm{400, 500, 600};

class Translator {
  public:
    Translator(ThreeChannels kind, const Detector& observer, const Library& library)
        : kind_(kind),
          observer_(observer),
          standard_(standardObserver(library)),
          daylight_(library.find("illuminants/D65").value().curve()),
          fromXyz_(srgbDisplay().fromXyz) {}

    [[nodiscard]] Curve surface(const Curve& reflectance) const {
        const Curve equal = Curve::constant(1);
        const Curve& light = kind_ == ThreeChannels::rgb ? daylight_ : equal;
        const std::array<const Curve*, 2> product{&light, &reflectance};
        const std::array<const Curve*, 1> alone{&light};
        const Triple seen = respondXyz(observer_, product), white = respondXyz(observer_, alone);
        if (kind_ == ThreeChannels::xyz)
            return table({seen[0] / white[0], seen[1] / white[1], seen[2] / white[2]});
        // The observer's own white, so that a perfect diffuser is (1, 1, 1) for every observer.
        const Triple rgb = fromXyz_ * seen, whiteRgb = fromXyz_ * white;
        Triple ratio{};
        for (size_t i = 0; i < 3; ++i)
            ratio[i] = std::clamp(rgb[i] / whiteRgb[i], 0.0, 1.0);
        return table(ratio);
    }

    void translate(Emitter& emitter) {
        const std::array<const Curve*, 1> light{&emitter.spectrum.curve()};
        Triple seen = respondXyz(observer_, light);
        const double factor = absoluteFactor(emitter, standard_);
        for (double& value : seen)
            value *= factor;
        if (kind_ == ThreeChannels::rgb) seen = fromXyz_ * seen;
        for (double& value : seen)
            value = std::max(value, 0.0);  // a lamp outside the gamut loses what RGB cannot say
        emitter.spectrum.curves = {table(seen)};
        emitter.spectrum.relative = false;
        // Lights of one name share a spectrum; these differ in size too.
        emitter.spectrum.text += fmt::format(" ({})", ++emitters_);
        emitter.scale = 1;
        if (!emitter.amount) return;
        // The same kind of amount, which a light may still have to divide by its solid angle, of a size that
        // leaves the three values as they are.
        const std::array<const Curve*, 1> told{&emitter.spectrum.curve()};
        const double integral = integrate(told, channelNm[0], channelNm[2]);
        if (!(integral > 0)) {
            emitter.amount.reset();
            emitter.scale = 0;
            return;
        }
        emitter.amount = Amount{radiometric(emitter.amount->unit), integral, std::nullopt};
    }

    /// From three channels to XYZ in the observer's own unit; emitters above carry that unit.
    [[nodiscard]] DetectorWeights weights() const {
        const Matrix3 m = kind_ == ThreeChannels::rgb ? srgbDisplay().toXyz : diagonal({1, 1, 1});
        DetectorWeights out;
        for (const Triple& row : m)
            out.weights.emplace_back(row.begin(), row.end());
        return out;
    }

  private:
    static Curve table(const Triple& values) {
        return Curve::table({channelNm.begin(), channelNm.end()}, {values.begin(), values.end()});
    }
    static AmountUnit radiometric(AmountUnit unit) {
        switch (unit) {
            case AmountUnit::candela:
                return AmountUnit::wattPerSteradian;
            case AmountUnit::lumen:
                return AmountUnit::watt;
            case AmountUnit::lux:
                return AmountUnit::wattPerSquareMetre;
            case AmountUnit::candelaPerSquareMetre:
                return AmountUnit::wattPerSquareMetreSteradian;
            default:
                return unit;
        }
    }

    ThreeChannels kind_;
    const Detector& observer_;
    Detector standard_;  ///< CIE 1931, which amounts are defined with
    Curve daylight_;
    Matrix3 fromXyz_;
    int emitters_ = 0;
};

void translate(Material& material, Translator& to) {
    if (material.diffuse && material.diffuse->reflectance)
        material.diffuse->reflectance->curves = {to.surface(material.diffuse->reflectance->curve())};
    if (material.diffuse && material.diffuse->select)
        for (Select::Choice& choice : material.diffuse->select->choices)
            choice.reflectance.curves = {to.surface(choice.reflectance.curve())};
    if (material.specular)
        material.specular->reflectance.curves = {to.surface(material.specular->reflectance.curve())};
    if (material.gloss)
        material.gloss->ior.curves = {Curve::constant(material.gloss->ior.curve().at(sodiumNm))};
    if (material.conductor) {
        const std::vector<Curve>& nk = material.conductor->ior.curves;
        const Curve facing = Curve::combined({nk.at(0), nk.at(1)}, [](std::span<const double> v) {
            const double k2 = v[1] * v[1];
            return ((v[0] - 1) * (v[0] - 1) + k2) / ((v[0] + 1) * (v[0] + 1) + k2);
        });
        Specular specular;
        specular.reflectance = material.conductor->ior;
        specular.reflectance.curves = {to.surface(facing)};
        specular.reflectance.quantity = Quantity::reflectance;
        specular.roughness = material.conductor->roughness;
        material.specular = specular;
        material.conductor.reset();
    }
    material.fluorescence.clear();
    if (material.emission) to.translate(*material.emission);
}

/// Spectra from place to place, of surfaces or of what glows.
bool hasPictures(const Scene& scene) {
    const auto glows = [](const Emitter& emitter) { return emitter.texture.has_value(); };
    const auto wears = [&](const Material& m) {
        return (m.diffuse && m.diffuse->texture) || (m.emission && glows(*m.emission));
    };
    return std::any_of(scene.materials.begin(), scene.materials.end(), wears) ||
           std::any_of(scene.lights.begin(), scene.lights.end(),
                       [&](const Light& light) { return glows(light.emitter); }) ||
           (scene.background && glows(*scene.background));
}

}  // namespace

std::optional<ThreeChannelScene> inThreeChannels(const Scene& scene, ThreeChannels kind,
                                                 const Detector& observer, const Library& library) {
    if (hasPictures(scene)) return std::nullopt;
    Translator translator(kind, observer, library);
    ThreeChannelScene out;
    out.scene = scene;
    for (Material& material : out.scene.materials)
        translate(material, translator);
    for (Light& light : out.scene.lights)
        translator.translate(light.emitter);
    if (out.scene.background) translator.translate(*out.scene.background);
    out.channels.nm.assign(channelNm.begin(), channelNm.end());
    out.channels.projection = Projection::point;
    out.weights = translator.weights();
    return out;
}

}  // namespace spectrad
