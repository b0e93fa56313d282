#include "render/range_check.h"

#include "base/text.h"
#include "colour/detector.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

namespace {

constexpr double tolerated = 1e-3;

/// Largest share of a channel of the observer that light outside from…to contributes.
double shareOutside(const Curve& light, const Detector& observer, double from, double to) {
    double largest = 0;
    for (const Curve& response : observer.response) {
        const std::array<const Curve*, 2> product{&light, &response};
        const double all = integrate(product);
        if (all > 0) largest = std::max(largest, 1 - integrate(product, from, to) / all);
    }
    return largest;
}

}  // namespace

void checkRange(const Wavelengths& grid, const std::vector<LightGroup>& groups, const Detector& observer,
                Notes& notes) {
    // One band, or point samples far apart, are asked for by people who do not want a colour.
    if (grid.size() < 2) return;
    const double from = grid.nm.front(), to = grid.nm.back();
    for (const LightGroup& group : groups) {
        if (group.factor == 0) continue;
        const double share = shareOutside(group.spectrum, observer, from, to);
        if (!(share > tolerated)) continue;
        constexpr double step = 5, shortest = 360, longest = 830;  // nm, of the observer
        double low = std::min(from, longest), high = std::max(to, shortest);
        while (low > shortest && shareOutside(group.spectrum, observer, low, longest) > tolerated / 2)
            low -= step;
        while (high < longest && shareOutside(group.spectrum, observer, low, high) > tolerated)
            high += step;
        notes.warn(fmt::format(
            "'{}' sends {} % of an observer's response outside {}…{} nm; {}…{} nm would do", group.text,
            rounded(100 * share, share < 0.995 ? 2 : 3), spectrad::shortest(from), spectrad::shortest(to),
            spectrad::shortest(std::max(low, shortest)), spectrad::shortest(std::min(high, longest))));
    }
}

void noteExtensions(const Wavelengths& grid, const std::vector<const Material*>& materials, Notes& notes) {
    const auto check = [&](const Spectrum& spectrum) {
        const auto range = spectrum.curve().range();
        if (!range || spectrum.curve().isConstant()) return;
        if (grid.nm.front() >= range->first && grid.nm.back() <= range->second) return;
        notes.say(fmt::format(
            "'{}' was measured from {} to {} nm: its end values are held for the rest of {}…{} nm",
            spectrum.text, shortest(range->first), shortest(range->second), shortest(grid.nm.front()),
            shortest(grid.nm.back())));
    };
    for (const Material* material : materials) {
        if (material->diffuse && material->diffuse->reflectance) check(*material->diffuse->reflectance);
        if (material->gloss) check(material->gloss->ior);
        if (material->specular) check(material->specular->reflectance);
        if (material->conductor) check(material->conductor->ior);
    }
}

}  // namespace spectrad
