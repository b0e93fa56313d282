// <camera> and <detector>.
#include "scene/reading.h"
#include "spectrum/detector_product.h"

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
    enum class Type { perspective, orthographic, cube };
    const Type type = element.choice<Type>(
        "type",
        {{"perspective", Type::perspective}, {"orthographic", Type::orthographic}, {"cube", Type::cube}},
        Type::perspective);
    camera.orthographic = type == Type::orthographic;
    camera.cube = type == Type::cube;
    if (camera.cube)
        for (const char* attribute : {"fov", "sensor", "focal", "height", "look-at", "up"})
            element.refuse(attribute, "does not belong to a cube camera (it looks all around)");
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

    const auto [width, height] =
        element.pixels("size", camera.cube ? std::pair{512, 512} : std::pair{1280, 720});
    if (camera.cube && width != height) element.fail("size", "the faces of a cube are square");
    camera.width = width;
    camera.height = height;
    return camera;
}

/// <detector>'s sensor, lens and filters, and its channels' own filters.
static DetectorProduct readProduct(const Element& element) {
    DetectorProduct product;
    const auto add = [](std::vector<DetectorFactor>& factors, const Element& from, const char* attribute,
                        bool quantum) {
        if (from.has(attribute)) factors.push_back({from.text(attribute), quantum, from.where(attribute)});
    };
    add(product.common, element, "sensitivity", false);
    add(product.common, element, "quantum-efficiency", true);
    if (product.common.size() != 1)
        element.fail("needs one of the attributes 'observer', 'sensitivity' and 'quantum-efficiency'");
    add(product.common, element, "lens", false);
    add(product.common, element, "filter", false);
    for (const pugi::xml_node node : element.node().children("channel")) {
        const Element channel(element.document(), node);
        product.channels.push_back({channel.text("name"), {}});
        add(product.channels.back().factors, channel, "filter", false);
    }
    return product;
}

void readDetectors(Reading& reading) {
    for (const pugi::xml_node node : reading.document.root().children("detector")) {
        const Element element(reading.document, node);
        DetectorUse detector;
        detector.where = element.where();
        detector.name = element.text("name");
        detector.observer = element.text("observer");
        if (element.has("observer")) {
            for (const char* attribute : {"sensitivity", "quantum-efficiency", "lens", "filter"})
                element.refuse(attribute, "cannot stand beside 'observer'");
            if (element.child("channel")) element.fail("has an 'observer', which brings its own channels");
            detector.sensitivity =
                detectorSpectrum(detector.observer, reading.resolver, element.where("observer"));
        } else {
            detector.sensitivity =
                multiplied(readProduct(element), detector.name, reading.resolver, element.where());
        }
        for (const std::filesystem::path& file : detector.sensitivity.files)
            reading.files.add(file);
        reading.detectors.add(detector.name, static_cast<Index>(reading.scene.detectors.size()),
                              detector.where);
        reading.scene.detectors.push_back(std::move(detector));
    }
}

}  // namespace spectrad
