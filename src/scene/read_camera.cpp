// <camera> and <detector>.
#include "scene/reading.h"

#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// Vertical field of view in degrees: fov= itself, or from the sensor's height and the focal length (both
/// mm).
double verticalFov(const Element& element) {
    if (!element.has("sensor") && !element.has("focal"))
        return element.number("fov", 40, {0, 180, false, false});
    element.refuse("fov", "cannot stand beside 'sensor' and 'focal'");
    if (!element.has("sensor") || !element.has("focal"))
        element.fail(std::string("has '") + (element.has("sensor") ? "sensor" : "focal") + "' without '" +
                     (element.has("sensor") ? "focal" : "sensor") + "' (both are needed, in mm)");
    const double sensorHeight = element.sides("sensor").second;
    const double focal = element.number("focal", 50, positive);
    return 2 * std::atan(sensorHeight / (2 * focal)) * 180 / std::numbers::pi;
}

}  // namespace

Camera readCamera(Reading& reading, const Element& element) {
    Camera camera;
    camera.where = element.where();
    camera.name = element.text("name");
    camera.orthographic =
        element.choice<bool>("type", {{"perspective", false}, {"orthographic", true}}, false);
    if (camera.orthographic) {
        for (const char* attribute : {"fov", "sensor", "focal"})
            element.refuse(attribute, "does not belong to an orthographic camera (its view has a height)");
        if (!element.has("height")) element.fail("of type orthographic needs the attribute 'height'");
        camera.viewHeight = reading.length(element, "height", 1, positive);
    } else {
        element.refuse("height", "does not belong to a perspective camera (its view has a fov)");
        camera.fovDegrees = verticalFov(element);
        if (!(camera.fovDegrees > 0) || !(camera.fovDegrees < 180))
            element.fail("focal", "sensor and focal length leave no angle of view");
    }

    const Vec3 from = reading.position(element, "look-from", {});
    const Vec3 at = element.has("look-at") ? reading.position(element, "look-at", {}) : from + Vec3{0, 0, -1};
    if (at == from)
        element.fail(element.has("look-at") ? "look-at" : "look-from", "the camera looks at its own place");
    const Vec3 up = element.vector("up", {0, 1, 0});
    if (up == Vec3{}) element.fail("up", "a direction cannot be 0 0 0");
    camera.toNode = Affine::lookAt(from, at, up);
    if (!camera.toNode.finite()) element.fail("the camera's place is beyond the range of numbers");

    const auto [width, height] = element.pixels("size", {1280, 720});
    camera.width = width;
    camera.height = height;
    return camera;
}

void readDetectors(Reading& reading) {
    for (const pugi::xml_node node : reading.document.root().children("detector")) {
        const Element element(reading.document, node);
        DetectorUse detector;
        detector.where = element.where();
        detector.name = element.text("name");
        detector.observer = element.text("observer");
        static_cast<void>(reading.spectrum(
            element, "observer", Role::detector));  // it must be there, and its file is one that was read
        reading.detectors.add(detector.name, static_cast<Index>(reading.scene.detectors.size()),
                              detector.where);
        reading.scene.detectors.push_back(std::move(detector));
    }
}

}  // namespace spectrad
