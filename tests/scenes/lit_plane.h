// A white-ish plane, the camera's rays through the centres of pixels, and where they meet, in double
// precision.
#pragma once

#include "base/vec.h"

#include <string>

namespace spectrad::test {

/// One band, one sample, scene lengths in metres unless `unit` says otherwise.
struct LitPlane {
    bool orthographic = false;
    Vec3 from{0.3, 0.2, 4}, at{0, 0, 0};  ///< of the camera
    double fov = 35, viewHeight = 2.5;    ///< degrees; scene units
    Vec3 axis{1, 0.4, 0.2};               ///< the plane is turned about it …
    double degrees = -40;
    double size = 16;  ///< … and this wide
    double reflectance = 0.8;
    int width = 60, height = 44;
    double unit = 1;  ///< all lengths here are multiplied by it

    /// The scene with `lights` in it.
    [[nodiscard]] std::string scene(const std::string& lights, const std::string& attributes = "") const;
    /// What the centre of a pixel sees; this and what follows with `unit` applied.
    [[nodiscard]] Vec3 seen(int x, int y) const;
    /// The plane's unit normal on the camera's side.
    [[nodiscard]] Vec3 normal() const;
    /// Radiance under intensity 1 at `light`: ρ cosθ / (π d²); 0 where the plane's other side is lit.
    [[nodiscard]] double underPoint(Vec3 light, int x, int y) const;
    /// The same, were the plane to face the light: ρ / (π d²).
    [[nodiscard]] double facingPoint(Vec3 light, int x, int y) const;
};

/// "x y z"
[[nodiscard]] std::string text(Vec3 v);

}  // namespace spectrad::test
