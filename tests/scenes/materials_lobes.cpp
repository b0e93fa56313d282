#include "scenes/materials_lobes.h"

#include "render/angle_table.h"

#include <cmath>
#include <numbers>

namespace spectrad::test {

namespace {

constexpr double pi = std::numbers::pi;

Vec3 at(double z, double azimuth) {
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

}  // namespace

double Reflectance::term(const sd_lobe& lobe, size_t function) const {
    const size_t number = material_.first_term + lobe.term + function * plan_.groups;
    return double{plan_.terms.spectra[number * plan_.terms.bands + band_]};
}

double Reflectance::facetsOf(const sd_lobe& lobe, Vec3 view, Vec3 light) const {
    const Vec3 h = normalized(view + light);
    const double a2 = double{lobe.alpha} * double{lobe.alpha}, d = h.z * h.z * (a2 - 1) + 1;
    const auto root = [a2](double z) { return std::sqrt(a2 + (1 - a2) * z * z); };
    const double shape = a2 / (pi * d * d) * 0.5 / (light.z * root(view.z) + view.z * root(light.z));
    double sum = 0;
    for (size_t f = 0; f < lobe.functions; ++f)
        sum += term(lobe, f) *
               evaluate(plan_.world.tables.data() + lobe.table + (1 + lobe.functions + f) * SD_CELLS,
                        dot(view, h));
    return shape * sum;
}

double Reflectance::facets(Vec3 view, Vec3 light) const {
    double sum = 0;
    for (size_t l = 0; l < material_.lobes; ++l) {
        const sd_lobe& lobe = plan_.world.lobes[material_.first_lobe + l];
        if (lobe.type == SD_LOBE_FACETS && lobe.alpha > 0) sum += facetsOf(lobe, view, light);
    }
    return sum;
}

double Reflectance::others(Vec3 view, Vec3 light) const {
    double sum = 0;
    for (size_t l = 0; l < material_.lobes; ++l) {
        const sd_lobe& lobe = plan_.world.lobes[material_.first_lobe + l];
        const sd_piece* table = plan_.world.tables.data() + lobe.table;
        if (lobe.type == SD_LOBE_DIFFUSE) {
            sum += term(lobe, 0);
            continue;
        }
        const double both = evaluate(table, view.z) * evaluate(table, light.z);
        if (lobe.type == SD_LOBE_COATED) sum += term(lobe, 0) * both;
        if (lobe.type == SD_LOBE_ROUGH) {
            const double beyond = dot(view, light) - view.z * light.z;
            const double divisor = beyond > 0 ? std::max(view.z, light.z) : 1;
            sum += term(lobe, 0) * double{lobe.mean_through} * (1 + double{lobe.alpha} * beyond / divisor);
            sum += term(lobe, 1) * both * double{lobe.multiple};
        }
        if (lobe.type == SD_LOBE_FACETS) sum += term(lobe, lobe.multiple_to) * both * double{lobe.multiple};
    }
    return sum;
}

double Reflectance::albedo(double cosView) const {
    double sum = 0;
    for (size_t l = 0; l < material_.lobes; ++l) {
        const sd_lobe& lobe = plan_.world.lobes[material_.first_lobe + l];
        const sd_piece* table = plan_.world.tables.data() + lobe.table;
        if (lobe.type == SD_LOBE_DIFFUSE) {
            sum += pi * term(lobe, 0);
            continue;
        }
        const double first = evaluate(table, cosView);
        if (lobe.type == SD_LOBE_COATED) sum += pi * term(lobe, 0) * first * double{lobe.mean_through};
        if (lobe.type == SD_LOBE_ROUGH) sum += pi * (term(lobe, 0) * (1 - first) + term(lobe, 1) * first);
        if (lobe.type == SD_LOBE_FACETS) {
            for (size_t f = 0; f < lobe.functions; ++f)
                sum += term(lobe, f) * evaluate(table + (1 + f) * SD_CELLS, cosView);
            if (lobe.multiple_to == lobe.functions) sum += term(lobe, lobe.functions) * first;
        }
    }
    return sum;
}

double Reflectance::integral(double cosView) const {
    const Vec3 view = at(cosView, 0);
    constexpr int rings = 160, around = 160;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        // Cosine-weighted: cos² even; u³ crowds the rings where cosines are small.
        const double s = (i + 0.5) / rings, lz = s * s;
        for (int k = 0; k < around; ++k)
            sum += others(view, at(lz, pi * (k + 0.5) / around)) * lz * 2 * s * 2 * pi;
    }
    sum /= rings * around;
    for (size_t l = 0; l < material_.lobes; ++l) {
        const sd_lobe& lobe = plan_.world.lobes[material_.first_lobe + l];
        if (lobe.type != SD_LOBE_FACETS) continue;
        if (lobe.alpha == 0) {  // a mirror: its albedo is its reflectance
            const sd_piece* table = plan_.world.tables.data() + lobe.table;
            for (size_t f = 0; f < lobe.functions; ++f)
                sum += term(lobe, f) * evaluate(table + (1 + lobe.functions + f) * SD_CELLS, cosView);
            continue;
        }
        constexpr int heights = 700, turns = 400;
        const double a = double{lobe.alpha};
        double single = 0;
        for (int i = 0; i < heights; ++i) {
            const double psi = pi / 2 * (i + 0.5) / heights, tangent = a * std::tan(psi),
                         hz = 1 / std::hypot(1, tangent);
            for (int k = 0; k < turns; ++k) {
                const Vec3 h = at(hz, pi * (k + 0.5) / turns);
                const double vh = dot(view, h);
                const Vec3 light = h * (2 * vh) - view;
                if (vh <= 0 || light.z <= 0) continue;
                // dω_l = 4 (v·h) dω_h, dω_h = sin θ dθ dφ, dθ = cos² θ · α / cos² ψ dψ.
                const double sine = tangent * hz, cosPsi = std::cos(psi);
                single +=
                    facetsOf(lobe, view, light) * light.z * 4 * vh * sine * hz * hz * a / (cosPsi * cosPsi);
            }
        }
        sum += single * (pi / 2) / heights * 2 * pi / turns;
    }
    return sum;
}

}  // namespace spectrad::test
