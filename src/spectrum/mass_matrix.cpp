#include "spectrum/mass_matrix.h"

namespace spectrad {

MassMatrix::MassMatrix(std::span<const double> nm) : off_(nm.size() - 1), inverse_(nm.size()) {
    // ∫ h_j² = (d_{j−1} + d_j) / 3 with d the distances between neighbours.
    for (size_t j = 0; j + 1 < nm.size(); ++j)
        off_[j] = (nm[j + 1] - nm[j]) / 6;
    for (size_t j = 0; j < nm.size(); ++j) {
        const double before = j > 0 ? off_[j - 1] : 0, after = j + 1 < nm.size() ? off_[j] : 0;
        const double eliminated = j > 0 ? before * before * inverse_[j - 1] : 0;
        inverse_[j] = 1 / (2 * (before + after) - eliminated);
    }
}

void MassMatrix::solve(std::span<double> x) const {
    for (size_t j = 1; j < inverse_.size(); ++j)
        x[j] -= off_[j - 1] * inverse_[j - 1] * x[j - 1];
    for (size_t j = inverse_.size(); j-- > 0;) {
        if (j + 1 < inverse_.size()) x[j] -= off_[j] * x[j + 1];
        x[j] *= inverse_[j];
    }
}

void MassMatrix::solveAll(std::span<double> x, size_t count) const {
    const size_t nodes = inverse_.size();
    for (size_t j = 1; j < nodes; ++j) {
        const double factor = off_[j - 1] * inverse_[j - 1];
        const double* before = x.data() + (j - 1) * count;
        double* here = x.data() + j * count;
        for (size_t i = 0; i < count; ++i)
            here[i] -= factor * before[i];
    }
    for (size_t j = nodes; j-- > 0;) {
        double* here = x.data() + j * count;
        const double* after = here + count;
        const double off = j + 1 < nodes ? off_[j] : 0, inverse = inverse_[j];
        if (j + 1 < nodes)
            for (size_t i = 0; i < count; ++i)
                here[i] = (here[i] - off * after[i]) * inverse;
        else
            for (size_t i = 0; i < count; ++i)
                here[i] *= inverse;
    }
}

}  // namespace spectrad
