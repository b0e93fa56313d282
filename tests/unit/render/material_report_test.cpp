// What `info` says of materials, against figures worked out by hand.
#include "render/material_report.h"

#include "scene/load.h"
#include "spectrum/library.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;

namespace {

const Library& library() {
    static const Library opened = Library::open();
    return opened;
}

/// Reports of the materials in `text`; `lights` are the scene's.
std::vector<MaterialReport> reports(const TemporaryFolder& folder, const std::string& text,
                                    const std::string& lights) {
    Notes notes;
    const auto file =
        folder.write("s.xml", "<scene version=\"1\"><wavelengths from=\"400\" to=\"700\" step=\"10\"/>" +
                                  text + lights + "<sphere material=\"m\"/><camera size=\"8x8\"/></scene>");
    const Scene scene = loadScene(file, library(), {}, notes);
    std::vector<MaterialReport> named;
    for (MaterialReport& report : reportMaterials(scene, scene.wavelengths, library()))
        if (report.name == "m") named.push_back(std::move(report));
    return named;
}

const std::string white = R"(<light type="ambient" spectrum="constant:1" scale="1"/>)";

}  // namespace

TEST_CASE("a dye's peaks, Stokes shift, yield and total radiance factor are those of its curves") {
    const TemporaryFolder folder;
    const auto m = reports(folder,
                           R"(<material name="m"><diffuse reflectance="constant:0.5"/>
        <fluorescence excitation="gaussian:450,20" emission="549.999:0 550:1 560:1 560.001:0" yield="0.8"/></material>)",
                           white)
                       .at(0);
    REQUIRE(m.fluorescence.size() == 1);
    const FluorophoreFigures& f = m.fluorescence.front();
    CHECK(f.excitationPeak.value() == Approx(450).margin(1e-9));
    CHECK(f.emissionPeak.value() == 550);
    CHECK(f.stokesShift().value() == Approx(100));
    CHECK(f.yield == Approx(0.8).epsilon(1e-9));
    CHECK_FALSE(f.matrix);
    // ∫ x(λ) λ dλ of a Gaussian is 450 × its area, half of which the base leaves; a box of 10 nm at 555 nm
    // sends it out, and the hats of the bands at its ends average half of it.
    const double area = 20 * std::sqrt(3.14159265358979324 / (4 * std::log(2.0)));
    const double radiance = 0.8 * 0.5 * 450 * area / (555 * 10);  // π L per nm where it emits
    REQUIRE(m.peaks.size() == 1);
    CHECK(m.peaks[0].light == "constant:1");
    CHECK((m.peaks[0].nm == 550 || m.peaks[0].nm == 560));
    CHECK(m.peaks[0].value == Approx(0.5 + radiance / 2).epsilon(2e-4));
}

TEST_CASE("a fluorophore that takes part of what the base leaves has that part of its yield") {
    const TemporaryFolder folder;
    const auto m = reports(folder,
                           R"(<material name="m"><diffuse reflectance="constant:0.5"/>
        <fluorescence excitation="gaussian:450,20" emission="550:1 560:1" yield="0.8" strength="0.1"/></material>)",
                           white)
                       .at(0);
    CHECK(m.fluorescence.at(0).yield == Approx(0.08).epsilon(1e-9));
}

TEST_CASE("where emission and excitation overlap, the yield counts what leaves above the excitation only") {
    const TemporaryFolder folder;
    const auto m = reports(folder,
                           R"(<material name="m"><diffuse reflectance="constant:0.5"/>
        <fluorescence excitation="490:0 500:1 510:0" emission="400:1 600:1" yield="1"/></material>)",
                           white)
                       .at(0);
    // Photons of equal energy per nm between 500 and 600 of those between 400 and 600.
    CHECK(m.fluorescence.at(0).yield ==
          Approx((600.0 * 600 - 500 * 500) / (600.0 * 600 - 400 * 400)).epsilon(1e-9));
}

TEST_CASE("a matrix's report says what was zeroed and clipped, and how its columns fare with energy") {
    const TemporaryFolder folder;
    // Rows 400, 420, 440; columns 400 and 420. In the first 0.2 and 0.1 are emitted; trapezoids of 20 nm over
    // bands of 20 nm.
    folder.write("m.csv", "emission_nm,ex400,ex420\n400,0.5,0.01\n420,0.2,-0.1\n440,0.1,1.9\n");
    const auto m =
        reports(folder, R"(<material name="m"><fluorescence matrix="m.csv"/></material>)", white).at(0);
    const FluorophoreFigures& f = m.fluorescence.at(0);
    REQUIRE(f.matrix);
    CHECK(f.matrix->zeroed == 1);
    CHECK(f.matrix->zeroedMost == 0.01);
    CHECK(f.matrix->clipped == 1);
    CHECK(f.matrix->columns == 2);
    CHECK(f.matrix->tooMuch == 0);
    CHECK(f.matrix->mostEnergy == Approx(0.95));  // 1.9 × 10 nm of 20
    CHECK(f.matrix->mostPhotons == Approx(0.95 * 440 / 420));
    CHECK(f.excitationPeak == 420);
    CHECK(f.emissionPeak == 440);
    CHECK(f.stokesShift() == 20);
    CHECK(f.yield == Approx(0.95 * 440 / 420));  // its diagonal, below zero, reflects nothing

    folder.write("loud.csv", "emission_nm,ex400,ex420\n400,0.5,0\n420,1,0.6\n440,0.1,0.3\n");
    const auto loud =
        reports(folder, R"(<material name="m"><fluorescence matrix="loud.csv"/></material>)", white).at(0);
    CHECK(loud.fluorescence.at(0).matrix->tooMuch == 1);
    CHECK(loud.fluorescence.at(0).matrix->mostEnergy == Approx(0.5 + (0.5 * 20 + 0.55 * 20) / 20));
}

TEST_CASE("metals and coats report their terms and errors, and what white light does on them") {
    const TemporaryFolder folder;
    const auto of = [&](const std::string& lobes) {
        return reports(folder, "<material name=\"m\">" + lobes + "</material>", white).at(0);
    };
    const auto gold = of(R"(<conductor ior="metals/Au" roughness="0.5"/>)");
    REQUIRE(gold.fresnel);
    CHECK(gold.fresnel->terms >= 3);
    CHECK(gold.fresnel->error <= 1e-6);
    CHECK(gold.terms == gold.fresnel->terms + 1);  // and light that bounces between facets
    REQUIRE(gold.furnace);
    CHECK(gold.furnace->most <= 1);
    CHECK(gold.furnace->bouncing > 0.05);

    const auto schlick = of(R"(<conductor ior="metals/Al" fresnel="schlick"/>)");
    CHECK(schlick.fresnel->model == FresnelFigures::Model::schlick);
    CHECK(schlick.fresnel->error > 0.01);
    CHECK(schlick.furnace->bouncing == 0);  // a mirror

    const auto glass = of(
        R"(<diffuse reflectance="constant:1"/><gloss ior="sellmeier:1.03961212,0.00600069867,0.231792344,0.0200179144,1.01046945,103.560653" roughness="0.4"/>)");
    CHECK(glass.fresnel->terms == 4);
    CHECK(glass.fresnel->error > 0);
    CHECK(glass.fresnel->error <= 1e-6);
    CHECK(glass.furnace->least == Approx(1).margin(1e-5));
    CHECK(glass.furnace->most == Approx(1).margin(1e-5));

    const auto plain = of(R"(<diffuse reflectance="constant:0.25"/>)");
    CHECK_FALSE(plain.fresnel);
    CHECK(plain.furnace->least == Approx(0.25).epsilon(1e-6));
    CHECK(plain.furnace->most == Approx(0.25).epsilon(1e-6));
}
