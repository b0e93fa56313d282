// A fluorophore in the figures that laboratories quote: peaks, Stokes shift, quantum yield, energy.
#include "render/cumulative.h"
#include "render/fluorescence.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

namespace {

/// Where a curve is largest: of a table at a sample, of a formula to a tenth of a nanometre.
std::optional<double> peakOf(const Curve& curve) {
    const auto nm = curve.sampleWavelengths(), value = curve.sampleValues();
    if (!nm.empty())
        return nm[static_cast<size_t>(std::max_element(value.begin(), value.end()) - value.begin())];
    const auto range = curve.range();
    if (!range) return std::nullopt;
    double best = range->first;
    for (double tenth = std::ceil(10 * range->first); tenth <= 10 * range->second; ++tenth)
        if (curve.at(tenth / 10) > curve.at(best)) best = tenth / 10;
    return best;
}

/// Trapezoids over the emission of a column, each row weighed.
template <typename Weight>
double columnSum(const std::vector<double>& emission, const std::vector<std::vector<double>>& value,
                 size_t column, Weight weight) {
    double sum = 0;
    for (size_t row = 0; row + 1 < emission.size(); ++row)
        sum += 0.5 *
               (value[row][column] * weight(emission[row]) +
                value[row + 1][column] * weight(emission[row + 1])) *
               (emission[row + 1] - emission[row]);
    return sum;
}

}  // namespace

double FluorescentBase::Bispectral::energyOut(size_t column) const {
    return columnSum(emission, value, column, [](double) { return 1.0; }) / width(column);
}

double FluorescentBase::Bispectral::photonsOut(size_t column) const {
    const double in = bandCentre[column];
    return columnSum(emission, value, column, [in](double out) { return out / in; }) / width(column);
}

FluorophoreFigures FluorescentBase::figuresOf(const Separable& part) const {
    FluorophoreFigures figures;
    figures.excitationPeak = peakOf(part.excitation);
    figures.emissionPeak = peakOf(part.emission);
    figures.yield = part.yield * part.strength;  // the rest is the base's, as in a measured matrix
    const auto range = part.emission.range();
    if (figures.excitationPeak && range && !part.antiStokes) {
        // Of the emission only what lies above the excitation leaves.
        const Curve photons =
            Curve::formula([](double nm) { return nm; }, [](double, double, std::vector<double>&) {});
        const std::array<const Curve*, 2> product{&part.emission, &photons};
        const double from = std::clamp(*figures.excitationPeak, range->first, range->second);
        figures.yield *= integrate(product, from, range->second) / integrate(product);
    }
    return figures;
}

FluorophoreFigures FluorescentBase::figuresOf(const Bispectral& part) const {
    FluorophoreFigures figures;
    size_t column = 0;
    for (size_t i = 1; i < part.bandCentre.size(); ++i)
        if (part.photonsOut(i) > part.photonsOut(column)) column = i;
    size_t row = 0;
    for (size_t r = 1; r < part.emission.size(); ++r)
        if (part.value[r][column] > part.value[row][column]) row = r;
    figures.matrix = part.changes;
    if (!(part.photonsOut(column) > 0)) return figures;
    figures.excitationPeak = part.bandCentre[column];
    figures.emissionPeak = part.emission[row];
    const double absorbed = 1 - base_.at(part.bandCentre[column]);
    if (absorbed > 0) figures.yield = part.photonsOut(column) / absorbed;
    return figures;
}

std::vector<FluorophoreFigures> FluorescentBase::figures() const {
    std::vector<FluorophoreFigures> all;
    for (const Separable& part : separable_)
        all.push_back(figuresOf(part));
    for (const Bispectral& part : bispectral_)
        all.push_back(figuresOf(part));
    return all;
}

}  // namespace spectrad
