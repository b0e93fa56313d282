#include "metamer/viewing.h"

#include "spectrum/projection.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

Viewing::Viewing(std::string name, Curve light, Detector detector, const Detector& standard)
    : name_(std::move(name)), light_(std::move(light)), detector_(std::move(detector)) {
    if (!detector_.tristimulus) toXyz_ = towardsXyz(detector_, standard);
    const std::array<const Curve*, 1> alone{&light_};
    const std::vector<double> channels = respond(detector_, alone);
    const double most =
        detector_.tristimulus ? channels[1] : *std::max_element(channels.begin(), channels.end());
    if (!(most > 0))
        throw InputError("'" + detector_.name + "' sees nothing of the light of '" + name_ + "'");
    scale_ = 1 / most;
    white_ = xyz(Curve::constant(1));
    if (!(*std::min_element(white_.begin(), white_.end()) > 0))
        throw InputError("the white of '" + name_ + "' lacks X, Y or Z: CIELAB is undefined for it");
}

std::vector<double> Viewing::signals(const Curve& reflectance) const {
    const std::array<const Curve*, 2> product{&light_, &reflectance};
    std::vector<double> channels = respond(detector_, product);
    for (double& c : channels)
        c *= scale_;
    return channels;
}

Triple Viewing::xyz(const Curve& reflectance) const {
    const std::vector<double> c = signals(reflectance);
    return detector_.tristimulus ? Triple{c[0], c[1], c[2]} : toXyz(toXyz_, c);
}

Triple Viewing::labOf(const Triple& xyz) const {
    return spectrad::lab(xyz, white_);
}

Triple Viewing::lab(const Curve& reflectance) const {
    return labOf(xyz(reflectance));
}

std::vector<std::vector<double>> Viewing::weights(const std::vector<double>& nm) const {
    Wavelengths grid;
    grid.nm = nm;
    std::vector<std::vector<double>> result;
    for (const Curve& response : detector_.response) {
        const std::array<const Curve*, 2> product{&light_, &response};
        std::vector<double> row(nm.size());
        for (size_t j = 0; j < nm.size(); ++j) {
            // A hat is a curve: light × response × hat is integrated like any other product.
            const double left = j > 0 ? nm[j - 1] : nm[j], right = j + 1 < nm.size() ? nm[j + 1] : nm[j];
            std::vector<double> at, value;
            if (left < nm[j]) at.push_back(left), value.push_back(0);
            at.push_back(nm[j]), value.push_back(1);
            if (right > nm[j]) at.push_back(right), value.push_back(0);
            const Curve hat = Curve::table(at, value);
            const std::array<const Curve*, 3> under{&light_, &response, &hat};
            row[j] = left < right ? integrate(under, left, right) : 0;
        }
        const double far = 10'000;  // nm; detectors end long before
        // A line on the outermost wavelength is under its hat already: what lies beyond begins next to it.
        row.front() += integrate(product, 1, std::nextafter(nm.front(), 0));
        row.back() += integrate(product, std::nextafter(nm.back(), far), far);
        for (double& w : row)
            w *= scale_ * detector_.scale;
        result.push_back(std::move(row));
    }
    return result;
}

double difference(const Viewing& viewing, const Curve& a, const Curve& b) {
    return deltaE00(viewing.lab(a), viewing.lab(b));
}

MetamerismIndex specialMetamerismIndex(const Viewing& reference, const Viewing& test, const Curve& a,
                                       const Curve& b) {
    const Triple referenceA = reference.xyz(a), referenceB = reference.xyz(b);
    Triple corrected = test.xyz(b);
    for (size_t k = 0; k < 3; ++k)
        if (referenceB[k] > 0) corrected[k] *= referenceA[k] / referenceB[k];
    const Triple labA = test.lab(a), labB = test.labOf(corrected);
    return {std::hypot(labA[0] - labB[0], labA[1] - labB[1], labA[2] - labB[2]), deltaE00(labA, labB)};
}

}  // namespace spectrad
