// Along which way brushed materials are brushed.
#include "render/tangents.h"

#include "scene/shapes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;

namespace {

/// Every vertex of a shape's mesh: its place, normal and tangent.
template <typename Check>
void each(const Mesh& mesh, Check check) {
    const auto tangents = tangentsOf(mesh);
    REQUIRE(tangents.size() == mesh.position.size());
    const auto vec = [](const std::array<float, 3>& v) {
        return Vec3{double{v[0]}, double{v[1]}, double{v[2]}};
    };
    for (size_t v = 0; v < tangents.size(); ++v) {
        const Vec3 t = vec(tangents[v]), n = vec(mesh.normal[v]);
        CHECK(length(t) == Approx(1).margin(1e-6));
        CHECK(dot(t, n) == Approx(0).margin(1e-6));
        check(vec(mesh.position[v]) + mesh.origin, n, t);
    }
}

/// How far t is from the line along `wanted`: the sine of the angle between them.
double apart(Vec3 t, Vec3 wanted) {
    return length(cross(t, normalized(wanted)));
}

Mesh cylinderSide(bool coordinates) {
    Mesh mesh;
    for (int i = 0; i <= 90; ++i) {
        const float phi = static_cast<float>(i) * 4 * 3.14159265F / 180;
        for (const float y : {0.0F, 1.0F}) {
            mesh.position.push_back({std::sin(phi), y, std::cos(phi)});
            mesh.normal.push_back({std::sin(phi), 0, std::cos(phi)});
            if (coordinates) mesh.uv.push_back({static_cast<float>(i) / 90, y});
        }
        if (i == 0) continue;
        const auto v = static_cast<std::uint32_t>(2 * i);
        for (const std::uint32_t corner : {v - 2, v, v + 1, v - 2, v + 1, v - 1})
            mesh.index.push_back(corner);
    }
    return mesh;
}

}  // namespace

TEST_CASE("tangents go along u: around a sphere's axis, around a torus, around a cylinder") {
    Shape sphere;
    sphere.kind = ShapeKind::sphere;
    each(tessellate(sphere, 1e-4), [](Vec3 p, Vec3 n, Vec3 t) {
        if (std::abs(n.y) < 0.99) CHECK(apart(t, {p.z, 0, -p.x}) < 0.02);
    });
    Shape torus;
    torus.kind = ShapeKind::torus;
    each(tessellate(torus, 1e-4), [](Vec3 p, Vec3, Vec3 t) { CHECK(apart(t, {p.y, -p.x, 0}) < 0.02); });
    each(cylinderSide(true), [](Vec3 p, Vec3, Vec3 t) { CHECK(apart(t, {p.z, 0, -p.x}) < 0.05); });
}

TEST_CASE("a mesh without texture coordinates is brushed around its own y axis") {
    each(cylinderSide(false), [](Vec3 p, Vec3, Vec3 t) { CHECK(apart(t, {p.z, 0, -p.x}) < 1e-6); });
    Mesh lid;  // a face at right angles to that axis
    lid.position = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    lid.normal = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
    lid.index = {0, 1, 2};
    each(lid, [](Vec3, Vec3, Vec3 t) { CHECK(apart(t, {1, 0, 0}) < 1e-6); });
}
