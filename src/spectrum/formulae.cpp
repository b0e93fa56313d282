// Curves given by formulae: Gaussian, blackbody, any function, and functions of other curves.
#include "base/error.h"
#include "spectrum/curve.h"
#include "spectrum/curve_body.h"
#include "spectrum/gauss.h"
#include "spectrum/si.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// exp(−(λ − c)² / 2σ²), and nothing at or below zero wavelength.
struct Gaussian final : Curve::Body {
    // Cuts a quarter of σ apart leave the Gauss rule an error of h⁸ · 5.6e-10 · max|f⁽⁸⁾| = 1e-12; beyond 9 σ
    // there is 3e-18.
    static constexpr int cutsPerSigma = 4, sigmas = 9;
    double centre, sigma;

    Gaussian(double c, double fwhm) : centre(c), sigma(fwhm / (2 * std::sqrt(2 * std::numbers::ln2))) {}
    [[nodiscard]] double at(double nm, Outside) const override {
        const double z = (nm - centre) / sigma;
        return nm > 0 ? std::exp(-z * z / 2) : 0;
    }
    void appendBreaks(double from, double to, Outside, std::vector<double>& out) const override {
        double last = from;
        if (from < 0 && to > 0) out.push_back(last = 0);
        for (int k = -cutsPerSigma * sigmas; k <= cutsPerSigma * sigmas; ++k) {
            const double nm = centre + k * sigma / cutsPerSigma;
            if (nm > last && nm < to) out.push_back(last = nm);
        }
    }
    [[nodiscard]] std::optional<NmRange> range() const override {
        return NmRange{std::max(0.0, centre - sigmas * sigma), centre + sigmas * sigma};
    }
    [[nodiscard]] std::optional<NmRange> support(Outside) const override { return range(); }
};

/// Planck's law. With x = c₂/(λT) the radiance per wavelength is c₁ λ⁻⁵ / (eˣ − 1).
struct Blackbody final : Curve::Body {
    // 2hc² in W·m²·sr⁻¹; Wien's displacement at x = 4.965…
    static constexpr double c1 = 1.191042972397188e-16, c2 = secondRadiation, xPeak = 4.965114231744276;
    static constexpr double xSteep = 10;  // above it e⁻ˣ rules: cuts go by x; below, by ln λ
    static constexpr double stepX = 0.5, stepLog = 0.05;
    static constexpr double xDark = 709;  // eˣ overflows, nothing is left
    static constexpr double xFar = 1e-5;  // the rest of the integral is 5e-17 of the whole
    double kelvin;

    explicit Blackbody(double t) : kelvin(t) {}
    [[nodiscard]] double nmAt(double x) const { return 1e9 * c2 / (x * kelvin); }
    [[nodiscard]] double at(double nm, Outside) const override {
        if (nm <= 0) return 0;
        const double metres = nm * 1e-9, m2 = metres * metres;
        const double occupation = 1 / std::expm1(c2 / (metres * kelvin));
        return occupation > 0 ? c1 * 1e-9 / (m2 * m2 * metres) * occupation : 0;
    }
    void appendBreaks(double from, double to, Outside, std::vector<double>& out) const override {
        double last = std::max(from, 0.0);
        const auto cut = [&](double nm) {
            if (nm > last && nm < to) out.push_back(last = nm);
        };
        if (from < 0) cut(nmAt(xDark) / 2);
        const double steepest = std::min(xDark, from > 0 ? nmAt(1) / from : xDark);
        for (int k = static_cast<int>((steepest - xSteep) / stepX); k >= 0; --k)
            cut(nmAt(xSteep + k * stepX));
        // Counted from the peak, so that the peak itself is among them.
        const double peak = nmAt(xPeak), steepEnd = nmAt(xSteep);
        const double start = std::max(last, steepEnd);
        for (auto k = static_cast<long>(std::floor(std::log(start / peak) / stepLog));; ++k) {
            const double nm = peak * std::exp(static_cast<double>(k) * stepLog);
            if (nm >= to || nm > nmAt(xFar)) break;
            if (nm > steepEnd) cut(nm);
        }
    }
    [[nodiscard]] std::optional<NmRange> support(Outside) const override {
        return NmRange{nmAt(xDark), nmAt(xFar)};
    }
};

struct Formula final : Curve::Body {
    std::function<double(double)> f;
    std::function<void(double, double, std::vector<double>&)> breaks;
    std::optional<NmRange> limits;

    [[nodiscard]] double at(double nm, Outside outside) const override {
        if (!limits || (nm >= limits->first && nm <= limits->second)) return f(nm);
        return outside == Outside::zero ? 0 : f(std::clamp(nm, limits->first, limits->second));
    }
    void appendBreaks(double from, double to, Outside, std::vector<double>& out) const override {
        const double a = limits ? std::max(from, limits->first) : from,
                     b = limits ? std::min(to, limits->second) : to;
        if (!(a < b)) {
            if (limits && limits->first == limits->second && from < limits->first && limits->first < to)
                out.push_back(limits->first);
            return;
        }
        if (a > from) out.push_back(a);
        breaks(a, b, out);
        if (b < to) out.push_back(b);
    }
    [[nodiscard]] std::optional<NmRange> range() const override { return limits; }
};

struct Combined final : Curve::Body {
    std::vector<Curve> inputs;
    std::function<double(std::span<const double>)> f;

    [[nodiscard]] double at(double nm, Outside) const override {
        std::vector<double> in(inputs.size());
        for (size_t i = 0; i < inputs.size(); ++i)
            in[i] = inputs[i].at(nm);
        return f(in);
    }
    void values(std::span<const double> nm, std::span<double> out, Outside) const override {
        const size_t count = inputs.size();
        std::vector<double> column(nm.size()), rows(nm.size() * count);
        for (size_t i = 0; i < count; ++i) {
            inputs[i].values(nm, column);
            for (size_t r = 0; r < nm.size(); ++r)
                rows[r * count + i] = column[r];
        }
        for (size_t r = 0; r < nm.size(); ++r)
            out[r] = f(std::span(rows).subspan(r * count, count));
    }
    /// True if no input changes over [a, b] by more than a twentieth of their magnitude: f is smooth, so its
    /// eighth derivative, which the Gauss rule misses, then counts 0.05⁸.
    [[nodiscard]] bool nearlyConstant(double a, double b) const {
        double magnitude = 0, change = 0;
        for (const Curve& input : inputs) {
            const double left = input.at(a + (b - a) * 0.01), right = input.at(b - (b - a) * 0.01);
            magnitude = std::max({magnitude, std::abs(left), std::abs(right)});
            change = std::max(change, std::abs(right - left));
        }
        return change <= 0.05 * magnitude;
    }
    void appendBreaks(double from, double to, Outside outside, std::vector<double>& out) const override {
        std::vector<double> knots;
        for (const Curve& input : inputs)
            input.appendBreaks(from, to, knots);
        std::sort(knots.begin(), knots.end());
        knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
        knots.push_back(to);
        const auto self = [this, outside](double nm) { return at(nm, outside); };
        double a = from;
        for (double b : knots) {
            if (!nearlyConstant(a, b)) appendSmoothBreaks(self, a, b, out);
            if (b < to) out.push_back(b);
            a = b;
        }
    }
    /// Where all inputs are tabulated.
    [[nodiscard]] std::optional<NmRange> range() const override {
        std::optional<NmRange> common;
        for (const Curve& input : inputs) {
            const auto r = input.range();
            if (r)
                common = common
                             ? NmRange{std::max(common->first, r->first), std::min(common->second, r->second)}
                             : *r;
        }
        if (common && common->first > common->second) common->second = common->first;
        return common;
    }
    [[nodiscard]] std::optional<NmRange> support(Outside) const override {
        if (inputs.empty() || f(std::vector<double>(inputs.size(), 0.0)) != 0) return std::nullopt;
        std::optional<NmRange> hull;
        for (const Curve& input : inputs) {
            const auto r = input.support();
            if (!r) return std::nullopt;
            hull = hull ? NmRange{std::min(hull->first, r->first), std::max(hull->second, r->second)} : *r;
        }
        return hull;
    }
    [[nodiscard]] bool isConstant(Outside) const override {
        return std::all_of(inputs.begin(), inputs.end(), [](const Curve& c) { return c.isConstant(); });
    }
};

/// ∫ f tᵏ dt over [−1, 1], k = 0…2, t the place between a and b, from that part of it between c and d.
struct Moments {
    std::array<double, 3> m{};
    double largest = 0;

    void add(const std::function<double(double)>& f, double a, double b, double c, double d) {
        for (size_t i = 0; i < gaussNodes.size(); ++i) {
            const double nm = (c + d) / 2 + gaussNodes[i] * (d - c) / 2, v = f(nm);
            const double t = (2 * nm - a - b) / (b - a), w = gaussWeights[i] * (d - c) / (b - a);
            m[0] += w * v;
            m[1] += w * v * t;
            m[2] += w * v * t * t;
            largest = std::max(largest, std::abs(v));
        }
    }
};

void refine(const std::function<double(double)>& f, double a, double b, int depth, std::vector<double>& out) {
    const double middle = a + (b - a) / 2;
    if (depth == 0 || !(middle > a && middle < b)) return;
    Moments whole, halves;
    whole.add(f, a, b, a, b);
    halves.add(f, a, b, a, middle);
    halves.add(f, a, b, middle, b);
    double error = 0;
    for (size_t k = 0; k < whole.m.size(); ++k)
        error = std::max(error, std::abs(whole.m[k] - halves.m[k]));
    if (error <= 1e-11 * std::max(whole.largest, halves.largest)) return;
    refine(f, a, middle, depth - 1, out);
    out.push_back(middle);
    refine(f, middle, b, depth - 1, out);
}

}  // namespace

void appendSmoothBreaks(const std::function<double(double)>& f, double from, double to,
                        std::vector<double>& out) {
    if (from < to) refine(f, from, to, 8, out);
}

Curve Curve::gaussian(double centre, double fwhm) {
    return Curve(std::make_shared<Gaussian>(centre, fwhm));
}

Curve Curve::blackbody(double kelvin) {
    return Curve(std::make_shared<Blackbody>(kelvin));
}

Curve Curve::formula(std::function<double(double)> at,
                     std::function<void(double, double, std::vector<double>&)> breaks,
                     std::optional<std::pair<double, double>> range) {
    auto body = std::make_shared<Formula>();
    body->f = std::move(at);
    body->breaks = std::move(breaks);
    body->limits = range;
    return Curve(std::move(body));
}

Curve Curve::combined(std::vector<Curve> inputs, std::function<double(std::span<const double>)> f) {
    for (const Curve& input : inputs)
        if (!input.lines().empty())
            throw InputError("a spectral line of no width has no values to compute with; give it a width");
    auto body = std::make_shared<Combined>();
    body->inputs = std::move(inputs);
    body->f = std::move(f);
    return Curve(std::move(body));
}

}  // namespace spectrad
