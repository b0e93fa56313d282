#include "study/linear_model.h"

#include "render/columns.h"
#include "study/eigen.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

/// The first components of the shapes, of unit length, by the smaller of the two matrices of inner products
/// that have them: a texture has a thousand terms and more.
std::vector<std::vector<double>> principal(const std::vector<std::vector<double>>& shape, size_t bands,
                                           size_t count) {
    const size_t terms = shape.size(), size = std::min(terms, bands);
    const bool ofTerms = terms <= bands;
    std::vector<double> products(size * size);
    for (size_t i = 0; i < size; ++i)
        for (size_t j = i; j < size; ++j)
            for (size_t k = 0; k < (ofTerms ? bands : terms); ++k)
                products[i * size + j] += ofTerms ? shape[i][k] * shape[j][k] : shape[k][i] * shape[k][j];
    const Eigen eigen = eigenOf(std::move(products), size);

    std::vector<std::vector<double>> basis;
    for (size_t k = 0; k < std::min(count, size); ++k) {
        if (eigen.value[k] <= 1e-14 * eigen.value[0]) break;
        if (!ofTerms) {
            basis.push_back(eigen.vector[k]);
            continue;
        }
        std::vector<double> component(bands, 0);
        for (size_t t = 0; t < terms; ++t)
            for (size_t b = 0; b < bands; ++b)
                component[b] += eigen.vector[k][t] * shape[t][b] / std::sqrt(eigen.value[k]);
        basis.push_back(std::move(component));
    }
    return basis;
}

}  // namespace

LinearModel inPrincipalComponents(Plan plan, const DetectorWeights& weights, int count) {
    const size_t bands = plan.terms.bands, terms = plan.terms.count();
    // Terms of a metre from a lamp and of the sun differ by powers of ten: each counts with its shape only.
    std::vector<std::vector<double>> shape(terms, std::vector<double>(bands, 0));
    for (size_t t = 0; t < terms; ++t) {
        double square = 0;
        for (size_t b = 0; b < bands; ++b)
            square += std::pow(double{plan.terms.spectra[t * bands + b]}, 2);
        const double scale = square > 0 ? 1 / std::sqrt(square) : 0;
        for (size_t b = 0; b < bands; ++b)
            shape[t][b] = scale * plan.terms.spectra[t * bands + b];
    }
    const std::vector<std::vector<double>> basis = principal(shape, bands, static_cast<size_t>(count));
    LinearModel model;
    std::vector<float> coefficients;
    for (size_t t = 0; t < terms; ++t) {
        for (const std::vector<double>& component : basis) {
            double sum = 0;
            for (size_t b = 0; b < bands; ++b)
                sum += component[b] * plan.terms.spectra[t * bands + b];
            coefficients.push_back(static_cast<float>(sum));
        }
    }
    for (const std::vector<double>& channel : weights.weights) {
        std::vector<double> onBasis;
        for (const std::vector<double>& component : basis) {
            double sum = 0;
            for (size_t b = 0; b < bands; ++b)
                sum += component[b] * channel[b];
            onBasis.push_back(sum);
        }
        model.weights.weights.push_back(std::move(onBasis));
    }
    model.plan = withColumns(std::move(plan), std::move(coefficients), basis.size());
    return model;
}

}  // namespace spectrad
