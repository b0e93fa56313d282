#include "spectrum/curve.h"

#include "base/error.h"
#include "base/text.h"
#include "spectrum/curve_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

struct Constant final : Curve::Body {
    double value = 0;

    explicit Constant(double v) : value(v) {}
    [[nodiscard]] double at(double, Outside) const override { return value; }
    void appendBreaks(double, double, Outside, std::vector<double>&) const override {}
    [[nodiscard]] bool isConstant(Outside) const override { return true; }
    /// Nothing at all has an integral, of zero; a constant has none.
    [[nodiscard]] std::optional<NmRange> support(Outside) const override {
        return value == 0 ? std::optional(NmRange{0, 0}) : std::nullopt;
    }
};

struct Line final : Curve::Body {
    SpectralLine line{};

    explicit Line(SpectralLine l) : line(l) {}
    [[nodiscard]] double at(double, Outside) const override { return 0; }
    void appendBreaks(double, double, Outside, std::vector<double>&) const override {}
    [[nodiscard]] std::optional<NmRange> range() const override { return NmRange{line.nm, line.nm}; }
    /// Nothing of a line is to be held beyond it.
    [[nodiscard]] std::optional<NmRange> support(Outside) const override { return range(); }
    [[nodiscard]] std::span<const SpectralLine> lines() const override { return {&line, 1}; }
    [[nodiscard]] std::shared_ptr<const Body> scaled(double factor) const override {
        return std::make_shared<Line>(SpectralLine{line.nm, line.integral * factor});
    }
};

struct Table final : Curve::Body {
    std::vector<double> nm, value;

    Table(std::vector<double> n, std::vector<double> v) : nm(std::move(n)), value(std::move(v)) {}

    [[nodiscard]] double beyond(double lambda, Outside outside) const {
        if (outside == Outside::zero) return 0;
        return lambda < nm.front() ? value.front() : value.back();
    }
    /// The value at lambda, where `upper` is the first sample that is not below it.
    [[nodiscard]] double within(double lambda, size_t upper) const {
        if (nm[upper] == lambda) {
            const bool jump = upper + 1 < nm.size() && nm[upper + 1] == lambda;
            return jump ? value[upper] / 2 + value[upper + 1] / 2 : value[upper];
        }
        const double t = (lambda - nm[upper - 1]) / (nm[upper] - nm[upper - 1]);
        return value[upper - 1] * (1 - t) + value[upper] * t;
    }
    [[nodiscard]] double at(double lambda, Outside outside) const override {
        if (lambda < nm.front() || lambda > nm.back()) return beyond(lambda, outside);
        return within(lambda,
                      static_cast<size_t>(std::lower_bound(nm.begin(), nm.end(), lambda) - nm.begin()));
    }
    void values(std::span<const double> lambdas, std::span<double> out, Outside outside) const override {
        if (lambdas.empty()) return;
        size_t upper =
            static_cast<size_t>(std::lower_bound(nm.begin(), nm.end(), lambdas.front()) - nm.begin());
        for (size_t i = 0; i < lambdas.size(); ++i) {
            const double lambda = lambdas[i];
            while (upper < nm.size() && nm[upper] < lambda)
                ++upper;
            out[i] =
                lambda < nm.front() || upper == nm.size() ? beyond(lambda, outside) : within(lambda, upper);
        }
    }
    void appendBreaks(double from, double to, Outside, std::vector<double>& out) const override {
        for (auto i = std::upper_bound(nm.begin(), nm.end(), from); i != nm.end() && *i < to; ++i)
            if (i == nm.begin() || *i != *(i - 1)) out.push_back(*i);
    }
    [[nodiscard]] std::optional<NmRange> range() const override { return NmRange{nm.front(), nm.back()}; }
    [[nodiscard]] std::span<const double> sampleWavelengths() const override { return nm; }
    [[nodiscard]] std::span<const double> sampleValues() const override { return value; }
    [[nodiscard]] bool isConstant(Outside outside) const override {
        return outside == Outside::hold &&
               std::all_of(value.begin(), value.end(), [this](double v) { return v == value.front(); });
    }
    [[nodiscard]] std::shared_ptr<const Body> scaled(double factor) const override {
        std::vector<double> product = value;
        for (double& v : product)
            v *= factor;
        return std::make_shared<Table>(nm, std::move(product));
    }
};

void checkSamples(const std::vector<double>& nm, const std::vector<double>& value) {
    if (nm.empty() || nm.size() != value.size())
        throw InputError(fmt::format("a spectrum of {} wavelengths and {} values", nm.size(), value.size()));
    for (size_t i = 0; i < nm.size(); ++i) {
        if (!std::isfinite(nm[i]) || !std::isfinite(value[i]))
            throw InputError(fmt::format("a spectrum's sample {} is not finite", i + 1));
        if (i > 0 && nm[i] < nm[i - 1])
            throw InputError(fmt::format("wavelengths must ascend, but {} nm follows {} nm", shortest(nm[i]),
                                         shortest(nm[i - 1])));
        if (i > 1 && nm[i] == nm[i - 2])
            throw InputError(fmt::format("more than two values at {} nm", shortest(nm[i])));
    }
}

}  // namespace

Curve::Curve() : Curve(std::make_shared<Constant>(0.0)) {}

Curve Curve::table(std::vector<double> nm, std::vector<double> value, Outside outside) {
    checkSamples(nm, value);
    Curve curve(std::make_shared<Table>(std::move(nm), std::move(value)));
    curve.outside_ = outside;
    return curve;
}

Curve Curve::constant(double value) {
    return Curve(std::make_shared<Constant>(value));
}

Curve Curve::line(double nm, double integral) {
    return Curve(std::make_shared<Line>(SpectralLine{nm, integral}));
}

Curve Curve::rectangle(double centre, double width) {
    const double from = centre - width / 2, to = centre + width / 2;
    if (!(to > from)) return line(centre);  // narrower than doubles can tell
    const double height =
        1 / (to - from);  // of the edges as rounded, so that the integral is 1 however narrow
    return table({from, to}, {height, height});
}

double Curve::at(double nm) const {
    return scale_ * body_->at(nm, outside_);
}

void Curve::values(std::span<const double> nm, std::span<double> out) const {
    body_->values(nm, out, outside_);
    if (scale_ != 1)
        for (double& v : out)
            v *= scale_;
}

std::span<const SpectralLine> Curve::lines() const {
    return body_->lines();
}

void Curve::appendBreaks(double from, double to, std::vector<double>& out) const {
    body_->appendBreaks(from, to, outside_, out);
}

std::optional<std::pair<double, double>> Curve::range() const {
    return body_->range();
}

std::optional<std::pair<double, double>> Curve::support() const {
    return body_->support(outside_);
}

std::span<const double> Curve::sampleWavelengths() const {
    return body_->sampleWavelengths();
}

std::span<const double> Curve::sampleValues() const {
    return body_->sampleValues();
}

Curve Curve::scaled(double factor) const {
    Curve result = *this;
    if (auto copy = body_->scaled(factor))
        result.body_ = std::move(copy);
    else if (body_->isConstant(outside_))
        result.body_ = std::make_shared<Constant>(at(0) * factor), result.scale_ = 1;
    else
        result.scale_ *= factor;
    return result;
}

Curve Curve::withOutside(Outside outside) const {
    Curve result = *this;
    result.outside_ = outside;
    return result;
}

Outside Curve::outside() const {
    return outside_;
}

bool Curve::isConstant() const {
    return body_->isConstant(outside_);
}

std::pair<double, double> Curve::bounds() const {
    if (const auto samples = sampleValues(); !samples.empty()) {
        const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
        return {*low, *high};
    }
    const auto [from, to] = range().value_or(NmRange{200, 20'000});
    std::vector<double> nm{from};
    appendBreaks(from, to, nm);
    nm.push_back(to);
    std::vector<double> value(nm.size());
    values(nm, value);
    const auto [low, high] = std::minmax_element(value.begin(), value.end());
    return {*low, *high};
}

}  // namespace spectrad
