#include "scene/mesh_builder.h"

#include <algorithm>

namespace spectrad {

std::uint32_t MeshBuilder::vertex(Vec3 position, Vec3 normal, double u, double v) {
    position_.push_back(position);
    normal_.push_back(normal);
    uv_.push_back({static_cast<float>(u), static_cast<float>(v)});
    return static_cast<std::uint32_t>(position_.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    index_.insert(index_.end(), {a, b, c});
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
}

void MeshBuilder::turnUpToFront() {
    for (std::vector<Vec3>* vectors : {&position_, &normal_})
        for (Vec3& v : *vectors)
            v = {v.x, -v.z, v.y};
}

Mesh MeshBuilder::finish(std::string name) const {
    Vec3 low = position_.front(), high = low;
    for (const Vec3& p : position_) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.origin = (low + high) * 0.5;
    mesh.uv = uv_;
    mesh.position.reserve(position_.size());
    mesh.normal.reserve(normal_.size());
    for (const Vec3& p : position_) {
        const Vec3 d = p - mesh.origin;
        mesh.position.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
    }
    for (const Vec3& n : normal_)
        mesh.normal.push_back({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
    const auto& p = mesh.position;
    for (size_t t = 0; t < index_.size(); t += 3) {
        const std::uint32_t a = index_[t], b = index_[t + 1], c = index_[t + 2];
        if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh.index.insert(mesh.index.end(), {a, b, c});
    }
    return mesh;
}

}  // namespace spectrad
