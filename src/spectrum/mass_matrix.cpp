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

}  // namespace spectrad
