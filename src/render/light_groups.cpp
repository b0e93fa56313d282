#include "render/light_groups.h"

#include "base/text.h"
#include "colour/detector.h"
#include "spectrum/projection.h"

#include <array>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// ∫ curve dλ over its own range; of Planck's law, which has none, over all wavelengths.
double radiometricIntegral(const Emitter& emitter) {
    const Curve& curve = emitter.spectrum.curve();
    if (emitter.amount->over) {
        const std::array<const Curve*, 1> product{&curve};
        return integrate(product, emitter.amount->over->first, emitter.amount->over->second);
    }
    if (curve.isConstant())
        throw InputError(
            emitter.where,
            "a constant spectrum has no total: say over which wavelengths, as in \"100 W/m2 over 400:700\"");
    const std::array<const Curve*, 1> product{&curve};
    return integrate(product);
}

double photometricIntegral(const Emitter& emitter, const Detector& observer) {
    const Curve& curve = emitter.spectrum.curve();
    const std::array<const Curve*, 2> product{&curve, &observer.response[1]};
    if (emitter.amount->over)
        return luminousEfficacy *
               integrate(product, emitter.amount->over->first, emitter.amount->over->second);
    return luminousEfficacy * integrate(product);
}

/// A spot's cone by its squared chords on the unit sphere, 2 (1 − cos θ) = 4 sin²(θ/2), at θ where its light
/// ends and where it begins to fade. Of a narrow cone the cosines have no digits left to tell them apart.
struct Cone {
    double outer, inner;

    /// sr that the intensity on the axis would fill with the spot's power: ∫ fade dω, where dω = π d(chord²)
    /// and a smoothstep has mean ½ on its ramp.
    [[nodiscard]] double solidAngle() const { return std::numbers::pi / 2 * (inner + outer); }
};
Cone coneOf(const Light& light) {
    const auto chord = [](double degrees) {
        const double sine = std::sin(degrees * std::numbers::pi / 360);
        return 4 * sine * sine;
    };
    // A hard edge is a ramp over a millionth of the cone, some steps of a float; the power counts it.
    constexpr double sharpest = 1 - 1e-6;
    // Directions are floats: of a narrower cone they would not say what is inside. Its power is all there.
    constexpr double narrowest = 0.001;
    const double half = std::max(light.angle, narrowest) / 2, outer = chord(half);
    return {outer, std::min(chord(half * (1 - light.blend)), outer * sharpest)};
}

sd_light placed(const Light& light, const Affine& toWorld, const View& view) {
    sd_light l{};
    const Vec3 position = view.worldToCamera.point(toWorld.point(light.position));
    const Vec3 along = normalized(view.worldToCamera.direction(toWorld.direction(light.direction)));
    switch (light.type) {
        case LightType::point:
            l.type = SD_LIGHT_POINT;
            break;
        case LightType::spot:
            l.type = SD_LIGHT_SPOT;
            break;
        case LightType::directional:
            l.type = SD_LIGHT_DIRECTIONAL;
            break;
        case LightType::ambient:
            l.type = SD_LIGHT_AMBIENT;
            break;
    }
    l.shadows = light.shadows;
    const Vec3 place = light.type == LightType::directional ? along * -1 : position;
    l.x = static_cast<float>(place.x);
    l.y = static_cast<float>(place.y);
    l.z = static_cast<float>(place.z);
    if (light.type == LightType::spot) {
        const Cone cone = coneOf(light);
        l.axis_x = static_cast<float>(along.x);
        l.axis_y = static_cast<float>(along.y);
        l.axis_z = static_cast<float>(along.z);
        l.chord_outer = static_cast<float>(cone.outer);
        l.inv_chord_range = static_cast<float>(1 / (cone.outer - cone.inner));
    }
    return l;
}

double powerToIntensity(const Light& light) {
    if (light.type == LightType::point) return 1 / (4 * std::numbers::pi);
    if (light.type == LightType::spot) return 1 / coneOf(light).solidAngle();
    return 1;
}

/// Only a perfectly smooth surface shows what is behind the viewer.
bool showsSurroundings(const Scene& scene) {
    for (const Material& m : scene.materials)
        if ((m.gloss && m.gloss->roughness.isMirror()) || (m.specular && m.specular->roughness.isMirror()) ||
            (m.conductor && m.conductor->roughness.isMirror()))
            return true;
    return false;
}

bool isPower(const Emitter& emitter) {
    return emitter.amount &&
           (emitter.amount->unit == AmountUnit::lumen || emitter.amount->unit == AmountUnit::watt);
}

/// The same amount of equal-energy light. A radiometric amount, and a spectrum that counts as it stands, are
/// spread evenly over the range that the spectrum has.
Emitter withConstantSpectrum(const Emitter& emitter) {
    Emitter e = emitter;
    const Curve& curve = emitter.spectrum.curve();
    constexpr std::pair<double, double> visible{360,
                                                830};  // nm; where neither spectrum nor amount names a range
    const auto range =
        emitter.amount && emitter.amount->over ? *emitter.amount->over : curve.range().value_or(visible);
    const double from = range.first,
                 to = std::max(range.second, range.first + 1);  // a line has no width to spread over
    if (!emitter.amount) {
        const std::array<const Curve*, 1> product{&curve};
        e.scale = emitter.scale * integrate(product, from, to) / (to - from);
    } else if (!isPhotometric(emitter.amount->unit)) {
        e.amount->over = {from, to};
    }
    e.spectrum.curves = {Curve::constant(1)};
    e.spectrum.text = "constant:1";
    return e;
}

}  // namespace

double absoluteFactor(const Emitter& emitter, const Detector& observer) {
    if (!emitter.amount) return emitter.scale;
    const Amount& amount = *emitter.amount;
    if (amount.value == 0) return 0;
    const double total =
        isPhotometric(amount.unit) ? photometricIntegral(emitter, observer) : radiometricIntegral(emitter);
    if (!(total > 0))
        throw InputError(emitter.where, "spectrum '" + emitter.spectrum.text + "' has no " +
                                            (isPhotometric(amount.unit) ? "light that is seen" : "power") +
                                            ", so it cannot be given that amount");
    return amount.value / total;
}

std::vector<LightGroup> groupLights(const Scene& scene, const FlatScene& flat, const View& view,
                                    const Detector& observer, const ResolveEmitter& resolved,
                                    std::vector<sd_light>& lights, bool equalEnergy, bool apart) {
    std::vector<LightGroup> groups;
    const auto add = [&](const Emitter& given, double unitFactor, sd_light l) {
        const Emitter emitter = equalEnergy ? withConstantSpectrum(given) : given;
        const double factor = unitFactor * absoluteFactor(emitter, observer);
        size_t group = apart ? groups.size() : 0;
        while (group < groups.size() && groups[group].text != emitter.spectrum.text)
            ++group;
        if (group == groups.size()) groups.push_back({emitter.spectrum.curve(), 0, emitter.spectrum.text});
        // The first light that shines sets the group's absolute spectrum, so that terms are of the image's
        // own magnitude.
        if (groups[group].factor == 0) groups[group].factor = factor;
        // What divides and what is divided are lit alike; neither is a picture.
        if (equalEnergy) l.shadows = 0;
        l.group = static_cast<sd_uint>(group);
        l.scale = apart                       ? 1.0f
                  : groups[group].factor == 0 ? 0.0f
                                              : static_cast<float>(factor / groups[group].factor);
        lights.push_back(l);
    };
    bool ambient = false;
    for (const Placed& place : flat.lights) {
        const Light& light = scene.lights[place.index];
        double factor = isPower(light.emitter) ? powerToIntensity(light) : 1;
        // Uniform radiance L from everywhere arrives as irradiance π L.
        if (light.type == LightType::ambient) factor *= std::numbers::pi;
        ambient = ambient || light.type == LightType::ambient;
        add(resolved(light.emitter), factor, placed(light, place.toWorld, view));
    }
    if (scene.background && !scene.background->texture && !ambient && !equalEnergy &&
        showsSurroundings(scene)) {
        sd_light surroundings{};
        surroundings.type = SD_LIGHT_SURROUNDINGS;
        add(*scene.background, std::numbers::pi, surroundings);
    }
    // Equal-energy light is there to be divided by: with this irradiance a white diffuser sends back exactly
    // 1, and what is divided by it keeps its bits.
    if (equalEnergy)
        for (LightGroup& group : groups)
            if (group.factor != 0) group.factor = std::numbers::pi;
    return groups;
}

void placeLights(const Scene& scene, const FlatScene& flat, const View& view, std::vector<sd_light>& lights) {
    for (size_t i = 0; i < flat.lights.size() && i < lights.size(); ++i) {
        sd_light moved = placed(scene.lights[flat.lights[i].index], flat.lights[i].toWorld, view);
        moved.group = lights[i].group;
        moved.scale = lights[i].scale;
        moved.shadows = lights[i].shadows;
        lights[i] = moved;
    }
}

}  // namespace spectrad
