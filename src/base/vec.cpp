#include "base/vec.h"

#include <cmath>
#include <numbers>

namespace spectrad {

/// Sine and cosine of degrees, exact at multiples of 90: a quarter turn moves an axis onto an axis.
static void sinCosDegrees(double degrees, double& sine, double& cosine) {
    const double quarter = std::remainder(degrees, 360.0);
    if (std::fmod(quarter, 90.0) == 0) {
        const int turn = (static_cast<int>(quarter / 90.0) + 4) % 4;
        static constexpr std::array<double, 4> sines{0, 1, 0, -1};
        sine = sines[static_cast<size_t>(turn)];
        cosine = sines[static_cast<size_t>((turn + 1) % 4)];
        return;
    }
    sine = std::sin(quarter * std::numbers::pi / 180);
    cosine = std::cos(quarter * std::numbers::pi / 180);
}

Affine Affine::rotation(Vec3 axis, double degrees) {
    const Vec3 a = normalized(axis);
    double s = 0, c = 1;
    sinCosDegrees(degrees, s, c);
    const double t = 1 - c;
    return {{t * a.x * a.x + c, t * a.x * a.y - s * a.z, t * a.x * a.z + s * a.y, 0,  //
             t * a.x * a.y + s * a.z, t * a.y * a.y + c, t * a.y * a.z - s * a.x, 0,  //
             t * a.x * a.z - s * a.y, t * a.y * a.z + s * a.x, t * a.z * a.z + c, 0}};
}

Affine Affine::lookAt(Vec3 from, Vec3 at, Vec3 up) {
    const Vec3 back = normalized(from - at);
    Vec3 right = cross(normalized(up), back);
    if (length(right) < 1e-12) right = cross(std::abs(back.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, -1}, back);
    right = normalized(right);
    const Vec3 top = cross(back, right);
    return {{right.x, top.x, back.x, from.x, right.y, top.y, back.y, from.y, right.z, top.z, back.z, from.z}};
}

Affine operator*(const Affine& a, const Affine& b) {
    Affine r;
    for (size_t row = 0; row < 3; ++row) {
        for (size_t col = 0; col < 4; ++col) {
            double sum = col == 3 ? a.m[row * 4 + 3] : 0;
            for (size_t k = 0; k < 3; ++k)
                sum += a.m[row * 4 + k] * b.m[k * 4 + col];
            r.m[row * 4 + col] = sum;
        }
    }
    return r;
}

Affine inverse(const Affine& a) {
    const auto& m = a.m;
    const double d = 1 / a.determinant();
    Affine r{{(m[5] * m[10] - m[6] * m[9]) * d, (m[2] * m[9] - m[1] * m[10]) * d,
              (m[1] * m[6] - m[2] * m[5]) * d, 0, (m[6] * m[8] - m[4] * m[10]) * d,
              (m[0] * m[10] - m[2] * m[8]) * d, (m[2] * m[4] - m[0] * m[6]) * d, 0,
              (m[4] * m[9] - m[5] * m[8]) * d, (m[1] * m[8] - m[0] * m[9]) * d,
              (m[0] * m[5] - m[1] * m[4]) * d, 0}};
    const Vec3 t = r.direction({m[3], m[7], m[11]});
    r.m[3] = -t.x;
    r.m[7] = -t.y;
    r.m[11] = -t.z;
    return r;
}

}  // namespace spectrad
