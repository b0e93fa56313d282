#include "scenes/measured.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace spectrad::test {

namespace fs = std::filesystem;

long double Polyline::at(long double lambda) const {
    if (lambda <= nm.front()) return lambda == nm.front() || held ? value.front() : 0;
    if (lambda >= nm.back()) return lambda == nm.back() || held ? value.back() : 0;
    const auto right = static_cast<size_t>(std::upper_bound(nm.begin(), nm.end(), lambda) - nm.begin());
    const long double from = nm[right - 1], to = nm[right];
    const long double t = (lambda - from) / (to - from);
    return value[right - 1] * (1 - t) + value[right] * t;
}

Table measuredTable(const std::string& name) {
    std::ifstream file(fs::path(SPECTRAD_SOURCE) / "spectra" / (name + ".csv"));
    Table table;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        const auto cells = split(line, ',');
        if (table.columns.empty()) {
            table.columns.assign(cells.begin() + 1, cells.end());
            table.curves.resize(table.columns.size());
            continue;
        }
        for (size_t c = 0; c < table.curves.size(); ++c) {
            table.curves[c].nm.push_back(parseDouble(cells.at(0)).value());
            table.curves[c].value.push_back(parseDouble(cells.at(c + 1)).value());
        }
    }
    if (table.curves.empty()) throw std::runtime_error("no table " + name);
    return table;
}

std::vector<std::string> measuredNames(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(SPECTRAD_SOURCE) / "spectra" / folder))
        if (entry.path().extension() == ".csv") names.push_back(folder + "/" + entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

long double integral(std::initializer_list<const Polyline*> product, double from, double to) {
    std::vector<double> knots{from, to};
    for (const Polyline* curve : product)
        for (double nm : curve->nm)
            if (nm > from && nm < to) knots.push_back(nm);
    std::sort(knots.begin(), knots.end());
    const long double offset = 0.5L / std::sqrt(3.0L);
    long double sum = 0;
    for (size_t i = 1; i < knots.size(); ++i) {
        const long double width = static_cast<long double>(knots[i]) - knots[i - 1];
        if (width == 0) continue;
        for (long double t : {0.5L - offset, 0.5L + offset}) {
            long double value = 1;
            for (const Polyline* curve : product)
                value *= curve->at(knots[i - 1] + t * width);
            sum += 0.5L * width * value;
        }
    }
    return sum;
}

long double integral(const Polyline& curve) {
    return integral({&curve}, curve.nm.front(), curve.nm.back());
}

double bandValue(const Polyline& a, const Polyline& b, const Wavelengths& grid, size_t band) {
    const double here = grid.nm[band];
    if (grid.projection == Projection::point) return static_cast<double>(a.at(here) * b.at(here));
    const bool first = band == 0, last = band + 1 == grid.size(), alone = first && last;
    Polyline weight;
    if (grid.projection == Projection::slit) {
        if (!first || alone)
            weight.nm.push_back(alone ? here - grid.step : grid.nm[band - 1]), weight.value.push_back(0);
        weight.nm.push_back(here), weight.value.push_back(1);
        if (!last || alone)
            weight.nm.push_back(alone ? here + grid.step : grid.nm[band + 1]), weight.value.push_back(0);
    } else {
        const double from = alone ? here - grid.step / 2 : first ? here : (grid.nm[band - 1] + here) / 2;
        const double to = alone ? here + grid.step / 2 : last ? here : (here + grid.nm[band + 1]) / 2;
        weight = {{from, to}, {1, 1}};
    }
    return static_cast<double>(integral({&a, &b, &weight}, weight.nm.front(), weight.nm.back()) /
                               integral(weight));
}

}  // namespace spectrad::test
