#include "colour/white.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace spectrad {

static bool isLight(const Triple& xyz) {
    return std::all_of(xyz.begin(), xyz.end(), [](double c) { return std::isfinite(c); }) && xyz[1] > 0;
}

White whiteOf(const std::string& name, const Curve& light, const Detector& detector, const XyzMatrix& matrix,
              const SourceLocation& where) {
    const std::array<const Curve*, 1> product{&light};
    const std::vector<double> channels = respond(detector, product);
    const Triple xyz =
        detector.tristimulus ? Triple{channels[0], channels[1], channels[2]} : toXyz(matrix, channels);
    if (!isLight(xyz))
        throw InputError(where,
                         "'" + name + "' cannot be a white: '" + detector.name + "' sees no light of it");
    return {name, {xyz[0] / xyz[1], 1, xyz[2] / xyz[1]}, false};
}

/// "95.05,100,108.9" and the like: every piece a number. A lone number is a name.
static std::optional<std::vector<double>> numbersIn(std::string_view text) {
    std::vector<double> values;
    for (std::string_view piece : split(text, ',')) {
        const auto value = parseDouble(piece);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    if (values.size() < 2) return std::nullopt;
    return values;
}

White whiteFor(const std::string& text, const Detector& detector, const XyzMatrix& matrix,
               const SpectrumResolver& resolver, const SourceLocation& where) {
    if (const auto values = numbersIn(text)) {
        const bool negative = std::any_of(values->begin(), values->end(), [](double v) { return v < 0; });
        if (values->size() != 3 || negative || !((*values)[1] > 0))
            throw InputError(where,
                             "the white '" + text +
                                 "' is no light (allowed: X,Y,Z with Y in cd/m2 above 0, none negative)");
        return {text, {(*values)[0], (*values)[1], (*values)[2]}, true};
    }
    return whiteOf(text, resolver.resolve(text, Role::light, where).curve(), detector, matrix, where);
}

White whiteAt(const ChannelImage& xyz, int x, int y) {
    const std::string place = "at:" + std::to_string(x) + "," + std::to_string(y);
    if (x < 0 || y < 0 || x >= xyz.width || y >= xyz.height)
        throw InputError("the white '" + place + "' lies outside the image (allowed: at:0,0 to at:" +
                         std::to_string(xyz.width - 1) + "," + std::to_string(xyz.height - 1) + ")");
    const Triple value =
        xyz.triple(static_cast<size_t>(y) * static_cast<size_t>(xyz.width) + static_cast<size_t>(x));
    if (!isLight(value)) throw InputError("the white '" + place + "' is a pixel without light");
    return {place, value, true};
}

std::optional<Triple> parseXyz(const std::string& text) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 3) return std::nullopt;
    Triple triple{};
    for (size_t i = 0; i < 3; ++i) {
        const std::optional<double> value = parseDouble(parts[i]);
        if (!value || *value < 0) return std::nullopt;
        triple[i] = *value;
    }
    return triple[1] > 0 ? std::optional(triple) : std::nullopt;
}

White withLuminance(White white, double y) {
    if (white.hasLuminance) return white;
    for (double& c : white.xyz)
        c *= y;
    white.hasLuminance = true;
    return white;
}

}  // namespace spectrad
