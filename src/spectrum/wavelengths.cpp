#include "spectrum/wavelengths.h"

#include "base/limits.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

namespace {

constexpr double shortestNm = 1, longestNm = 1e6;  // 1 nm to 1 mm
constexpr std::array<std::string_view, 3> projectionNames{"slit", "box", "point"};
constexpr std::string_view allowedForms =
    "(allowed: from:to:step, as in 380:780:5, or a list, as in 400,405.2,410)";

void checkCount(double count, const SourceLocation& where) {
    if (count > static_cast<double>(maxBands))
        throw InputError(where,
                         fmt::format("{:.0f} wavelengths, more than the limit of {}", count, maxBands));
}

void checkRange(double nm, const SourceLocation& where) {
    if (!(nm >= shortestNm && nm <= longestNm))
        throw InputError(where, fmt::format("wavelength {} nm (allowed: {} … {} nm)", shortest(nm),
                                            shortest(shortestNm), shortest(longestNm)));
}

void checkAscending(const std::vector<double>& nm, const SourceLocation& where) {
    for (size_t i = 1; i < nm.size(); ++i)
        if (!(nm[i] > nm[i - 1]))
            throw InputError(where, fmt::format("wavelengths must ascend, but {} nm follows {} nm",
                                                shortest(nm[i]), shortest(nm[i - 1])));
}

double number(std::string_view text, const SourceLocation& where) {
    const auto value = parseDouble(text);
    if (!value) throw InputError(where, fmt::format("'{}' is not a wavelength in nm {}", text, allowedForms));
    return *value;
}

/// One formula for the border of two boxes, so that both put it on the same double.
double middle(double a, double b) {
    return a + (b - a) / 2;
}

}  // namespace

std::string_view name(Projection projection) {
    return projectionNames.at(static_cast<size_t>(projection));
}

Projection parseProjection(std::string_view text, const SourceLocation& where) {
    for (size_t i = 0; i < projectionNames.size(); ++i)
        if (text == projectionNames[i]) return static_cast<Projection>(i);
    const std::vector<std::string> known(projectionNames.begin(), projectionNames.end());
    throw InputError(where, fmt::format("unknown projection '{}'{} (allowed: slit, box, point)", text,
                                        didYouMean(text, known)));
}

Wavelengths regularWavelengths(double from, double to, double step, const SourceLocation& where) {
    checkRange(from, where);
    checkRange(to, where);
    if (to < from)
        throw InputError(where, fmt::format("wavelengths must ascend, but they go from {} nm to {} nm",
                                            shortest(from), shortest(to)));
    if (!(step > 0 && std::isfinite(step)))
        throw InputError(where, fmt::format("step {} nm (allowed: a number above 0)", shortest(step)));
    // The end counts when it is a billionth of a step away: 400:700:0.1 means 3001 bands in spite of binary
    // fractions.
    const double steps = std::floor((to - from) / step + 1e-9);
    checkCount(steps + 1, where);
    Wavelengths grid;
    grid.step = step;
    for (size_t i = 0; i <= static_cast<size_t>(steps); ++i)
        grid.nm.push_back(from + static_cast<double>(i) * step);
    if (std::abs(grid.nm.back() - to) <= 1e-9 * step) grid.nm.back() = to;
    checkAscending(grid.nm, where);
    return grid;
}

Wavelengths parseWavelengths(std::string_view text, const SourceLocation& where) {
    if (text.find(':') != std::string_view::npos) {
        const auto parts = split(text, ':');
        if (parts.size() != 3)
            throw InputError(where, fmt::format("wavelengths '{}' {}", trimmed(text), allowedForms));
        return regularWavelengths(number(parts[0], where), number(parts[1], where), number(parts[2], where),
                                  where);
    }
    Wavelengths grid;
    const bool commas = text.find(',') != std::string_view::npos;
    for (std::string_view part : split(text, ',')) {
        const auto numbers = words(part);
        if (numbers.empty() && commas)
            throw InputError(where, fmt::format("a wavelength is missing between commas {}", allowedForms));
        for (std::string_view word : numbers)
            grid.nm.push_back(number(word, where));
    }
    if (grid.nm.empty()) throw InputError(where, fmt::format("no wavelengths {}", allowedForms));
    checkCount(static_cast<double>(grid.nm.size()), where);
    for (double nm : grid.nm)
        checkRange(nm, where);
    checkAscending(grid.nm, where);
    return grid;
}

Band band(const Wavelengths& grid, size_t j) {
    const double nm = grid.nm[j];
    const bool first = j == 0, last = j + 1 == grid.size();
    const bool alone = first && last;
    switch (grid.projection) {
        case Projection::point:
            return {nm, nm, nm, 1, 1};
        case Projection::box: {
            // A lone box is one step wide; neither reaches below zero wavelength.
            const double half = std::min(grid.step / 2, nm);
            if (alone) return {nm - half, nm, nm + half, 1, 1};
            const double from = first ? nm : middle(grid.nm[j - 1], nm);
            const double to = last ? nm : middle(nm, grid.nm[j + 1]);
            return {from, nm, to, 1, 1};
        }
        case Projection::slit:
            break;
    }
    const double half = std::min(grid.step, nm);
    if (alone) return {nm - half, nm, nm + half, 0, 0};
    return {first ? nm : grid.nm[j - 1], nm, last ? nm : grid.nm[j + 1], first ? 1.0 : 0.0, last ? 1.0 : 0.0};
}

double Band::weight(double lambda) const {
    if (lambda < from || lambda > to) return 0;
    if (lambda < nm) return atFrom + (1 - atFrom) * ((lambda - from) / (nm - from));
    if (lambda > nm) return atTo + (1 - atTo) * ((to - lambda) / (to - nm));
    return 1;
}

double Band::area() const {
    return (nm - from) * (1 + atFrom) / 2 + (to - nm) * (1 + atTo) / 2;
}

int decimalsToTellApart(const Wavelengths& grid) {
    int decimals = 6;
    for (size_t i = 1; i < grid.size(); ++i)
        while (decimals < 20 && fmt::format("{:.{}f}", grid.nm[i], decimals) ==
                                    fmt::format("{:.{}f}", grid.nm[i - 1], decimals))
            ++decimals;
    return decimals;
}

}  // namespace spectrad
