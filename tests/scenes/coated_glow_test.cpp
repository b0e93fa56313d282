// Fluorescence below coats that pass exciting light otherwise than what is emitted: closed forms, and photons
// counted.
#include "image/picture.h"
#include "render/renderer.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

constexpr double pi = std::numbers::pi;
using Function = std::function<double(double)>;

const std::string
    ambient = R"(<light type="ambient" spectrum="gaussian:450,10" scale="1"/>)",
    square = R"(<light type="directional" direction="0 0 -1" spectrum="gaussian:450,10" scale="1"/>)",
    dye = R"(<fluorescence excitation="gaussian:450,60" emission="gaussian:560,30"/>)";

double gauss(double nm, double centre, double fwhm) {
    return std::exp(-4 * std::log(2.0) * (nm - centre) * (nm - centre) / (fwhm * fwhm));
}
/// Value `a` up to one wavelength and `b` from another on, straight between.
Function ramp(double nmA, double a, double nmB, double b) {
    return [=](double nm) { return a + (b - a) * std::clamp((nm - nmA) / (nmB - nmA), 0.0, 1.0); };
}

double dielectric(double c, double n) {
    const double g = std::sqrt(n * n - 1 + c * c), a = (g - c) / (g + c),
                 b = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * a * a * (1 + b * b);
}
double meanDielectric(double n) {
    constexpr int count = 400;
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const double c = (i + 0.5) / count;
        sum += 2 * c * dielectric(c, n) / count;
    }
    return sum;
}

/// A plane seen square-on; radiances of its bands from 505 nm on, where only what is emitted is seen.
std::vector<double> glowOf(const std::string& lobes, const std::string& light) {
    const std::string text =
        "<scene version=\"1\"><wavelengths from=\"400\" to=\"700\" step=\"5\"/><material name=\"m\">" +
        lobes + "</material><plane size=\"2 2\" material=\"m\"/>" + light +
        R"(<camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="8x8"/></scene>)";
    const Image image = imageOf(text);
    std::vector<double> bands;
    for (size_t band = 21; band < image.wavelengths.size(); ++band)
        bands.push_back(image.at(3, 4, band));
    return bands;
}

/// The same by the reradiation's formula, for what the coat passes in and out, each at its own wavelength.
std::vector<double> expected(const Function& in, const Function& out) {
    double taken = 0, photons = 0;
    for (double nm = 400.005; nm < 500; nm += 0.01)
        taken += gauss(nm, 450, 10) * gauss(nm, 450, 60) * nm * in(nm)*0.01;
    for (double nm = 460.005; nm < 660; nm += 0.01)
        photons += gauss(nm, 560, 30) * nm * 0.01;
    std::vector<double> bands;
    for (int j = 21; j <= 60; ++j) {
        double sum = 0, weights = 0;
        for (double nm = 395.05 + 5 * j; nm < 405 + 5 * j; nm += 0.1) {
            if (nm > 700) continue;
            const double hat = 1 - std::abs(nm - 400 - 5 * j) / 5;
            sum += hat * gauss(nm, 560, 30) * out(nm);
            weights += hat;
        }
        bands.push_back(sum / weights * taken / photons / pi);
    }
    return bands;
}

double worst(const std::vector<double>& got, const std::vector<double>& want) {
    const double peak = *std::max_element(want.begin(), want.end());
    double error = got.size() == want.size() ? 0 : 1;
    for (size_t j = 0; j < want.size() && j < got.size(); ++j)
        error = std::max(error, std::abs(got[j] - want[j]) / peak);
    return error;
}

/// Photons that a ball sends out ÷ photons that reach it, in light of 450 nm from everywhere: its picture's
/// sum is the hemisphere's integral.
double photonsOut(const std::string& lobes) {
    const Image image = imageOf(
        "<scene version=\"1\"><wavelengths from=\"400\" to=\"700\" step=\"5\"/><material name=\"m\">" +
        lobes + "</material><sphere radius=\"1\" material=\"m\"/>" + ambient +
        R"(<camera type="orthographic" height="2.2" look-from="0 0 5" look-at="0 0 0" size="44x44"/></scene>)");
    double out = 0, in = 0;
    for (size_t band = 0; band < image.wavelengths.size(); ++band) {
        const double nm = image.wavelengths.nm[band];
        for (int y = 0; y < 44; ++y)
            for (int x = 0; x < 44; ++x)
                out += image.at(x, y, band) * nm * 5 * 0.05 * 0.05;
    }
    for (double nm = 400.05; nm < 500; nm += 0.1)
        in += gauss(nm, 450, 10) * nm * 0.1 * pi;
    return out / in;
}

}  // namespace

TEST_CASE(
    "under a measured specular reflectance exciting light comes in by what it is there, not where the dye "
    "emits") {
    if (!haveDevice()) return;
    for (const auto& [text, r0] :
         {std::pair<std::string, Function>{"500:0.95 520:0.05", ramp(500, 0.95, 520, 0.05)},
          {"500:0.05 520:0.95", ramp(500, 0.05, 520, 0.95)},
          {"440:0.1 460:0.8", ramp(440, 0.1, 460, 0.8)},
          {"constant:0.4", ramp(400, 0.4, 500, 0.4)}})
        for (const std::string& light : {ambient, square}) {
            // Of Schlick's formula: 1 − r0 is let through square-on and 20/21 of it on the mean; a coat
            // whose inside is not known lets out all that leaves the base.
            const std::vector<double> want =
                light == ambient
                    ? expected([&, r = r0](double nm) { return pi * (1 - r(nm)); },
                               [](double) { return 1.0; })
                    : expected([&, r = r0](double nm) { return 1 - r(nm); }, [](double) { return 1.05; });
            const std::string coat = "<specular reflectance=\"" + text + "\"/>";
            CAPTURE(text, light);
            CHECK(worst(glowOf(coat + dye, light), want) < 2e-4);
        }
}

TEST_CASE("under a glass of strong dispersion light comes in by its own index and gets out by its own") {
    if (!haveDevice()) return;
    const Function n = ramp(450, 2.5, 560, 1.3);
    for (const double rho : {0.0, 0.6})
        for (const std::string& light : {ambient, square}) {
            const auto inside = [&](double nm) { return 1 - (1 - meanDielectric(n(nm))) / (n(nm) * n(nm)); };
            const auto table = [](const Function& f) {  // slow functions, every half nanometre
                std::vector<double> values;
                for (double nm = 390; nm <= 720; nm += 0.5)
                    values.push_back(f(nm));
                return [values](double nm) {
                    const double at = (nm - 390) * 2;
                    const auto i = static_cast<size_t>(at);
                    return values[i] + (values[i + 1] - values[i]) * (at - static_cast<double>(i));
                };
            };
            const Function in = table([&](double nm) {
                const double through =
                    light == ambient ? pi * (1 - meanDielectric(n(nm))) : 1 - dielectric(1, n(nm));
                return through * (1 - rho) / (1 - rho * inside(nm));
            });
            const Function out = table([&](double nm) {
                return (1 - dielectric(1, n(nm))) / (n(nm) * n(nm)) / (1 - rho * inside(nm));
            });
            const std::vector<double> want = expected(in, out);
            const std::string gloss = R"(<gloss ior="450:2.5 560:1.3"/>)";
            CAPTURE(rho, light);
            CHECK(
                worst(glowOf("<diffuse reflectance=\"constant:" + std::to_string(rho) + "\"/>" + gloss + dye,
                             light),
                      want) < 5e-4);
        }
}

TEST_CASE(
    "a black base whose dye takes every photon gives each back once, or what of them a glass lets out") {
    if (!haveDevice()) return;
    const std::string all = R"(<fluorescence excitation="380:1 500:1" emission="gaussian:580,30"/>)";
    for (const std::string coat :
         {R"(<specular reflectance="500:0.95 520:0.05"/>)", R"(<specular reflectance="500:0.05 520:0.95"/>)",
          R"(<specular reflectance="500:0.95 520:0.05" roughness="0.6"/>)",
          R"(<specular reflectance="500:0.05 520:0.95" roughness="0.3 0.9"/>)",
          R"(<specular reflectance="445:0.9 455:0.1 500:0.1 560:0.1 600:0.9"/>)"}) {
        const double share = photonsOut(coat + all);
        CAPTURE(coat, share);
        CHECK(share == Approx(1).margin(0.012));
    }
    // A glass sends part of what is emitted back to the black base.
    const auto reflected = [](double nm) { return meanDielectric(ramp(450, 2.5, 560, 1.3)(nm)); };
    double in = 0, once = 0, photons = 0, out = 0;
    for (double nm = 400.5; nm < 700; ++nm) {
        const double n = ramp(450, 2.5, 560, 1.3)(nm), lamp = gauss(nm, 450, 10) * nm,
                     emission = gauss(nm, 580, 30) * nm;
        in += lamp;
        once += lamp * reflected(nm);
        photons += emission;
        out += emission * (1 - reflected(nm)) / (n * n);
    }
    CHECK(photonsOut(R"(<gloss ior="450:2.5 560:1.3"/>)" + all) ==
          Approx(once / in + (1 - once / in) * out / photons).margin(0.012));
}

TEST_CASE("a rough base below such coats sends out no more photons than come in") {
    if (!haveDevice()) return;
    for (const std::string coat :
         {R"(<specular reflectance="500:0.95 520:0.05"/>)",
          R"(<specular reflectance="500:0.05 520:0.95" roughness="0.4"/>)",
          R"(<gloss ior="450:2.5 560:1.3"/>)", R"(<gloss ior="450:1.2 560:2.5"/>)"}) {
        const double share =
            photonsOut(R"(<diffuse reflectance="constant:0.5" roughness="50"/>)" + coat +
                       R"(<fluorescence excitation="380:1 500:1" emission="gaussian:580,30"/>)");
        CAPTURE(coat, share);
        CHECK(share < 1.012);
        CHECK(share > 0.4);
    }
}

TEST_CASE("pairs of nodes are made where the coat asks for them: none for one index, four for a real glass") {
    const auto planned = [](const std::string& lobes) {
        return planOf(
            sceneFrom("<scene version=\"1\"><wavelengths from=\"400\" to=\"700\" step=\"5\"/>"
                      "<material name=\"m\">" +
                      lobes + "</material><plane size=\"2 2\" material=\"m\"/>" + square +
                      R"(<camera look-from="0 0 5" look-at="0 0 0" size="8x8"/></scene>)"));
    };
    const auto lobesMore = [&](const std::string& coat) {
        const std::string grey = R"(<diffuse reflectance="constant:0.5"/>)";
        const Plan plain = planned(grey + coat), glowing = planned(grey + coat + dye);
        CHECK(glowing.terms.count() - plain.terms.count() ==
              glowing.world.lobes.size() - plain.world.lobes.size());
        return glowing.world.lobes.size() - plain.world.lobes.size();
    };
    CHECK(lobesMore(R"(<gloss ior="1.5"/>)") == 0);
    CHECK(lobesMore(R"(<specular reflectance="constant:0.2" roughness="0.4"/>)") == 0);
    CHECK(lobesMore(R"(<gloss ior="cauchy:1.5046,0.0042"/>)") <= 4);
    // It depends on the wavelength where nothing is excited, and nothing emitted.
    CHECK(lobesMore(R"(<specular reflectance="660:0.05 680:0.5"/>)") <= 2);
    CHECK(lobesMore(R"(<specular reflectance="400:0.05 700:0.9" roughness="0.5"/>)") <= 81);
}

TEST_CASE("what glows under a lamp is not known to be without light: masked and below coats, too") {
    const TemporaryFolder folder;
    writePng(folder.path() / "mask.png", {2, 1, 1, {0, 255}}, {}, {});
    for (const std::string& coat : {std::string(), std::string(R"(<gloss ior="cauchy:1.5,0.02"/>)")}) {
        Notes notes;
        const Plan plan = planOf(loadScene(
            folder.write(
                "scene.xml",
                "<scene version=\"1\"><material name=\"m\"><diffuse reflectance=\"constant:0.5\"/>" + coat +
                    R"(<fluorescence excitation="gaussian:450,60" emission="gaussian:560,30" mask="mask.png"/>)"
                    R"(</material><plane size="2 2" material="m"/>)" +
                    square + R"(<camera look-from="0 0 5" look-at="0 0 0" size="8x8"/></scene>)"),
            library(), {}, notes));
        size_t unknown = 0;
        for (const TermRecipe& recipe : plan.terms.recipes) {
            CHECK(recipe.group != TermRecipe::none);
            if (recipe.group == TermRecipe::unknown) ++unknown;
        }
        CHECK(unknown > 0);
    }
}
