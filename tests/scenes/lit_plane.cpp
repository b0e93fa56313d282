#include "scenes/lit_plane.h"

#include "base/text.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace spectrad::test {

std::string text(Vec3 v) {
    return shortest(v.x) + " " + shortest(v.y) + " " + shortest(v.z);
}

std::string LitPlane::scene(const std::string& lights, const std::string& attributes) const {
    const std::string camera =
        orthographic ? fmt::format("type=\"orthographic\" height=\"{}\"", shortest(viewHeight * unit))
                     : fmt::format("type=\"perspective\" fov=\"{}\"", shortest(fov));
    return fmt::format(
        "<scene version=\"1\" {}>\n<wavelengths>550</wavelengths>\n"
        "<material name=\"paint\"><diffuse reflectance=\"constant:{}\"/></material>\n"
        "<node rotate=\"{} {}\"><plane size=\"{} {}\" material=\"paint\"/></node>\n{}\n"
        "<camera {} look-from=\"{}\" look-at=\"{}\" size=\"{}x{}\"/>\n</scene>",
        attributes, shortest(reflectance), text(axis), shortest(degrees), shortest(size * unit),
        shortest(size * unit), lights, camera, text(from * unit), text(at * unit), width, height);
}

Vec3 LitPlane::normal() const {
    // Rodrigues' formula on (0, 0, 1).
    const Vec3 k = normalized(axis), z{0, 0, 1};
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const Vec3 n = z * c + cross(k, z) * s + k * (dot(k, z) * (1 - c));
    return dot(n, from - at) < 0 ? n * -1 : n;
}

Vec3 LitPlane::seen(int x, int y) const {
    const Vec3 back = normalized(from - at), right = normalized(cross({0, 1, 0}, back)),
               up = cross(back, right);
    const double half = orthographic ? viewHeight / 2 : std::tan(fov * std::numbers::pi / 360);
    const double u = (x + 0.5 - 0.5 * width) * half / (0.5 * height),
                 v = -(y + 0.5 - 0.5 * height) * half / (0.5 * height);
    const Vec3 shift = right * u + up * v;
    const Vec3 origin = orthographic ? from + shift : from, along = orthographic ? back * -1 : shift - back;
    const Vec3 n = normal();
    return (origin + along * (-dot(n, origin) / dot(n, along))) * unit;
}

double LitPlane::underPoint(Vec3 light, int x, int y) const {
    const Vec3 to = light - seen(x, y);
    const double d = length(to);
    return std::max(0.0, reflectance * dot(normal(), to) / (d * d * d) / std::numbers::pi);
}

double LitPlane::facingPoint(Vec3 light, int x, int y) const {
    const double d = length(light - seen(x, y));
    return reflectance / (d * d) / std::numbers::pi;
}

}  // namespace spectrad::test
