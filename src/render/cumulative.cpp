#include "render/cumulative.h"

#include "base/error.h"
#include "spectrum/gauss.h"
#include "spectrum/projection.h"

#include <algorithm>

namespace spectrad {

namespace {

/// By the 4-point Gauss rule, on a segment without breaks.
double segment(const std::vector<Curve>& factors, double from, double to) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0;
    for (size_t i = 0; i < gaussNodes.size(); ++i) {
        double product = gaussWeights[i];
        for (const Curve& factor : factors)
            product *= factor.at(middle + half * gaussNodes[i]);
        sum += product;
    }
    return sum * half;
}

}  // namespace

Cumulative::Cumulative(std::vector<Curve> weights, const Curve& light,
                       std::optional<std::pair<double, double>> range) {
    auto body = std::make_shared<Body>();
    const auto lightRange = light.range();
    if (!range && !lightRange)
        throw InputError("an excitation that goes on at all wavelengths needs a light that does not");
    body->from =
        std::max(range ? range->first : lightRange->first, lightRange ? lightRange->first : range->first);
    body->to =
        std::min(range ? range->second : lightRange->second, lightRange ? lightRange->second : range->second);
    body->factors = weights;
    body->factors.push_back(light);
    if (body->to > body->from) {
        body->knots = {body->from, body->to};
        for (const Curve& factor : body->factors)
            factor.appendBreaks(body->from, body->to, body->knots);
        std::sort(body->knots.begin(), body->knots.end());
        body->knots.erase(std::unique(body->knots.begin(), body->knots.end()), body->knots.end());
        double sum = 0;
        body->sums.push_back(0);
        for (size_t i = 0; i + 1 < body->knots.size(); ++i) {
            sum += segment(body->factors, body->knots[i], body->knots[i + 1]);
            body->sums.push_back(sum);
        }
    }
    double power = 0;
    for (const SpectralLine& line : light.lines()) {
        double product = line.integral;
        for (const Curve& weight : weights)
            product *= weight.at(line.nm);
        power += product;
        body->lines.emplace_back(line.nm, power);
    }
    body_ = body;
}

double Cumulative::upTo(double nm) const {
    const Body& b = *body_;
    double sum = 0;
    if (!b.knots.empty() && nm > b.from) {
        const double end = std::min(nm, b.to);
        const auto after = std::upper_bound(b.knots.begin(), b.knots.end(), end);
        const auto i = static_cast<size_t>(after - b.knots.begin()) - 1;
        sum = b.sums[i];
        if (end > b.knots[i]) sum += segment(b.factors, b.knots[i], end);
    }
    for (auto line = b.lines.rbegin(); line != b.lines.rend(); ++line)
        if (line->first <= nm) return sum + line->second;
    return sum;
}

double Cumulative::total() const {
    const Body& b = *body_;
    return (b.sums.empty() ? 0 : b.sums.back()) + (b.lines.empty() ? 0 : b.lines.back().second);
}

void Cumulative::appendBreaks(double from, double to, std::vector<double>& out) const {
    for (double knot : body_->knots)
        if (knot > from && knot < to) out.push_back(knot);
    for (const auto& line : body_->lines)
        if (line.first > from && line.first < to) out.push_back(line.first);
}

}  // namespace spectrad
