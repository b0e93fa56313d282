#include "camera/film.h"

#include "base/text.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

constexpr double greyCard = 0.18;  ///< reflectance that light meters are made for
constexpr double fromNm = 360, toNm = 832,
                 stepNm = 4;  ///< hats that carry lamp × eye; dyes are linear between

double transmitted(double density) {
    return std::pow(10.0, -density);
}

}  // namespace

double CharacteristicCurve::density(double exposure) const {
    if (!(exposure > 0)) return dmax;
    return dmin +
           (dmax - dmin) * std::pow(1 + std::pow(10.0, slope * (std::log10(exposure) - centre)), -shoulder);
}

FilmProjection::FilmProjection(Film film, const Detector& eye) : film_(std::move(film)) {
    const std::array<const Curve*, 1> balance{&film_.balance};
    const double luminance = respondXyz(eye, balance)[1];
    const std::vector<double> channels = respond(film_.layers, balance);
    for (size_t i = 0; i < 3; ++i) {
        perLuminance_[i] = channels[i] / luminance;
        if (!(luminance > 0) || !(perLuminance_[i] > 0))
            throw InputError("the film '" + film_.name +
                             "' is not exposed by the light that it is balanced for");
    }
    light(eye);
    balanceDyes();
}

void FilmProjection::project(const Spectrum* lamp, const Detector* eye, const Detector& standard) {
    if (lamp) {
        film_.projector = lamp->curve();
        film_.projectorName = lamp->text;
    }
    light(eye ? *eye : standard);
}

void FilmProjection::light(const Detector& eye) {
    if (!eye.tristimulus)
        throw InputError("'" + eye.name + "' has no X, Y, Z: it cannot look at a projected film");
    const std::array<const Curve*, 1> projector{&film_.projector};
    const Triple whole = respondXyz(eye, projector);
    if (!(whole[1] > 0))
        throw InputError("the projector's lamp of '" + film_.name + "' gives no light to the eye");

    nodes_.clear();
    lamp_ = {};
    Wavelengths grid;
    for (double nm = fromNm; nm <= toNm; nm += stepNm)
        grid.nm.push_back(nm);
    std::array<std::vector<double>, 3> weights;
    for (size_t k = 0; k < 3; ++k)
        weights[k] = moments(grid, Curve::combined({film_.projector, eye.response[k]},
                                                   [](std::span<const double> v) { return v[0] * v[1]; }));
    for (size_t j = 0; j < grid.nm.size(); ++j) {
        Node node{{}, film_.base.at(grid.nm[j]), {}};
        for (size_t k = 0; k < 3; ++k) {
            node.dye[k] = film_.dyes[k].at(grid.nm[j]);
            node.weight[k] = eye.scale * weights[k][j] / whole[1];
        }
        for (size_t k = 0; k < 3; ++k)
            lamp_[k] += node.weight[k];
        nodes_.push_back(node);
    }
}

Triple FilmProjection::seen(const Triple& dyes) const {
    Triple xyz{};
    for (const Node& node : nodes_) {
        const double t = transmitted(dyes[0] * node.dye[0] + dyes[1] * node.dye[1] + dyes[2] * node.dye[2]);
        for (size_t k = 0; k < 3; ++k)
            xyz[k] += node.weight[k] * t;
    }
    return xyz;
}

/// Newton's method for dyes that together, without the base, let a tenth of X, Y and Z through.
void FilmProjection::balanceDyes() {
    constexpr int steps = 50;
    constexpr double step = 1e-5, precise = 1e-12;
    const auto error = [&](const Triple& dyes) {
        const Triple xyz = seen(dyes);
        Triple e;
        for (size_t k = 0; k < 3; ++k)
            e[k] = -std::log10(xyz[k] / lamp_[k]) - 1;
        return e;
    };
    for (int i = 0; i < steps; ++i) {
        const Triple now = error(amount_);
        Matrix3 slope;
        for (size_t c = 0; c < 3; ++c) {
            Triple moved = amount_;
            moved[c] += step;
            const Triple there = error(moved);
            for (size_t r = 0; r < 3; ++r)
                slope[r][c] = (there[r] - now[r]) / step;
        }
        const Triple change = inverse(slope) * now;
        for (size_t c = 0; c < 3; ++c)
            amount_[c] -= change[c];
        if (!std::all_of(amount_.begin(), amount_.end(), [](double a) { return std::isfinite(a) && a > 0; }))
            break;
        if (std::max({std::abs(change[0]), std::abs(change[1]), std::abs(change[2])}) < precise) return;
    }
    throw InputError("the dyes of '" + film_.name + "' make no neutral under its projector's lamp");
}

Triple FilmProjection::exposures(const std::vector<double>& channels, double whiteLuminance,
                                 double ev) const {
    Triple result;
    const double card = greyCard * whiteLuminance * std::exp2(-ev);
    for (size_t i = 0; i < 3; ++i)
        result[i] = channels[i] / (perLuminance_[i] * card);
    return result;
}

Triple FilmProjection::densities(const Triple& exposures) const {
    Triple result;
    for (size_t i = 0; i < 3; ++i)
        result[i] = film_.curves[i].density(exposures[i]);
    return result;
}

double FilmProjection::transmittance(const Triple& densities, double nm) const {
    double density = film_.base.at(nm);
    for (size_t k = 0; k < 3; ++k)
        density += densities[k] * amount_[k] * film_.dyes[k].at(nm);
    return transmitted(density);
}

Triple FilmProjection::xyz(const Triple& densities) const {
    Triple result{};
    for (const Node& node : nodes_) {
        double density = node.base;
        for (size_t k = 0; k < 3; ++k)
            density += densities[k] * amount_[k] * node.dye[k];
        const double t = transmitted(density);
        for (size_t k = 0; k < 3; ++k)
            result[k] += node.weight[k] * t;
    }
    return result;
}

}  // namespace spectrad
