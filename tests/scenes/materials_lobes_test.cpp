// Reciprocity and energy of every lobe, in pixels and by quadrature over the hemisphere.
#include "scenes/materials_lobes.h"

#include "base/text.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

const std::string paint = "<diffuse reflectance=\"400:0.3 700:0.9\"/>";
const std::string matt = "<diffuse reflectance=\"400:0.3 700:0.9\" roughness=\"40\"/>";
const std::vector<std::string> lobes{
    paint,
    "<diffuse reflectance=\"400:0.3 700:0.9\" roughness=\"30\"/>",
    "<diffuse reflectance=\"constant:1\" roughness=\"90\"/>",
    paint + "<gloss ior=\"1.5\" roughness=\"0.05\"/>",
    paint + "<gloss ior=\"1.5\" roughness=\"0.4\"/>",
    "<diffuse reflectance=\"constant:1\"/><gloss ior=\"1.5\" roughness=\"1\"/>",
    paint + "<gloss ior=\"cauchy:1.6,0.02\" roughness=\"0.3\"/>",
    paint + "<specular reflectance=\"400:0.05 700:0.9\" roughness=\"0.5\"/>",
    "<specular reflectance=\"constant:1\" roughness=\"0.7\"/>",
    "<conductor ior=\"metals/Au\" roughness=\"0.2\"/>",
    "<conductor ior=\"metals/Cu\" roughness=\"0.6\"/>",
    "<conductor ior=\"metals/Ag\" roughness=\"1\"/>",
    "<conductor ior=\"metals/Au\" roughness=\"0.5\" fresnel=\"schlick\"/>",
    "<conductor ior=\"metals/Au\" roughness=\"0.2 0.6\"/>",
    paint + "<gloss ior=\"1.5\" roughness=\"0.8 0.25\"/>",
    "<specular reflectance=\"constant:1\" roughness=\"0.2 1\"/>",
    matt + "<gloss ior=\"1.5\" roughness=\"0.3\"/>",
    "<diffuse reflectance=\"constant:1\" roughness=\"90\"/><gloss ior=\"2.4\" roughness=\"0.6\"/>",
    matt + "<gloss ior=\"cauchy:1.6,0.02\" roughness=\"0.2 0.6\"/>",
    matt + "<specular reflectance=\"400:0.05 700:0.9\" roughness=\"0.5\"/>",
};
const std::vector<double> wavelengths{420, 550, 680};

Vec3 towards(double degrees, double azimuth) {
    const double t = degrees * std::numbers::pi / 180, p = azimuth * std::numbers::pi / 180;
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

std::string textOf(Vec3 v) {
    return shortest(v.x) + " " + shortest(v.y) + " " + shortest(v.z);
}

/// The lobes as patches in the plane z = 0, seen from `view`, irradiance 1 square-on from `light`.
constexpr double viewHeight = 20;
constexpr int pixels = 200;
Vec3 placeOf(size_t patch) {
    return {2.0 * static_cast<double>(patch % 4) - 3, 2.0 * static_cast<double>(patch / 4) - 3, 0};
}
std::string sceneOf(Vec3 view, Vec3 light) {
    std::string text = "<scene version=\"1\"><wavelengths projection=\"point\">420 550 680</wavelengths>\n";
    for (size_t i = 0; i < lobes.size(); ++i)
        text += fmt::format(
            "<material name=\"m{}\">{}</material><node translate=\"{}\"><plane size=\"1.8 1.8\" "
            "material=\"m{}\"/></node>\n",
            i, lobes[i], textOf(placeOf(i)), i);
    return text + fmt::format(
                      "<light type=\"directional\" direction=\"{}\" spectrum=\"constant:1\" scale=\"1\"/>\n"
                      "<camera type=\"orthographic\" height=\"{}\" look-from=\"{}\" look-at=\"0 0 0\" up=\"0 "
                      "1 0\" size=\"{}x{}\"/></scene>",
                      textOf(light * -1), viewHeight, textOf(view * 100), pixels, pixels);
}

/// f of each patch and band: what the middle of the patch shows, over the irradiance.
std::vector<double> measured(Vec3 view, Vec3 light) {
    RenderSettings settings;
    settings.samples = 1;
    const Image image = imageOf(sceneOf(view, light), settings);
    const Vec3 right = normalized(cross({0, 1, 0}, view)), up = cross(view, right);
    std::vector<double> f;
    for (size_t i = 0; i < lobes.size(); ++i) {
        const double scale = pixels / viewHeight;
        const int x = static_cast<int>(pixels / 2.0 + dot(placeOf(i), right) * scale),
                  y = static_cast<int>(pixels / 2.0 - dot(placeOf(i), up) * scale);
        for (size_t band = 0; band < wavelengths.size(); ++band)
            f.push_back(image.at(x, y, band) / light.z);
    }
    return f;
}

}  // namespace

TEST_CASE("light takes the way back as it came: f(view, light) = f(light, view) in every lobe's pixels") {
    if (!haveDevice()) return;
    const Plan plan = planOf(sceneFrom(sceneOf({0, 0, 1}, {0, 0, 1})));
    for (const auto& [a, b] : {std::pair{towards(10, 0), towards(60, 40)},
                               {towards(45, 180), towards(43, 5)},
                               {towards(72, 100), towards(30, 250)},
                               {towards(65, 190), towards(66, 10)}}) {
        const std::vector<double> there = measured(a, b), back = measured(b, a);
        for (size_t i = 0; i < there.size(); ++i) {
            const size_t patch = i / wavelengths.size(), band = i % wavelengths.size();
            const double inDouble = Reflectance(plan, patch + 1, band)(a, b);
            CAPTURE(lobes[patch], band);
            // The narrowest peak, α = 0.0025, takes cosines' last digits a hundredfold.
            CHECK(there[i] == Approx(back[i]).epsilon(5e-5));
            CHECK(there[i] == Approx(inDouble).epsilon(1e-4));
            CHECK(there[i] > 0);
        }
    }
}

TEST_CASE("the integral of every lobe over the hemisphere is its albedo, and nowhere above 1") {
    const Plan plan = planOf(sceneFrom(sceneOf({0, 0, 1}, {0, 0, 1})));
    for (size_t patch = 0; patch < lobes.size(); ++patch) {
        for (double cosine : {0.05, 0.2, 0.5, 0.8, 1.0}) {
            const size_t band = patch % 3;
            const double azimuth = 7 * cosine;  // all round, where it matters
            const double sine = std::sqrt(1 - cosine * cosine);
            const Vec3 view{sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
            const Reflectance f(plan, patch + 1, band);
            const double sum = f.integral(view), table = f.albedo(view);
            CAPTURE(lobes[patch], cosine, band);
            CHECK(sum == Approx(table).margin(2e-3));
            CHECK(sum <= 1 + 1e-3);
            CHECK(table <= 1 + 1e-4);
            CHECK(table > 0.01);
        }
    }
}
