// Amounts with units come out of the cube again: lux, candela, lumen and cd/m² as a luminance meter reads
// them, watts as sums.
#include "colour/detector.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

constexpr double pi = std::numbers::pi;

/// A white plane, or one that glows, seen head-on; the pixel in the middle.
Image middle(const std::string& material, const std::string& light, const std::string& grid) {
    RenderSettings settings;
    settings.wavelengths = parseWavelengths(grid, {});
    settings.samples = 1;
    return imageOf(
        fmt::format(
            "<scene version=\"1\"><material name=\"m\">{}</material><plane size=\"9 9\" material=\"m\"/>{}"
            "<camera type=\"orthographic\" height=\"0.001\" look-from=\"0 0 5\" look-at=\"0 0 0\" "
            "size=\"1x1\"/></scene>",
            material, light),
        settings);
}

double luminance(const Image& image) {
    const DetectorWeights weights = weightsOn(image.wavelengths, standardObserver(library()));
    double sum = 0;
    for (size_t j = 0; j < image.wavelengths.size(); ++j)
        sum += weights.weights[1][j] * image.at(0, 0, j);
    return sum;
}

/// ∫ L dλ: hats add up to one everywhere between the first and the last band.
double radiance(const Image& image) {
    double sum = 0;
    for (size_t j = 0; j < image.wavelengths.size(); ++j)
        sum += band(image.wavelengths, j).area() * image.at(0, 0, j);
    return sum;
}

/// Planck's law, W·m⁻²·sr⁻¹·m⁻¹.
double planckAt(double metres, double kelvin) {
    constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23;
    return 2 * h * c * c / std::pow(metres, 5) / std::expm1(h * c / (metres * k * kelvin));
}

/// The matrix of a node that turns the x–y plane across `direction`.
std::string facing(Vec3 direction) {
    const Vec3 z = normalized(direction), x = normalized(cross(Vec3{0, 1, 0}, z)), y = cross(z, x);
    return fmt::format("{} {} {} 0 {} {} {} 0 {} {} {} 0 0 0 0 1", x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z,
                       z.z);
}

const std::string white = "<diffuse reflectance=\"constant:1\"/>";
// On the observer's own nanometres its functions are linear between the bands, so that nothing but float
// arithmetic is lost.
const std::string fine = "360:830:1";

}  // namespace

TEST_CASE("a white plane measures what its lamp's photometric amount says") {
    if (!haveDevice()) return;
    for (const std::string lamp : {"illuminants/A", "illuminants/D65", "illuminants/FL11",
                                   "illuminants/LED-B3", "blackbody:2856", "gaussian:555,10"}) {
        const auto light = [&](const std::string& attributes) {
            return fmt::format("<light {} spectrum=\"{}\"/>", attributes, lamp);
        };
        INFO(lamp);
        CHECK(luminance(middle(white, light(R"(type="directional" direction="0 0 -1" illuminance="1000 lx")"),
                               fine)) == Approx(1000 / pi).epsilon(1e-5));
        CHECK(luminance(middle(white, light(R"(type="point" position="0 0 2" intensity="800 cd")"), fine)) ==
              Approx(800 / 4.0 / pi).epsilon(1e-5));
        CHECK(luminance(middle(white, light(R"(type="point" position="0 0 2" power="800 lm")"), fine)) ==
              Approx(800 / (4 * pi) / 4 / pi).epsilon(1e-5));
        CHECK(luminance(middle(white, light(R"(type="ambient" luminance="20 cd/m2")"), fine)) ==
              Approx(20).epsilon(1e-5));
        CHECK(luminance(middle(fmt::format("<emission spectrum=\"{}\" luminance=\"100 cd/m2\"/>", lamp), "",
                               fine)) == Approx(100).epsilon(1e-5));
        CHECK(
            luminance(middle(
                "<diffuse reflectance=\"constant:0\"/>",
                fmt::format(
                    "<light type=\"directional\" direction=\"0 0 -1\" spectrum=\"{0}\" illuminance=\"1 lx\"/>"
                    "<background spectrum=\"{0}\" luminance=\"55 cd/m2\"/>",
                    lamp),
                fine)) == 0);
        // The usual grid: what it leaves out and what bands of 5 nm miss.
        const double usual = luminance(middle(
            white, light(R"(type="directional" direction="0 0 -1" illuminance="1000 lx")"), "380:780:5"));
        CHECK(usual == Approx(1000 / pi).epsilon(2e-4));
    }
}

TEST_CASE("a background measures its luminance") {
    if (!haveDevice()) return;
    RenderSettings settings;
    settings.wavelengths = parseWavelengths(fine, {});
    const Image image =
        imageOf(R"(<scene version="1"><background spectrum="illuminants/FL11" luminance="55 cd/m2"/>
<camera type="perspective" fov="40" look-from="0 0 5" look-at="0 0 0" size="2x2"/></scene>)",
                settings);
    CHECK(luminance(image) == Approx(55).epsilon(1e-5));
}

TEST_CASE("a white plane sends what its lamp's radiometric amount says") {
    if (!haveDevice()) return;
    const std::string range = "380:780:5";  // all of FL11, FL2 and LED-B3
    for (const std::string lamp :
         {"illuminants/FL11", "illuminants/FL2", "illuminants/LED-B3", "line:546.1", "line:546.1,0.01"}) {
        const auto light = [&](const std::string& attributes) {
            return fmt::format("<light {} spectrum=\"{}\"/>", attributes, lamp);
        };
        INFO(lamp);
        CHECK(radiance(middle(white, light(R"(type="directional" direction="0 0 -1" irradiance="100 W/m2")"),
                              range)) == Approx(100 / pi).epsilon(1e-6));
        CHECK(radiance(middle(white, light(R"(type="point" position="0 0 2" intensity="12 W/sr")"), range)) ==
              Approx(3 / pi).epsilon(1e-6));
        CHECK(radiance(middle(white, light(R"(type="point" position="0 0 2" power="12 W")"), range)) ==
              Approx(12 / (4 * pi) / 4 / pi).epsilon(1e-6));
        CHECK(radiance(middle(white, light(R"(type="ambient" radiance="7 W/m2/sr")"), range)) ==
              Approx(7).epsilon(1e-6));
        CHECK(radiance(middle(fmt::format("<emission spectrum=\"{}\" radiance=\"9 W/m2/sr\"/>", lamp), "",
                              range)) == Approx(9).epsilon(1e-6));
    }
    // A black body's power lies at all wavelengths, however hot or cold: Stefan and Boltzmann's σT⁴/π.
    for (const double kelvin : {300.0, 2856.0, 1e5, 1e6, 1e7, 1e8}) {
        const Image image =
            middle(white,
                   fmt::format(R"(<light type="ambient" spectrum="blackbody:{:.0f}" radiance="7 W/m2/sr"/>)",
                               kelvin),
                   "3000:3001:1");
        INFO(kelvin << " K");
        CHECK(radiance(image) == Approx(7 * planckAt(3000.5e-9, kelvin) * 1e-9 * pi /
                                        (5.670374419e-8 * kelvin * kelvin * kelvin * kelvin))
                                     .epsilon(1e-5));
    }
    const std::string constant =
        R"(<light type="directional" direction="0 0 -1" spectrum="constant:1" irradiance="100 W/m2 over 400:700"/>)";
    CHECK(radiance(middle(white, constant, "400:700:10")) == Approx(100 / pi).epsilon(1e-6));
}

TEST_CASE("a spot's power fills its cone") {
    if (!haveDevice()) return;
    // Straight below a hard-edged spot of 60°: I = Φ / (2π (1 − cos 30°)).
    const std::string spot =
        R"(<light type="spot" position="0 0 2" target="0 0 0" angle="60" blend="0" spectrum="illuminants/FL11" power="12 W"/>)";
    CHECK(radiance(middle(white, spot, "380:780:5")) ==
          Approx(12 / (2 * pi * (1 - std::cos(pi / 6))) / 4 / pi).epsilon(1e-6));
}

TEST_CASE("a spot's power is all there, however narrow its cone") {
    if (!haveDevice()) return;
    // What arrives on a plane across the spot, which stands at 5 m in an oblique direction.
    const Vec3 place{2.1, -1.7, 4.2};
    const double distance = std::sqrt(dot(place, place));
    for (const double angle : {60.0, 10.0, 1.0, 0.3, 0.1, 0.05, 0.02, 0.01, 0.001, 1e-5}) {
        for (const double blend : {0.0, 0.5}) {
            const double radius = distance * std::tan(std::max(angle, 0.001) / 2 * pi / 180);
            constexpr int size = 160;
            const double height = 2.2 * radius, pixel = height / size;
            RenderSettings settings;
            settings.wavelengths = parseWavelengths("400,401", {});
            settings.samples = 16;
            const Image image = imageOf(
                fmt::format(
                    "<scene version=\"1\"><material name=\"m\">{}</material>"
                    "<node matrix=\"{}\"><plane size=\"20 20\" material=\"m\"/></node>"
                    "<light type=\"spot\" position=\"{} {} {}\" target=\"0 0 0\" angle=\"{}\" blend=\"{}\" "
                    "spectrum=\"constant:1\" power=\"100 W over 400:401\"/>"
                    "<camera type=\"orthographic\" height=\"{}\" look-from=\"{} {} {}\" look-at=\"0 0 0\" "
                    "size=\"{}x{}\"/></scene>",
                    white, facing(place), place.x, place.y, place.z, angle, blend, height, place.x, place.y,
                    place.z, size, size),
                settings);
            double watts = 0;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x)
                    watts += pi * image.at(x, y) * pixel * pixel;
            INFO(angle << " degrees, blend " << blend);
            CHECK(watts == Approx(100).epsilon(2e-3));
        }
    }
}
