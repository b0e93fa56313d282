#include "scene/import_collada.h"

#include "base/text.h"

#include <pugixml.hpp>

#include <cmath>
#include <cstring>
#include <numbers>

namespace spectrad {

namespace {

constexpr double radians = std::numbers::pi / 180;

std::optional<double> positive(const pugi::xml_node& parent, const char* name) {
    const auto value = parseDouble(parent.child(name).child_value());
    return value && *value > 0 ? value : std::nullopt;
}

double tanHalf(double degrees) {
    return std::tan(0.5 * degrees * radians);
}

ColladaOptics opticsOf(const pugi::xml_node& camera) {
    ColladaOptics optics;
    const pugi::xml_node common = camera.child("optics").child("technique_common");
    const pugi::xml_node perspective = common.child("perspective"),
                         orthographic = common.child("orthographic");
    optics.xfov = positive(perspective, "xfov");
    optics.yfov = positive(perspective, "yfov");
    optics.xmag = positive(orthographic, "xmag");
    optics.ymag = positive(orthographic, "ymag");
    optics.aspect = positive(perspective ? perspective : orthographic, "aspect_ratio");
    return optics;
}

/// Document order without recursion.
pugi::xml_node following(const pugi::xml_node& node) {
    if (node.first_child()) return node.first_child();
    pugi::xml_node at = node;
    while (at && !at.next_sibling())
        at = at.parent();
    return at.next_sibling();
}

}  // namespace

std::optional<double> ColladaOptics::widthByHeight() const {
    if (aspect) return aspect;
    if (xfov && yfov) return tanHalf(*xfov) / tanHalf(*yfov);
    if (xmag && ymag) return *xmag / *ymag;
    return std::nullopt;
}

std::optional<double> ColladaOptics::verticalFov(double otherwise) const {
    if (yfov) return yfov;
    if (xfov) return 2 * std::atan(tanHalf(*xfov) / widthByHeight().value_or(otherwise)) / radians;
    return std::nullopt;
}

std::optional<double> ColladaOptics::height(double otherwise) const {
    if (ymag) return 2 * *ymag;
    if (xmag) return 2 * *xmag / widthByHeight().value_or(otherwise);
    return std::nullopt;
}

std::unordered_map<std::string, ColladaOptics> colladaOptics(const std::filesystem::path& path) {
    pugi::xml_document document;
    std::unordered_map<std::string, ColladaOptics> optics, ofNode;
    if (!document.load_file(path.c_str())) return ofNode;
    for (pugi::xml_node at = document.document_element(); at; at = following(at))
        if (std::strcmp(at.name(), "camera") == 0)
            optics.try_emplace(at.attribute("id").value(), opticsOf(at));
    for (pugi::xml_node at = document.document_element(); at; at = following(at)) {
        if (std::strcmp(at.name(), "instance_camera") != 0) continue;
        const char* const url = at.attribute("url").value();
        const auto found = url[0] == '#' ? optics.find(url + 1) : optics.end();
        if (found == optics.end()) continue;
        const pugi::xml_node node = at.parent();
        ofNode.try_emplace(node.attribute(node.attribute("id") ? "id" : "name").value(), found->second);
    }
    return ofNode;
}

}  // namespace spectrad
