#include "scene/mesh.h"

#include <bit>
#include <cmath>
#include <limits>

namespace spectrad {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

Vec3 toVec3(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}
std::array<float, 3> toFloats(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
/// Adding 0 turns −0 into 0, so that equal numbers have equal bits.
std::uint32_t bitsOf(float v) {
    return std::bit_cast<std::uint32_t>(v + 0.0f);
}

/// For each of `count` keys the index of the first equal one. Open addressing with linear probing: one pass,
/// no allocation per key, and the result does not depend on the hash.
template <typename KeyOf>
std::vector<std::uint32_t> firstEqual(size_t count, KeyOf keyOf) {
    std::vector<std::uint32_t> first(count);
    std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 1), none);
    const size_t mask = table.size() - 1;
    for (size_t i = 0; i < count; ++i) {
        const auto key = keyOf(i);
        std::uint64_t hash = 0;
        for (const std::uint32_t word : key) {
            hash = (hash ^ word) *
                   0x9e3779b97f4a7c15u;  // Fibonacci hashing (Knuth 6.4), the high bits folded down
            hash ^= hash >> 29;
        }
        size_t slot = hash & mask;
        while (table[slot] != none && keyOf(table[slot]) != key)
            slot = (slot + 1) & mask;
        if (table[slot] == none) table[slot] = static_cast<std::uint32_t>(i);
        first[i] = table[slot];
    }
    return first;
}

std::array<std::uint32_t, 3> positionKey(const Mesh& mesh, size_t i) {
    const auto& p = mesh.position[i];
    return {bitsOf(p[0]), bitsOf(p[1]), bitsOf(p[2])};
}

/// Twice the area times the normal; in double no product of floats over- or underflows.
Vec3 areaNormal(const Mesh& mesh, size_t triangle) {
    const Vec3 a = toVec3(mesh.position[mesh.index[3 * triangle]]);
    const Vec3 b = toVec3(mesh.position[mesh.index[3 * triangle + 1]]);
    const Vec3 c = toVec3(mesh.position[mesh.index[3 * triangle + 2]]);
    return cross(b - a, c - a);
}

/// Unit normals, one per vertex: the same for all vertices at a position. Weighted by the face's angle there,
/// so that the result does not depend on how a polygon was cut into triangles (Thürmer & Wüthrich 1998).
std::vector<Vec3> smoothNormals(const Mesh& mesh) {
    const auto first = firstEqual(mesh.position.size(), [&](size_t i) { return positionKey(mesh, i); });
    std::vector<Vec3> sum(mesh.position.size());
    for (size_t t = 0; t < mesh.triangles(); ++t) {
        const Vec3 normal = normalized(areaNormal(mesh, t));
        if (normal == Vec3{}) continue;
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 here = toVec3(mesh.position[mesh.index[3 * t + k]]);
            const Vec3 u = toVec3(mesh.position[mesh.index[3 * t + (k + 1) % 3]]) - here;
            const Vec3 v = toVec3(mesh.position[mesh.index[3 * t + (k + 2) % 3]]) - here;
            const double angle = std::atan2(length(cross(u, v)), dot(u, v));
            Vec3& s = sum[first[mesh.index[3 * t + k]]];
            s = s + normal * angle;
        }
    }
    std::vector<Vec3> result(mesh.position.size());
    for (size_t i = 0; i < result.size(); ++i) {
        result[i] = normalized(sum[first[i]]);
        // Only zero-area faces meet here, or faces that cancel out: any direction does, but it must be one.
        if (result[i] == Vec3{}) result[i] = {0, 0, 1};
    }
    return result;
}

void makeSmooth(Mesh& mesh) {
    const std::vector<Vec3> smooth = smoothNormals(mesh);
    mesh.normal.resize(mesh.position.size());
    for (size_t i = 0; i < smooth.size(); ++i)
        mesh.normal[i] = toFloats(smooth[i]);
}

/// The file's normals at unit length; those that are no direction (zero, not finite) become smooth ones.
void repairNormals(Mesh& mesh) {
    std::vector<Vec3> smooth;
    for (size_t i = 0; i < mesh.normal.size(); ++i) {
        const Vec3 n = normalized(toVec3(mesh.normal[i]));
        const bool usable = std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z) && !(n == Vec3{});
        if (!usable && smooth.empty()) smooth = smoothNormals(mesh);
        mesh.normal[i] = toFloats(usable ? n : smooth[i]);
    }
}

/// Three vertices of its own for every triangle.
Mesh flat(const Mesh& mesh) {
    Mesh result;
    result.name = mesh.name;
    result.origin = mesh.origin;
    result.position.reserve(mesh.index.size());
    result.normal.reserve(mesh.index.size());
    result.uv.reserve(mesh.uv.empty() ? 0 : mesh.index.size());
    result.index.reserve(mesh.index.size());
    for (size_t t = 0; t < mesh.triangles(); ++t) {
        Vec3 normal = normalized(areaNormal(mesh, t));
        if (normal == Vec3{}) normal = {0, 0, 1};
        for (size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.index[3 * t + k];
            result.index.push_back(static_cast<std::uint32_t>(result.position.size()));
            result.position.push_back(mesh.position[v]);
            result.normal.push_back(toFloats(normal));
            if (!mesh.uv.empty()) result.uv.push_back(mesh.uv[v]);
        }
    }
    return result;
}

}  // namespace

Mesh withNormals(const Mesh& mesh, Normals normals) {
    if (normals == Normals::flat) return flat(mesh);
    Mesh result = mesh;
    if (normals == Normals::smooth || mesh.normal.empty())
        makeSmooth(result);
    else
        repairNormals(result);
    return result;
}

void weldIdentical(Mesh& mesh) {
    const auto first = firstEqual(mesh.position.size(), [&](size_t i) {
        std::array<std::uint32_t, 8> key{};
        for (size_t k = 0; k < 3; ++k) {
            key[k] = bitsOf(mesh.position[i][k]);
            if (!mesh.normal.empty()) key[3 + k] = bitsOf(mesh.normal[i][k]);
            if (!mesh.uv.empty() && k < 2) key[6 + k] = bitsOf(mesh.uv[i][k]);
        }
        return key;
    });
    // New numbers in the order in which the triangles first name the vertices: neighbours stay near each
    // other in memory.
    std::vector<std::uint32_t> renumbered(mesh.position.size(), none);
    Mesh welded;
    for (std::uint32_t& v : mesh.index) {
        std::uint32_t& number = renumbered[first[v]];
        if (number == none) {
            number = static_cast<std::uint32_t>(welded.position.size());
            welded.position.push_back(mesh.position[v]);
            if (!mesh.normal.empty()) welded.normal.push_back(mesh.normal[v]);
            if (!mesh.uv.empty()) welded.uv.push_back(mesh.uv[v]);
        }
        v = number;
    }
    mesh.position = std::move(welded.position);
    mesh.normal = std::move(welded.normal);
    mesh.uv = std::move(welded.uv);
}

}  // namespace spectrad
