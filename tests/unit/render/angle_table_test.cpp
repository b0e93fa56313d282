// Functions of a cosine as kernels read them, and the energy of rough surfaces.
#include "render/angle_table.h"

#include "render/facets.h"
#include "render/fresnel.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace spectrad;

namespace {

/// Single-scattering directional albedo of GGX over all half vectors, midpoint by midpoint, whether or not
/// they send light above the surface.
double albedoByQuadrature(double cosView, double alpha, const AngleFunction& fresnel) {
    constexpr int rings = 1000, around = 500;
    constexpr double quarter = std::numbers::pi / 2;
    const double a2 = alpha * alpha, vz = cosView, vx = std::sqrt(1 - vz * vz);
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        // tan θ = α tan ψ: then D cos θ dω = sin 2ψ dψ dφ / 2π.
        const double psi = quarter * (i + 0.5) / rings, tangent = alpha * std::tan(psi);
        const double hz = 1 / std::hypot(1, tangent), hr = tangent * hz,
                     measure = quarter * std::sin(2 * psi);
        for (int k = 0; k < around; ++k) {
            const double phi = std::numbers::pi * (k + 0.5) / around, vh = vx * hr * std::cos(phi) + vz * hz;
            const double lz = 2 * vh * hz - vz;
            if (vh <= 0 || lz <= 0) continue;
            const auto root = [a2](double z) { return std::sqrt(a2 + (1 - a2) * z * z); };
            const double visible = 0.5 / (lz * root(vz) + vz * root(lz));  // G2 / (4 v l)
            sum += measure * fresnel(vh) * visible * lz * 4 * vh / hz;
        }
    }
    return sum / (rings * around);
}

}  // namespace

TEST_CASE("a tabulated function is the function, to float's digits") {
    const std::pair<AngleFunction, double> functions[] = {
        {[](double) { return 0.25; }, 1e-8},
        {[](double c) { return c; }, 2e-7},
        {[](double c) { return fresnelDielectric(c, 1.5); }, 2e-7},
        {[](double c) { return fresnelConductor(c, 0.2, 3); }, 2e-7},
        {[](double c) { return fresnelSchlick(c, 0.04); }, 2e-7},
    };
    for (const auto& [f, bound] : functions) {
        const std::vector<sd_piece> table = tabulate(f);
        double worst = 0;
        for (int i = 0; i <= 20000; ++i) {
            const double c = i / 20000.0;
            worst = std::max(worst, std::abs(evaluate(table.data(), c) - f(c)));
        }
        CHECK(worst <= bound);
    }
}

TEST_CASE("the cosine-weighted mean of known functions") {
    CHECK(cosineMean([](double) { return 0.3; }) == Approx(0.3).epsilon(1e-12));
    CHECK(cosineMean([](double c) { return c; }) == Approx(2.0 / 3).epsilon(1e-10));
    CHECK(cosineMean([](double c) { return fresnelSchlick(c, 0); }) == Approx(2.0 / 42).epsilon(1e-8));
    // Walsh 1926: diffuse reflectance of a smooth surface of n = 1.5 from outside.
    CHECK(cosineMean([](double c) { return fresnelDielectric(c, 1.5); }) == Approx(0.0918).epsilon(1e-3));
}

TEST_CASE("directional albedos of facets agree with a quadrature over half vectors") {
    const AngleFunction glass = [](double c) { return fresnelDielectric(c, 1.5); };
    for (double alpha : {0.0025, 0.01, 0.09, 0.25, 0.5, 1.0}) {
        const FacetAlbedos facets = facetAlbedos({glass}, alpha);
        for (double cosine : {0.03, 0.1, 0.3, 0.6, 0.95, 1.0}) {
            CAPTURE(alpha, cosine);
            const double white = albedoByQuadrature(cosine, alpha, [](double) { return 1.0; });
            CHECK(facets.white[0](cosine) == Approx(white).margin(5e-4));
            CHECK(facets.albedo[0][0](cosine) ==
                  Approx(albedoByQuadrature(cosine, alpha, glass)).margin(5e-4));
            CHECK(facets.white[0](cosine) <= 1);
        }
    }
}

TEST_CASE("what facets that reflect everything bounce on makes up for what one bounce loses") {
    for (double alpha : {0.01, 0.25, 1.0}) {
        const FacetAlbedos facets = facetAlbedos({[](double) { return 1.0; }}, alpha);
        const double again = multipleScattering(1, facets.whiteMean);
        for (double cosine : {0.0, 0.02, 0.4, 1.0})
            CHECK(facets.albedo[0][0](cosine) + (1 - facets.white[0](cosine)) * again ==
                  Approx(1).margin(1e-6));
    }
    CHECK(multipleScattering(0, 0.7) == 0);
}

TEST_CASE("Oren-Nayar's albedo is the integral of its own shape, and one more bounce makes it white") {
    for (double sigma : {5.0, 20.0, 45.0, 90.0}) {
        const OrenNayar model = orenNayar(sigma);
        for (double vz : {0.05, 0.3, 0.7, 1.0}) {
            const double vx = std::sqrt(1 - vz * vz);
            constexpr int rings = 800, around = 800;
            double sum = 0;
            for (int i = 0; i < rings; ++i) {
                const double lz = std::sqrt((i + 0.5) / rings),
                             lr = std::sqrt(1 - lz * lz);  // cosine-weighted
                for (int k = 0; k < around; ++k) {
                    const double s =
                        vx * lr * std::cos(2 * std::numbers::pi * (k + 0.5) / around);  // v·l − vz lz
                    sum += model.a + model.b * (s > 0 ? s / std::max(vz, lz) : s);
                }
            }
            CAPTURE(sigma, vz);
            CHECK(model.albedo(vz) == Approx(sum / rings / around).margin(2e-4));
            CHECK(model.albedo(vz) <= 1 + 1e-12);
        }
        CHECK(model.mean == Approx(cosineMean(model.albedo)));
    }
}
