// Filters, wrapping and placing of images, against what the formulae of docs/format.md give in double
// precision.
#include "image/cube.h"
#include "image/picture.h"
#include "render/texels.h"
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

/// A surface chosen between black and white by a grey map, under uniform light of radiance 1: pixels are the
/// map's values.
std::string chosen(const std::string& attributes, const std::string& geometry, const std::string& camera) {
    return "<scene version=\"1\"><wavelengths projection=\"point\">550</wavelengths><material "
           "name=\"m\"><diffuse "
           "select=\"map.png\" values=\"mix\" " +
           attributes +
           R"(><choose value="0" reflectance="constant:0"/><choose value="255" reflectance="constant:1"/></diffuse></material>)" +
           geometry + R"(<light type="ambient" spectrum="constant:1" scale="1"/>)" + camera + "</scene>";
}

Image rendered(const TemporaryFolder& folder, const std::string& text, int samples = 1) {
    Notes notes;
    RenderSettings settings;
    settings.samples = samples;
    return imageOf(loadScene(folder.write("scene.xml", text), library(), {}, notes), settings);
}

void writeGrey(const TemporaryFolder& folder, int width, int height,
               const std::vector<std::uint8_t>& pixels) {
    writePng(folder.path() / "map.png", {width, height, 1, pixels}, {}, {});
}

}  // namespace

TEST_CASE("placed, turned and repeated images are where scale, rotate and offset put them") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    const int w = 5, h = 4;
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < w * h; ++i)
        pixels.push_back(static_cast<std::uint8_t>(i * 53 % 256));
    writeGrey(folder, w, h, pixels);
    for (const std::string filter : {"nearest", "bilinear"})
        for (const bool repeat : {false, true}) {
            const Image image = rendered(
                folder,
                chosen(
                    fmt::format(R"(filter="{}" wrap="{}" scale="1.7 -0.8" rotate="30" offset="0.4 0.15")",
                                filter, repeat ? "repeat" : "clamp"),
                    R"(<plane size="2 1" material="m"/>)",
                    R"(<camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="64x32"/>)"));
            Worst worst;
            int compared = 0;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 64; ++x) {
                    const double u0 = (x + 0.5) / 64, v0 = 1 - (y + 0.5) / 32,
                                 c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
                    double u = c * 1.7 * u0 - s * -0.8 * v0 + 0.4, v = s * 1.7 * u0 + c * -0.8 * v0 + 0.15;
                    const auto within = [repeat](int i, int n) {
                        return repeat ? ((i % n) + n) % n : std::clamp(i, 0, n - 1);
                    };
                    const auto at = [&](int column, int row) {
                        return pixels[static_cast<size_t>(within(row, h) * w + within(column, w))] / 255.0;
                    };
                    if (!repeat) u = std::clamp(u, 0.0, 1.0), v = std::clamp(v, 0.0, 1.0);
                    const double px = u * w, py = (1 - v) * h;
                    double want = 0;
                    if (filter == "nearest") {
                        // Too close to a texel's border, float decides.
                        if (std::abs(px - std::round(px)) < 1e-4 || std::abs(py - std::round(py)) < 1e-4)
                            continue;
                        want = at(static_cast<int>(std::floor(px)), static_cast<int>(std::floor(py)));
                    } else {
                        const int left = static_cast<int>(std::floor(px - 0.5)),
                                  top = static_cast<int>(std::floor(py - 0.5));
                        const double right = px - 0.5 - left, down = py - 0.5 - top;
                        want = (1 - down) * ((1 - right) * at(left, top) + right * at(left + 1, top)) +
                               down * ((1 - right) * at(left, top + 1) + right * at(left + 1, top + 1));
                    }
                    worst.add(image.at(x, y), want, 1, x, y);
                    ++compared;
                }
            INFO(filter << " " << repeat << " " << worst.str());
            CHECK(worst.error < 1e-5);
            CHECK(compared > 250);
        }
}

TEST_CASE("each level of a pyramid has the mean of the one above, whatever its size") {
    Texels image;
    image.width = 13, image.height = 7, image.bands = 2;
    for (int i = 0; i < 13 * 7 * 2; ++i)
        image.texels.push_back(static_cast<float>(i * 29 % 64) / 64);
    const auto mean = [](const Texels& t, size_t band) {
        double sum = 0;
        for (size_t i = band; i < t.texels.size(); i += 2)
            sum += static_cast<double>(t.texels[i]);
        return sum / (t.width * t.height);
    };
    const double first = mean(image, 0), second = mean(image, 1);
    for (int width : {6, 3, 1}) {
        image = halved(image);
        CHECK(image.width == width);
        CHECK(mean(image, 0) == Approx(first).epsilon(1e-6));
        CHECK(mean(image, 1) == Approx(second).epsilon(1e-6));
    }
    CHECK(image.height == 1);
    image = halved({1, 1, 2, {0.25f, 0.5f}});
    CHECK(image.texels == std::vector<float>{0.25f, 0.5f});
}

TEST_CASE("mip: from far away a chequerboard is even grey with one sample a pixel; from near it is itself") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 64 * 64; ++i)
        pixels.push_back((i % 64 + i / 64) % 2 == 0 ? 0 : 255);
    writeGrey(folder, 64, 64, pixels);
    const auto view = [&](const std::string& filter, const std::string& camera) {
        return rendered(folder, chosen("filter=\"" + filter + "\" wrap=\"repeat\" scale=\"8\"",
                                       R"(<plane size="10" material="m"/>)", camera));
    };
    const std::string
        far = R"(<camera type="orthographic" height="8" look-from="0 0 5" look-at="0 0 0" size="50x50"/>)",
        near =
            R"(<camera type="orthographic" height="0.05" look-from="0.01 0.02 5" look-at="0.01 0.02 0" size="50x50"/>)";
    double farthest = 0, moire = 0, nearest = 0;
    const Image grey = view("mip", far), rough = view("bilinear", far), a = view("mip", near),
                b = view("bilinear", near);
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 50; ++x) {
            farthest = std::max<double>(farthest, std::abs(grey.at(x, y) - 0.5f));
            moire = std::max<double>(moire, std::abs(rough.at(x, y) - 0.5f));
            nearest = std::max<double>(nearest, std::abs(a.at(x, y) - b.at(x, y)));
        }
    CHECK(farthest < 1e-6);
    CHECK(moire > 0.2);
    CHECK(nearest == 0);
}

TEST_CASE(
    "mip: the level is the one whose texels are as large as a sample's share of the pixel, in both "
    "projections") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    // Two rows apart by one level's mean: level l of this map is half black, half white along u until texels
    // reach the half.
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 256; ++i)
        pixels.push_back(i < 128 ? 0 : 255);
    writeGrey(folder, 256, 1, pixels);
    // An edge as wide as the texels of the level: its slope at u = 1/2 tells their size.
    const auto slope = [&](const std::string& camera, int samples, double texelsAcross) {
        const Image image = rendered(
            folder, chosen("filter=\"mip\"", R"(<plane size="2 1" material="m"/>)", camera), samples);
        double most = 0;
        for (int x = 0; x + 1 < image.width; ++x)
            most = std::max<double>(most, image.at(x + 1, image.height / 2) - image.at(x, image.height / 2));
        return most * texelsAcross;
    };
    // 128 pixels over the map's 256 texels: two texels a pixel, level 1, whose texels are a pixel wide.
    const double level1 = slope(
        R"(<camera type="orthographic" height="1" look-from="0 0 5" look-at="0 0 0" size="128x64"/>)", 1, 1);
    CHECK(level1 == Approx(1).margin(0.02));
    // The same at the middle of a perspective view.
    const double distance = 0.5 / std::tan(20 * std::numbers::pi / 180);
    const double perspective =
        slope(fmt::format(R"(<camera fov="40" look-from="0 0 {}" look-at="0 0 0" size="128x64"/>)", distance),
              1, 1);
    CHECK(perspective == Approx(1).margin(0.02));
    // Half a texel a pixel: magnified, the edge is two pixels wide.
    const double magnified = slope(
        R"(<camera type="orthographic" height="0.25" look-from="0 0 5" look-at="0 0 0" size="128x64"/>)", 1,
        1);
    CHECK(magnified == Approx(0.5).margin(0.02));
}
