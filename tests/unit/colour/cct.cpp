// Correlated colour temperature and Duv.
#include "colour/cct.h"

#include <catch2/catch.hpp>

using namespace spectrad;

namespace {

const PlanckianLocus& locus() {
    static const PlanckianLocus shared(standardObserver(Library::open()));
    return shared;
}

struct Reference {
    const char* name;
    double x, y, kelvin, duv;
};

// colour-science 0.4.7, uv_to_CCT_Ohno2013 with spacing 1.0005 (Ohno 2014), chromaticities of CIE 015:2018
// and others. It takes c2 = 1.4388e-2 m K (ITS-90), we CODATA 2018's: the same chromaticity is a body colder
// by their ratio.
constexpr double c2Ratio = 1.438776877e-2 / 1.4388e-2;
constexpr Reference references[] = {
    {"A", 0.44758, 0.40745, 2855.5277562, 0.0000033758},
    {"C", 0.31006, 0.31616, 6774.1538114, -0.0021515097},
    {"D50", 0.34567, 0.35851, 5001.8618318, 0.0032101493},
    {"D65", 0.31272, 0.32903, 6503.0338166, 0.0032124998},
    {"FL2", 0.37208, 0.37529, 4225.2605016, 0.0018643192},
    {"FL11", 0.38052, 0.37713, 4000.7056162, 0.0001560414},
    {"LED-B1", 0.4560, 0.4078, 2732.7987591, -0.0007082831},
    {"HP1", 0.533, 0.415, 1959.5329180, 0.0007953655},
    {"far above", 0.35, 0.40, 4983.4386755, 0.0206185651},
    {"blue sky", 0.26, 0.27, 15345.3024016, 0.0039557303},
    {"E", 1.0 / 3, 1.0 / 3, 5455.4863446, -0.0044233247},
};

}  // namespace

TEST_CASE("Temperature and Duv of CIE illuminants are those of Ohno's method") {
    for (const Reference& reference : references) {
        CAPTURE(reference.name);
        const auto cct = locus().nearest(xyzFromChromaticity({reference.x, reference.y}, 100));
        REQUIRE(cct);
        CHECK(cct->kelvin == Approx(reference.kelvin * c2Ratio).epsilon(1.5e-5));
        CHECK(cct->duv == Approx(reference.duv).margin(1e-6));
    }
}

TEST_CASE("A black body has its own temperature and no Duv, from red heat to beyond the bluest sky") {
    const Detector observer = standardObserver(Library::open());
    for (const double kelvin :
         {801.0, 1000.0, 1850.0, 2856.0, 4000.0, 6504.0, 10000.0, 25000.0, 100000.0, 900000.0}) {
        CAPTURE(kelvin);
        const Curve body = Curve::blackbody(kelvin);
        const std::array<const Curve*, 1> light{&body};
        const auto cct = locus().nearest(respondXyz(observer, light));
        REQUIRE(cct);
        CHECK(cct->kelvin == Approx(kelvin).epsilon(1e-7));
        CHECK(cct->duv == Approx(0).margin(1e-9));
    }
}

TEST_CASE("Going off the locus at right angles leaves the temperature and gives the distance with its sign") {
    for (const double kelvin : {1500.0, 2856.0, 5000.0, 6504.0, 12000.0})
        for (const double duv : {-0.03, -0.003, 0.003, 0.03}) {
            CAPTURE(kelvin, duv);
            const auto here = locus().at(kelvin), hotter = locus().at(kelvin * 1.0001);
            const double du = here[0] - hotter[0], dv = here[1] - hotter[1], length = std::hypot(du, dv);
            const double u = here[0] - duv * dv / length, v = here[1] + duv * du / length;
            const auto cct = locus().nearest(
                xyzFromChromaticity({3 * u / (2 * u - 8 * v + 4), 2 * v / (2 * u - 8 * v + 4)}, 1e-6));
            REQUIRE(cct);
            CHECK(cct->kelvin == Approx(kelvin).epsilon(2e-4));
            CHECK(cct->duv == Approx(duv).margin(1e-7));
        }
}

TEST_CASE("Black, saturated colours and what no black body reaches have no colour temperature") {
    CHECK_FALSE(locus().nearest({0, 0, 0}));
    CHECK_FALSE(locus().nearest(xyzFromChromaticity({0.17, 0.70})));    // green
    CHECK_FALSE(locus().nearest(xyzFromChromaticity({0.15, 0.06})));    // blue
    CHECK_FALSE(locus().nearest(xyzFromChromaticity({0.715, 0.284})));  // 633 nm
    CHECK_FALSE(locus().nearest(xyzFromChromaticity({0.235, 0.225})));  // bluer than an infinite temperature
}

TEST_CASE("A detector without X, Y, Z has no Planckian locus") {
    Detector camera;
    camera.name = "camera";
    camera.channels = {"R", "G", "B"};
    camera.response = {Curve::gaussian(600, 50), Curve::gaussian(550, 50), Curve::gaussian(450, 50)};
    CHECK_THROWS_AS(PlanckianLocus(camera), InputError);
}
