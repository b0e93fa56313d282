// Channel names of the spectral EXR layout 1.0 (Fichet, Pacanowski, Wilkie, JCGT 10(3), 2021).
#pragma once

#include "image/cube.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

/// What a channel's name says:
///     channel = "S" ("0".."3") "." wave  |  "T" "." wave  |  "T" "." wave "." wave
///     wave    = digits ["," digits] [("e"|"E") ["+"|"-"] digits] [SI prefix] ("m" | "Hz")
struct SpectralChannel {
    enum class Kind { emissive, reflective, reradiation };
    Kind kind = Kind::emissive;
    int stokes = 0;        ///< 0…3 of an emissive channel
    double nm = 0;         ///< wavelength in vacuum; 0 or infinite where the name says so
    double emittedNm = 0;  ///< of a reradiation channel; `nm` is then the illumination's
};

/// The whole name as above (upper and lower case count, at least one digit in each number), or nothing.
[[nodiscard]] std::optional<SpectralChannel> parseChannelName(std::string_view name);

/// A wave as above (with a decimal comma in names, a decimal point elsewhere) as a wavelength in nm, or
/// nothing.
[[nodiscard]] std::optional<double> parseWave(std::string_view text, char decimalMark);

/// One name a band, of one width, so that alphabetical order is ascending order: "S0.380,000000nm", or "T."
/// for reflectance and transmittance. Throws InputError if two bands cannot be told apart within the 31 bytes
/// of a name that every reader takes.
[[nodiscard]] std::vector<std::string> bandNames(const Wavelengths& grid, CubeKind kind);

}  // namespace spectrad
