// Donaldson matrices below a coat, between their rows.
#include "render/fluorescence.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace spectrad;

TEST_CASE("under a coat a matrix keeps its lines between rows, and the coat the base's shape there") {
    const TemporaryFolder folder;
    Fluorescence f;
    f.matrixFile = folder.write("m.csv", "emission_nm,ex400,ex420\n420,0.2,0\n480,0.1,0\n").string();
    f.diagonalNone = true;
    Notes notes;
    const double r = 0.6;
    const auto rho = [](double nm) { return 0.9 - 0.8 * (nm - 400) / 100; };
    Material material;
    material.diffuse.emplace().reflectance.emplace().curves = {
        Curve::table({400, 500}, {rho(400), rho(500)}, Outside::hold)};
    material.fluorescence = {f};
    const FluorescentBase base(material, r, notes);
    // A line of power 3 in the first band.
    const Curve out = base.reradiation(Curve::line(400, 3)).front();
    const double width = base.bispectral().front().width(0), irradiance = 3 / width / (1 - rho(400) * r);
    for (const double nm : {420.0, 437.0, 450.0, 479.0, 480.0}) {
        CAPTURE(nm);
        const double row = 0.2 - 0.1 * (nm - 420) / 60;
        CHECK(out.at(nm) == Approx((1 - r) / (1 - rho(nm) * r) * row * irradiance).epsilon(1e-12));
    }
    CHECK(out.at(481) == 0);
}

TEST_CASE(
    "light comes in by the coat's figures where it excites, and gets out by those where it is emitted") {
    const TemporaryFolder folder;
    Fluorescence matrix;
    matrix.matrixFile = folder.write("m.csv", "emission_nm,ex400,ex420\n420,0.2,0\n480,0.1,0\n").string();
    matrix.diagonalNone = true;
    const auto spectrum = [](Curve curve) {
        Spectrum s;
        s.curves = {std::move(curve)};
        return s;
    };
    Fluorescence dye;
    dye.excitation = spectrum(Curve::table({390, 410}, {1, 1}));
    dye.emission = spectrum(Curve::table({420, 480}, {1, 1}));
    const auto rho = [](double nm) { return 0.9 - 0.8 * (nm - 400) / 100; };
    Material material;
    material.diffuse.emplace().reflectance.emplace().curves = {
        Curve::table({400, 500}, {rho(400), rho(500)}, Outside::hold)};
    material.fluorescence = {matrix, dye};
    const double in = 0.7, out = 0.3, share = 0.25;
    const Curve weight = Curve::table({390, 410, 411, 500}, {share, share, 9, 9}, Outside::hold);
    Notes notes;
    const FluorescentBase base(material, out, notes, Entry{in, &weight});
    const std::vector<Curve> glow = base.reradiation(Curve::line(400, 3));  // separable ones come first
    const double width = base.bispectral().front().width(0);
    for (const double nm : {425.0, 450.0, 479.0}) {
        CAPTURE(nm);
        const double up = (1 - out) / (1 - rho(nm) * out), light = 3 * share / (1 - rho(400) * in);
        CHECK(glow.at(0).at(nm) == Approx(up * light * (1 - rho(400)) * 400 / (60.0 * 450))
                                       .epsilon(1e-12));  // ∫ λ dλ of the emission
        CHECK(glow.at(1).at(nm) == Approx(up * light / width * (0.2 - 0.1 * (nm - 420) / 60)).epsilon(1e-12));
    }
}
