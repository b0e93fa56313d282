// <light> and <background>.
#include "scene/reading.h"

namespace spectrad {

namespace {

/// Unit vector of a direction attribute.
Vec3 direction(const Element& element, const char* attribute) {
    const Vec3 v = element.vector(attribute, {});
    if (v == Vec3{}) element.fail(attribute, "a direction cannot be 0 0 0");
    return normalized(v);
}

SourceKind sourceKind(LightType type) {
    switch (type) {
        case LightType::directional:
            return SourceKind::irradiance;
        case LightType::ambient:
            return SourceKind::radiance;
        default:
            return SourceKind::intensity;
    }
}

/// Where a spot shines: at a target, or into a direction.
Vec3 spotDirection(const Reading& reading, const Element& element, Vec3 position) {
    if (element.has("target") == element.has("direction"))
        element.fail(element.has("target") ? "has both 'target' and 'direction' (one is allowed)"
                                           : "of type spot needs the attribute 'target' or 'direction'");
    if (element.has("direction")) return direction(element, "direction");
    const Vec3 target = reading.position(element, "target", {});
    if (target == position) element.fail("target", "the target is the light's own position");
    return normalized(target - position);
}

}  // namespace

Light readLight(Reading& reading, const Element& element) {
    Light light;
    light.where = element.where();
    light.name = element.text("name");
    light.type = element.choice<LightType>("type",
                                           {{"point", LightType::point},
                                            {"spot", LightType::spot},
                                            {"directional", LightType::directional},
                                            {"ambient", LightType::ambient}},
                                           LightType::point);
    const std::string type = element.text("type");
    const std::string what = (light.type == LightType::ambient ? "an " : "a ") + type + " light";
    const std::string notHere = "does not belong to " + what;

    const bool placed = light.type == LightType::point || light.type == LightType::spot;
    if (!placed) element.refuse("position", notHere);
    if (light.type != LightType::spot)
        for (const char* attribute : {"target", "angle", "blend"})
            element.refuse(attribute, notHere);
    if (light.type == LightType::ambient)
        element.refuse("shadows", notHere + ", which comes from everywhere");
    if (light.type == LightType::point || light.type == LightType::ambient)
        element.refuse("direction", notHere);

    light.position = reading.position(element, "position", {});
    if (light.type == LightType::spot) {
        light.direction = spotDirection(reading, element, light.position);
        light.angle = element.number("angle", light.angle, {0, 180, false, true});
        light.blend = element.number("blend", light.blend, zeroToOne);
    } else if (light.type == LightType::directional) {
        if (!element.has("direction")) element.fail("of type directional needs the attribute 'direction'");
        light.direction = direction(element, "direction");
    }
    light.shadows = element.boolean("shadows", reading.scene.shadows && light.type != LightType::ambient);
    light.emitter = readEmitter(reading, element, sourceKind(light.type), what);
    return light;
}

void readBackground(Reading& reading) {
    if (const auto background = Element(reading.document, reading.document.root()).child("background")) {
        reading.scene.background = readGlow(reading, *background, "the background");
        if (!reading.scene.background->texture)
            background->refuse("mapping", "stands only beside 'texture'");
        else
            reading.scene.background->texture->mapping = background->choice<TextureMapping>(
                "mapping", {{"picture", TextureMapping::picture}, {"cube", TextureMapping::cube}},
                TextureMapping::picture);
    }
}

}  // namespace spectrad
