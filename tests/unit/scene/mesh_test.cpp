#include "scene/mesh.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace spectrad;

namespace {

/// The unit cube around zero: 8 vertices, 12 triangles. Of each side's two triangles, one meets four corners
/// less often.
Mesh cube() {
    Mesh m;
    for (int i = 0; i < 8; ++i)
        m.position.push_back({i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f});
    m.index = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
               2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return m;
}

Vec3 vec(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

}  // namespace

TEST_CASE("smooth normals of a cube point along the diagonals, however its sides are cut") {
    const Mesh m = withNormals(cube(), Normals::smooth);
    REQUIRE(m.normal.size() == 8);
    for (size_t i = 0; i < 8; ++i)
        CHECK(length(vec(m.normal[i]) - normalized(vec(m.position[i]))) < 1e-6);
    CHECK(m.index == cube().index);
}

TEST_CASE("smooth normals join vertices that lie at the same place, +0 and -0 alike") {
    Mesh m;
    m.position = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {-0.0f, 0, -0.0f}, {0, 1, 0}, {0, 0, 1}};
    m.index = {0, 1, 2, 3, 4, 5};  // normals +y and +x; right angles at the shared corner
    const Mesh s = withNormals(m, Normals::smooth);
    const double h = std::sqrt(0.5);
    CHECK(length(vec(s.normal[0]) - Vec3{h, h, 0}) < 1e-6);
    CHECK(s.normal[0] == s.normal[3]);
    CHECK(length(vec(s.normal[1]) - Vec3{0, 1, 0}) < 1e-6);
}

TEST_CASE("flat normals give each triangle its own corners and keep its order") {
    Mesh m = cube();
    m.uv.assign(8, {0.25f, 0.75f});
    const Mesh f = withNormals(m, Normals::flat);
    REQUIRE(f.position.size() == 36);
    REQUIRE(f.uv.size() == 36);
    for (size_t k = 0; k < 36; ++k) {
        CHECK(f.position[f.index[k]] == m.position[m.index[k]]);
        CHECK(std::abs(length(vec(f.normal[k])) - 1) < 1e-6);
        CHECK(dot(vec(f.normal[k]), vec(f.position[k])) == Approx(0.5));  // outward, on a side
    }
}

TEST_CASE("the file's normals stay, at unit length; those that are no direction become smooth ones") {
    Mesh m = cube();
    m.normal.assign(8, {0, 3, 0});
    m.normal[5] = {0, 0, 0};
    m.normal[6] = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
    const Mesh f = withNormals(m, Normals::file);
    CHECK(f.normal[0] == std::array<float, 3>{0, 1, 0});
    CHECK(length(vec(f.normal[5]) - normalized(vec(m.position[5]))) < 1e-6);
    CHECK(length(vec(f.normal[6]) - normalized(vec(m.position[6]))) < 1e-6);
    m.normal.clear();
    CHECK(withNormals(m, Normals::file).normal == withNormals(m, Normals::smooth).normal);
}

TEST_CASE("zero-area faces have no say in smooth normals, and get a direction themselves") {
    Mesh m = cube();
    m.index.insert(m.index.end(), {0, 0, 7, 3, 3, 3});
    m.position.push_back({9, 9, 9});
    m.index.insert(m.index.end(), {8, 8, 8});
    const Mesh s = withNormals(m, Normals::smooth);
    for (size_t i = 0; i < 8; ++i)
        CHECK(length(vec(s.normal[i]) - normalized(vec(m.position[i]))) < 1e-6);
    CHECK(length(vec(s.normal[8])) == Approx(1));
    for (const auto& n : withNormals(m, Normals::flat).normal)
        CHECK(length(vec(n)) == Approx(1));
}

TEST_CASE("normals hold for the smallest and largest meshes that float can state") {
    for (const float scale : {1e-36f, 1e37f}) {
        Mesh m = cube();
        for (auto& p : m.position)
            for (float& x : p)
                x *= scale;
        const Mesh s = withNormals(m, Normals::smooth);
        for (size_t i = 0; i < 8; ++i)
            CHECK(length(vec(s.normal[i]) - normalized(vec(m.position[i]))) < 1e-5);
    }
}

TEST_CASE("a mesh of nothing stays one") {
    for (const Normals normals : {Normals::smooth, Normals::flat, Normals::file})
        CHECK(withNormals(Mesh{}, normals).position.empty());
}

TEST_CASE("welding joins what is equal, keeps what differs, drops what no triangle uses") {
    Mesh m;
    m.position = {{5, 5, 5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-0.0f, 0, 0}, {0, 0, 1}};
    m.normal.assign(7, {0, 0, 1});
    m.normal[4] = {1, 0, 0};
    m.uv.assign(7, {0, 0});
    m.index = {1, 2, 3, 5, 4, 6};
    const Mesh before = m;
    weldIdentical(m);
    REQUIRE(m.position.size() == 5);
    REQUIRE(m.normal.size() == 5);
    REQUIRE(m.uv.size() == 5);
    CHECK(m.index[0] == m.index[3]);
    CHECK(m.index[1] != m.index[4]);
    for (size_t k = 0; k < 6; ++k) {
        CHECK(m.position[m.index[k]] == before.position[before.index[k]]);
        CHECK(m.normal[m.index[k]] == before.normal[before.index[k]]);
    }
}
