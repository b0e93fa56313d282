// A spectrum as the user named it: one or more curves with what they measure.
#pragma once

#include "base/error.h"
#include "spectrum/curve.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

enum class Quantity {
    unknown,
    reflectance,
    transmittance,
    radiance,
    irradiance,
    intensity,
    power,
    sensitivity,
    index,
    reradiation,
    density  ///< optical density, −lg of a transmittance
};
[[nodiscard]] std::string_view name(Quantity quantity);
/// Throws InputError (with the allowed names) for an unknown one.
[[nodiscard]] Quantity parseQuantity(std::string_view text, const SourceLocation& where);

struct Spectrum {
    std::string text;  ///< as the user wrote it: "illuminants/D65", "paint", "lamp.csv#3", …
    Quantity quantity = Quantity::unknown;
    std::string unit;        ///< of the values: "1", "W.m^-2.sr^-1.nm^-1", …; may be empty if not stated
    bool relative = false;   ///< only the shape is meant
    bool electrons = false;  ///< a sensitivity of electrons per joule: a quantum efficiency times λ/hc
    bool formula = false;    ///< made from a formula (blackbody:…, constant:…), not from samples
    std::vector<std::string>
        channels;  ///< names of the curves; one for a plain spectrum, X Y Z for an observer
    std::vector<Curve> curves;
    std::optional<double> efficacy;  ///< lm/W of a product's observer, which its filters do not change
    std::vector<std::filesystem::path> files;  ///< files that were read for it
    std::string source, licence;               ///< where the data come from, if the file says

    [[nodiscard]] const Curve& curve() const { return curves.front(); }
};

}  // namespace spectrad
