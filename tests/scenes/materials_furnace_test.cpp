// White furnaces: in uniform light of radiance 1 nothing may shine brighter than 1, and what reflects
// everything is 1.
#include "render/renderer.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>

using namespace spectrad;
using namespace spectrad::test;

namespace {

constexpr std::array<double, 12> ladder{0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1};

/// Spheres side by side, one a step of the ladder; "{}" in `lobes` becomes the roughness × factor, a second
/// "{}" × across.
Image furnace(const std::string& lobes, double factor = 1, double across = 1) {
    const TemporaryFolder folder;
    folder.write("perfect.csv", "wavelength_nm,n,k\n300,0.00001,100\n900,0.00001,100\n");
    std::string text = "<scene version=\"1\"><wavelengths>400 450 500 550 600 650 700</wavelengths>\n";
    for (size_t i = 0; i < ladder.size(); ++i) {
        text += fmt::format("<material name=\"m{}\">{}</material>\n", i,
                            fmt::format(fmt::runtime(lobes), ladder[i] * factor, ladder[i] * across));
        text += fmt::format("<node translate=\"{} 0 0\"><sphere radius=\"0.5\" material=\"m{}\"/></node>\n",
                            static_cast<double>(i) + 0.5, i);
    }
    text +=
        "<light type=\"ambient\" spectrum=\"constant:1\" scale=\"1\"/><background spectrum=\"constant:1\" "
        "scale=\"1\"/>\n"
        "<camera type=\"orthographic\" height=\"1\" look-from=\"6 0 5\" look-at=\"6 0 0\" "
        "size=\"576x48\"/></scene>";
    Notes notes;
    RenderSettings settings;
    settings.samples = 4;
    return imageOf(loadScene(folder.write("scene.xml", text), library(), {}, notes), settings);
}

struct Range {
    float least, most;
};
Range rangeOf(const Image& image) {
    const auto [least, most] = std::minmax_element(image.values.begin(), image.values.end());
    return {*least, *most};
}

}  // namespace

TEST_CASE("a white Lambertian sphere disappears in the furnace") {
    if (!haveDevice()) return;
    const auto [least, most] = rangeOf(furnace("<diffuse reflectance=\"constant:1\"/><!-- {} -->"));
    CHECK(least >= 1 - 1e-6f);
    CHECK(most <= 1 + 1e-6f);
}

TEST_CASE(
    "whatever reflects all light loses less than 1 % in the furnace, at any roughness and from any side, and "
    "gains nothing") {
    if (!haveDevice()) return;
    const std::string white = "<diffuse reflectance=\"constant:1\"/>";
    for (const std::string& lobes :
         {white + "<gloss ior=\"1.5\" roughness=\"{}\"/>", white + "<gloss ior=\"1.05\" roughness=\"{}\"/>",
          white + "<gloss ior=\"2.4\" roughness=\"{}\"/>",
          white + "<gloss ior=\"cauchy:1.6,0.02\" roughness=\"{}\"/>",
          white + "<specular reflectance=\"400:0.03 700:0.97\" roughness=\"{}\"/>",
          white + "<specular reflectance=\"constant:0.5\" roughness=\"{}\"/>",
          std::string("<specular reflectance=\"constant:1\" roughness=\"{}\"/>"),
          std::string("<conductor ior=\"perfect.csv\" roughness=\"{}\"/>"),
          std::string("<conductor ior=\"perfect.csv\" roughness=\"{}\" fresnel=\"schlick\"/>")}) {
        const auto [least, most] = rangeOf(furnace(lobes));
        INFO(lobes << ": " << least << " to " << most);
        CHECK(least >= 0.99f);
        CHECK(most <= 1 + 1e-3f);
    }
    // Rougher along one axis, up to five times, on spheres that show it from all azimuths.
    for (const std::string& lobes :
         {white + "<gloss ior=\"1.5\" roughness=\"{} {}\"/>",
          std::string("<specular reflectance=\"constant:1\" roughness=\"{} {}\"/>"),
          std::string("<conductor ior=\"perfect.csv\" roughness=\"{} {}\"/>")}) {
        const auto [low, high] = rangeOf(furnace(lobes, 1, 0.2));
        INFO(lobes << ": " << low << " to " << high);
        CHECK(low >= 0.99f);
        CHECK(high <= 1 + 1e-3f);
    }
    // A rough base under coats: by the coat's roughness, and by its own.
    const std::string matt = "<diffuse reflectance=\"constant:1\" roughness=\"50\"/>",
                      steps = "<diffuse reflectance=\"constant:1\" roughness=\"{}\"/>";
    for (const auto& [lobes, factor] :
         {std::pair{matt + "<gloss ior=\"1.5\" roughness=\"{}\"/>", 1.0},
          {matt + "<gloss ior=\"cauchy:1.6,0.02\" roughness=\"{}\"/>", 1.0},
          {matt + "<specular reflectance=\"400:0.03 700:0.97\" roughness=\"{}\"/>", 1.0},
          {steps + "<gloss ior=\"1.5\" roughness=\"0.3\"/>", 90.0},
          {steps + "<gloss ior=\"2.4\" roughness=\"0 0\"/>", 90.0},
          {steps + "<gloss ior=\"1.5\" roughness=\"0.2 0.6\"/>", 90.0}}) {
        const auto [low, high] = rangeOf(furnace(lobes, factor));
        INFO(lobes << ": " << low << " to " << high);
        CHECK(low >= 0.99f);
        CHECK(high <= 1 + 1e-3f);
    }
    const auto [least, most] = rangeOf(furnace("<diffuse reflectance=\"constant:1\" roughness=\"{}\"/>", 90));
    INFO("Oren-Nayar: " << least << " to " << most);
    CHECK(least >= 0.99f);
    CHECK(most <= 1 + 1e-3f);
}

TEST_CASE("under a coat a base that gets smoother becomes the smooth one") {
    if (!haveDevice()) return;
    for (const std::string coat : {"<gloss ior=\"1.5\" roughness=\"{}\"/>",
                                   "<specular reflectance=\"400:0.03 700:0.97\" roughness=\"{}\"/>"}) {
        const Image rough = furnace("<diffuse reflectance=\"400:0.2 700:0.9\" roughness=\"0.05\"/>" + coat),
                    smooth = furnace("<diffuse reflectance=\"400:0.2 700:0.9\"/>" + coat);
        double worst = 0;
        for (size_t i = 0; i < rough.values.size(); ++i)
            worst = std::max<double>(worst, std::abs(rough.values[i] - smooth.values[i]));
        CAPTURE(coat);
        CHECK(worst < 1e-4);
    }
}

TEST_CASE("what does not reflect all light stays below 1, and darker bases are darker") {
    if (!haveDevice()) return;
    CHECK(rangeOf(furnace("<conductor ior=\"metals/Au\" roughness=\"{}\"/>")).most <= 1 + 1e-4f);
    const Image light =
        furnace("<diffuse reflectance=\"constant:0.9\"/><gloss ior=\"1.5\" roughness=\"{}\"/>");
    const Image dark =
        furnace("<diffuse reflectance=\"constant:0.2\"/><gloss ior=\"1.5\" roughness=\"{}\"/>");
    CHECK(rangeOf(light).most <= 1 + 1e-4f);
    for (size_t i = 0; i < ladder.size(); ++i)
        CHECK(dark.at(static_cast<int>(i) * 48 + 24, 24) < light.at(static_cast<int>(i) * 48 + 24, 24));
}
