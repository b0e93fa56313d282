#include "colour/rendering.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

constexpr double brightest = 4;  ///< times the exposure's white, that Reinhard's curve shows as white

/// What moves a luminance onto the curve, as a factor of all signals.
double toneFactor(double luminance) {
    if (!(luminance > 0)) return 1;
    return (1 + luminance / (brightest * brightest)) / (1 + luminance);
}

/// The share of the way to grey `y` that brings every signal into 0…1.
double desaturation(const Triple& signal, double y) {
    const double grey = std::clamp(y, 0.0, 1.0);
    double share = 0;
    for (const double s : signal) {
        if (s > 1) share = std::max(share, (s - 1) / (s - grey));
        if (s < 0) share = std::max(share, s / (s - grey));
    }
    return std::min(share, 1.0);
}

}  // namespace

Tone parseTone(std::string_view text) {
    if (text == "linear") return Tone::linear;
    if (text == "reinhard") return Tone::reinhard;
    const std::vector<std::string> known{"linear", "reinhard"};
    throw UsageError("unknown tone curve '" + std::string(text) + "' (allowed: linear, reinhard)" +
                     didYouMean(text, known));
}

GamutMapping parseGamutMapping(std::string_view text) {
    if (text == "clip") return GamutMapping::clip;
    if (text == "desaturate") return GamutMapping::desaturate;
    const std::vector<std::string> known{"clip", "desaturate"};
    throw UsageError("unknown gamut mapping '" + std::string(text) + "' (allowed: clip, desaturate)" +
                     didYouMean(text, known));
}

Matrix3 renderingMatrix(const Rendering& rendering, double whiteLuminance) {
    const DevelopSettings& base = rendering.base;
    // Scaling cone responses by D · gain + 1 − D is, the cones being linear, the same mixture of the
    // matrices.
    Matrix3 adapted = adaptation(base.adaptation, base.white.xyz, base.display.white);
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            adapted[i][j] = rendering.degree * adapted[i][j] + (i == j ? 1 - rendering.degree : 0);
    const double scale = 1 / whiteLuminance;
    return base.display.fromXyz * adapted * diagonal({scale, scale, scale});
}

Triple toned(const Triple& signals, const Display& display, Tone tone) {
    if (tone == Tone::linear) return signals;
    const double factor = toneFactor((display.toXyz * signals)[1]);
    return {signals[0] * factor, signals[1] * factor, signals[2] * factor};
}

ShownSignals shownSignals(Triple signals, const Display& display, Tone tone, GamutMapping gamut) {
    signals = toned(signals, display, tone);
    const auto [least, most] = std::minmax_element(signals.begin(), signals.end());
    ShownSignals shown{signals, (display.toXyz * signals)[1],
                       *least<-signalTolerance, *most> 1 + signalTolerance};
    const double share = gamut == GamutMapping::desaturate ? desaturation(signals, shown.luminance) : 0;
    for (double& s : shown.signals)
        s = std::clamp(s + share * (std::clamp(shown.luminance, 0.0, 1.0) - s), 0.0, 1.0);
    return shown;
}

RenderedPicture render(const ChannelImage& xyz, const Rendering& rendering) {
    const DevelopSettings& base = rendering.base;
    RenderedPicture result;
    DevelopedPicture& picture = result.picture;
    picture.width = xyz.width;
    picture.height = xyz.height;
    picture.whiteLuminance = displayWhiteLuminance(xyz, base);
    picture.rgb.resize(3 * xyz.pixels());
    result.map.resize(3 * xyz.pixels());
    result.signals = ChannelImage(xyz.width, xyz.height, 3);
    const Matrix3 toSignals = renderingMatrix(rendering, picture.whiteLuminance);
    const Encoder8 encoder(base.display), grey(srgbDisplay());
    for (size_t i = 0; i < xyz.pixels(); ++i) {
        const ShownSignals shown =
            shownSignals(toSignals * xyz.triple(i), base.display, rendering.tone, rendering.gamut);
        const bool outside = shown.below || shown.above;
        if (outside) ++picture.clipped;
        const std::uint8_t level = grey(0.8 * shown.luminance);
        const std::array<std::uint8_t, 3> mark{shown.above ? std::uint8_t{255} : std::uint8_t{0}, 0,
                                               shown.below ? std::uint8_t{255} : std::uint8_t{0}};
        for (size_t c = 0; c < 3; ++c) {
            result.signals.plane[c][i] = shown.signals[c];
            picture.rgb[3 * i + c] = encoder(shown.signals[c]);
            result.map[3 * i + c] = outside ? mark[c] : level;
        }
    }
    return result;
}

}  // namespace spectrad
