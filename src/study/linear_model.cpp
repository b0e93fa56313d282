#include "study/linear_model.h"

#include "render/columns.h"
#include "study/eigen.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

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
    std::vector<double> gram(terms * terms);
    for (size_t i = 0; i < terms; ++i)
        for (size_t j = i; j < terms; ++j)
            for (size_t b = 0; b < bands; ++b)
                gram[i * terms + j] += shape[i][b] * shape[j][b];
    const Eigen eigen = eigenOf(std::move(gram), terms);

    std::vector<std::vector<double>> basis;
    for (size_t k = 0; k < std::min<size_t>(static_cast<size_t>(count), terms); ++k) {
        if (eigen.value[k] <= 1e-14 * eigen.value[0]) break;
        std::vector<double> component(bands, 0);
        for (size_t t = 0; t < terms; ++t)
            for (size_t b = 0; b < bands; ++b)
                component[b] += eigen.vector[k][t] * shape[t][b] / std::sqrt(eigen.value[k]);
        basis.push_back(std::move(component));
    }
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
