// The white that colours are seen against.
#pragma once

#include "colour/observe.h"

#include <optional>
#include <string>

namespace spectrad {

/// Y of the perfect diffuser (or of no filter) where nothing but the light gives a scale.
inline constexpr double diffuserY = 100;

struct White {
    std::string name;     ///< as the user wrote it, or the spectrum's name
    Triple xyz{1, 1, 1};  ///< Y in cd/m² with a luminance, else Y is 1
    bool hasLuminance = false;
};

/// `text` as --white takes it: X,Y,Z in numbers ("95.05,100,108.9": absolute, with luminance), or a light's
/// spectrum (its chromaticity). "at:X,Y" is for the caller, who has the image (see whiteAt). A detector
/// without X, Y, Z sees the light through `matrix` (towardsXyz); for X, Y, Z it may be empty. Throws
/// InputError: unknown spectrum, numbers that are no light, a light that the detector does not see.
[[nodiscard]] White whiteFor(const std::string& text, const Detector& detector, const XyzMatrix& matrix,
                             const SpectrumResolver& resolver, const SourceLocation& where);
/// The chromaticity of a light: what whiteFor makes of a spectrum.
[[nodiscard]] White whiteOf(const std::string& name, const Curve& light, const Detector& detector,
                            const XyzMatrix& matrix, const SourceLocation& where);
/// A pixel of an XYZ image, with its luminance. Throws InputError outside the image, and for a pixel that is
/// black.
[[nodiscard]] White whiteAt(const ChannelImage& xyz, int x, int y);

/// "0.95,1,1.09": three numbers of which none is negative and the second is positive.
[[nodiscard]] std::optional<Triple> parseXyz(const std::string& text);

/// The same white at a luminance of `y` cd/m²; one that has a luminance keeps it.
[[nodiscard]] White withLuminance(White white, double y);

}  // namespace spectrad
