// Mirrors in uniform light show their reflectance: pixels against the complex amplitudes.
#include "base/text.h"
#include "render/renderer.h"
#include "scenes/measured.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

using namespace spectrad;
using namespace spectrad::test;

namespace {

using Complex = std::complex<double>;

const RenderSettings oneSample = [] {
    RenderSettings settings;
    settings.samples = 1;
    return settings;
}();

double unpolarized(double cosine, Complex index) {
    const double sine2 = 1 - cosine * cosine;
    const Complex inside = std::sqrt(index * index - sine2);
    const Complex s = (cosine - inside) / (cosine + inside);
    const Complex p = (index * index * cosine - inside) / (index * index * cosine + inside);
    return 0.5 * (std::norm(s) + std::norm(p));
}

double cosineOf(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180);
}

const std::vector<double> tilts{0, 10, 20, 30, 40, 50, 60, 70, 75, 80, 84, 87, 88.5, 89.5, 89.8, 89.9};
constexpr int cellPixels = 4;

/// One row a material, one column a tilt, each plane `cellPixels` pixels wide, in uniform light of
/// radiance 1.
std::string ladder(const std::vector<std::string>& lobes) {
    std::string text = "<scene version=\"1\"><wavelengths from=\"380\" to=\"780\" step=\"5\"/>\n";
    for (size_t row = 0; row < lobes.size(); ++row) {
        text += fmt::format("<material name=\"m{}\">{}</material>\n", row, lobes[row]);
        for (size_t i = 0; i < tilts.size(); ++i)
            text += fmt::format(
                "<node translate=\"{} {} 0\" rotate=\"0 1 0 {}\"><plane size=\"{} 1\" "
                "material=\"m{}\"/></node>\n",
                static_cast<double>(i) + 0.5, -static_cast<double>(row) - 0.5, shortest(tilts[i]),
                shortest(0.9 / cosineOf(tilts[i])), row);
    }
    const double width = static_cast<double>(tilts.size()), height = static_cast<double>(lobes.size());
    return text + fmt::format(
                      "<light type=\"ambient\" spectrum=\"constant:1\" scale=\"1\"/>\n"
                      "<camera type=\"orthographic\" height=\"{}\" look-from=\"{} {} 1000\" look-at=\"{} {} "
                      "0\" size=\"{}x{}\"/></scene>",
                      height, width / 2, -height / 2, width / 2, -height / 2, tilts.size() * cellPixels,
                      lobes.size() * cellPixels);
}

/// The largest relative error over the middle pixels of a row's planes.
template <typename Expected>
Worst compareRow(const Image& image, size_t row, const Expected& expected) {
    Worst worst;
    for (size_t i = 0; i < tilts.size(); ++i)
        for (size_t band = 0; band < image.wavelengths.size(); ++band) {
            const double want = expected(cosineOf(tilts[i]), band);
            for (int dx = 1; dx < 3; ++dx) {
                const int x = static_cast<int>(i) * cellPixels + dx,
                          y = static_cast<int>(row) * cellPixels + 2;
                worst.add(image.at(x, y, band), want, want, x, y, band);
            }
        }
    return worst;
}

}  // namespace

TEST_CASE(
    "planes of every metal, 0 to 89.9 degrees: each pixel is the band's average of the exact reflectance, "
    "within 1e-5") {
    if (!haveDevice()) return;
    const std::vector<std::string> names = measuredNames("metals");
    REQUIRE(names.size() >= 18);
    std::vector<std::string> lobes;
    for (const std::string& name : names)
        lobes.push_back("<conductor ior=\"" + name + "\" roughness=\"0\"/>");
    const Image image = imageOf(ladder(lobes), oneSample);
    for (size_t row = 0; row < names.size(); ++row) {
        Table table = measuredTable(names[row]);
        Polyline &n = table.curves.at(0), &k = table.curves.at(1);
        n.held = k.held = true;
        const Worst worst = compareRow(image, row, [&](double cosine, size_t band) {
            // Midpoints an eighth of a nanometre apart under the hat.
            const double here = image.wavelengths.nm[band];
            double sum = 0, weights = 0;
            for (int i = -40; i < 40; ++i) {
                const double nm = here + (i + 0.5) / 8, hat = 1 - std::abs(nm - here) / 5;
                if (nm < 380 || nm > 780) continue;
                sum +=
                    hat * unpolarized(cosine, {static_cast<double>(n.at(nm)), static_cast<double>(k.at(nm))});
                weights += hat;
            }
            return sum / weights;
        });
        INFO(names[row] << ": " << worst.str());
        CHECK(worst.error <= 1e-5);
    }
}

TEST_CASE("a smooth coat over black shows the reflectance of glass at every angle, Brewster's included") {
    if (!haveDevice()) return;
    const std::string black = "<diffuse reflectance=\"constant:0\"/>";
    const Image image = imageOf(ladder({black + "<gloss ior=\"1.5\" roughness=\"0\"/>",
                                        black + "<gloss ior=\"cauchy:1.5,0.01\" roughness=\"0\"/>"}),
                                oneSample);
    Worst worst = compareRow(image, 0, [](double cosine, size_t) { return unpolarized(cosine, {1.5, 0}); });
    INFO("1.5: " << worst.str());
    CHECK(worst.error <= 1e-5);
    worst = compareRow(image, 1, [&](double cosine, size_t band) {
        const double here = image.wavelengths.nm[band];
        double sum = 0, weights = 0;
        for (int i = -40; i < 40; ++i) {
            const double nm = here + (i + 0.5) / 8, hat = 1 - std::abs(nm - here) / 5;
            if (nm < 380 || nm > 780) continue;
            sum += hat * unpolarized(cosine, {1.5 + 0.01 / (nm * nm * 1e-6), 0});
            weights += hat;
        }
        return sum / weights;
    });
    INFO("cauchy: " << worst.str());
    CHECK(worst.error <= 1e-5);
}

TEST_CASE("where the index is that of the air nothing is reflected: a metal is black, a coat is not there") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    folder.write("air.csv", "wavelength_nm,n,k\n300,1,0\n900,1,0\n");
    const std::string paint = "<diffuse reflectance=\"400:0.1 500:0.7 600:0.2 700:0.4\"/>";
    for (const std::string roughness : {"0", "0.3", "1"}) {
        const std::string text =
            ladder({"<conductor ior=\"air.csv\" roughness=\"" + roughness + "\"/>", paint,
                    paint + "<gloss ior=\"1\" roughness=\"" + roughness + "\"/>"});
        Notes notes;
        const Image image =
            imageOf(loadScene(folder.write("scene.xml", text), library(), {}, notes), oneSample);
        for (size_t i = 0; i < tilts.size(); ++i)
            for (size_t band = 0; band < image.wavelengths.size(); ++band) {
                const int x = static_cast<int>(i) * cellPixels + 2;
                CAPTURE(roughness, tilts[i], band);
                CHECK(image.at(x, 2, band) <= 1e-9f);
                CHECK(image.at(x, 10, band) == Approx(image.at(x, 6, band)).epsilon(2e-7));
            }
    }
}

TEST_CASE("Schlick's formula is what fresnel=\"schlick\" shows, and the plan says how far off it is") {
    if (!haveDevice()) return;
    const Scene scene =
        sceneFrom(ladder({"<conductor ior=\"metals/Au\" roughness=\"0\" fresnel=\"schlick\"/>"}));
    Notes notes;
    const Plan plan = makePlan(scene, oneSample, library(), notes);
    bool said = false;
    for (const std::string& line : notes.lines())
        said = said || line.find("Schlick") != std::string::npos;
    CHECK(said);
    const Image image = imageOf(plan);
    const Worst worst = compareRow(image, 0, [&](double cosine, size_t band) {
        const double r0 = image.at(2, 2, band);  // seen square-on
        return r0 + (1 - r0) * std::pow(1 - cosine, 5);
    });
    INFO(worst.str());
    CHECK(worst.error <= 1e-6);
}
