// Grids of bands: how they are written, what each band's weight is, what is refused and in which words.
#include "spectrum/wavelengths.h"

#include <catch2/catch.hpp>

#include <string>

using namespace spectrad;

namespace {

Wavelengths grid(std::vector<double> nm, Projection projection, double step = 5) {
    return {std::move(nm), projection, step};
}

}  // namespace

TEST_CASE("from:to:step reaches the end in spite of binary fractions") {
    const Wavelengths visible = parseWavelengths("380:780:5", {});
    REQUIRE(visible.size() == 81);
    CHECK(visible.nm.front() == 380);
    CHECK(visible.nm.back() == 780);
    CHECK(visible.projection == Projection::slit);
    CHECK(visible.step == 5);

    const Wavelengths tenths = parseWavelengths(" 400 : 700 : 0.1 ", {});
    REQUIRE(tenths.size() == 3001);
    CHECK(tenths.nm.back() == 700);

    const Wavelengths uneven = parseWavelengths("380:780:7", {});
    CHECK(uneven.nm.back() == 779);
}

TEST_CASE("Lists are separated by commas, blanks or both, and one wavelength is a grid") {
    CHECK(parseWavelengths("400,405.2,410", {}).nm == std::vector<double>{400, 405.2, 410});
    CHECK(parseWavelengths("\n 400 405.2\t410\n", {}).nm == std::vector<double>{400, 405.2, 410});
    CHECK(parseWavelengths("400, 405.2, 410", {}).nm == std::vector<double>{400, 405.2, 410});
    CHECK(parseWavelengths("632.8", {}).nm == std::vector<double>{632.8});
    CHECK(parseWavelengths("550:550:10", {}).step == 10);
}

TEST_CASE("Grids from 1 nm to 1 mm and up to 10 000 bands are taken") {
    CHECK(parseWavelengths("1,1000000", {}).size() == 2);
    CHECK(regularWavelengths(100, 10'099, 1, {}).size() == 10'000);
}

TEST_CASE("A grid that cannot be is refused with the place, the number and what is allowed") {
    const SourceLocation at{"scene.xml", 2, 16};
    const std::string forms = "(allowed: from:to:step, as in 380:780:5, or a list, as in 400,405.2,410)";
    CHECK_THROWS_WITH(parseWavelengths("", at), "scene.xml:2:16: no wavelengths " + forms);
    CHECK_THROWS_WITH(parseWavelengths("380:780", at), "scene.xml:2:16: wavelengths '380:780' " + forms);
    CHECK_THROWS_WITH(parseWavelengths("380:x:5", at),
                      "scene.xml:2:16: 'x' is not a wavelength in nm " + forms);
    CHECK_THROWS_WITH(parseWavelengths("400,,410", at),
                      "scene.xml:2:16: a wavelength is missing between commas " + forms);
    CHECK_THROWS_WITH(parseWavelengths("400,nan", at),
                      "scene.xml:2:16: 'nan' is not a wavelength in nm " + forms);
    CHECK_THROWS_WITH(parseWavelengths("410,400", at),
                      "scene.xml:2:16: wavelengths must ascend, but 400 nm follows 410 nm");
    CHECK_THROWS_WITH(parseWavelengths("400,400", at),
                      "scene.xml:2:16: wavelengths must ascend, but 400 nm follows 400 nm");
    CHECK_THROWS_WITH(parseWavelengths("-400,400", at),
                      "scene.xml:2:16: wavelength -400 nm (allowed: 1 … 1000000 nm)");
    CHECK_THROWS_WITH(parseWavelengths("780:380:5", at),
                      "scene.xml:2:16: wavelengths must ascend, but they go from 780 nm to 380 nm");
    CHECK_THROWS_WITH(parseWavelengths("380:780:0", at),
                      "scene.xml:2:16: step 0 nm (allowed: a number above 0)");
    CHECK_THROWS_WITH(parseWavelengths("380:780:0.01", at),
                      "scene.xml:2:16: 40001 wavelengths, more than the limit of 10000");
    CHECK_THROWS_AS(parseWavelengths("380:780:1e-300", at), InputError);
    CHECK_THROWS_WITH(
        parseProjection("slitt", at),
        "scene.xml:2:16: unknown projection 'slitt' (did you mean 'slit'?) (allowed: slit, box, point)");
}

TEST_CASE("Projections keep their names") {
    for (Projection p : {Projection::slit, Projection::box, Projection::point})
        CHECK(parseProjection(name(p), {}) == p);
}

TEST_CASE("Hats reach to their neighbours and are one-sided at both ends") {
    const Wavelengths g = grid({400, 410, 440}, Projection::slit);
    CHECK(band(g, 0).area() == 5);
    CHECK(band(g, 1).area() == 20);
    CHECK(band(g, 2).area() == 15);
    CHECK(band(g, 0).weight(399.9) == 0);
    CHECK(band(g, 0).weight(400) == 1);
    CHECK(band(g, 1).weight(405) == 0.5);
    CHECK(band(g, 1).weight(425) == 0.5);
    CHECK(band(g, 2).weight(440) == 1);
    CHECK(band(g, 2).weight(440.1) == 0);
    for (double nm : {400.0, 403.3, 410.0, 438.9, 440.0})
        CHECK(band(g, 0).weight(nm) + band(g, 1).weight(nm) + band(g, 2).weight(nm) ==
              Approx(1).margin(1e-15));
}

TEST_CASE("Boxes end half-way and leave no gap, whatever the rounding") {
    const Wavelengths g = grid({400, 410.1, 440.7}, Projection::box);
    CHECK(band(g, 0).from == 400);
    CHECK(band(g, 0).to == band(g, 1).from);
    CHECK(band(g, 1).to == band(g, 2).from);
    CHECK(band(g, 2).to == 440.7);
    CHECK(band(g, 1).weight(406) == 1);
    CHECK(band(g, 0).area() + band(g, 1).area() + band(g, 2).area() == Approx(40.7).epsilon(1e-15));
}

TEST_CASE("A single wavelength has a hat of half-width step, a box one step wide, a point of no width") {
    const Band hat = band(grid({550}, Projection::slit, 10), 0);
    CHECK(hat.from == 540);
    CHECK(hat.to == 560);
    CHECK(hat.area() == 10);
    CHECK(hat.weight(545) == 0.5);
    CHECK(band(grid({550}, Projection::box, 10), 0).area() == 10);
    CHECK(band(grid({550}, Projection::point, 10), 0).area() == 0);
    CHECK(band(grid({2}, Projection::slit, 10), 0).from == 0);
}

TEST_CASE("Band names get as many decimals as tell them apart, six at least") {
    CHECK(decimalsToTellApart(grid({400, 410}, Projection::slit)) == 6);
    CHECK(decimalsToTellApart(grid({400, 400.00000001, 410}, Projection::slit)) == 8);
}
