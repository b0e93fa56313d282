// Formulae against their closed forms and published tables.
#include "base/error.h"
#include "spectrum/curve.h"
#include "spectrum/dispersion.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace spectrad;

namespace {

double integral(const Curve& curve) {
    const Curve* factor = &curve;
    return integrate({&factor, 1});
}
double integral(const Curve& curve, double from, double to) {
    const Curve* factor = &curve;
    return integrate({&factor, 1}, from, to);
}

constexpr double stefanBoltzmann = 5.670374419e-8;  // W·m⁻²·K⁻⁴, CODATA 2018

}  // namespace

TEST_CASE("A Gaussian has peak 1, half of it at half its width, and its closed-form integral") {
    const Curve g = Curve::gaussian(520, 40);
    CHECK(g.at(520) == 1);
    CHECK(g.at(500) == Approx(0.5).epsilon(1e-14));
    for (double fwhm : {1e-5, 0.01, 1.0, 40.0, 200.0}) {
        const double expected = fwhm * std::sqrt(std::numbers::pi / std::numbers::ln2) / 2;
        CHECK(integral(Curve::gaussian(1520, fwhm)) == Approx(expected).epsilon(2e-12));
    }
}

TEST_CASE("A Gaussian's band integrals agree with the error function") {
    const double sigma = 40 / (2 * std::sqrt(2 * std::numbers::ln2));
    const auto below = [&](double nm) {
        return sigma * std::sqrt(std::numbers::pi / 2) * std::erf((nm - 520) / sigma / std::sqrt(2.0));
    };
    CHECK(integral(Curve::gaussian(520, 40), 505.3, 531.7) ==
          Approx(below(531.7) - below(505.3)).epsilon(1e-12));
    CHECK(integral(Curve::gaussian(520, 40), 380, 520) == Approx(below(520) - below(380)).epsilon(1e-12));
}

TEST_CASE("There is no light at or below zero wavelength") {
    CHECK(Curve::gaussian(5, 100).at(-1) == 0);
    CHECK(Curve::blackbody(3000).at(0) == 0);
    CHECK(Curve::blackbody(3000).at(-5) == 0);
    CHECK(Curve::gaussian(5, 100).range()->first == 0);
}

TEST_CASE("A blackbody radiates sigma T^4 / pi") {
    for (double kelvin : {20.0, 300.0, 2856.0, 6500.0, 1e5, 1e7})
        CHECK(integral(Curve::blackbody(kelvin)) ==
              Approx(stefanBoltzmann * std::pow(kelvin, 4) / std::numbers::pi).epsilon(1e-9));
}

TEST_CASE("A blackbody peaks at Wien's wavelength") {
    const Curve b = Curve::blackbody(2856);
    const double peak = 2.897771955e6 / 2856;
    CHECK(b.at(peak) > b.at(peak * 1.0001));
    CHECK(b.at(peak) > b.at(peak * 0.9999));
    CHECK_FALSE(b.range());
}

TEST_CASE("Planck's law holds from the far ultraviolet tail to a millimetre") {
    const double c1 = 1.191042972397188e-16, c2 = 1.438776877503933e-2;
    const Curve b = Curve::blackbody(2856);
    // Rayleigh–Jeans, to the second order of x = c₂/λT
    const double far = 1e-3, x = c2 / (far * 2856);
    CHECK(b.at(1e6) == Approx(c1 * 1e-9 / std::pow(far, 5) / x * (1 - x / 2)).epsilon(1e-5));
    // Wien
    CHECK(b.at(100) == Approx(c1 * 1e-9 / 1e-35 * std::exp(-c2 / (1e-7 * 2856))).epsilon(1e-12));
    CHECK(b.at(1) == 0);
    CHECK(std::isfinite(b.at(1e-300)));
    // CIE 015: illuminant A is 100 at 560 nm with c₂ of 1931 at 2848 K; with today's c₂ that is 2855.5 K.
    const Curve a = Curve::blackbody(2848 * 1.438776877503933 / 1.435);
    CHECK(100 * a.at(780) / a.at(560) == Approx(241.675).epsilon(1e-5));
    CHECK(100 * a.at(300) / a.at(560) == Approx(0.930483).epsilon(1e-5));
}

TEST_CASE("A blackbody's integral in a steep tail is as good as at its peak") {
    // ∫ from 0 to λ = c₁ (T/c₂)⁴ Σ e^{-kx} (x³/k + 3x²/k² + 6x/k³ + 6/k⁴)
    const double kelvin = 2000, nm = 300, c1 = 1.191042972397188e-16, c2 = 1.438776877503933e-2;
    const double x = c2 / (nm * 1e-9 * kelvin);
    double series = 0;
    for (int k = 1; k < 20; ++k)
        series += std::exp(-k * x) *
                  (x * x * x / k + 3 * x * x / (k * k) + 6 * x / std::pow(k, 3) + 6 / std::pow(k, 4));
    CHECK(integral(Curve::blackbody(kelvin), 1, nm) ==
          Approx(c1 * std::pow(kelvin / c2, 4) * series).epsilon(1e-11));
}

TEST_CASE("Any formula is cut to its range and zero or held beyond it") {
    const auto none = [](double, double, std::vector<double>&) {};
    const Curve f = Curve::formula([](double nm) { return nm; }, none, std::pair{400.0, 500.0});
    CHECK(f.at(450) == 450);
    CHECK(f.at(399) == 0);
    CHECK(f.withOutside(Outside::hold).at(399) == 400);
    CHECK(integral(f, 0, 1000) == Approx(45'000).epsilon(1e-14));
    CHECK(integral(f) == Approx(45'000).epsilon(1e-14));
}

TEST_CASE("Daylight is the CIE's D65 to its last printed digit, at the temperature that the CIE takes") {
    // CIE 015:2018, table 5 (every 50 nm)
    const std::vector<std::pair<double, double>> d65{
        {300, 0.0341},  {350, 44.9117}, {400, 82.7549}, {450, 117.008}, {500, 109.354}, {550, 104.046},
        {600, 90.0062}, {650, 80.0268}, {700, 71.6091}, {750, 63.5927}, {800, 59.4519}, {830, 60.3125}};
    // 6500 K with the c₂ of 1931; half a kelvin more changes the rounded weights by 0.001.
    const Curve noon = Curve::daylight(6500 * 1.4388 / 1.4380), nominal = Curve::daylight(6504);
    for (const auto& [nm, value] : d65) {
        CAPTURE(nm);
        CHECK(noon.at(nm) == Approx(value).epsilon(6e-6).margin(6e-5));
        CHECK(nominal.at(nm) == Approx(value).epsilon(1e-3));
    }
    CHECK(noon.at(560) == 100);
    CHECK(noon.range() == std::pair{300.0, 830.0});
}

TEST_CASE("Daylight is light from 4000 to 25000 K and nothing else is daylight") {
    for (double kelvin : {4000.0, 5003.0, 7000.0, 7001.0, 25'000.0})
        CHECK(Curve::daylight(kelvin).bounds().first >= 0);
    CHECK_THROWS_WITH(Curve::daylight(3999), "daylight of 3999 K (allowed: 4000 … 25000 K)");
    CHECK_THROWS_AS(Curve::daylight(NAN), InputError);
}

TEST_CASE("Sellmeier's formula gives N-BK7 its catalogue indices, and means nothing at its resonances") {
    // Schott's data sheet: n_d at 587.5618 nm, n_F at 486.1327 nm, n_C at 656.2725 nm, n at 1064 nm
    const std::vector<double> bk7{1.03961212,   0.00600069867, 0.231792344,
                                  0.0200179144, 1.01046945,    103.560653};
    const auto n = sellmeier(bk7);
    REQUIRE(n);
    CHECK(n->at(587.5618) == Approx(1.51680).margin(5e-6));
    CHECK(n->at(486.1327) == Approx(1.52238).margin(5e-6));
    CHECK(n->at(656.2725) == Approx(1.51432).margin(5e-6));
    CHECK(n->at(1064) == Approx(1.50663).margin(5e-6));
    for (double nm : {1.0, 141.0, 10'176.0, 1e6}) {
        CHECK(n->at(nm) >= 1);
        CHECK(n->at(nm) <= 6);
    }
    CHECK_FALSE(sellmeier(std::vector<double>{-5, 0}));
}

TEST_CASE("Cauchy's formula counts in micrometres") {
    const auto n = cauchy(std::vector<double>{1.5, 0.004, 0.0001});
    REQUIRE(n);
    CHECK(n->at(500) == Approx(1.5 + 0.004 / 0.25 + 0.0001 / 0.0625).epsilon(1e-14));
    CHECK_FALSE(cauchy(std::vector<double>{0.5}));
}
