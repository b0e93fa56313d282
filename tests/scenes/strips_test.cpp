// The picture does not depend on how it is cut into strips, and images of any shape are whole.
#include "render/renderer.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstring>

using namespace spectrad;
using namespace spectrad::test;

namespace {

/// Several materials, lamps, a coat and a background, so that blocks have term lists of all kinds.
const char* stillLife = R"(<scene version="1">
  <wavelengths>450 500 550 600 650</wavelengths>
  <material name="plastic"><diffuse reflectance="srgb:#2050a0"/><gloss ior="1.5" roughness="0.3"/></material>
  <material name="paint"><diffuse reflectance="constant:0.4"/></material>
  <material name="lamp"><emission spectrum="illuminants/A" luminance="100 cd/m2"/></material>
  <node rotate="1 0 0 -75" translate="0 -0.6 0"><plane size="8 8" material="paint"/></node>
  <sphere radius="0.6" material="plastic"/>
  <node translate="1 0 0.4" rotate="1 1 0 40"><torus radius="0.5" tube="0.15" material="lamp"/></node>
  <node translate="-1.1 -0.5 0"><teapot size="0.8" material="paint"/></node>
  <light type="point" position="1 3 4" spectrum="illuminants/D65" intensity="100 cd"/>
  <light type="spot" position="-2 3 2" target="0 0 0" angle="40" blend="0.5" spectrum="illuminants/FL11" intensity="100 cd"/>
  <background spectrum="illuminants/D65" luminance="5 cd/m2"/>
  <camera type="perspective" fov="35" look-from="0 0.8 5" look-at="0 0 0" size="130x90"/>
</scene>)";

bool same(const Image& a, const Image& b) {
    return a.values.size() == b.values.size() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0 &&
           a.preview.size() == b.preview.size() &&
           std::memcmp(a.preview.data(), b.preview.data(), a.preview.size() * sizeof(float)) == 0;
}

}  // namespace

TEST_CASE("the image is the same whatever memory a strip may take") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(stillLife);
    for (const auto& size : {std::pair{130, 90}, {1, 1}, {63, 40}, {65, 37}, {300, 70}}) {
        RenderSettings settings;
        settings.size = size;
        const Image whole = imageOf(scene, settings);
        for (const std::uint64_t bytes :
             {std::uint64_t{1}, std::uint64_t{40'000}, std::uint64_t{300'000}, std::uint64_t{1} << 40}) {
            settings.stripBytes = bytes;
            CAPTURE(size.first, size.second, bytes);
            CHECK(same(imageOf(scene, settings), whole));
        }
    }
    RenderSettings tiny;
    tiny.stripBytes = 1;
    const Plan plan = planOf(scene, tiny);
    CHECK(Renderer(device(), plan).stripRows() == 1);
}

TEST_CASE("images of odd shapes are whole") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(stillLife);
    for (const auto& size : {std::pair{1, 1}, {63, 63}, {65, 65}, {300, 1}, {1, 300}, {1, 5000}, {5000, 1}}) {
        RenderSettings settings;
        settings.size = size;
        const Image image = imageOf(scene, settings);
        size_t wrong = 0;
        for (float v : image.values)
            wrong += !(v >= 0 && std::isfinite(v));
        for (float v : image.preview)
            wrong += !std::isfinite(v);
        CAPTURE(size.first, size.second);
        CHECK(wrong == 0);
        CHECK(image.at(size.first / 2, size.second / 2, 2) > 0);
    }
}

TEST_CASE("a picture is the middle of a wider one") {
    if (!haveDevice()) return;
    // The view's height decides the scale; pixels of an even difference in width lie on the same rays.
    const Scene scene = sceneFrom(stillLife);
    RenderSettings settings;
    settings.size = {301, 61};
    const Image wide = imageOf(scene, settings);
    for (const int width : {1, 63, 65, 129, 299}) {
        settings.size = {width, 61};
        const Image narrow = imageOf(scene, settings);
        size_t different = 0;
        for (int y = 0; y < 61; ++y)
            for (size_t band = 0; band < 5; ++band)
                for (int x = 0; x < width; ++x)
                    different += narrow.at(x, y, band) != wide.at(x + (301 - width) / 2, y, band);
        CAPTURE(width);
        CHECK(different == 0);
    }
}

TEST_CASE("two renders of a scene are the same bytes") {
    if (!haveDevice()) return;
    const Scene scene = sceneFrom(stillLife);
    CHECK(same(imageOf(scene), imageOf(scene)));
}
