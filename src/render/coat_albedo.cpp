#include "render/coat_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spectrad {

double fresnelDielectric(double c, double n) {
    const double square = n * n - 1 + c * c;
    if (square < 0) return 1;
    const double g = std::sqrt(square);
    if (g + c == 0) return 1;  // n = 1 seen exactly edge-on: the limit of n > 1
    const double a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * a * a * (1 + b * b);
}

namespace {

/// Gauss–Legendre nodes and weights on 0…1.
template <size_t N>
struct Gauss {
    std::array<double, N> x{}, w{};
    Gauss() {
        for (size_t i = 0; i < N; ++i) {
            double z = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (N + 0.5)), slope = 1;
            for (int step = 0; step < 100; ++step) {
                double p0 = 1, p1 = z;
                for (size_t k = 2; k <= N; ++k) {
                    const auto d = static_cast<double>(k);
                    const double p2 = ((2 * d - 1) * z * p1 - (d - 1) * p0) / d;
                    p0 = p1;
                    p1 = p2;
                }
                slope = N * (z * p1 - p0) / (z * z - 1);
                const double change = p1 / slope;
                z -= change;
                if (std::abs(change) < 1e-15) break;
            }
            x[i] = 0.5 * (1 - z);
            w[i] = 1 / ((1 - z * z) * slope * slope);
        }
    }
};

struct Albedos {
    double reflected = 0;  ///< with Fresnel
    double white = 0;      ///< were the facets perfect mirrors
};

/// Single-scattering albedos towards a view at `cosine`, by quadrature over the distribution of visible normals (Heitz 2018):
/// there the integrand is F · G2 / G1, smooth at any roughness.
Albedos singleScattering(double cosine, double ior, double alpha) {
    static const Gauss<32> radial;
    constexpr int around = 48;
    const double vz = std::max(cosine, 1e-6), vx = std::sqrt(std::max(0.0, 1 - vz * vz));
    const double stretched = std::hypot(alpha * vx, vz);
    const double hx = alpha * vx / stretched, hz = vz / stretched;
    const double a2 = alpha * alpha;
    const auto lambda = [a2](double z) { return std::sqrt(a2 + (1 - a2) * z * z); };
    Albedos sum;
    for (size_t i = 0; i < radial.x.size(); ++i) {
        const double r = radial.x[i];
        for (int k = 0; k < around; ++k) {
            // Mirror-symmetric about the plane of incidence: half the circle, twice the weight.
            const double phi = std::numbers::pi * (k + 0.5) / around;
            const double s = 0.5 * (1 + hz), t1 = r * std::sin(phi);
            const double t2 = (1 - s) * std::sqrt(1 - t1 * t1) + s * r * std::cos(phi);
            const double t3 = std::sqrt(std::max(0.0, 1 - t1 * t1 - t2 * t2));
            // Basis: T1 = y, T2 = Vh × T1 up to sign; only the plane's components and y matter.
            double nx = -t2 * hz + t3 * hx, ny = t1, nz = t2 * hx + t3 * hz;
            nx *= alpha;
            ny *= alpha;
            nz = std::max(nz, 0.0);
            const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
            if (length == 0) continue;
            nx /= length;
            nz /= length;
            const double vh = std::max(0.0, vx * nx + vz * nz);
            const double lz = 2 * vh * nz - vz;
            if (lz <= 0) continue;
            // G2 / G1(v) with height-correlated Smith: (vz-side lambda) 2 terms.
            const double g1 = 2 * vz / (lambda(vz) + vz), g2 = 2 * lz * vz / (vz * lambda(lz) + lz * lambda(vz));
            const double weight = radial.w[i] * 2 * r / around * g2 / g1;
            sum.white += weight;
            sum.reflected += weight * fresnelDielectric(vh, ior);
        }
    }
    return {std::min(sum.reflected, 1.0), std::min(sum.white, 1.0)};
}

/// Cosine-weighted mean over the hemisphere, 2 ∫ f(μ) μ dμ, of a function given at uniform nodes; exact for linear pieces.
template <typename F>
double cosineMean(F f) {
    double sum = 0;
    const double h = 1.0 / SD_TABLE_CELLS;
    for (int i = 0; i < SD_TABLE_CELLS; ++i) {
        const double a = i * h, fa = f(i), fb = f(i + 1);
        sum += h * (fa * (a / 2 + h / 6) + fb * (a / 2 + h / 3));
    }
    return 2 * sum;
}

/// Nodes of the slow quadrature, denser towards grazing; the fine table is a cubic through them.
constexpr int coarse = 160;
double coarseCosine(double i) { return (i / coarse) * (i / coarse); }

double cubic(const std::vector<double>& values, double cosine) {
    const double at = std::sqrt(cosine) * coarse;
    const int i = std::clamp(static_cast<int>(at) - 1, 0, coarse - 3);
    double sum = 0;
    for (int a = i; a < i + 4; ++a) {
        double weight = 1;
        for (int b = i; b < i + 4; ++b)
            if (b != a) weight *= (at - b) / (a - b);
        sum += weight * values[static_cast<size_t>(a)];
    }
    return sum;
}

}  // namespace

CoatAlbedo coatAlbedo(double ior, double alpha) {
    std::vector<double> reflected(SD_TABLE_CELLS + 1), white(SD_TABLE_CELLS + 1, 1.0);
    if (alpha == 0) {
        for (int i = 0; i <= SD_TABLE_CELLS; ++i)
            reflected[static_cast<size_t>(i)] = fresnelDielectric(static_cast<double>(i) / SD_TABLE_CELLS, ior);
    } else {
        std::vector<double> slowReflected, slowWhite;
        for (int i = 0; i <= coarse; ++i) {
            const Albedos a = singleScattering(coarseCosine(i), ior, alpha);
            slowReflected.push_back(a.reflected);
            slowWhite.push_back(a.white);
        }
        for (int i = 0; i <= SD_TABLE_CELLS; ++i) {
            const double cosine = static_cast<double>(i) / SD_TABLE_CELLS;
            reflected[static_cast<size_t>(i)] = std::clamp(cubic(slowReflected, cosine), 0.0, 1.0);
            white[static_cast<size_t>(i)] = std::clamp(cubic(slowWhite, cosine), 0.0, 1.0);
        }
    }
    const double meanWhite = cosineMean([&](int i) { return white[static_cast<size_t>(i)]; });
    const double meanFresnel = cosineMean([&](int i) { return fresnelDielectric(static_cast<double>(i) / SD_TABLE_CELLS, ior); });
    // Light that bounces again between facets meets Fresnel each time: a geometric series (Kulla & Conty 2017).
    const double again = meanFresnel * meanFresnel * meanWhite / (1 - meanFresnel * (1 - meanWhite));
    CoatAlbedo coat;
    // A coat that misses less than a millionth sends nothing round again.
    if (1 - meanWhite > 1e-6) coat.multiple = again / (std::numbers::pi * (1 - meanWhite));
    std::vector<double> through(SD_TABLE_CELLS + 1);
    for (size_t i = 0; i < through.size(); ++i) {
        const double missing = coat.multiple > 0 ? 1 - white[i] : 0.0;
        through[i] = 1 - std::min(1.0, reflected[i] + missing * again);
        coat.table.push_back({static_cast<float>(through[i]), static_cast<float>(missing)});
    }
    coat.meanThrough = cosineMean([&](int i) { return through[static_cast<size_t>(i)]; });
    // What a diffuse base sends up is let through as much as what comes down, per solid angle inside (n² of it):
    // 1 − r_inside = (1 − r_outside) / n², from the reciprocity of transmission.
    coat.insideReflectance = std::max(0.0, 1 - coat.meanThrough / (ior * ior));
    return coat;
}

}  // namespace spectrad
