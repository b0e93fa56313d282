// A plane under lamps of every type, pixel by pixel against closed forms.
#include "base/text.h"
#include "scenes/lit_plane.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

const RenderSettings oneSample = [] {
    RenderSettings settings;
    settings.samples = 1;  // the pixel's centre
    return settings;
}();

std::string pointLight(Vec3 position, double intensity) {
    return fmt::format("<light type=\"point\" position=\"{}\" spectrum=\"constant:1\" scale=\"{}\"/>",
                       text(position), shortest(intensity));
}

Worst compare(const Image& image, const std::function<double(int, int)>& expected) {
    Worst worst;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double want = expected(x, y);
            worst.add(image.at(x, y), want, want, x, y);
        }
    return worst;
}

/// Under a point light alone. Where light grazes, a cosine in float keeps fewer digits: below 0.1 errors are
/// relative to what a cosine of 0.1 gives.
Worst compareUnderPoint(const LitPlane& plane, Vec3 light) {
    constexpr double intensity = 7;
    const Image image = imageOf(plane.scene(pointLight(light, intensity)), oneSample);
    Worst worst;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double want = intensity * plane.underPoint(light, x, y);
            worst.add(image.at(x, y), want, std::max(want, 0.1 * intensity * plane.facingPoint(light, x, y)),
                      x, y);
        }
    return worst;
}

}  // namespace

TEST_CASE("an oblique plane under a point light is I cosθ ρ / (π d²) in every pixel") {
    if (!haveDevice()) return;
    for (const bool orthographic : {false, true}) {
        for (const double degrees : {0.0, -40.0, 50.0, 140.0}) {
            LitPlane plane;
            plane.orthographic = orthographic;
            plane.degrees = degrees;
            const Worst worst = compareUnderPoint(plane, {0.9, 1.1, 1.4});
            INFO((orthographic ? "orthographic, " : "perspective, ")
                 << degrees << " degrees: " << worst.str());
            CHECK(worst.error <= 1e-5);
        }
    }
}

TEST_CASE("a light behind the seen side adds nothing") {
    if (!haveDevice()) return;
    LitPlane plane;
    plane.degrees = 0;
    const Image image = imageOf(plane.scene(pointLight({0.1, 0.2, -1.5}, 7)), oneSample);
    CHECK(std::all_of(image.values.begin(), image.values.end(), [](float v) { return v == 0; }));
}

TEST_CASE("inverse square holds from a millimetre to a kilometre") {
    if (!haveDevice()) return;
    for (const double unit : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3}) {
        LitPlane plane;
        plane.unit = unit;
        const Worst worst = compareUnderPoint(plane, Vec3{0.9, 1.1, 1.4} * unit);
        INFO("lengths times " << unit << ": " << worst.str());
        CHECK(worst.error <= 1e-5);
    }
    // The lamp alone goes away. Places are floats from the eye, good to 6e-8 of the distance to a triangle's
    // furthest corner, here 4 m: nearer than some centimetres the lamp would show that.
    for (const double distance : {0.1, 1.0, 10.0, 100.0, 1e3}) {
        LitPlane plane;
        plane.degrees = 0;
        plane.from = {0, 0, 3};
        plane.size = 4;
        plane.orthographic = true;
        const Worst worst = compareUnderPoint(plane, {0.1, 0.2, distance});
        INFO("lamp at " << distance << " m: " << worst.str());
        CHECK(worst.error <= 1e-5);
    }
}

TEST_CASE("lengths in another unit give the same picture") {
    if (!haveDevice()) return;
    const Vec3 light{0.9, 1.1, 1.4};
    const Image metres = imageOf(LitPlane{}.scene(pointLight(light, 7)), oneSample);
    for (const auto& [unit, metresPerUnit] :
         {std::pair{"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"km", 1e3}, {"in", 0.0254}, {"ft", 0.3048}}) {
        LitPlane plane;
        plane.unit = 1 / metresPerUnit;
        const Image other = imageOf(
            plane.scene(pointLight(light * plane.unit, 7), fmt::format("unit=\"{}\"", unit)), oneSample);
        const Worst worst = compare(other, [&](int x, int y) { return metres.at(x, y); });
        INFO(unit << ": " << worst.str());
        CHECK(worst.error <= 1e-6);
    }
}

TEST_CASE(
    "a spot is a point light within its inner cone, nothing outside, and a smooth step over the cosine "
    "between") {
    if (!haveDevice()) return;
    const Vec3 light{0.9, 1.1, 2.4}, target{0.2, 0.1, 0};
    for (const auto& [angle, blend] : {std::pair{30.0, 0.2}, {50.0, 0.0}, {40.0, 1.0}, {60.0, 0.5}}) {
        LitPlane plane;
        const std::string spot = fmt::format(
            "<light type=\"spot\" position=\"{}\" target=\"{}\" angle=\"{}\" blend=\"{}\" "
            "spectrum=\"constant:1\" scale=\"7\"/>",
            text(light), text(target), angle, blend);
        const Image image = imageOf(plane.scene(spot), oneSample);
        const double half = angle / 2 * std::numbers::pi / 180, outer = std::cos(half),
                     inner = std::cos(half * (1 - blend));
        // How fast the fade goes with the cosine decides what is left of its float's 1e-7; a hard edge is
        // decided within it.
        const double slope = inner > outer ? 1.5 / (inner - outer) : 0;
        int inside = 0, outside = 0, between = 0;
        Worst worst;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const double cosine = dot(normalized(plane.seen(x, y) - light), normalized(target - light));
                const double full = 7 * plane.underPoint(light, x, y);
                if (std::abs(cosine - outer) < 1e-6 && slope == 0) continue;
                const double t =
                    inner > outer ? std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0) : cosine > outer;
                (t == 1 ? inside : t == 0 ? outside : between)++;
                worst.add(image.at(x, y), full * t * t * (3 - 2 * t),
                          full * (t > 0 && t < 1 ? 1 + slope * 0.1 : 1), x, y);
            }
        }
        INFO(angle << " degrees, blend " << blend << ": " << worst.str());
        CHECK(worst.error <= 1e-5);
        CHECK(outside > 100);
        CHECK((blend == 1 || inside > 100));
        CHECK((blend == 0 || between > 100));
    }
}

TEST_CASE("directional and ambient light fill a plane evenly") {
    if (!haveDevice()) return;
    LitPlane plane;
    const Vec3 along{-0.3, -0.9, -1.2};
    const std::string sun = fmt::format(
        "<light type=\"directional\" direction=\"{}\" spectrum=\"constant:1\" scale=\"3\"/>", text(along));
    const double cosine = dot(plane.normal(), normalized(along * -1));
    Worst worst = compare(imageOf(plane.scene(sun), oneSample),
                          [&](int, int) { return 3 * cosine * plane.reflectance / std::numbers::pi; });
    INFO("directional: " << worst.str());
    CHECK(worst.error <= 2e-6);
    worst = compare(
        imageOf(plane.scene("<light type=\"ambient\" spectrum=\"constant:1\" scale=\"3\"/>"), oneSample),
        [&](int, int) { return 3 * plane.reflectance; });
    INFO("ambient: " << worst.str());
    CHECK(worst.error <= 1e-6);
}

TEST_CASE("several lights add up, of one spectrum or of several") {
    if (!haveDevice()) return;
    const std::vector<std::string> lights{
        pointLight({0.9, 1.1, 1.4}, 7),
        pointLight({-1.2, 0.3, 1.9}, 0.25),
        R"(<light type="point" position="0.3 -0.4 2" spectrum="illuminants/A" intensity="3 W/sr"/>)",
        R"(<light type="spot" position="-1 1 3" target="0 0 0" angle="30" blend="0.4" spectrum="illuminants/FL11" intensity="5 W/sr"/>)",
        R"(<light type="directional" direction="1 -2 -3" spectrum="illuminants/A" irradiance="0.7 W/m2"/>)",
        R"(<light type="ambient" spectrum="constant:1" scale="0.02"/>)"};
    LitPlane plane;
    RenderSettings settings = oneSample;
    settings.wavelengths = parseWavelengths("400:700:10", {});
    std::string all;
    std::vector<double> sum;
    for (const std::string& light : lights) {
        all += light;
        const Image alone = imageOf(plane.scene(light), settings);
        sum.resize(alone.values.size());
        for (size_t i = 0; i < sum.size(); ++i)
            sum[i] += alone.values[i];
    }
    const Image together = imageOf(plane.scene(all), settings);
    double worst = 0;
    for (size_t i = 0; i < sum.size(); ++i)
        worst = std::max(worst, std::abs(together.values[i] - sum[i]) / sum[i]);
    CHECK(worst <= 2e-6);
}

TEST_CASE("a ground of two triangles is lit right below the eye, as far as floats of its corners reach") {
    if (!haveDevice()) return;
    constexpr int width = 60, height = 40;
    RenderSettings settings;
    settings.samples = 1;
    constexpr double eye = 1.7, slope = 0.4;  // m; of half the picture's height, looking straight down
    for (const auto& [size, bound] : {std::pair{1e3, 3e-5}, {1e4, 3e-4}, {1e5, 3e-3}}) {
        const Image image = imageOf(
            fmt::format(
                R"(<scene version="1"><wavelengths>550</wavelengths><material name="g"><diffuse reflectance="constant:1"/></material>
<node rotate="1 0 0 -90"><plane size="{}" material="g"/></node><light type="point" position="0 1 -0.3" spectrum="constant:1" scale="1"/>
<camera fov="{}" look-from="0.3 {} 0.2" look-at="0.3 0 0.2" up="0 0 -1" size="{}x{}"/></scene>)",
                size, 2 * std::atan(slope) * 180 / std::numbers::pi, eye, width, height),
            settings);
        std::vector<double> error;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double pixel = 2 * slope * eye / height;
                const double px = 0.3 + (x + 0.5 - width / 2.0) * pixel,
                             pz = 0.2 + (y + 0.5 - height / 2.0) * pixel;
                const double square = px * px + 1 + (pz + 0.3) * (pz + 0.3);
                error.push_back(std::abs(image.at(x, y) * std::numbers::pi * square * std::sqrt(square) - 1));
            }
        std::nth_element(error.begin(), error.begin() + width * height / 2, error.end());
        INFO(size << " m: median " << error[width * height / 2]);
        CHECK(error[width * height / 2] < bound);
    }
}
