#include "spectrum/lift.h"

#include "base/error.h"
#include "base/text.h"
#include "spectrum/curve_body.h"
#include "spectrum/library.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

namespace {

constexpr double firstNm = 360, lastNm = 830;
constexpr double saturated = 1e9;  // x at which S is exactly 0 or 1 in double

double sigmoid(double x) {
    return 0.5 + x / (2 * std::sqrt(1 + x * x));
}

double inverseSigmoid(double s) {
    const double u = 2 * s - 1, rest = (1 - u) * (1 + u);
    return rest > 0 ? std::clamp(u / std::sqrt(rest), -saturated, saturated) : std::copysign(saturated, u);
}

constexpr double labBend = 216.0 / 24389;  ///< below it f of CIE Lab is a line

/// f of CIE Lab (CIE 015:2018, 8.2.1.1) and its derivative.
double labF(double r) {
    return r > labBend ? std::cbrt(r) : (24389.0 / 27 * r + 16) / 116;
}
double labSlope(double r) {
    return r > labBend ? 1 / (3 * std::cbrt(r * r)) : 24389.0 / 27 / 116;
}

Vector labOf(const Vector& f) {
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

/// Lab of tristimulus values that are 1 for the white.
Vector labOfRatios(const Vector& ratio) {
    return labOf({labF(ratio[0]), labF(ratio[1]), labF(ratio[2])});
}

Vector targetLab(const Vector& rgb) {
    const Vector xyz = xyzOfLinearSrgb(rgb), white = xyzOfLinearSrgb({1, 1, 1});
    return labOfRatios({xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]});
}

double determinant(const Matrix& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Cramer's rule; zero where the matrix is singular.
Vector solve(const Matrix& m, const Vector& b) {
    const double d = determinant(m);
    Vector x{};
    for (size_t col = 0; col < 3; ++col) {
        Matrix replaced = m;
        for (size_t row = 0; row < 3; ++row)
            replaced[row][col] = b[row];
        x[col] = d != 0 ? determinant(replaced) / d : 0;
    }
    return x;
}

}  // namespace

double linearOfSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Vector xyzOfLinearSrgb(const Vector& rgb) {
    // From the primaries' chromaticities and D65 at x = 0.3127, y = 0.3290, without the standard's rounding
    // to four digits.
    static constexpr Matrix m{{{0.41239079926595934, 0.357584339383878, 0.1804807884018343},
                               {0.21263900587151027, 0.715168678767756, 0.07219231536073371},
                               {0.01933081871559182, 0.11919477979462598, 0.9505321522496607}}};
    Vector xyz{};
    for (size_t row = 0; row < 3; ++row)
        for (size_t col = 0; col < 3; ++col)
            xyz[row] += m[row][col] * rgb[col];
    return xyz;
}

double LiftedColour::at(double nm) const {
    const double t = (std::clamp(nm, firstNm, lastNm) - firstNm) / (lastNm - firstNm);
    return sigmoid((c[0] * t + c[1]) * t + c[2]);
}

Curve LiftedColour::curve() const {
    if (c[0] == 0 && c[1] == 0) return Curve::constant(sigmoid(c[2]));
    const LiftedColour self = *this;
    const auto at = [self](double nm) { return self.at(nm); };
    const auto breaks = [at](double from, double to, std::vector<double>& out) {
        // A saturated colour's edge may be steep: start fine enough not to miss it, then halve where it needs
        // more.
        constexpr double step = 10;
        double a = from;
        for (double b = (std::floor(from / step) + 1) * step; a < to; b += step) {
            appendSmoothBreaks(at, a, std::min(b, to), out);
            if (b < to) out.push_back(b);
            a = b;
        }
    };
    return Curve::formula(at, breaks, NmRange{firstNm, lastNm}).withOutside(Outside::hold);
}

/// One step of the fit: parameters, what they give, how far that is from the target, and which way it moves.
struct ColourLift::State {
    Vector c{}, residual{};
    Matrix jacobian{};

    [[nodiscard]] double distance() const { return std::hypot(residual[0], residual[1], residual[2]); }
};

namespace {

/// D65 and the CIE 1931 observer.
std::pair<Spectrum, Spectrum> lampAndObserver(const Library& library) {
    auto lamp = library.find("illuminants/D65"), observer = library.find("observers/cie1931-2");
    if (!lamp || !observer || observer->curves.size() != 3)
        throw InputError(fmt::format("{}: the library lacks {}, which colours are lifted with",
                                     library.folder().string(),
                                     lamp ? "observers/cie1931-2" : "illuminants/D65"));
    return {std::move(*lamp), std::move(*observer)};
}

}  // namespace

ColourLift::ColourLift(const Library& library, const std::vector<double>& nodes) {
    const auto [lamp, observer] = lampAndObserver(library);
    weights_.resize(nodes.size());
    Vector white{};
    for (size_t i = 0; i < nodes.size(); ++i) {
        t_.push_back((nodes[i] - firstNm) / (lastNm - firstNm));
        std::vector<double> at, value;
        for (size_t n = i > 0 ? i - 1 : 0; n < std::min(i + 2, nodes.size()); ++n) {
            at.push_back(nodes[n]);
            value.push_back(n == i ? 1.0 : 0.0);
        }
        const Curve hat = Curve::table(at, value, Outside::hold);
        for (size_t channel = 0; channel < 3; ++channel) {
            const std::array<const Curve*, 3> product{&lamp.curve(), &observer.curves[channel], &hat};
            white[channel] += weights_[i][channel] = integrate(product);
        }
    }
    for (Vector& weight : weights_)
        for (size_t channel = 0; channel < 3; ++channel)
            weight[channel] /= white[channel];
}

ColourLift::ColourLift(const Library& library) {
    const auto [lamp, observer] = lampAndObserver(library);
    const Wavelengths grid = regularWavelengths(firstNm, lastNm, 1, {});
    for (double nm : grid.nm)
        t_.push_back((nm - firstNm) / (lastNm - firstNm));
    weights_.resize(grid.size());
    for (size_t channel = 0; channel < 3; ++channel) {
        const std::array<const Curve*, 2> product{&lamp.curve(), &observer.curves[channel]};
        std::vector<double> weight = project(grid, product);
        double white = 0;
        for (size_t i = 0; i < weight.size(); ++i)
            white += weight[i] *= band(grid, i).area();
        for (size_t i = 0; i < weight.size(); ++i)
            weights_[i][channel] = weight[i] / white;
    }
}

ColourLift::State ColourLift::evaluate(const Vector& c, const Vector& target) const {
    Vector ratio{};
    Matrix slope{};  // ∂ratio/∂c
    for (size_t i = 0; i < t_.size(); ++i) {
        const double t = t_[i], x = (c[0] * t + c[1]) * t + c[2], root = std::sqrt(1 + x * x);
        const double s = 0.5 + x / (2 * root), ds = 1 / (2 * root * root * root);
        for (size_t k = 0; k < 3; ++k) {
            const double w = weights_[i][k];
            ratio[k] += w * s;
            slope[k][0] += w * ds * t * t;
            slope[k][1] += w * ds * t;
            slope[k][2] += w * ds;
        }
    }
    State state;
    state.c = c;
    const Vector lab = labOfRatios(ratio);
    for (size_t k = 0; k < 3; ++k)
        state.residual[k] = lab[k] - target[k];
    for (size_t p = 0; p < 3; ++p) {
        const Vector df{labSlope(ratio[0]) * slope[0][p], labSlope(ratio[1]) * slope[1][p],
                        labSlope(ratio[2]) * slope[2][p]};
        state.jacobian[0][p] = 116 * df[1];
        state.jacobian[1][p] = 500 * (df[0] - df[1]);
        state.jacobian[2][p] = 200 * (df[1] - df[2]);
    }
    return state;
}

/// Levenberg–Marquardt from `start` towards the target; never ends farther from it than it began.
ColourLift::State ColourLift::approach(State start, const Vector& target) const {
    State state = evaluate(start.c, target);
    double damping = 1e-4;
    for (int iteration = 0; iteration < 60 && state.distance() > 1e-7 && damping < 1e12; ++iteration) {
        Matrix normal{};
        Vector gradient{};
        for (size_t a = 0; a < 3; ++a)
            for (size_t k = 0; k < 3; ++k) {
                gradient[a] -= state.jacobian[k][a] * state.residual[k];
                for (size_t b = 0; b < 3; ++b)
                    normal[a][b] += state.jacobian[k][a] * state.jacobian[k][b];
            }
        for (size_t a = 0; a < 3; ++a)
            normal[a][a] *= 1 + damping;
        const Vector step = solve(normal, gradient);
        const State next =
            evaluate({state.c[0] + step[0], state.c[1] + step[1], state.c[2] + step[2]}, target);
        if (next.distance() < state.distance()) {
            state = next;
            damping /= 10;
        } else {
            damping *= 10;
        }
    }
    return state;
}

LiftedColour ColourLift::fit(Vector rgb) const {
    for (double component : rgb)
        if (!(component >= 0 && component <= 1))
            throw InputError(fmt::format("linear RGB component {} (allowed: 0 … 1)", shortest(component)));
    return fitNearest(rgb).colour;
}

ColourLift::Nearest ColourLift::fitNearest(const Vector& rgb) const {
    if (rgb[0] == rgb[1] && rgb[1] == rgb[2]) {
        const double grey = std::clamp(rgb[0], 0.0, 1.0);
        return {{{0, 0, inverseSigmoid(grey)}},
                std::abs(targetLab(rgb)[0] - targetLab({grey, grey, grey})[0])};
    }

    // From the grey of the same luminance (not so dark or bright that its slope vanishes) straight to the
    // colour, in as many steps as it takes: a step that does not arrive is halved.
    constexpr double arrived = 1e-4;  // ΔE*ab
    const double grey = std::clamp(xyzOfLinearSrgb(rgb)[1], 1e-4, 1 - 1e-4);
    const auto targetAt = [&](double part) {
        return targetLab(
            {grey + part * (rgb[0] - grey), grey + part * (rgb[1] - grey), grey + part * (rgb[2] - grey)});
    };
    State state = evaluate({0, 0, inverseSigmoid(grey)}, targetAt(0));
    double part = 0, stride = 1;
    while (part < 1 && stride > 1e-4) {
        const double aim = std::min(1.0, part + stride);
        const State next = approach(state, targetAt(aim));
        if (next.distance() <= arrived) {
            state = next;
            part = aim;
            stride *= 2;
        } else {
            stride /= 2;
        }
    }
    // At the brim of what surfaces can show the last bit may be out of reach: take what comes nearest.
    if (part < 1) state = approach(state, targetAt(1));
    return {{state.c}, state.distance()};
}

}  // namespace spectrad
