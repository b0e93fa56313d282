#include "spectrum/projection.h"

#include "base/error.h"
#include "base/text.h"
#include "spectrum/gauss.h"
#include "spectrum/mass_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace spectrad {

namespace {

/// Where a product is sampled, ascending, and what a sample's value is multiplied by in ∫ dλ.
struct Quadrature {
    std::vector<double> nm, weight;
};

/// Merges the ascending run that starts at `middle` into the ascending values before it.
void mergeRun(std::vector<double>& values, size_t middle) {
    std::inplace_merge(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle), values.end());
}

/// Gauss nodes in every segment between the union of `knots` (ascending, at least two) and the curves'
/// breaks.
Quadrature quadrature(Product product, std::vector<double> knots) {
    const double from = knots.front(), to = knots.back();
    for (const Curve* curve : product) {
        const size_t before = knots.size();
        curve->appendBreaks(from, to, knots);
        mergeRun(knots, before);
    }
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    Quadrature result;
    result.nm.reserve(4 * knots.size());
    result.weight.reserve(4 * knots.size());
    for (size_t s = 0; s + 1 < knots.size(); ++s) {
        const double half = (knots[s + 1] - knots[s]) / 2, middle = knots[s] + half;
        for (size_t k = 0; k < gaussNodes.size(); ++k) {
            result.nm.push_back(middle + gaussNodes[k] * half);
            result.weight.push_back(gaussWeights[k] * half);
        }
    }
    return result;
}

/// Values of the product, lines left out, at ascending wavelengths.
std::vector<double> productAt(Product product, std::span<const double> nm) {
    std::vector<double> result(nm.size(), 1.0), factor(nm.size());
    for (const Curve* curve : product) {
        curve->values(nm, factor);
        for (size_t i = 0; i < nm.size(); ++i)
            result[i] *= factor[i];
    }
    return result;
}

/// The product's lines, each times the other factors at its place. A curve has lines or values, never both.
std::vector<SpectralLine> linesOf(Product product) {
    const Curve* lined = nullptr;
    for (const Curve* curve : product) {
        if (curve->lines().empty()) continue;
        if (lined)
            throw InputError(fmt::format(
                "the spectral lines at {} nm and {} nm are multiplied, but have no width; give one of "
                "them a width, as in line:632.8,0.01",
                shortest(lined->lines().front().nm), shortest(curve->lines().front().nm)));
        lined = curve;
    }
    if (!lined) return {};
    std::vector<SpectralLine> lines(lined->lines().begin(), lined->lines().end());
    for (SpectralLine& line : lines)
        for (const Curve* curve : product)
            if (curve != lined) line.integral *= curve->at(line.nm);
    return lines;
}

/// Share of a line at `nm` in band j; one on the edge between two boxes belongs half to each, so that no
/// power is lost.
double lineWeight(const Wavelengths& grid, size_t j, double nm) {
    const Band b = band(grid, j);
    if (grid.projection == Projection::slit) return b.weight(nm);
    if (nm < b.from || nm > b.to) return 0;
    const bool shared = (nm == b.from && j > 0) || (nm == b.to && j + 1 < grid.size());
    return shared ? 0.5 : 1.0;
}

void addLines(const Wavelengths& grid, Product product, std::vector<CompensatedSum>& sums) {
    for (const SpectralLine& line : linesOf(product)) {
        // Bands that reach the line are the neighbours of the first node not below it.
        const auto at = std::lower_bound(grid.nm.begin(), grid.nm.end(), line.nm) - grid.nm.begin();
        const size_t node = static_cast<size_t>(at), last = std::min(node + 1, grid.size() - 1);
        for (size_t j = node > 0 ? node - 1 : 0; j <= last; ++j)
            sums[j].add(line.integral * lineWeight(grid, j, line.nm));
    }
}

/// Edges of the pieces on which each band's weight is linear: the wavelengths for hats, the borders for
/// boxes.
std::vector<double> bandKnots(const Wavelengths& grid) {
    std::vector<double> knots;
    knots.reserve(grid.size() + 2);
    if (grid.projection == Projection::slit && grid.size() > 1) return grid.nm;
    for (size_t j = 0; j < grid.size(); ++j) {
        const Band b = band(grid, j);
        if (j == 0) knots.push_back(b.from);
        if (grid.projection == Projection::slit) knots.push_back(b.nm);
        knots.push_back(b.to);
    }
    return knots;
}

/// ∫ Π h_j dλ for slit and box, all bands in one sweep over the ascending samples.
std::vector<double> bandIntegrals(const Wavelengths& grid, Product product) {
    const std::vector<double> knots = bandKnots(grid);
    const Quadrature samples = quadrature(product, knots);
    const std::vector<double> value = productAt(product, samples.nm);
    std::vector<CompensatedSum> sums(grid.size());
    size_t piece = 0;  // samples lie between knots[piece] and knots[piece + 1]
    for (size_t i = 0; i < value.size(); ++i) {
        const double nm = samples.nm[i], term = samples.weight[i] * value[i];
        while (piece + 2 < knots.size() && nm > knots[piece + 1])
            ++piece;
        if (grid.projection == Projection::box) {
            sums[piece].add(term);
            continue;
        }
        const double width = knots[piece + 1] - knots[piece];
        const double rising = (nm - knots[piece]) / width, falling = (knots[piece + 1] - nm) / width;
        if (grid.size() == 1) {
            sums[0].add(term * (piece == 0 ? rising : falling));
        } else {
            sums[piece].add(term * falling);
            sums[piece + 1].add(term * rising);
        }
    }
    addLines(grid, product, sums);
    std::vector<double> result;
    result.reserve(sums.size());
    for (const CompensatedSum& sum : sums)
        result.push_back(sum.value());
    return result;
}

std::vector<double> pointValues(const Wavelengths& grid, Product product) {
    for (const SpectralLine& line : linesOf(product))
        if (std::binary_search(grid.nm.begin(), grid.nm.end(), line.nm))
            throw InputError(fmt::format(
                "the spectral line at {} nm lies on a wavelength of a point projection, where a line of "
                "no width is infinite; use projection slit or box, or give it a width, as in line:{},0.01",
                shortest(line.nm), shortest(line.nm)));
    return productAt(product, grid.nm);
}

/// What a band's value stands for on the wavelength axis under the trapezoid rule, nm; one step for a lone
/// wavelength.
double trapezoidWidth(const Wavelengths& grid, size_t j) {
    if (grid.size() == 1) return grid.step;
    const double before = j > 0 ? grid.nm[j] - grid.nm[j - 1] : 0;
    const double after = j + 1 < grid.size() ? grid.nm[j + 1] - grid.nm[j] : 0;
    return (before + after) / 2;
}

}  // namespace

double integrate(Product product, double from, double to) {
    CompensatedSum sum;
    if (from < to) {
        const Quadrature samples = quadrature(product, {from, to});
        const std::vector<double> value = productAt(product, samples.nm);
        for (size_t i = 0; i < value.size(); ++i)
            sum.add(samples.weight[i] * value[i]);
    }
    for (const SpectralLine& line : linesOf(product))
        if (line.nm >= from && line.nm <= to) sum.add(line.integral);
    return sum.value();
}

double integrate(Product product) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double from = -infinity, to = infinity;
    for (const Curve* curve : product) {
        const auto support = curve->support();
        if (!support) continue;
        from = std::max(from, support->first);
        to = std::min(to, support->second);
    }
    if (from == -infinity || to == infinity)
        throw InputError(
            "the spectrum goes on at all wavelengths and has no integral; say a range, as in 'over 400:700'");
    return from <= to ? integrate(product, from, to) : 0;
}

std::vector<double> project(const Wavelengths& grid, Product product) {
    if (grid.projection == Projection::point) return pointValues(grid, product);
    std::vector<double> values = bandIntegrals(grid, product);
    for (size_t j = 0; j < values.size(); ++j)
        values[j] /= band(grid, j).area();
    return values;
}

std::vector<double> moments(const Wavelengths& grid, const Curve& curve) {
    const Curve* const factor = &curve;
    const Product product(&factor, 1);
    if (grid.projection != Projection::point) return bandIntegrals(grid, product);
    std::vector<double> values = pointValues(grid, product);
    for (size_t j = 0; j < values.size(); ++j)
        values[j] *= trapezoidWidth(grid, j);
    return values;
}

std::vector<double> detectorWeights(const Wavelengths& grid, const Curve& detector) {
    std::vector<double> weights = moments(grid, detector);
    // Boxes are orthogonal: the detector's average times the width is its integral over the box. A lone hat
    // stands for the light under it, so that a line at its peak is weighed as the detector weighs it.
    if (grid.projection != Projection::slit || grid.size() == 1) return weights;
    // Nodal values x of the detector's projection on the hats; Σ x_j ⟨L, h_j⟩ with ⟨L, h_j⟩ = L_j ∫ h_j.
    MassMatrix(grid.nm).solve(weights);
    for (size_t j = 0; j < weights.size(); ++j)
        weights[j] *= band(grid, j).area();
    return weights;
}

std::vector<double> nodalValues(const Wavelengths& grid, std::span<const double> values) {
    std::vector<double> nodal(values.begin(), values.end());
    if (grid.projection != Projection::slit || grid.size() == 1) return nodal;
    for (size_t j = 0; j < nodal.size(); ++j)
        nodal[j] *= band(grid, j).area();
    MassMatrix(grid.nm).solve(nodal);
    return nodal;
}

}  // namespace spectrad
