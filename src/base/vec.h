// Small vectors and affine matrices, in double: scenes are composed in double and leave for the device
// camera-relative.
#pragma once

#include <array>
#include <cmath>

namespace spectrad {

struct Vec3 {
    double x = 0, y = 0, z = 0;
    friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Length without overflow or underflow.
inline double length(Vec3 a) {
    return std::hypot(a.x, a.y, a.z);
}
/// Unit vector; the zero vector stays zero.
inline Vec3 normalized(Vec3 a) {
    const double l = length(a);
    return l > 0 ? a * (1 / l) : a;
}

/// Affine transform, row by row: the upper three rows of a 4×4 matrix acting on column vectors.
struct Affine {
    std::array<double, 12> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

    [[nodiscard]] Vec3 point(Vec3 p) const {
        return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    }
    [[nodiscard]] Vec3 direction(Vec3 d) const {
        return {m[0] * d.x + m[1] * d.y + m[2] * d.z, m[4] * d.x + m[5] * d.y + m[6] * d.z,
                m[8] * d.x + m[9] * d.y + m[10] * d.z};
    }
    [[nodiscard]] double determinant() const {
        return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
               m[2] * (m[4] * m[9] - m[5] * m[8]);
    }
    [[nodiscard]] bool finite() const {
        for (double v : m)
            if (!std::isfinite(v)) return false;
        return true;
    }

    static Affine translation(Vec3 t) { return {{1, 0, 0, t.x, 0, 1, 0, t.y, 0, 0, 1, t.z}}; }
    static Affine scaling(Vec3 s) { return {{s.x, 0, 0, 0, 0, s.y, 0, 0, 0, 0, s.z, 0}}; }
    /// Right-handed rotation by `degrees` about `axis` (any length but zero).
    static Affine rotation(Vec3 axis, double degrees);
    /// Rigid camera-to-world transform: the camera at `from` looks down its −z at `at`, +y near `up`.
    static Affine lookAt(Vec3 from, Vec3 at, Vec3 up);
};

/// First b, then a.
Affine operator*(const Affine& a, const Affine& b);
/// Inverse of a transform with non-zero determinant.
Affine inverse(const Affine& a);

}  // namespace spectrad
