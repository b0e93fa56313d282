// Fluorescence in pixels: lamps with lines, measured matrices, parts that add, coats, and scenes without it.
#include "render/renderer.h"
#include "scenes/measured.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

constexpr double pi = std::numbers::pi;

/// A plane of one material, square-on to a directional lamp of a spectrum that counts as it stands.
std::string plane(const std::string& lobes, const std::string& light,
                  const std::string& bands = "from=\"400\" to=\"700\" step=\"10\"") {
    return "<scene version=\"1\"><wavelengths " + bands + "/><material name=\"m\">" + lobes +
           "</material><plane size=\"2 2\" material=\"m\"/>" + light +
           R"(<camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="8x8"/></scene>)";
}
std::string lamp(const std::string& spectrum, const std::string& amount = "scale=\"1\"") {
    return "<light name=\"lamp\" type=\"directional\" direction=\"0 0 -1\" spectrum=\"" + spectrum + "\" " +
           amount + "/>";
}
std::vector<double> pixel(const std::string& text, const RenderSettings& settings = {}) {
    const Image image = imageOf(text, settings);
    std::vector<double> bands;
    for (size_t band = 0; band < image.wavelengths.size(); ++band)
        bands.push_back(image.at(3, 4, band));
    return bands;
}
RenderSettings only(Only part) {
    RenderSettings settings;
    settings.only = part;
    return settings;
}
double gauss(double nm, double centre, double fwhm) {
    return std::exp(-4 * std::log(2.0) * (nm - centre) * (nm - centre) / (fwhm * fwhm));
}
const std::string base = "<diffuse reflectance=\"constant:0.5\"/>";
const std::string matt = "<diffuse reflectance=\"constant:0.5\" roughness=\"40\"/>";
const std::string dye =
    R"(<fluorescence excitation="gaussian:380,60" emission="gaussian:520,40" yield="0.8"/>)";

/// Radiance that the dye emits, band by band, for photons absorbed up to λ as `taken` says.
template <typename Taken>
std::vector<double> emitted(const Taken& taken) {
    double photons = 0;
    for (double nm = 300.005; nm < 800; nm += 0.01)
        photons += gauss(nm, 520, 40) * nm * 0.01;
    std::vector<double> bands;
    for (int j = 0; j <= 30; ++j) {
        double sum = 0, weights = 0;
        for (double nm = 390.005 + 10 * j; nm < 410 + 10 * j; nm += 0.01) {
            if (nm < 400 || nm > 700) continue;
            const double hat = 1 - std::abs(nm - 400 - 10 * j) / 10;
            sum += hat * 0.8 * gauss(nm, 520, 40) / photons * taken(nm);
            weights += hat;
        }
        bands.push_back(sum / weights / pi);
    }
    return bands;
}

double worst(const std::vector<double>& got, const std::vector<double>& want) {
    const double peak = *std::max_element(want.begin(), want.end());
    double error = 0;
    for (size_t j = 0; j < want.size(); ++j)
        error = std::max(error, std::abs(got[j] - want[j]) / std::max(want[j], 1e-9 * peak));
    return peak > 0 ? error : 1;
}

}  // namespace

TEST_CASE(
    "a line in the ultraviolet, which no band of the image sees, makes a fluorophore glow by its photons") {
    if (!haveDevice()) return;
    const std::vector<double> got = pixel(plane(base + dye, lamp("line:365")));
    const double taken = 0.5 * gauss(365, 380, 60) * 365;
    const std::vector<double> want = emitted([&](double) { return taken; });
    CHECK(worst(got, want) <= 1e-5);
}

TEST_CASE("a measured lamp with ultraviolet: every band within 1e-5 of the direct product") {
    if (!haveDevice()) return;
    for (const std::string name : {"lamps/uv-365", "illuminants/D65", "illuminants/FL11"}) {
        const Polyline light = measuredTable(name).curves.front();
        // Absorbed up to each hundredth of a nanometre.
        std::vector<double> taken(60001, 0.0);
        for (size_t i = 1; i < taken.size(); ++i) {
            const double nm = 250 + (static_cast<double>(i) - 0.5) / 100;
            taken[i] = taken[i - 1] + 0.5 * gauss(nm, 380, 60) * nm * static_cast<double>(light.at(nm)) / 100;
        }
        const std::vector<double> want = emitted([&](double nm) {
            const double at = (nm - 250) * 100;
            const auto i = static_cast<size_t>(at);
            return taken[i] + (taken[i + 1] - taken[i]) * (at - static_cast<double>(i));
        });
        const std::vector<double> got = pixel(plane(base + dye, lamp(name)), only(Only::fluorescence));
        CAPTURE(name);
        CHECK(worst(got, want) <= 1e-5);
    }
}

TEST_CASE(
    "reflection alone and fluorescence alone add up to everything, under every kind of light and under a "
    "coat") {
    if (!haveDevice()) return;
    const std::vector<std::string> lights{
        lamp("illuminants/D65", "illuminance=\"1000 lx\""),
        R"(<light type="point" position="0.3 0.2 2" spectrum="lamps/uv-365" intensity="3 W/sr"/>)",
        R"(<light type="spot" position="0.3 0.2 2" target="0 0 0" angle="40" spectrum="illuminants/A" intensity="300 cd"/>)",
        R"(<light type="ambient" spectrum="illuminants/FL11" luminance="100 cd/m2"/>)"};
    std::vector<std::pair<std::string, std::string>> cases;
    for (const std::string& paint : {base, matt})
        for (const std::string& light : lights)
            cases.emplace_back(paint, light);
    for (const std::string& coat :
         {std::string(), std::string("<gloss ior=\"1.5\" roughness=\"0.3\"/>"),
          std::string("<specular reflectance=\"constant:0.1\" roughness=\"0.5\"/>")})
        for (const auto& [paint, light] : cases) {
            const std::string text = plane(paint + coat + dye, light);
            const std::vector<double> all = pixel(text), reflected = pixel(text, only(Only::reflection)),
                                      glowing = pixel(text, only(Only::fluorescence));
            const std::vector<double> bare = pixel(plane(paint + coat, light));
            for (size_t j = 0; j < all.size(); ++j) {
                CAPTURE(coat, light, j);
                CHECK(all[j] == Approx(reflected[j] + glowing[j]).epsilon(1e-6));
                CHECK(reflected[j] == Approx(bare[j]).epsilon(1e-6));
            }
            CHECK(*std::max_element(glowing.begin(), glowing.end()) > 0);
        }
}

TEST_CASE("under a coat of any roughness nothing gains photons: a furnace gives back at most what it sends") {
    if (!haveDevice()) return;
    for (const std::string& coat :
         {std::string(), std::string("<gloss ior=\"1.5\" roughness=\"0\"/>"),
          std::string("<gloss ior=\"1.5\" roughness=\"0.4\"/>"),
          std::string("<gloss ior=\"2\" roughness=\"1\"/>"),
          std::string("<specular reflectance=\"constant:0.4\" roughness=\"0.4\"/>")}) {
        for (const std::string reflectance :
             {"0", "0.5", "0.95", "0.5\" roughness=\"60", "0.95\" roughness=\"20"}) {
            // All that is excited and emitted lies within the bands; light from 350 to 750 nm.
            const std::vector<double> got = pixel(plane(
                "<diffuse reflectance=\"constant:" + reflectance + "\"/>" + coat +
                    R"(<fluorescence excitation="gaussian:420,30" emission="gaussian:560,40" yield="1"/>)",
                R"(<light type="ambient" spectrum="350:1 750:1" scale="1"/>)",
                "from=\"350\" to=\"750\" step=\"5\""));
            double photons = 0, sent = 0;
            for (size_t j = 0; j < got.size(); ++j) {
                const double width = j == 0 || j + 1 == got.size() ? 2.5 : 5,
                             nm = 350 + 5 * static_cast<double>(j);
                photons += got[j] * width * nm;
                sent += width * nm;
            }
            CAPTURE(coat, reflectance);
            CHECK(photons <= sent * (1 + 1e-4));
            CHECK(photons > 0.01 * sent);
        }
    }
}

TEST_CASE(
    "matrices measured at RIT under D65, A and an ultraviolet lamp: no radiance below zero, and none lost") {
    for (const std::string name : {"ciba12", "herpiora", "ixcrlale", "php8hp1c"}) {
        const std::filesystem::path path =
            std::filesystem::path(SPECTRAD_SHARED) / "data/fluorescence/bispectral_rit" / (name + ".csv");
        if (!std::filesystem::exists(path)) {
            WARN("skipped: no " << path.string());
            continue;
        }
        if (!haveDevice()) return;
        const TemporaryFolder folder;
        std::filesystem::copy(path, folder.path() / "m.csv");
        for (const std::string light : {"illuminants/D65", "illuminants/A", "lamps/uv-365"}) {
            const std::string text =
                plane("<fluorescence matrix=\"m.csv\"/>", lamp(light, "irradiance=\"100 W/m2\""),
                      "from=\"380\" to=\"780\" step=\"10\"");
            Notes notes;
            const Scene scene = loadScene(folder.write("scene.xml", text), library(), {}, notes);
            const Image image = imageOf(scene), glowing = imageOf(scene, only(Only::fluorescence));
            CAPTURE(name, light);
            CHECK(*std::min_element(image.values.begin(), image.values.end()) >= 0);
            CHECK(*std::min_element(glowing.values.begin(), glowing.values.end()) >= 0);
            // Yellow and orange glow in the light of any lamp, brightened paper in the ultraviolet.
            CHECK(*std::max_element(glowing.values.begin(), glowing.values.end()) > 1e-4f);
        }
    }
}

TEST_CASE("a scene without fluorescence, metals and textures has no code, table or term for them") {
    const Plan plan = planOf(sceneFrom(plane(base, lamp("illuminants/D65"))));
    for (const std::string feature : {"fluorescence", "conductor", "gloss", "texture", "specular"})
        CHECK(std::find(plan.features.begin(), plan.features.end(), feature) == plan.features.end());
    for (const std::string& define : plan.defines)
        CHECK((define == "HAS_DIRECTIONAL" || define.starts_with("SLOTS")));
    CHECK(plan.world.tables.empty());
    CHECK(plan.world.textures.empty());
    CHECK(plan.terms.count() == 1);
}

TEST_CASE("fluorescence costs nothing per pixel where its light factors: the same term, the same switches") {
    const Plan plain = planOf(sceneFrom(plane(base, lamp("illuminants/D65")))),
               glowing = planOf(sceneFrom(plane(base + dye + dye, lamp("illuminants/D65"))));
    CHECK(glowing.terms.count() == plain.terms.count());
    CHECK(glowing.world.lobes.size() == plain.world.lobes.size());
    CHECK(glowing.defines == plain.defines);
    CHECK(std::find(glowing.features.begin(), glowing.features.end(), "fluorescence") !=
          glowing.features.end());
}

TEST_CASE(
    "without fluorescence no ultraviolet is read: lamps that differ below the bands make the same terms") {
    const std::string dark = "300:0 379:0 380:1 780:1", bright = "300:5 379:5 380:1 780:1";
    const auto terms = [&](const std::string& lobes, const std::string& spectrum) {
        return planOf(sceneFrom(plane(lobes, lamp(spectrum)))).terms.spectra;
    };
    CHECK(terms(base, dark) == terms(base, bright));
    CHECK(terms("<conductor ior=\"metals/Au\" roughness=\"0.2\"/>", dark) ==
          terms("<conductor ior=\"metals/Au\" roughness=\"0.2\"/>", bright));
    CHECK(terms(base + dye, dark) != terms(base + dye, bright));
}

TEST_CASE("angle tables are made for metals and coats alone") {
    for (const std::string& lobes :
         {base, base + dye, std::string(R"(<fluorescence excitation="gaussian:380,60"
                                                                       emission="gaussian:520,40"/>)")})
        CHECK(planOf(sceneFrom(plane(lobes, lamp("illuminants/D65")))).world.tables.empty());
    CHECK_FALSE(planOf(sceneFrom(plane(base + "<gloss ior=\"1.5\"/>", lamp("illuminants/D65"))))
                    .world.tables.empty());
}
