#include "viewer/carry.h"

#include "viewer/scene_subject.h"

namespace spectrad::view {

namespace {

bool sameAmount(const Emitter& a, const Emitter& b) {
    const auto value = [](const Emitter& e) { return e.amount ? e.amount->value : e.scale; };
    return a.amount.has_value() == b.amount.has_value() &&
           (!a.amount || (a.amount->unit == b.amount->unit && a.amount->over == b.amount->over)) &&
           value(a) == value(b);
}

bool samePlace(const Pose& a, const Pose& b) {
    const auto near = [](Vec3 p, Vec3 q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
    const Vec3 aheadA = normalized(a.target - a.eye), aheadB = normalized(b.target - b.eye);
    constexpr double tolerance = 1e-9;  // the target's distance depends on the geometry
    return near(a.eye, b.eye) && near(a.up, b.up) && length(aheadA - aheadB) < tolerance &&
           a.pixelsPerSlopeOverHeight == b.pixelsPerSlopeOverHeight && a.orthographic == b.orthographic;
}

const Spectrum* reflectanceOf(const Material& material) {
    return material.diffuse && material.diffuse->reflectance ? &*material.diffuse->reflectance : nullptr;
}

}  // namespace

Look carried(const Look& old, const Subject& before, const Subject& fresh, const SpectrumResolver& resolver) {
    Look made = fresh.firstLook();
    const Look first = before.firstLook();
    made.eye = old.eye;
    made.film = old.film;
    for (LightSetting& light : made.lights)
        for (size_t i = 0; i < first.lights.size(); ++i) {
            const LightSetting &was = first.lights[i], &now = old.lights[i];
            if (was.name != light.name) continue;
            const bool sameSpectrum = was.emitter.spectrum.text == light.emitter.spectrum.text;
            if (sameAmount(was.emitter, light.emitter)) {
                light.times = now.times;
                light.on = now.on;
            }
            if (sameSpectrum && now.emitter.spectrum.text != was.emitter.spectrum.text) {
                light.emitter.spectrum = resolver.resolve(now.emitter.spectrum.text, Role::light, {});
                light.emitter.texture.reset();
            }
        }
    const auto *opened = dynamic_cast<const SceneSubject*>(&fresh),
               *closed = dynamic_cast<const SceneSubject*>(&before);
    if (!opened || !closed) return made;
    const std::vector<Material>&then = closed->scene().materials, &now = opened->scene().materials;
    for (const auto& [number, reflectance] : old.reflectances)
        for (Index m = 0; m < now.size(); ++m) {
            const Spectrum *was = reflectanceOf(then[number]), *is = reflectanceOf(now[m]);
            if (now[m].name == then[number].name && was && is && was->text == is->text)
                made.reflectances[m] = resolver.resolve(reflectance.text, Role::reflectance, {});
        }
    return made;
}

Stand carried(const Stand& old, const Subject& before, const Subject& fresh) {
    Stand made = old;
    const auto *opened = dynamic_cast<const SceneSubject*>(&fresh),
               *closed = dynamic_cast<const SceneSubject*>(&before);
    if (!opened) return {};
    if (!closed) return {opened->home(), opened->width(), opened->height(), std::nullopt};
    if (same(old.pose, closed->home()) || !samePlace(opened->home(), closed->home()))
        made.pose = opened->home();
    return made;
}

}  // namespace spectrad::view
