// Fresnel reflectance against the complex amplitudes of the textbook, and its separation into angle and
// wavelength.
#include "render/fresnel.h"

#include "base/error.h"
#include "spectrum/library.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

using namespace spectrad;

namespace {

using Complex = std::complex<double>;

/// Unpolarized reflectance from the amplitudes of both polarizations; `index` relative to the outside.
double oracle(double cosine, Complex index) {
    const double sine2 = 1 - cosine * cosine;
    const Complex inside = std::sqrt(index * index - sine2);  // index × cosine of refraction
    const Complex s = (cosine - inside) / (cosine + inside);
    const Complex p = (index * index * cosine - inside) / (index * index * cosine + inside);
    return 0.5 * (std::norm(s) + std::norm(p));
}

double cosineOf(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180);
}

std::vector<std::string> metals(const Library& library) {
    std::vector<std::string> names;
    for (const std::string& name : library.names())
        if (name.starts_with("metals/")) names.push_back(name);
    return names;
}

double mixed(const FresnelBasis& basis, double cosine, double nm) {
    double sum = 0;
    for (size_t i = 0; i < basis.angle.size(); ++i)
        sum += basis.angle[i](cosine) * basis.spectrum[i].at(nm);
    return sum;
}

}  // namespace

TEST_CASE("conductors and dielectrics reflect what the complex amplitudes say") {
    for (int tenths = 0; tenths < 900; ++tenths) {
        const double degrees = tenths / 10.0, c = cosineOf(degrees);
        for (double n : {0.03, 0.2, 0.9, 1.0, 1.5, 4.0, 10.0})
            for (double k : {0.0, 1e-4, 0.3, 1.0, 3.0, 8.0, 40.0}) {
                if (k == 0 && n < 1)
                    continue;  // beyond the critical angle of a lossless medium: dielectrics, below
                CAPTURE(degrees, n, k);
                CHECK(fresnelConductor(c, n, k) == Approx(oracle(c, {n, k})).epsilon(1e-9).margin(1e-12));
            }
        for (double n : {0.4, 0.67, 1.0, 1.0003, 1.33, 1.5, 2.4}) {
            CAPTURE(degrees, n);
            CHECK(fresnelDielectric(c, n) == Approx(oracle(c, {n, 0})).epsilon(1e-9).margin(1e-12));
        }
    }
}

TEST_CASE(
    "at Brewster's angle half of what is reflected square-on to the plane of incidence is all there is") {
    for (double n : {1.2, 1.5, 2.4}) {
        const double c = 1 / std::hypot(1, n);  // tan θ = n
        const double s = (1 - n * n) / (1 + n * n);
        CHECK(fresnelDielectric(c, n) == Approx(0.5 * s * s).epsilon(1e-12));
        CHECK(fresnelConductor(c, n, 0) == Approx(0.5 * s * s).epsilon(1e-12));
    }
}

TEST_CASE("what has the index of the air reflects nothing, from square-on to grazing") {
    for (double degrees : {0.0, 30.0, 60.0, 89.0, 89.9, 89.9999}) {
        CHECK(fresnelDielectric(cosineOf(degrees), 1) <= 1e-20);
        CHECK(fresnelConductor(cosineOf(degrees), 1, 0) <= 1e-10);
    }
    const FresnelBasis basis = conductorBasis(Curve::constant(1), Curve::constant(0), 380, 780);
    for (double degrees : {0.0, 45.0, 89.9})
        CHECK(std::abs(mixed(basis, cosineOf(degrees), 550)) <= 1e-10);
}

TEST_CASE("everything grazing is reflected") {
    CHECK(fresnelDielectric(0, 1.5) == Approx(1));
    CHECK(fresnelConductor(0, 0.2, 3) == Approx(1));
    CHECK(fresnelSchlick(0, 0.04) == Approx(1));
}

TEST_CASE(
    "every metal of the library is a sum of few terms within 1e-5 of its exact reflectance, 0 to 89.9 "
    "degrees, 300 to 1000 nm") {
    const Library library = Library::open();
    const std::vector<std::string> names = metals(library);
    REQUIRE(names.size() >= 18);
    for (const std::string& name : names) {
        const Spectrum ior = library.find(name).value();
        const Curve n = ior.curves.at(0).withOutside(Outside::hold),
                    k = ior.curves.at(1).withOutside(Outside::hold);
        for (const auto& [from, to] : {std::pair{380.0, 780.0}, {300.0, 1000.0}, {550.0, 551.0}}) {
            const FresnelBasis basis = conductorBasis(n, k, from, to);
            double worst = 0, atNm = 0, atDegrees = 0;
            for (double nm = from; nm <= to; nm += to - from > 10 ? 2.3 : 0.1) {
                for (double degrees = 0; degrees <= 89.95; degrees += degrees < 80 ? 0.7 : 0.05) {
                    const double c = cosineOf(degrees), exact = oracle(c, {n.at(nm), k.at(nm)});
                    const double error = std::abs(mixed(basis, c, nm) - exact) / exact;
                    if (error > worst) worst = error, atNm = nm, atDegrees = degrees;
                }
            }
            INFO(fmt::format("{} {}-{} nm: {} terms, {:.1e} said, {:.1e} found at {} nm and {} degrees", name,
                             from, to, basis.angle.size(), basis.relativeError, worst, atNm, atDegrees));
            CHECK(worst <= 1e-5);
            CHECK(worst <=
                  std::max(4 * basis.relativeError, 1e-7));  // what the plan says of itself is no boast
            CHECK(basis.angle.size() <= 12);
        }
    }
}

TEST_CASE("spectra of a metal's terms are reflectances in their own right") {
    const Library library = Library::open();
    const Spectrum ior = library.find("metals/Cu").value();
    const FresnelBasis basis = conductorBasis(ior.curves.at(0), ior.curves.at(1), 380, 780);
    for (const Curve& spectrum : basis.spectrum)
        for (double nm = 380; nm <= 780; nm += 1) {
            CHECK(spectrum.at(nm) >= 0);
            CHECK(spectrum.at(nm) <= 1);
        }
}

TEST_CASE("Schlick's two terms are his formula over the metal's own reflectance at normal incidence") {
    const Library library = Library::open();
    const Spectrum ior = library.find("metals/Au").value();
    const FresnelBasis basis = schlickBasis(ior.curves.at(0), ior.curves.at(1));
    double worst = 0;
    for (double nm = 380; nm <= 780; nm += 5) {
        const Complex index{ior.curves.at(0).at(nm), ior.curves.at(1).at(nm)};
        const double r0 = oracle(1, index);
        for (double degrees = 0; degrees <= 90; degrees += 1) {
            const double c = cosineOf(degrees), expected = r0 + (1 - r0) * std::pow(1 - c, 5);
            CHECK(mixed(basis, c, nm) == Approx(expected).epsilon(1e-12));
            worst = std::max(worst, std::abs(expected - oracle(c, index)));
        }
    }
    const double said = schlickError(ior.curves.at(0), ior.curves.at(1), 380, 780);
    CHECK(said >= worst - 1e-12);
    CHECK(said <= 1.05 * worst);
}
