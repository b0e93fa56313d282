#include "scene/shapes.h"

#include "base/files.h"
#include "base/text.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <set>

using namespace spectrad;

namespace {

constexpr double pi = std::numbers::pi;

Vec3 at(const Mesh& mesh, std::uint32_t i) {
    const auto& p = mesh.position[i];
    return mesh.origin + Vec3{p[0], p[1], p[2]};
}

Vec3 normalOf(const Mesh& mesh, std::uint32_t i) {
    return {mesh.normal[i][0], mesh.normal[i][1], mesh.normal[i][2]};
}

struct Measures {
    double area = 0, volume = 0;
};
Measures measure(const Mesh& mesh) {
    Measures m;
    for (size_t t = 0; t < mesh.index.size(); t += 3) {
        const Vec3 a = at(mesh, mesh.index[t]), b = at(mesh, mesh.index[t + 1]),
                   c = at(mesh, mesh.index[t + 2]);
        m.area += length(cross(b - a, c - a)) / 2;
        m.volume += dot(a, cross(b, c)) / 6;
    }
    return m;
}

/// Every edge, after welding equal positions, is used once in each direction.
bool isWatertight(const Mesh& mesh) {
    std::map<std::array<float, 3>, int> weld;
    const auto id = [&](std::uint32_t i) {
        return weld.try_emplace(mesh.position[i], static_cast<int>(weld.size())).first->second;
    };
    std::map<std::pair<int, int>, int> edges;
    for (size_t t = 0; t < mesh.index.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
            ++edges[{id(mesh.index[t + k]), id(mesh.index[t + (k + 1) % 3])}];
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        const auto back = edges.find({edge.first.second, edge.first.first});
        return edge.second == 1 && back != edges.end() && back->second == 1;
    });
}

/// Largest |distance(p)| over points spread over every triangle.
double largestDeviation(const Mesh& mesh, const std::function<double(Vec3)>& distance) {
    double largest = 0;
    for (size_t t = 0; t < mesh.index.size(); t += 3) {
        const Vec3 a = at(mesh, mesh.index[t]), b = at(mesh, mesh.index[t + 1]),
                   c = at(mesh, mesh.index[t + 2]);
        for (int i = 0; i <= 6; ++i)
            for (int j = 0; i + j <= 6; ++j) {
                const Vec3 p = a * (i / 6.0) + b * (j / 6.0) + c * ((6 - i - j) / 6.0);
                largest = std::max(largest, std::abs(distance(p)));
            }
    }
    return largest;
}

struct Sample {
    const char* name;
    Shape shape;
    double area, volume;
    std::function<double(Vec3)> distance;  ///< from the true surface
};

/// Distance from a polygon's outline (r, y) turned about y; the outline need not be closed on the axis.
double distanceFromOutline(Vec3 p, const std::vector<std::pair<double, double>>& outline) {
    const double r = std::hypot(p.x, p.z);
    double nearest = 1e300;
    for (size_t i = 0; i + 1 < outline.size(); ++i) {
        const auto [r0, y0] = outline[i];
        const auto [r1, y1] = outline[i + 1];
        const double dr = r1 - r0, dy = y1 - y0;
        const double t = std::clamp(((r - r0) * dr + (p.y - y0) * dy) / (dr * dr + dy * dy), 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(r - r0 - t * dr, p.y - y0 - t * dy));
    }
    return nearest;
}

std::vector<Sample> closedShapes() {
    const double slant = std::hypot(1.5, 2.0);
    return {
        {"sphere",
         {.kind = ShapeKind::sphere, .radius = 1.5},
         4 * pi * 2.25,
         4 * pi * 3.375 / 3,
         [](Vec3 p) { return length(p) - 1.5; }},
        {"cylinder",
         {.kind = ShapeKind::cylinder, .radius = 1.5, .height = 2},
         2 * pi * 2.25 + 2 * pi * 1.5 * 2,
         pi * 2.25 * 2,
         [](Vec3 p) {
             return distanceFromOutline(p, {{0, 0}, {1.5, 0}, {1.5, 2}, {0, 2}});
         }},
        {"cone",
         {.kind = ShapeKind::cone, .radius = 1.5, .height = 2},
         pi * 2.25 + pi * 1.5 * slant,
         pi * 2.25 * 2 / 3,
         [](Vec3 p) {
             return distanceFromOutline(p, {{0, 0}, {1.5, 0}, {0, 2}});
         }},
        {"torus",
         {.kind = ShapeKind::torus, .radius = 1.5, .tube = 0.4},
         4 * pi * pi * 1.5 * 0.4,
         2 * pi * pi * 1.5 * 0.16,
         [](Vec3 p) { return std::hypot(std::hypot(p.x, p.y) - 1.5, p.z) - 0.4; }},
        {"box", {.kind = ShapeKind::box, .size = {1, 2, 3}}, 22, 6, {}},
    };
}

std::vector<Shape> allShapes() {
    std::vector<Shape> shapes;
    for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::box, ShapeKind::plane, ShapeKind::disc,
                                 ShapeKind::cylinder, ShapeKind::cone, ShapeKind::torus, ShapeKind::teapot})
        shapes.push_back({.kind = kind, .size = {1, 2, 3}, .radius = 1.5, .height = 2, .tube = 0.4});
    return shapes;
}

}  // namespace

TEST_CASE("closed shapes are watertight and their faces turn outwards, coarse and fine") {
    for (const Sample& sample : closedShapes()) {
        for (const double tolerance : {1.0, 0.1, 1e-3}) {
            CAPTURE(sample.name, tolerance);
            const Mesh mesh = tessellate(sample.shape, tolerance);
            CHECK(isWatertight(mesh));
            CHECK(measure(mesh).volume > 0);
        }
    }
}

TEST_CASE("area and volume converge to the closed forms, from inside") {
    for (const Sample& sample : closedShapes()) {
        CAPTURE(sample.name);
        const Measures coarse = measure(tessellate(sample.shape, 1e-2)),
                       fine = measure(tessellate(sample.shape, 1e-5, 8192));
        CHECK(fine.area == Approx(sample.area).epsilon(5e-5));
        CHECK(fine.volume == Approx(sample.volume).epsilon(5e-5));
        if (sample.shape.kind == ShapeKind::box) continue;
        CHECK(std::abs(coarse.volume - sample.volume) > 20 * std::abs(fine.volume - sample.volume));
        CHECK(coarse.volume < sample.volume);
    }
}

TEST_CASE("no point of a mesh is further from the true surface than the tolerance") {
    for (const Sample& sample : closedShapes()) {
        if (!sample.distance) continue;
        for (const double tolerance : {0.05, 1e-3}) {
            CAPTURE(sample.name, tolerance);
            const double deviation = largestDeviation(tessellate(sample.shape, tolerance), sample.distance);
            CHECK(deviation <= tolerance);
            CHECK(deviation > tolerance / 5);  // nor is it cut much finer than asked
        }
    }
}

TEST_CASE("normals are of unit length and point to the side from which triangles run counter-clockwise") {
    for (const Shape& shape : allShapes()) {
        const Mesh mesh = tessellate(shape, 1e-2);
        CAPTURE(mesh.name);
        REQUIRE(mesh.normal.size() == mesh.position.size());
        double worstLength = 0;
        size_t inwards = 0, degenerate = 0;
        for (size_t i = 0; i < mesh.normal.size(); ++i)
            worstLength =
                std::max(worstLength, std::abs(length(normalOf(mesh, static_cast<std::uint32_t>(i))) - 1));
        for (size_t t = 0; t < mesh.index.size(); t += 3) {
            const Vec3 a = at(mesh, mesh.index[t]), b = at(mesh, mesh.index[t + 1]),
                       c = at(mesh, mesh.index[t + 2]);
            const Vec3 face = cross(b - a, c - a);
            if (length(face) == 0) ++degenerate;
            for (size_t k = 0; k < 3; ++k)
                if (!(dot(face, normalOf(mesh, mesh.index[t + k])) > 0)) ++inwards;
        }
        CHECK(worstLength < 1e-6);
        CHECK(degenerate == 0);
        CHECK(inwards == 0);
    }
}

TEST_CASE("texture coordinates fill the unit square and grow to the right and up as seen from the front") {
    for (const Shape& shape : allShapes()) {
        const Mesh mesh = tessellate(shape, 1e-2);
        CAPTURE(mesh.name);
        REQUIRE(mesh.uv.size() == mesh.position.size());
        float low = 1, high = 0;
        for (const auto& uv : mesh.uv)
            for (const float c : uv) {
                low = std::min(low, c);
                high = std::max(high, c);
            }
        CHECK(low == Approx(0).margin(1e-6));
        CHECK(high == Approx(1));
        if (shape.kind == ShapeKind::teapot) continue;
        // Positive area in (u, v) where the triangle is counter-clockwise: the texture is not mirrored.
        size_t mirrored = 0;
        for (size_t t = 0; t < mesh.index.size(); t += 3) {
            const auto &a = mesh.uv[mesh.index[t]], &b = mesh.uv[mesh.index[t + 1]],
                       &c = mesh.uv[mesh.index[t + 2]];
            if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0) ++mirrored;
        }
        CHECK(mirrored == 0);
    }
}

TEST_CASE("a cone's normal keeps the slope of its side up to the apex") {
    const Mesh mesh = tessellate({.kind = ShapeKind::cone, .radius = 3, .height = 4}, 1e-2);
    size_t apexes = 0;
    for (std::uint32_t i = 0; i < mesh.position.size(); ++i) {
        if (at(mesh, i).y < 3.999) continue;
        ++apexes;
        CHECK(normalOf(mesh, i).y == Approx(0.6));
    }
    CHECK(apexes >= 8);
}

TEST_CASE("shapes stand where the format says") {
    const auto bounds = [](const Shape& shape) {
        const Mesh mesh = tessellate(shape, 1e-3);
        Vec3 low = at(mesh, 0), high = low;
        for (std::uint32_t i = 0; i < mesh.position.size(); ++i) {
            const Vec3 p = at(mesh, i);
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        return std::pair{low, high};
    };
    const auto near = [](Vec3 a, Vec3 b) { return length(a - b) < 5e-3; };
    auto [low, high] = bounds({.kind = ShapeKind::plane, .size = {2, 1, 1}});
    CHECK((near(low, {-1, -0.5, 0}) && near(high, {1, 0.5, 0})));
    std::tie(low, high) = bounds({.kind = ShapeKind::disc, .radius = 2});
    CHECK((near(low, {-2, -2, 0}) && near(high, {2, 2, 0})));
    std::tie(low, high) = bounds({.kind = ShapeKind::cylinder, .radius = 1, .height = 3});
    CHECK((near(low, {-1, 0, -1}) && near(high, {1, 3, 1})));
    std::tie(low, high) = bounds({.kind = ShapeKind::cone, .radius = 1, .height = 3});
    CHECK((near(low, {-1, 0, -1}) && near(high, {1, 3, 1})));
    std::tie(low, high) = bounds({.kind = ShapeKind::torus, .radius = 1, .tube = 0.25});
    CHECK((near(low, {-1.25, -1.25, -0.25}) && near(high, {1.25, 1.25, 0.25})));
    for (const ShapeKind kind : {ShapeKind::plane, ShapeKind::disc}) {
        const Mesh mesh = tessellate({.kind = kind}, 0.1);
        CHECK(normalOf(mesh, 0) == Vec3{0, 0, 1});
    }
}

TEST_CASE("no finer than asked around a turn, no coarser than a shape bears, whatever the tolerance") {
    for (const Shape& shape : allShapes()) {
        const size_t coarse = tessellate(shape, 1e9).triangles(),
                     capped = tessellate(shape, 1e-300, 64).triangles();
        CHECK(coarse >= 2);
        CHECK(capped <= 64 * 64 * 8);
        CHECK(capped >= coarse);
        CHECK(boundingRadius(shape) > 0);
    }
}

TEST_CASE("no point of a shape is further from its origin than its bounding radius, and the bound is close") {
    for (const Shape& shape : allShapes()) {
        const Mesh mesh = tessellate(shape, 1e-3);
        CAPTURE(mesh.name);
        double furthest = 0;
        for (std::uint32_t i = 0; i < mesh.position.size(); ++i)
            furthest = std::max(furthest, length(at(mesh, i)));
        CHECK(furthest <= boundingRadius(shape) * (1 + 1e-6));
        CHECK(furthest >= boundingRadius(shape) * 0.95);
    }
}

TEST_CASE("the teapot has its height, Newell's proportions, lid, spout and handle") {
    const Mesh mesh = tessellate({.kind = ShapeKind::teapot, .size = {3.15, 1, 1}}, 1e-3);
    Vec3 low = at(mesh, 0), high = low;
    double spoutY = 0, handleY = 0, knobRadius = 0;
    for (std::uint32_t i = 0; i < mesh.position.size(); ++i) {
        const Vec3 p = at(mesh, i);
        if (p.x > high.x) spoutY = p.y;
        if (p.x < low.x) handleY = p.y;
        if (p.y > 2.9) knobRadius = std::max(knobRadius, std::hypot(p.x, p.z));
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    CHECK(high.x - low.x == Approx(6.43).margin(0.01));
    CHECK(high.y - low.y == Approx(3.15).margin(1e-5));
    CHECK(high.z - low.z == Approx(4).margin(0.01));
    CHECK(low.y == Approx(0).margin(1e-6));
    CHECK(high.z == Approx(-low.z).margin(1e-5));
    CHECK(spoutY == Approx(2.45).margin(0.1));  // the spout's mouth is the furthest towards +x …
    CHECK(handleY == Approx(1.9).margin(0.2));  // … the handle's bow towards −x
    CHECK(knobRadius == Approx(0.38).margin(0.1));
}

TEST_CASE("the teapot's body is as round as its four patches and its patches meet without cracks") {
    const Mesh mesh = tessellate({.kind = ShapeKind::teapot, .size = {1, 1, 1}}, 1e-3);
    std::map<std::array<float, 3>, int> weld;
    const auto id = [&](std::uint32_t i) {
        return weld.try_emplace(mesh.position[i], static_cast<int>(weld.size())).first->second;
    };
    std::map<std::pair<int, int>, int> edges;
    for (size_t t = 0; t < mesh.index.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) {
            const int a = id(mesh.index[t + k]), b = id(mesh.index[t + (k + 1) % 3]);
            ++edges[std::minmax(a, b)];
        }
    // Open edges: lid's lower edge, body's inner rim, spout's two ends, handle's two ends. Each is a closed
    // loop: at every vertex as many open edges as make pairs.
    std::map<int, int> ends;
    int shared = 0;
    for (const auto& [edge, uses] : edges) {
        shared += uses > 2 ? 1 : 0;
        if (uses != 1) continue;
        ++ends[edge.first];
        ++ends[edge.second];
    }
    for (const auto& [vertex, count] : ends)
        CHECK(count == 2);
}

TEST_CASE("the teapot agrees with the mesh that others made of Newell's patches") {
    const std::filesystem::path file = std::filesystem::path(SPECTRAD_SHARED) / "models/teapot.obj";
    if (!std::filesystem::exists(file)) {
        WARN("skipped: " << file << " is not here");
        return;
    }
    const std::string text = readFile(file);
    std::vector<Vec3> theirs;
    for (std::string_view line : split(text, '\n')) {
        const auto pieces = words(line);
        if (pieces.size() < 4 || pieces[0] != "v") continue;
        theirs.push_back({*parseDouble(pieces[1]), *parseDouble(pieces[2]), *parseDouble(pieces[3])});
    }
    REQUIRE(theirs.size() > 100);
    const Mesh ours = tessellate({.kind = ShapeKind::teapot, .size = {3.15, 1, 1}}, 2e-4);
    double worst = 0;
    for (size_t i = 0; i < theirs.size(); i += 97) {
        double nearest = 1e300;
        for (std::uint32_t j = 0; j < ours.position.size(); ++j)
            nearest = std::min(nearest, length(at(ours, j) - theirs[i]));
        worst = std::max(worst, nearest);
    }
    CHECK(worst < 0.05);
}
