// Mirrors (roughness 0): they show uniform light from everywhere, and nothing of lamps that have no size.
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>

using namespace spectrad;
using namespace spectrad::test;

namespace {

const std::string ambient = R"(<light type="ambient" spectrum="constant:1" scale="3"/>)";
const std::string background = R"(<background spectrum="constant:1" scale="2"/>)";
const std::string lamps =
    R"(<light type="point" position="0 0 4" spectrum="constant:1" scale="50"/>)"
    R"(<light type="directional" direction="0 0 -1" spectrum="constant:1" scale="50"/>)"
    R"(<light type="spot" position="0 0 4" target="0 0 0" angle="60" spectrum="constant:1" scale="50"/>)";

/// The middle pixel of a plane seen square-on.
double seen(const std::string& lobes, const std::string& lights) {
    const Image image = imageOf(
        "<scene version=\"1\"><wavelengths>550</wavelengths><material name=\"m\">" + lobes +
        "</material><plane material=\"m\"/>" + lights +
        R"(<camera type="orthographic" height="0.5" look-from="0 0 5" look-at="0 0 0" size="9x9"/></scene>)");
    return image.at(4, 4);
}
Plan plan(const std::string& lobes, const std::string& lights) {
    return planOf(sceneFrom("<scene version=\"1\"><material name=\"m\">" + lobes +
                            "</material><plane material=\"m\"/>" + lights +
                            "<camera size=\"8x8\"/></scene>"));
}

const std::string half = "<specular reflectance=\"constant:0.5\"/>";
const std::string glass = "<diffuse reflectance=\"constant:0\"/><gloss ior=\"1.5\"/>";

}  // namespace

TEST_CASE("a mirror shows the ambient light, else the background, and no lamp that has no size") {
    if (!haveDevice()) return;
    CHECK(seen(half, ambient) == Approx(0.5 * 3).epsilon(1e-6));
    CHECK(seen(half, background) == Approx(0.5 * 2).epsilon(1e-6));
    CHECK(seen(half, ambient + background) == Approx(0.5 * 3).epsilon(1e-6));
    CHECK(seen(half, lamps) == 0);
    CHECK(seen(half, lamps + background) == Approx(0.5 * 2).epsilon(1e-6));
    CHECK(seen(glass, background) == Approx(0.04 * 2).epsilon(1e-5));
    CHECK(seen(glass, ambient) == Approx(0.04 * 3).epsilon(1e-5));
}

TEST_CASE("what is not quite a mirror does not see the background, which lights nothing") {
    if (!haveDevice()) return;
    CHECK(seen("<specular reflectance=\"constant:0.5\" roughness=\"0.01\"/>", lamps + background) > 0);
    CHECK(seen("<specular reflectance=\"constant:0.5\" roughness=\"0.01\"/>", background) == 0);
    CHECK(seen("<diffuse reflectance=\"constant:0.5\"/>", background) == 0);
}

TEST_CASE("only a scene with a mirror has the background among its lights") {
    const auto uniform = [](const Plan& p) {
        return std::find(p.defines.begin(), p.defines.end(), "HAS_UNIFORM") != p.defines.end();
    };
    CHECK(uniform(plan(half, background)));
    CHECK_FALSE(uniform(plan("<diffuse reflectance=\"constant:0.5\"/>", lamps + background)));
    CHECK_FALSE(uniform(plan("<conductor ior=\"metals/Au\" roughness=\"0.2\"/>", lamps + background)));
}

TEST_CASE("two roughnesses that are equal are one: the same plan, and no code for azimuths") {
    const Plan one = plan("<conductor ior=\"metals/Au\" roughness=\"0.3\"/>", lamps),
               two = plan("<conductor ior=\"metals/Au\" roughness=\"0.3 0.3\"/>", lamps),
               brushed = plan("<conductor ior=\"metals/Au\" roughness=\"0.3 0.2\"/>", lamps);
    CHECK(one.defines == two.defines);
    CHECK(one.world.tables.size() == two.world.tables.size());
    CHECK(one.world.tangent.empty());
    const auto azimuths = std::find(brushed.defines.begin(), brushed.defines.end(), "HAS_ANISOTROPY");
    CHECK(azimuths != brushed.defines.end());
    CHECK_FALSE(brushed.world.tangent.empty());
}

TEST_CASE("a brushed metal turned by a quarter is the metal brushed the other way") {
    if (!haveDevice()) return;
    const auto picture = [](const std::string& roughness, const std::string& turn) {
        return imageOf(
            "<scene version=\"1\"><wavelengths>550</wavelengths><material name=\"m\"><conductor "
            "ior=\"metals/Al\" roughness=\"" +
            roughness + "\"/></material><node rotate=\"0 0 1 " + turn +
            "\"><plane size=\"3 3\" material=\"m\"/></node>"
            R"(<light type="point" position="0.7 0.4 1" spectrum="constant:1" scale="1"/>
<camera fov="40" look-from="-0.4 0.3 3" look-at="0 0 0" size="24x16"/></scene>)");
    };
    const Image a = picture("0.6 0.2", "0"), b = picture("0.2 0.6", "90"), c = picture("0.2 0.6", "0");
    double apart = 0;
    for (size_t i = 0; i < a.values.size(); ++i) {
        CHECK(a.values[i] == Approx(b.values[i]).epsilon(1e-4));
        apart = std::max(apart, std::abs(double{a.values[i]} - double{c.values[i]}) / double{a.values[i]});
    }
    CHECK(apart > 0.5);
}
