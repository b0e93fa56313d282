#include "render/cube_light.h"

#include "base/text.h"

#include <cmath>

namespace spectrad {

namespace {

bool sameChromaticity(const Triple& a, const Triple& b) {
    constexpr double tolerance = 1e-4;
    const auto xyA = chromaticity(a), xyB = chromaticity(b);
    return xyA && xyB && std::hypot((*xyA)[0] - (*xyB)[0], (*xyA)[1] - (*xyB)[1]) < tolerance;
}

}  // namespace

bool needsLight(CubeKind kind) {
    return kind == CubeKind::reflectance || kind == CubeKind::transmittance;
}

Detector litBy(const Spectrum& light, const Detector& detector, const Detector& standard) {
    const std::array<const Curve*, 1> alone{&light.curve()};
    const double y = respond(detector.tristimulus ? detector : standard, alone)[1];
    if (!(y > 0))
        throw InputError("'" + light.text +
                         "' cannot light a reflectance cube: the observer sees no light of it");
    Detector lit = detector;
    for (Curve& response : lit.response)
        response =
            Curve::combined({response, light.curve()}, [](std::span<const double> v) { return v[0] * v[1]; });
    lit.scale *= diffuserY / y;
    return lit;
}

std::optional<Spectrum> statedLight(const CubeInfo& info, const Detector& standard,
                                    const SpectrumResolver& resolver) {
    const auto xyz = info.attributes.find(attribute::whiteXyz), name = info.attributes.find(attribute::white);
    if (xyz == info.attributes.end() || name == info.attributes.end()) return std::nullopt;
    const std::optional<Triple> stated = parseXyz(xyz->second);
    if (!stated) return std::nullopt;
    try {
        Spectrum light = resolver.resolve(name->second, Role::light, {});
        const std::array<const Curve*, 1> alone{&light.curve()};
        if (sameChromaticity(respondXyz(standard, alone), *stated)) return light;
    } catch (const InputError&) {
        // Not in the library.
    }
    return std::nullopt;
}

White statedWhite(const CubeInfo& info, const Detector& detector, const XyzMatrix& toXyz,
                  const Detector& standard, const SpectrumResolver& resolver, Notes& notes) {
    const auto xyz = info.attributes.find(attribute::whiteXyz), name = info.attributes.find(attribute::white);
    const std::optional<Triple> stated = xyz == info.attributes.end() ? std::nullopt : parseXyz(xyz->second);
    if (!stated) {
        White white = whiteFor("constant:1", detector, toXyz, resolver, {});
        white.name = "E";
        return white;
    }
    White known{name == info.attributes.end() ? xyz->second : name->second, *stated, false};
    if (detector.name.ends_with("cie1931-2")) return known;
    // Another observer wants the light's spectrum. A name that is the library's says it; one of the scene's
    // own may by chance name another light here, which its chromaticity betrays.
    if (statedLight(info, standard, resolver)) return whiteFor(known.name, detector, toXyz, resolver, {});
    notes.warn("the spectrum of the white '" + known.name +
               "' is not known here: its CIE 1931 chromaticity is used (--white)");
    return known;
}

}  // namespace spectrad
