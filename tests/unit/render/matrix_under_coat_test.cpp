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
