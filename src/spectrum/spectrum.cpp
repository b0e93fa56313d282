#include "spectrum/spectrum.h"

#include "base/text.h"

#include <fmt/format.h>

#include <array>

namespace spectrad {

static constexpr std::array<std::string_view, 11> quantityNames{
    "unknown", "reflectance", "transmittance", "radiance",    "irradiance", "intensity",
    "power",   "sensitivity", "index",         "reradiation", "density"};

std::string_view name(Quantity quantity) {
    return quantityNames.at(static_cast<size_t>(quantity));
}

Quantity parseQuantity(std::string_view text, const SourceLocation& where) {
    // "unknown" is what a file says by saying nothing; nobody may write it.
    for (size_t i = 1; i < quantityNames.size(); ++i)
        if (text == quantityNames[i]) return static_cast<Quantity>(i);
    const std::vector<std::string> known(quantityNames.begin() + 1, quantityNames.end());
    throw InputError(where, fmt::format("unknown quantity '{}'{} (allowed: {})", text,
                                        didYouMean(text, known), fmt::join(known, ", ")));
}

}  // namespace spectrad
