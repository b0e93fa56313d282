// The scenes of the interface as they stand: each renders, or is refused in the one way that says "not there
// yet".
#include "scenes/measured.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

using namespace spectrad;
using namespace spectrad::test;

namespace fs = std::filesystem;

namespace {

/// Nothing, and said, if the scenes are not there.
std::optional<fs::path> contractScene(const std::string& name) {
    const fs::path path = fs::path(SPECTRAD_SHARED) / "contract" / name;
    if (fs::exists(path)) return path;
    WARN("skipped: no " << path.string());
    return std::nullopt;
}

Image imageOfFile(const fs::path& path) {
    Notes notes;
    return imageOf(loadScene(path, library(), {}, notes));
}

/// The image, or nothing if this version says that it cannot: "file:line:col: …: … is not there yet", one
/// line.
std::optional<Image> imageOrRefusal(const fs::path& path) {
    try {
        return imageOfFile(path);
    } catch (const InputError& error) {
        const std::string what = error.what();
        CHECK(what.starts_with(path.string() + ":"));
        CHECK(what.find("there yet") != std::string::npos);
        CHECK(what.find('\n') == std::string::npos);
        WARN(what);
        return std::nullopt;
    }
}

/// ∫ of a formula over [from, to] by midpoints a hundredth of a nanometre apart.
template <typename Function>
double fineSum(double from, double to, const Function& f) {
    const auto steps = static_cast<long>(std::lround((to - from) * 100));
    long double sum = 0;
    for (long i = 0; i < steps; ++i)
        sum += static_cast<long double>(f(from + (static_cast<double>(i) + 0.5) / 100));
    return static_cast<double>(sum / 100);
}

}  // namespace

TEST_CASE("contract: every pixel of chart.xml is reflectance × irradiance / π") {
    const auto path = contractScene("chart.xml");
    if (!path || !haveDevice()) return;
    const Image image = imageOfFile(*path);
    REQUIRE((image.width == 300 && image.height == 200 && image.wavelengths.size() == 31));
    const Polyline lamp{{400, 450, 545, 546, 547, 610, 611, 613, 700},
                        {0.5, 1.0, 0.6, 9.0, 0.6, 0.9, 7.5, 0.4, 0.7}};
    const auto constant = [](double value) { return Polyline{{400, 700}, {value, value}, true}; };
    const Table checker = measuredTable("charts/colorchecker");
    Polyline green;
    for (size_t i = 0; i < checker.columns.size(); ++i)
        if (checker.columns[i] == "green") green = checker.curves[i];
    const Polyline patches[6] = {constant(0), constant(0.18),
                                 constant(1), {{400, 580, 620, 700}, {0.05, 0.06, 0.70, 0.85}, true},
                                 green,       {{400, 544, 546, 548, 700}, {0.9, 0.9, 0.1, 0.9, 0.9}, true}};
    for (int patch = 0; patch < 6; ++patch) {
        Worst worst;
        for (size_t band = 0; band < 31; ++band) {
            const double expected =
                bandValue(lamp, patches[patch], image.wavelengths, band) / std::numbers::pi;
            for (int y = patch / 3 * 100; y < patch / 3 * 100 + 100; ++y)
                for (int x = patch % 3 * 100; x < patch % 3 * 100 + 100; ++x)
                    worst.add(image.at(x, y, band), expected, expected, x, y, band);
        }
        INFO("patch " << patch << ": " << worst.str());
        CHECK(worst.error <= 1e-6);
    }
}

TEST_CASE("contract: furnace.xml's white sphere disappears, its coat gains and loses no energy") {
    const auto path = contractScene("furnace.xml");
    if (!path || !haveDevice()) return;
    const Image image = imageOfFile(*path);
    Worst plain;
    double least = 1, most = 1;
    for (int y = 0; y < image.height; ++y) {
        for (size_t band = 0; band < image.wavelengths.size(); ++band) {
            for (int x = 0; x < image.width / 2; ++x)
                plain.add(image.at(x, y, band), 1, 1, x, y, band);
            for (int x = image.width / 2; x < image.width; ++x) {
                least = std::min<double>(least, image.at(x, y, band));
                most = std::max<double>(most, image.at(x, y, band));
            }
        }
    }
    INFO(plain.str());
    CHECK(plain.error <= 1e-6);
    INFO("coated: " << least << " to " << most);
    CHECK(most <= 1 + 1e-4);
    CHECK(least >= 1 - 1e-3);
}

TEST_CASE("contract: a substrate under a lamp with ultraviolet, with and without a fluorophore") {
    const auto path = contractScene("fluorescence.xml");
    if (!path || !haveDevice()) return;
    const auto image = imageOrRefusal(*path);
    if (!image) return;
    const auto gaussian = [](double nm, double centre, double fwhm) {
        return std::exp(-4 * std::log(2.0) * (nm - centre) * (nm - centre) / fwhm / fwhm);
    };
    // Q a(λi) λi e(λo) / ∫ e λ dλ with a = x (1 − R), under an irradiance of 1 from 300 to 780 nm; nothing
    // below the excitation.
    const double photons = fineSum(300, 780, [&](double nm) { return gaussian(nm, 520, 40) * nm; });
    std::vector<double> absorbed(48001);  // ∫ from 300 nm to 300 + i / 100 nm
    for (size_t i = 1; i < absorbed.size(); ++i) {
        const double nm = 300 + (static_cast<double>(i) - 0.5) / 100;
        absorbed[i] = absorbed[i - 1] + 0.8 * 0.5 * gaussian(nm, 380, 60) * nm / 100;
    }
    Worst plain, glowing;
    for (size_t band = 0; band < image->wavelengths.size(); ++band) {
        const double here = image->wavelengths.nm[band];
        const double from = band == 0 ? here : here - 10,
                     to = band + 1 == image->wavelengths.size() ? here : here + 10;
        const auto hat = [&](double nm) { return 1 - std::abs(nm - here) / 10; };
        const double emitted =
            fineSum(from, to,
                    [&](double nm) {
                        return hat(nm) * gaussian(nm, 520, 40) / photons *
                               absorbed[static_cast<size_t>(std::lround((nm - 300) * 100))];
                    }) /
            fineSum(from, to, hat);
        for (int y = 0; y < image->height; ++y) {
            for (int x = 0; x < 100; ++x)
                plain.add(image->at(x, y, band), 0.5 / std::numbers::pi, 0.5 / std::numbers::pi, x, y, band);
            for (int x = 100; x < 200; ++x) {
                const double expected = (0.5 + emitted) / std::numbers::pi;
                glowing.add(image->at(x, y, band), expected, expected, x, y, band);
            }
        }
    }
    INFO("plain: " << plain.str());
    CHECK(plain.error <= 1e-6);
    INFO("glowing: " << glowing.str());
    CHECK(glowing.error <= 1e-4);
}

TEST_CASE("contract: a picture keeps its reflectance under another lamp") {
    const auto path = contractScene("picture.xml");
    if (!path || !haveDevice()) return;
    const auto image = imageOrRefusal(*path);
    if (!image) return;
    REQUIRE((image->width == 512 && image->height == 256));
    const Polyline lamp = measuredTable("illuminants/D65").curves.front();
    const double factor = 100 / static_cast<double>(integral(lamp)) / std::numbers::pi;
    // The wall is 4 × 2 m, the canvas 2 × 1 m in its middle; both paints are not linear between the bands
    // only at 500 and 600 nm, where bands lie, so that the texture is exact.
    const Polyline wall{{400, 700}, {0.5, 0.5}, true}, left{{400, 500, 600, 700}, {0.1, 0.7, 0.2, 0.4}, true},
        right{{400, 500, 600, 700}, {0.6, 0.2, 0.1, 0.8}, true};
    const std::tuple<const Polyline*, int, int> places[] = {
        {&wall, 60, 128}, {&wall, 256, 30},   {&wall, 450, 200}, {&left, 190, 128},
        {&left, 150, 80}, {&right, 320, 128}, {&right, 370, 180}};
    for (const auto& [paint, x, y] : places) {
        Worst worst;
        for (size_t band = 0; band < image->wavelengths.size(); ++band) {
            const double expected = factor * bandValue(lamp, *paint, image->wavelengths, band);
            worst.add(image->at(x, y, band), expected, expected, x, y, band);
        }
        INFO(worst.str());
        CHECK(worst.error <= 1e-5);
    }
}

TEST_CASE("contract: the still life of metals is finite, lit and nowhere negative") {
    const auto path = contractScene("metals.xml");
    if (!path || !haveDevice()) return;
    const auto image = imageOrRefusal(*path);
    if (!image) return;
    size_t wrong = 0, lit = 0;
    for (float v : image->values)
        wrong += !(std::isfinite(v) && v >= 0), lit += v > 0;
    CHECK(wrong == 0);
    CHECK(lit > image->values.size() / 3);
}
