#include "spectrum/projection.h"
#include "unit/verify/judged_scene.h"

#include <cmath>
#include <numbers>

using namespace spectrad;
using test::JudgedScene;

namespace {

/// Everything that has a lobe of its own, curved, with edges, under lights of each kind.
constexpr const char* everything = R"(<scene version="1">
  <wavelengths from="380" to="780" step="20"/>
  <material name="wall"><diffuse reflectance="charts/colorchecker/blue-sky" roughness="20"/></material>
  <material name="gold"><conductor ior="metals/Au" roughness="0.3"/></material>
  <material name="mirror"><conductor ior="metals/Cu"/></material>
  <material name="car"><diffuse reflectance="charts/colorchecker/red"/><gloss ior="cauchy:1.5,0.004" roughness="0.3"/></material>
  <material name="brushed"><conductor ior="metals/Al" roughness="0.5 0.25"/></material>
  <material name="silk"><diffuse reflectance="charts/colorchecker/green"/><specular reflectance="constant:0.1" roughness="0.4"/></material>
  <material name="dye"><diffuse reflectance="constant:0.3"/><fluorescence excitation="gaussian:450,40" emission="gaussian:550,40" yield="0.8"/></material>
  <material name="lamp"><emission spectrum="illuminants/A" luminance="40 cd/m2"/></material>
  <node translate="0 0 -1"><plane size="6 4" material="wall"/></node>
  <node translate="-1.5 0.6 0"><sphere radius="0.5" material="gold"/></node>
  <node translate="-0.5 0.6 0"><sphere radius="0.5" material="mirror"/></node>
  <node translate="0.5 0.6 0"><sphere radius="0.5" material="car"/></node>
  <node translate="1.5 0.6 0"><cylinder radius="0.4" height="0.9" material="brushed"/></node>
  <node translate="-1.2 -0.6 0"><torus radius="0.4" tube="0.15" material="silk"/></node>
  <node translate="0 -0.6 0"><box size="0.7" material="dye"/></node>
  <node translate="1.2 -0.6 0"><sphere radius="0.3" material="lamp"/></node>
  <light type="point" position="1 2 3" spectrum="illuminants/FL11" intensity="400 cd"/>
  <light type="spot" position="-2 1 4" target="0 0 0" angle="60" blend="0.3" spectrum="illuminants/A" intensity="300 cd"/>
  <light type="directional" direction="0 -1 -1" spectrum="illuminants/D65" illuminance="100 lx"/>
  <light type="ambient" spectrum="illuminants/LED-B3" luminance="10 cd/m2"/>
  <camera name="c" fov="36" look-from="0 0 6" look-at="0 0 0" size="96x64"/>
</scene>)";

}  // namespace

TEST_CASE("a matt plane: the reference is the closed form to 1e-12") {
    JudgedScene s(R"(<scene version="1"><wavelengths from="400" to="700" step="50"/>
      <material name="m"><diffuse reflectance="400:0.2 700:0.8"/></material>
      <node><plane size="9 9" material="m"/></node>
      <light type="directional" direction="0 0 -1" spectrum="illuminants/FL11" illuminance="1000 lx"/>
      <camera name="c" type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="4x3"/></scene>)");
    const Wavelengths grid = s.plan().wavelengths;
    const Reference reference(s.scene, {}, grid, s.observer, s.library, s.device);
    const std::vector<PixelPlace> places{{0, 0}, {3, 2}};
    const auto pixels = reference.at(places);
    const Curve& lamp = s.scene.lights.front().emitter.spectrum.curve();
    const Curve paint = s.scene.materials.back().diffuse->reflectance->curve();
    const std::array<const Curve*, 2> product{&lamp, &paint}, seen{&lamp, &s.observer.response[1]};
    const double factor = 1000 / (luminousEfficacy * integrate(seen)) / std::numbers::pi;
    const auto bands = project(grid, product);
    const auto xyz = respondXyz(s.observer, product);
    for (const ReferencePixel& pixel : pixels) {
        for (size_t b = 0; b < bands.size(); ++b)
            CHECK(pixel.bands[b] == Approx(factor * bands[b]).epsilon(1e-12));
        for (size_t c = 0; c < 3; ++c)
            CHECK(pixel.xyz[c] == Approx(factor * xyz[c]).epsilon(1e-12));
    }
}

TEST_CASE(
    "an image with the reference's samples differs from it by float arithmetic only, whatever it shows") {
    JudgedScene s(everything);
    RenderSettings settings;
    settings.samples = referenceSamples;
    const Certificate c = s.certificate(s.image(settings), 1);
    REQUIRE(c.pixels == c.population);
    CHECK(c.bands.p99.value < 2e-6);
    CHECK(c.bands.largest < 1e-3);  // a sample at an edge may fall to the other side
    CHECK(c.taken.empty());
}

TEST_CASE("the reference of a pixel is the same bits among all pixels, on all cores, and alone") {
    JudgedScene s(everything);
    const Reference reference(s.scene, {}, s.plan().wavelengths, s.observer, s.library, s.device);
    std::vector<PixelPlace> places;
    for (int y = 0; y < reference.height(); ++y)
        for (int x = 0; x < reference.width(); ++x)
            places.push_back({x, y});
    const std::vector<ReferencePixel> together = reference.at(places);
    REQUIRE(together.size() > 4096);  // several threads' worth
    for (size_t i = 0; i < places.size(); i += 641) {
        const ReferencePixel alone = reference.at(std::span(&places[i], 1)).front();
        CHECK(alone.xyz == together[i].xyz);
        CHECK(alone.bands == together[i].bands);
    }
}

TEST_CASE("with the samples of a pixel's area an edge is met within 0.1 %, and a certificate says it") {
    // A white wall whose edge, 37.5/256 of a pixel off the middle of the image, leans by a 7th of a pixel.
    JudgedScene s(R"(<scene version="1"><wavelengths from="500" to="600" step="50"/>
      <material name="m"><diffuse reflectance="constant:1"/></material>
      <node translate="0.5732421875 0 0" rotate="0 0 1 2.0454"><plane size="1 9" material="m"/></node>
      <light type="directional" direction="0 0 -1" spectrum="illuminants/E" illuminance="1000 lx"/>
      <camera name="c" type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="4x4"/></scene>)");
    const Reference reference(s.scene, {}, s.plan().wavelengths, s.observer, s.library, s.device);
    const std::vector<PixelPlace> row{{2, 2}, {3, 2}};
    const std::vector<ReferencePixel> area = reference.at(row, areaSamples);
    // The plane's left edge crosses pixel (2, 2), whose sides are half a metre long and whose left one is
    // x = 0, its middle y = −0.25: covered is what lies to the right of the edge there.
    const double angle = 2.0454 * std::numbers::pi / 180,
                 edge = 0.5732421875 - 0.5 / std::cos(angle) + 0.25 * std::tan(angle),
                 covered = 1 - edge / 0.5;
    REQUIRE(covered > 0.6);
    REQUIRE(covered < 0.95);
    CHECK(area[0].bands[1] / area[1].bands[1] == Approx(covered).margin(1e-3));

    RenderSettings one, most;
    one.samples = 1;
    most.samples = referenceSamples;
    const Certificate rough = s.certificate(s.image(one), 1), fine = s.certificate(s.image(most), 1);
    REQUIRE(rough.areaPixels == rough.population);
    CHECK(rough.areaBands.largest > 0.1);
    CHECK(fine.bands.largest < 1e-6);      // the reference has the same samples
    CHECK(fine.areaBands.largest > 1e-4);  // which leave this of the pixel
    CHECK(fine.areaBands.largest < 3.0 / 64);
}

TEST_CASE("a scene of one bad sample a pixel is told from one of many") {
    JudgedScene s(everything);
    RenderSettings coarse, fine;
    coarse.samples = 1;
    fine.samples = 32;
    CHECK(s.certificate(s.image(coarse), 1).colour.p99.value >
          3 * s.certificate(s.image(fine), 1).colour.p99.value);
}

TEST_CASE("an image's certificate contains the truth of all its pixels in at least 95 % of 200 trials") {
    JudgedScene s(everything);
    RenderSettings points;
    points.samples = 4;
    points.projection = Projection::point;
    const Cube cube = s.image(points);
    const Reference reference(s.scene, {}, cube.info.wavelengths, s.observer, s.library, s.device);
    PixelSample all(cube.info, 1, 1, s.observer, false);
    all.add(0, cube.info.height, cube.values.data());
    const White white = defaultWhite(s.scene, {}, s.observer, s.library, s.device, all.brightest());
    const std::vector<ReferencePixel> right = reference.at(all.places());
    std::vector<double> errors;
    for (size_t i = 0; i < right.size(); ++i)
        errors.push_back(deltaE00(lab(right[i].xyz, white.xyz), lab(all.xyzOf(i), white.xyz)));
    const Certificate truth = certify(all, reference, s.observer, white);
    REQUIRE(truth.pixels == truth.population);
    const Estimates whole = estimate(errors, errors.size(), certificateConfidence);
    CHECK(truth.colour.mean.value == Approx(whole.mean.value));
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        std::vector<double> some;
        for (std::uint64_t place : drawn(errors.size(), fewestPixels, seed))
            some.push_back(errors[place]);
        const Estimates e = estimate(some, errors.size(), certificateConfidence);
        const auto holds = [](const Estimate& interval, double value) {
            return interval.low.value_or(0) <= value && value <= interval.high.value_or(1e9);
        };
        held += holds(e.mean, whole.mean.value) && holds(e.p95, whole.p95.value) &&
                holds(e.p99, whole.p99.value) && e.largest <= whole.largest;
    }
    CHECK(held >= 190);
}

TEST_CASE("what cannot be judged is refused in one line that names it") {
    JudgedScene s(R"(<scene version="1"><node><plane/></node>
      <light type="ambient" spectrum="illuminants/D65" luminance="10 cd/m2"/>
      <camera name="round" type="cube" size="8x8"/><camera name="c" size="8x8" look-from="0 0 3"/>
      <pass name="paint" camera="c" as="reflectance"/></scene>)");
    RenderSettings cube, paint;
    cube.camera = "round";
    paint.pass = "paint";
    const Wavelengths grid = s.scene.wavelengths;
    CHECK_THROWS_WITH(Reference(s.scene, cube, grid, s.observer, s.library, s.device),
                      Catch::Contains("camera of type cube cannot be certified"));
    CHECK_THROWS_WITH(Reference(s.scene, paint, grid, s.observer, s.library, s.device),
                      Catch::Contains("as reflectance cannot be certified"));
}

TEST_CASE("the default white is no highlight: at most what a white diffuser would send back") {
    JudgedScene s(R"(<scene version="1">
      <material name="m"><diffuse reflectance="constant:0.5"/></material>
      <node><plane size="9 9" material="m"/></node>
      <light type="directional" direction="0 0 -1" spectrum="illuminants/A" illuminance="314.159265 lx"/>
      <camera name="c" type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="4x3"/></scene>)");
    CHECK(defaultWhite(s.scene, {}, s.observer, s.library, s.device, 1e6).xyz[1] ==
          Approx(100).epsilon(1e-5));
    CHECK(defaultWhite(s.scene, {}, s.observer, s.library, s.device, 50).xyz[1] == Approx(50));
    CHECK(defaultWhite(s.scene, {}, s.observer, s.library, s.device, 50).name == "illuminants/A");
}
