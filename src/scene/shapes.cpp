#include "scene/shapes.h"

#include "scene/mesh_builder.h"
#include "scene/teapot.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace spectrad {

namespace {

/// Chords around a full turn of a circle, so that none leaves the arc by more than `tolerance`: the sagitta
/// is r (1 − cos(π/n)) = 2 r sin²(π/2n).
int chords(double radius, double tolerance, int least, int most) {
    const double share = std::min(tolerance / (2 * radius), 1.0);
    const double angle = 2 * std::asin(std::sqrt(std::max(share, 0.0)));
    const double n = angle > 0 ? std::ceil(std::numbers::pi / angle) : most;
    return static_cast<int>(
        std::clamp(n, static_cast<double>(least), static_cast<double>(std::max(least, most))));
}

constexpr int leastAround = 8;

/// The circle at which a surface of revolution is cut, closed to the last bit. Seen from +y it runs
/// counter-clockwise from −z over +x … so that from outside u grows to the right and the seam is at the back.
class Circle {
  public:
    explicit Circle(int n) {
        for (int i = 0; i < n; ++i) {
            const double angle = std::numbers::pi * (2.0 * i / n - 1);
            points_.push_back({std::sin(angle), 0, std::cos(angle)});
        }
    }
    [[nodiscard]] int size() const { return static_cast<int>(points_.size()); }
    [[nodiscard]] Vec3 operator[](int i) const { return points_[static_cast<size_t>(i % size())]; }
    /// Half-way between i and i + 1.
    [[nodiscard]] Vec3 between(int i) const { return normalized((*this)[i] + (*this)[i + 1]); }

  private:
    std::vector<Vec3> points_;
};

/// One point of the curve that is turned about the y axis, with the surface's normal there.
struct ProfilePoint {
    double radius, y;
    double outward, upward;  ///< the normal's components away from the axis and along it; a unit vector
    double v;
};

/// Turns a profile, bottom to top as seen from outside, about y. A point on the axis becomes one vertex a
/// segment, with the normal and u of the segment's middle: a pole without zero-area triangles, an apex with a
/// normal of its own side.
void revolve(MeshBuilder& mesh, const std::vector<ProfilePoint>& profile, const Circle& circle) {
    const int n = circle.size();
    std::vector<std::uint32_t> below, row;
    for (size_t j = 0; j < profile.size(); ++j) {
        const ProfilePoint& p = profile[j];
        const bool pole = p.radius == 0;
        row.clear();
        for (int i = 0; i < (pole ? n : n + 1); ++i) {
            const Vec3 spoke = pole ? circle.between(i) : circle[i];
            const Vec3 normal = normalized(spoke * p.outward + Vec3{0, p.upward, 0});
            row.push_back(mesh.vertex({circle[i].x * p.radius, p.y, circle[i].z * p.radius}, normal,
                                      (i + (pole ? 0.5 : 0)) / n, p.v));
        }
        for (size_t i = 0; j > 0 && i < static_cast<size_t>(n); ++i) {
            if (pole) {
                mesh.triangle(below[i], below[i + 1], row[i]);
            } else if (profile[j - 1].radius == 0) {
                mesh.triangle(below[i], row[i + 1], row[i]);
            } else {
                mesh.quad(below[i], below[i + 1], row[i + 1], row[i]);
            }
        }
        below.swap(row);
    }
}

/// A disc about the y axis at height y, facing up or down; seen from its front, (0,0) is bottom left with +x
/// to the right.
void cap(MeshBuilder& mesh, const Circle& circle, double radius, double y, bool up) {
    const Vec3 normal{0, up ? 1.0 : -1.0, 0};
    const std::uint32_t centre = mesh.vertex({0, y, 0}, normal, 0.5, 0.5);
    std::vector<std::uint32_t> rim;
    for (int i = 0; i < circle.size(); ++i) {
        const Vec3 p = circle[i];
        rim.push_back(
            mesh.vertex({p.x * radius, y, p.z * radius}, normal, 0.5 + p.x / 2, 0.5 - normal.y * p.z / 2));
    }
    for (size_t i = 0; i < rim.size(); ++i) {
        const std::uint32_t here = rim[i], next = rim[(i + 1) % rim.size()];
        mesh.triangle(centre, up ? here : next, up ? next : here);
    }
}

Mesh sphere(const Shape& shape, double tolerance, int maxSegments) {
    // Around and from pole to pole each takes half of the tolerance: a point of the mesh leaves its
    // meridian's arc by one sagitta and its parallel's by another.
    const int n = chords(shape.radius, tolerance / 2, leastAround, maxSegments);
    const int rings = (n + 1) / 2;
    std::vector<ProfilePoint> profile;
    for (int j = 0; j <= rings; ++j) {
        const double latitude = std::numbers::pi * (static_cast<double>(j) / rings - 0.5);
        const bool pole = j == 0 || j == rings;
        const double c = pole ? 0 : std::cos(latitude), s = pole ? (j == 0 ? -1 : 1) : std::sin(latitude);
        profile.push_back({shape.radius * c, shape.radius * s, c, s, static_cast<double>(j) / rings});
    }
    MeshBuilder mesh;
    revolve(mesh, profile, Circle(n));
    return mesh.finish("sphere");
}

Mesh cylinder(const Shape& shape, double tolerance, int maxSegments) {
    const Circle circle(chords(shape.radius, tolerance, leastAround, maxSegments));
    MeshBuilder mesh;
    revolve(mesh, {{shape.radius, 0, 1, 0, 0}, {shape.radius, shape.height, 1, 0, 1}}, circle);
    cap(mesh, circle, shape.radius, 0, false);
    cap(mesh, circle, shape.radius, shape.height, true);
    return mesh.finish("cylinder");
}

Mesh cone(const Shape& shape, double tolerance, int maxSegments) {
    const Circle circle(chords(shape.radius, tolerance, leastAround, maxSegments));
    const double slant = std::hypot(shape.radius, shape.height);
    const double outward = shape.height / slant, upward = shape.radius / slant;
    MeshBuilder mesh;
    revolve(mesh, {{shape.radius, 0, outward, upward, 0}, {0, shape.height, outward, upward, 1}}, circle);
    cap(mesh, circle, shape.radius, 0, false);
    return mesh.finish("cone");
}

Mesh torus(const Shape& shape, double tolerance, int maxSegments) {
    const int around = chords(shape.radius + shape.tube, tolerance / 2, leastAround, maxSegments);
    const int across = chords(shape.tube, tolerance / 2, leastAround, maxSegments);
    std::vector<ProfilePoint> profile;
    for (int j = 0; j <= across; ++j) {
        const double angle =
            std::numbers::pi * (2.0 * (j % across) / across - 1);  // from the inner side, by the bottom
        const double c = std::cos(angle), s = std::sin(angle);
        profile.push_back(
            {shape.radius + shape.tube * c, shape.tube * s, c, s, static_cast<double>(j) / across});
    }
    MeshBuilder mesh;
    revolve(mesh, profile, Circle(around));
    mesh.turnUpToFront();
    return mesh.finish("torus");
}

Mesh disc(const Shape& shape, double tolerance, int maxSegments) {
    MeshBuilder mesh;
    cap(mesh, Circle(chords(shape.radius, tolerance, leastAround, maxSegments)), shape.radius, 0, true);
    mesh.turnUpToFront();
    return mesh.finish("disc");
}

/// A rectangle about `centre`; `right` and `up` are half its sides, as seen from its front.
void rectangle(MeshBuilder& mesh, Vec3 centre, Vec3 right, Vec3 up) {
    const Vec3 normal = normalized(cross(normalized(right), normalized(up)));
    const std::uint32_t a = mesh.vertex(centre - right - up, normal, 0, 0),
                        b = mesh.vertex(centre + right - up, normal, 1, 0),
                        c = mesh.vertex(centre + right + up, normal, 1, 1),
                        d = mesh.vertex(centre - right + up, normal, 0, 1);
    mesh.quad(a, b, c, d);
}

Mesh plane(const Shape& shape) {
    MeshBuilder mesh;
    rectangle(mesh, {}, {shape.size.x / 2, 0, 0}, {0, shape.size.y / 2, 0});
    return mesh.finish("plane");
}

Mesh box(const Shape& shape) {
    const Vec3 x{shape.size.x / 2, 0, 0}, y{0, shape.size.y / 2, 0}, z{0, 0, shape.size.z / 2};
    const auto minus = [](Vec3 v) { return v * -1; };
    MeshBuilder mesh;
    rectangle(mesh, z, x, y);
    rectangle(mesh, minus(z), minus(x), y);
    rectangle(mesh, x, minus(z), y);
    rectangle(mesh, minus(x), z, y);
    rectangle(mesh, y, x, minus(z));
    rectangle(mesh, minus(y), x, z);
    return mesh.finish("box");
}

}  // namespace

double boundingRadius(const Shape& shape) {
    switch (shape.kind) {
        case ShapeKind::box:
            return length(shape.size) / 2;
        case ShapeKind::plane:
            return std::hypot(shape.size.x, shape.size.y) / 2;
        case ShapeKind::cylinder:
            return std::hypot(shape.radius, shape.height);
        case ShapeKind::cone:
            return std::max(shape.radius, shape.height);
        case ShapeKind::torus:
            return shape.radius + shape.tube;
        case ShapeKind::teapot:
            return teapotBoundingRadius(shape.size.x);
        default:
            return shape.radius;
    }
}

Mesh tessellate(const Shape& shape, double tolerance, int maxSegments) {
    switch (shape.kind) {
        case ShapeKind::sphere:
            return sphere(shape, tolerance, maxSegments);
        case ShapeKind::box:
            return box(shape);
        case ShapeKind::plane:
            return plane(shape);
        case ShapeKind::disc:
            return disc(shape, tolerance, maxSegments);
        case ShapeKind::cylinder:
            return cylinder(shape, tolerance, maxSegments);
        case ShapeKind::cone:
            return cone(shape, tolerance, maxSegments);
        case ShapeKind::torus:
            return torus(shape, tolerance, maxSegments);
        default:
            return tessellateTeapot(shape.size.x, tolerance, maxSegments);
    }
}

}  // namespace spectrad
