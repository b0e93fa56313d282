// Nodes and what stands in them, in document order, without recursion.
#include "scene/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace spectrad {

namespace {

std::optional<ShapeKind> shapeKind(std::string_view element) {
    static constexpr std::array<std::pair<std::string_view, ShapeKind>, 8> kinds{
        {{"sphere", ShapeKind::sphere},
         {"box", ShapeKind::box},
         {"plane", ShapeKind::plane},
         {"disc", ShapeKind::disc},
         {"cylinder", ShapeKind::cylinder},
         {"cone", ShapeKind::cone},
         {"torus", ShapeKind::torus},
         {"teapot", ShapeKind::teapot}}};
    for (const auto& [name, kind] : kinds)
        if (name == element) return kind;
    return std::nullopt;
}

/// matrix="…": 16 numbers row by row, acting on column vectors; the last column's upper three are a
/// displacement.
Affine readMatrix(const Reading& reading, const Element& element) {
    for (const char* attribute : {"translate", "rotate", "scale"})
        element.refuse(attribute, "cannot stand beside 'matrix'");
    const std::vector<double> v = element.numbers("matrix", {16});
    if (v[12] != 0 || v[13] != 0 || v[14] != 0 || v[15] != 1)
        element.fail("matrix", "the last row must be 0 0 0 1");
    Affine result;
    std::copy_n(v.begin(), 12, result.m.begin());
    for (const size_t i : {3u, 7u, 11u})
        result.m[i] = reading.metres(element, "matrix", result.m[i]);
    // Singular up to rounding: the determinant against the box that the columns would span at right angles.
    double box = 1;
    for (size_t column = 0; column < 3; ++column)
        box *= length({result.m[column], result.m[4 + column], result.m[8 + column]});
    const double determinant = result.determinant();
    if (!std::isfinite(determinant) || !(std::abs(determinant) > 1e-14 * box))
        element.fail("matrix",
                     "the matrix is singular or beyond the range of numbers (it must have an inverse)");
    return result;
}

Vec3 readScale(const Element& element) {
    if (!element.has("scale")) return {1, 1, 1};
    const std::vector<double> v = element.numbers("scale", {1, 3});
    const Vec3 scale = v.size() == 1 ? Vec3{v[0], v[0], v[0]} : Vec3{v[0], v[1], v[2]};
    const double volume = scale.x * scale.y * scale.z;
    if (volume == 0)
        element.fail("scale", scale.x == 0 || scale.y == 0 || scale.z == 0
                                  ? "a scale cannot be 0"
                                  : "the volume it leaves is below the range of numbers");
    if (!std::isfinite(volume)) element.fail("scale", "the volume it makes is beyond the range of numbers");
    return scale;
}

Index addNode(Reading& reading, const Element& element, Index parent) {
    const Index index = static_cast<Index>(reading.scene.nodes.size());
    Node& node = reading.scene.nodes.emplace_back();
    node.name = element.text("name");
    node.where = element.where();
    node.local = readTransform(reading, element);
    node.throwsShadows = element.boolean("shadows", true);
    reading.nodes.add(node.name, index, node.where);
    reading.scene.nodes[parent].children.push_back(index);
    return index;
}

struct InstanceToResolve {
    Index node;
    Element element;
};

/// One element that stands in `parent`. Returns the new node if it has content of its own that is still to be
/// read.
std::optional<Index> readContent(Reading& reading, const Element& element, Index parent,
                                 std::vector<InstanceToResolve>& instances) {
    Scene& scene = reading.scene;
    const std::string_view kind = element.name();
    if (kind == "node") return addNode(reading, element, parent);
    if (kind == "instance") {
        instances.push_back({addNode(reading, element, parent), element});
    } else if (kind == "import") {
        readImport(reading, element, addNode(reading, element, parent));
    } else if (kind == "mesh") {
        readMesh(reading, element, parent);
    } else if (kind == "light") {
        const Index index = static_cast<Index>(scene.lights.size());
        scene.lights.push_back(readLight(reading, element));
        reading.lights.add(scene.lights.back().name, index, scene.lights.back().where);
        scene.nodes[parent].lights.push_back(index);
    } else if (kind == "camera") {
        const Index index = static_cast<Index>(scene.cameras.size());
        scene.cameras.push_back(readCamera(reading, element));
        reading.cameras.add(scene.cameras.back().name, index, scene.cameras.back().where);
        scene.nodes[parent].cameras.push_back(index);
    } else if (const auto shape = shapeKind(kind)) {
        scene.nodes[parent].shapes.push_back(readShape(reading, element, *shape));
    }
    return std::nullopt;
}

/// Nodes and cameras that imports brought can be named too, where the scene has not taken the name.
void addImportedNames(Reading& reading) {
    if (reading.cache.models.empty()) return;
    for (Index i = 0; i < reading.scene.nodes.size(); ++i)
        reading.nodes.addImported(reading.scene.nodes[i].name, i);
    for (Index i = 0; i < reading.scene.cameras.size(); ++i)
        reading.cameras.addImported(reading.scene.cameras[i].name, i);
}

}  // namespace

Affine readTransform(const Reading& reading, const Element& element) {
    if (element.has("matrix")) return readMatrix(reading, element);
    Affine result = Affine::translation(reading.position(element, "translate", {}));
    if (element.has("rotate")) {
        const std::vector<double> v = element.numbers("rotate", {4});
        const Vec3 axis{v[0], v[1], v[2]};
        if (axis == Vec3{})
            element.fail("rotate", "the axis cannot be 0 0 0 (expected axis x y z and degrees)");
        result = result * Affine::rotation(axis, v[3]);
    }
    if (element.has("scale")) result = result * Affine::scaling(readScale(element));
    return result;
}

ShapeUse readShape(Reading& reading, const Element& element, ShapeKind kind) {
    ShapeUse use;
    Shape& shape = use.shape;
    shape.kind = kind;
    shape.radius = reading.length(element, "radius", 1, positive);
    shape.height = reading.length(element, "height", 2, positive);
    shape.tube = reading.length(element, "tube", 0.25, positive);
    std::vector<double> size{1, 1, 1};
    if (element.has("size")) {
        const size_t sides = kind == ShapeKind::box ? 3 : kind == ShapeKind::plane ? 2 : 1;
        size = sides == 1 ? element.numbers("size", {1}) : element.numbers("size", {1, sides});
        for (const double side : size)
            if (!positive.contain(side)) element.fail("size", "every side must be " + positive.text());
        if (size.size() == 1) size.assign(3, size.front());
        size.resize(3, 1);
    }
    shape.size = {reading.metres(element, "size", size[0]), reading.metres(element, "size", size[1]),
                  reading.metres(element, "size", size[2])};
    if (kind == ShapeKind::torus && shape.tube >= shape.radius)
        element.fail("needs a tube thinner than its ring (tube below radius)");
    use.material = reading.material(element, "material");
    return use;
}

void readGraph(Reading& reading) {
    struct Frame {
        pugi::xml_node next;
        Index node;
    };
    std::vector<Frame> open{{reading.document.root().first_child(), 0}};
    std::vector<InstanceToResolve> instances;
    while (!open.empty()) {
        const auto [child, parent] = open.back();
        if (!child) {
            open.pop_back();
            continue;
        }
        open.back().next = child.next_sibling();
        if (const auto node = readContent(reading, Element(reading.document, child), parent, instances))
            open.push_back({child.first_child(), *node});
    }
    addImportedNames(reading);
    for (const auto& [node, element] : instances)
        reading.scene.nodes[node].instanceOf = reading.nodes.find(element.text("of"), element.where("of"));
    checkInstances(reading.scene);
}

}  // namespace spectrad
