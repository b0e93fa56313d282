#include "image/cube.h"

#include <algorithm>
#include <array>

namespace spectrad {

namespace {

struct KindWords {
    CubeKind kind;
    std::string_view name, unit, column;
};
constexpr std::array<KindWords, 4> kinds{
    {{CubeKind::radiance, "radiance", "W.m^-2.sr^-1.nm^-1", "radiance_W_m2_sr_nm"},
     {CubeKind::irradiance, "irradiance", "W.m^-2.nm^-1", "irradiance_W_m2_nm"},
     {CubeKind::reflectance, "reflectance", "", "reflectance"},
     {CubeKind::transmittance, "transmittance", "", "transmittance"}}};

const KindWords& wordsOf(CubeKind kind) {
    return *std::find_if(kinds.begin(), kinds.end(), [&](const KindWords& k) { return k.kind == kind; });
}

}  // namespace

std::string_view name(CubeKind kind) {
    return wordsOf(kind).name;
}

std::optional<CubeKind> parseCubeKind(std::string_view text) {
    for (const KindWords& k : kinds)
        if (k.name == text) return k.kind;
    return std::nullopt;
}

std::string_view unit(CubeKind kind) {
    return wordsOf(kind).unit;
}

std::string_view columnName(CubeKind kind) {
    return wordsOf(kind).column;
}

}  // namespace spectrad
