// Measured curves read and integrated without the library's code: what band values and colours are held
// against.
#pragma once

#include "spectrum/wavelengths.h"

#include <initializer_list>
#include <string>
#include <vector>

namespace spectrad::test {

/// Linear between samples.
struct Polyline {
    std::vector<double> nm, value;
    bool held = false;  ///< beyond its range: the end values; else zero

    [[nodiscard]] long double at(long double lambda) const;
};

/// A file of spectra/: "illuminants/FL11"; one curve a column, their names in the file's head.
struct Table {
    std::vector<std::string> columns;
    std::vector<Polyline> curves;
};
[[nodiscard]] Table measuredTable(const std::string& name);
/// All names in a folder of spectra/, with the folder, sorted.
[[nodiscard]] std::vector<std::string> measuredNames(const std::string& folder);

/// ∫ of the product over [from, to], in nm. A 2-point Gauss rule between all neighbouring samples: exact for
/// up to three factors, and never on a sample, where a curve may jump.
[[nodiscard]] long double integral(std::initializer_list<const Polyline*> product, double from, double to);
[[nodiscard]] long double integral(const Polyline& curve);

/// The mean of a product of two under the hat, box or point of a band, as docs/format.md words it.
[[nodiscard]] double bandValue(const Polyline& a, const Polyline& b, const Wavelengths& grid, size_t band);

}  // namespace spectrad::test
