#include "scene/reading.h"

#include <fmt/format.h>

#include <cmath>

namespace spectrad {

void FilesRead::add(const std::filesystem::path& file) {
    if (known_.insert(file.string()).second) list_.push_back(file.string());
}

double Reading::metres(const Element& element, const char* attribute, double value) const {
    const double result = value * scene.metresPerUnit;
    if (!std::isfinite(result))
        element.fail(attribute, "the length in metres is beyond the range of numbers");
    return result;
}

double Reading::length(const Element& element, const char* attribute, double fallback, Bounds bounds) const {
    return metres(element, attribute, element.number(attribute, fallback, bounds));
}

Vec3 Reading::position(const Element& element, const char* attribute, Vec3 fallback) const {
    const Vec3 units = element.vector(attribute, fallback);
    return {metres(element, attribute, units.x), metres(element, attribute, units.y),
            metres(element, attribute, units.z)};
}

Spectrum Reading::spectrum(const Element& element, const char* attribute, Role role) {
    Spectrum result = resolver.resolve(element.text(attribute), role, element.where(attribute));
    for (const std::filesystem::path& read : result.files)
        files.add(read);
    return result;
}

Index Reading::material(const Element& element, const char* attribute) {
    if (!element.has(attribute)) return 0;
    const Index index = materials.find(element.text(attribute), element.where(attribute));
    materialUsed[index] = true;
    return index;
}

std::filesystem::path Reading::file(const Element& element, const char* attribute) {
    std::filesystem::path found = resolver.findFile(element.text(attribute), element.where(attribute));
    files.add(found);
    return found;
}

Scene emptyScene() {
    Scene scene;
    Spectrum grey;
    grey.text = "constant:0.5";
    grey.quantity = Quantity::reflectance;
    grey.formula = true;
    grey.channels = {"value"};
    grey.curves = {Curve::constant(0.5).withOutside(Outside::hold)};
    Material material;
    material.diffuse.emplace().reflectance = std::move(grey);
    scene.materials.push_back(std::move(material));
    scene.nodes.emplace_back();
    return scene;
}

}  // namespace spectrad
