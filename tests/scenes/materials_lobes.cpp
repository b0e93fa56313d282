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
    const double u = double{lobe.alpha}, v = lobe.alpha_v != 0 ? double{lobe.alpha_v} : u;
    const double w = std::pow(h.x / u, 2) + std::pow(h.y / v, 2) + h.z * h.z;
    const auto root = [=](Vec3 d) {
        return std::sqrt(std::pow(u * d.x, 2) + std::pow(v * d.y, 2) + d.z * d.z);
    };
    const double shape = 1 / (pi * u * v * w * w) * 0.5 / (light.z * root(view) + view.z * root(light));
    double sum = 0;
    for (size_t f = 0; f < lobe.functions; ++f)
        sum += term(lobe, f) * fresnel(lobe, f, dot(view, h));
    return shape * sum;
}

double Reflectance::function(const sd_lobe& lobe, size_t number, Vec3 direction) const {
    const size_t each = lobe.alpha_v != 0 ? SD_AZIMUTHS : 1;
    const sd_piece* table = plan_.world.tables.data() + lobe.table + number * each * SD_CELLS;
    if (each == 1) return evaluate(table, direction.z);
    const double u = double{lobe.alpha}, v = double{lobe.alpha_v}, shift = 0.15 * std::max(u, v);
    const double sine = std::hypot(direction.x, direction.y);
    const double width = sine > 0 ? std::hypot(u * direction.x, v * direction.y) / sine : u;
    const double most = 1 / (std::min(u, v) + shift), least = 1 / (std::max(u, v) + shift);
    const double x = (2 / (width + shift) - most - least) / (most - least);
    double sum = 0;
    for (size_t k = 0; k < each; ++k)
        sum += evaluate(table + k * SD_CELLS, direction.z) * std::pow(x, k);
    return number == 0 ? std::max(sum, 0.0) : sum;
}

double Reflectance::fresnel(const sd_lobe& lobe, size_t number, double cosine) const {
    const size_t each = lobe.alpha_v != 0 ? SD_AZIMUTHS : 1;
    return evaluate(
        plan_.world.tables.data() + lobe.table + ((1 + lobe.functions) * each + number) * SD_CELLS, cosine);
}

Reflectance::Below Reflectance::below(const sd_lobe& lobe, double cosine) const {
    const sd_piece* own =
        plan_.world.tables.data() + lobe.table + (lobe.alpha_v != 0 ? SD_AZIMUTHS : 1) * SD_CELLS;
    return {std::sqrt(1 - double{lobe.inv_n2} * (1 - cosine * cosine)), evaluate(own, cosine),
            evaluate(own + SD_CELLS, cosine)};
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
        if (lobe.type == SD_LOBE_DIFFUSE) {
            sum += term(lobe, 0);
            continue;
        }
        const double both = function(lobe, 0, view) * function(lobe, 0, light);
        if (lobe.type == SD_LOBE_COATED) sum += term(lobe, 0) * both;
        if (lobe.type == SD_LOBE_ROUGH) {
            const double beyond = dot(view, light) - view.z * light.z;
            const double divisor = beyond > 0 ? std::max(view.z, light.z) : 1;
            sum += term(lobe, 0) * double{lobe.mean_through} * (1 + double{lobe.alpha} * beyond / divisor);
            sum += term(lobe, 1) * both * double{lobe.multiple};
        }
        if (lobe.type == SD_LOBE_ROUGH_COATED) {
            const Below v = below(lobe, view.z), in = below(lobe, light.z);
            const double beyond = (dot(view, light) - view.z * light.z) * double{lobe.inv_n2};
            const double divisor = beyond > 0 ? std::max(v.cosine, in.cosine) : 1;
            const double through = both * double{lobe.inv_n2};
            sum += through * term(lobe, 0) * double{lobe.mean_through} *
                   (1 + double{lobe.ratio} * beyond / divisor);
            sum += through * term(lobe, 1) * v.missing * in.missing * double{lobe.multiple};
            sum += through * term(lobe, 2) * v.back * in.back * double{lobe.rest};
        }
        if (lobe.type == SD_LOBE_FACETS) sum += term(lobe, lobe.multiple_to) * both * double{lobe.multiple};
    }
    return sum;
}

double Reflectance::albedo(Vec3 view) const {
    double sum = 0;
    for (size_t l = 0; l < material_.lobes; ++l) {
        const sd_lobe& lobe = plan_.world.lobes[material_.first_lobe + l];
        if (lobe.type == SD_LOBE_DIFFUSE) {
            sum += pi * term(lobe, 0);
            continue;
        }
        const double first = function(lobe, 0, view);
        if (lobe.type == SD_LOBE_COATED) sum += pi * term(lobe, 0) * first * double{lobe.mean_through};
        if (lobe.type == SD_LOBE_ROUGH) sum += pi * (term(lobe, 0) * (1 - first) + term(lobe, 1) * first);
        if (lobe.type == SD_LOBE_ROUGH_COATED) {
            const Below v = below(lobe, view.z);
            const double multiple = v.missing * double{lobe.escape};
            sum +=
                pi * first *
                (term(lobe, 0) * (1 - v.back - multiple) + term(lobe, 1) * multiple + term(lobe, 2) * v.back);
        }
        if (lobe.type == SD_LOBE_FACETS) {
            for (size_t f = 0; f < lobe.functions; ++f)
                sum += term(lobe, f) * function(lobe, 1 + f, view);
            if (lobe.multiple_to == lobe.functions) sum += term(lobe, lobe.functions) * first;
        }
    }
    return sum;
}

double Reflectance::integral(Vec3 view) const {
    constexpr int rings = 160, around = 160;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        // Cosine-weighted: cos² even; u³ crowds the rings where cosines are small.
        const double s = (i + 0.5) / rings, lz = s * s;
        for (int k = 0; k < around; ++k)
            sum += others(view, at(lz, 2 * pi * (k + 0.5) / around)) * lz * 2 * s * 2 * pi;
    }
    sum /= rings * around;
    for (size_t l = 0; l < material_.lobes; ++l) {
        const sd_lobe& lobe = plan_.world.lobes[material_.first_lobe + l];
        if (lobe.type != SD_LOBE_FACETS) continue;
        if (lobe.alpha == 0) {  // a mirror: its albedo is its reflectance
            for (size_t f = 0; f < lobe.functions; ++f)
                sum += term(lobe, f) * fresnel(lobe, f, view.z);
            continue;
        }
        constexpr int heights = 700, turns = 400;
        const double a = double{lobe.alpha}, b = lobe.alpha_v != 0 ? double{lobe.alpha_v} : a;
        double single = 0;
        for (int i = 0; i < heights; ++i) {
            const double psi = pi / 2 * (i + 0.5) / heights, t = std::tan(psi);
            for (int k = 0; k < turns; ++k) {
                // Slopes on an ellipse.
                const double phi = 2 * pi * (k + 0.5) / turns;
                const Vec3 slope{a * t * std::cos(phi), b * t * std::sin(phi), 1};
                const Vec3 h = normalized(slope);
                const double vh = dot(view, h);
                const Vec3 light = h * (2 * vh) - view;
                if (vh <= 0 || light.z <= 0) continue;
                // dω_l = 4 (v·h) dω_h, dω_h = cos³ θ dx dy over slopes x, y; dx dy = α_u α_v t dt dφ.
                const double cosPsi = std::cos(psi);
                single += facetsOf(lobe, view, light) * light.z * 4 * vh * h.z * h.z * h.z * a * b * t /
                          (cosPsi * cosPsi);
            }
        }
        sum += single * (pi / 2) / heights * 2 * pi / turns;
    }
    return sum;
}

}  // namespace spectrad::test
