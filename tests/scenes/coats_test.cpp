// Coats whose optics depend on the wavelength: white furnaces on any wavelengths, and colours that the bands
// have no part in.
#include "render/renderer.h"
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace spectrad;
using namespace spectrad::test;

namespace {

const std::string white = R"(<diffuse reflectance="constant:1"/>)";

/// A plane of one material, seen obliquely and square-on, in light of radiance 1 from everywhere.
Image inUniformLight(const std::string& lobes, const std::string& bands) {
    return imageOf(
        "<scene version=\"1\"><wavelengths>" + bands + "</wavelengths><material name=\"m\">" + lobes +
        "</material><plane size=\"100 100\" material=\"m\"/>"
        R"(<light type="ambient" spectrum="constant:1" scale="1"/>)"
        R"(<camera type="perspective" fov="60" look-from="0 0 3" look-at="1.5 0 0" size="8x8"/></scene>)");
}

/// The largest difference of the colours that a viewer shows, as a share.
double colourApart(const Image& a, const Image& right) {
    double worst = 0;
    for (size_t i = 0; i < a.preview.size(); ++i)
        worst = std::max<double>(worst, std::abs(a.preview[i] / right.preview[i] - 1));
    return worst;
}

/// Schott's BK7.
const std::string bk7 = "sellmeier:1.03961212,0.00600069867,0.231792344,0.0200179144,1.01046945,103.560653";

}  // namespace

TEST_CASE("a single band reaches to both sides of its wavelength, and so do the coats that it sees") {
    if (!haveDevice()) return;
    for (const auto& [coat, bands] :
         {std::pair<std::string, std::string>{
              R"(<specular reflectance="545:0.9 550:0.1 555:0.05" roughness="0.5"/>)", "550"},
          {R"(<specular reflectance="589:0.95 590:0.05"/>)", "590"},
          {R"(<gloss ior="545:1.9 550:1.2 555:1.1" roughness="0.5"/>)", "550"}}) {
        const Image image = inUniformLight(white + coat, bands);
        CAPTURE(coat, bands);
        const auto [least, most] = std::minmax_element(image.values.begin(), image.values.end());
        CHECK(*most <= 1 + 2e-4f);
        CHECK(*least >= 1 - 2e-4f);
    }
}

TEST_CASE("a white base under a coat looks white, whatever the bands of the cube are") {
    if (!haveDevice()) return;
    const Image bare = inUniformLight(white, "380 780");
    for (const std::string& coat :
         {"<gloss ior=\"" + bk7 + "\"/>", "<gloss ior=\"" + bk7 + "\" roughness=\"0.4\"/>",
          std::string(R"(<gloss ior="cauchy:1.6,0.02"/>)"),
          std::string(R"(<specular reflectance="400:0.03 700:0.97" roughness="0.3"/>)")})
        for (const std::string bands : {"550", "632 633", "405 406", "700 701 702", "1500 1600"}) {
            CAPTURE(coat, bands);
            CHECK(colourApart(inUniformLight(white + coat, bands), bare) < 5e-4);
        }
}

TEST_CASE("a metal has one colour, whatever the bands of the cube are") {
    if (!haveDevice()) return;
    for (const std::string metal : {"Au", "Cu"}) {
        const std::string lobes = "<conductor ior=\"metals/" + metal + "\" roughness=\"0.3\"/>";
        const Image all = inUniformLight(lobes, "380 480 580 680 780");
        for (const std::string bands : {"550", "632 633", "700 701 702", "1500 1600"}) {
            CAPTURE(metal, bands);
            CHECK(colourApart(inUniformLight(lobes, bands), all) < 1e-4);
        }
    }
}

TEST_CASE("a glass for the infrared whose formula has a pole in the visible keeps its bands") {
    if (!haveDevice()) return;
    // Germanium's pole lies at 664 nm (Icenogle, Platt & Wolfe 1976); its bands are 8 to 12 µm.
    const Image image = inUniformLight(
        white + R"(<gloss ior="sellmeier:8.28156,0,6.72880,0.44105,0.21307,3870.1"/>)", "8000 10000 12000");
    for (const float value : image.values)
        CHECK(value == Approx(1).epsilon(2e-4));
}
