#include "image/envi_units.h"

#include "base/text.h"

#include <array>
#include <cmath>
#include <string>

namespace spectrad {

namespace {

enum class Part { power, area, angle, wavelength };

struct Name {
    std::string_view text;  ///< letters and digits in lower case; exponents keep their digit
    Part part;
    int exponent;  ///< of ten
};
constexpr std::array<Name, 33> names{{{"w", Part::power, 0},
                                      {"watt", Part::power, 0},
                                      {"watts", Part::power, 0},
                                      {"mw", Part::power, -3},
                                      {"milliwatt", Part::power, -3},
                                      {"milliwatts", Part::power, -3},
                                      {"uw", Part::power, -6},
                                      {"microwatt", Part::power, -6},
                                      {"microwatts", Part::power, -6},
                                      {"nw", Part::power, -9},
                                      {"nanowatt", Part::power, -9},
                                      {"nanowatts", Part::power, -9},
                                      {"m2", Part::area, 0},
                                      {"cm2", Part::area, 4},
                                      {"mm2", Part::area, 6},
                                      {"sr", Part::angle, 0},
                                      {"sr1", Part::angle, 0},
                                      {"str", Part::angle, 0},
                                      {"ster", Part::angle, 0},
                                      {"steradian", Part::angle, 0},
                                      {"nm", Part::wavelength, 0},
                                      {"nm1", Part::wavelength, 0},
                                      {"nanometer", Part::wavelength, 0},
                                      {"nanometers", Part::wavelength, 0},
                                      {"nanometre", Part::wavelength, 0},
                                      {"um", Part::wavelength, -3},
                                      {"um1", Part::wavelength, -3},
                                      {"micron", Part::wavelength, -3},
                                      {"microns", Part::wavelength, -3},
                                      {"micrometer", Part::wavelength, -3},
                                      {"micrometers", Part::wavelength, -3},
                                      {"micrometre", Part::wavelength, -3},
                                      {"a", Part::wavelength, 1}}};
constexpr unsigned everyPart = 0b1111;

/// Letters and digits in lower case, every µ (UTF-8's two, Latin-1's one) as u.
std::string bareOf(std::string_view text) {
    constexpr std::array<std::string_view, 3> micro{"\xc2\xb5", "\xce\xbc", "\xb5"};
    const std::string lower = lowerCase(text);
    std::string bare;
    for (text = lower; !text.empty();) {
        size_t taken = 1;
        char c = text.front();
        for (const std::string_view mu : micro)
            if (text.starts_with(mu)) c = 'u', taken = mu.size();
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) bare += c;
        text.remove_prefix(taken);
    }
    return bare;
}

/// The power of ten of `rest`, each part once; every way of cutting it into names is tried. The power comes
/// first.
std::optional<int> exponentOf(std::string_view rest, unsigned seen) {
    if (rest.empty()) return seen == everyPart ? std::optional(0) : std::nullopt;
    for (const Name& name : names) {
        const unsigned bit = 1u << static_cast<unsigned>(name.part);
        if ((seen & bit) != 0 || (seen == 0) != (name.part == Part::power) || !rest.starts_with(name.text))
            continue;
        if (const auto further = exponentOf(rest.substr(name.text.size()), seen | bit))
            return name.exponent + *further;
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> radianceUnit(std::string_view text) {
    const auto exponent = exponentOf(bareOf(text), 0);
    return exponent ? std::optional(std::pow(10.0, *exponent)) : std::nullopt;
}

}  // namespace spectrad
