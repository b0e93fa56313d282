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

RenderedPicture render(const ChannelImage& xyz, const Rendering& rendering) {
    constexpr double tolerance = 1e-4;  // as develop()
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
        Triple signal = toSignals * xyz.triple(i);
        const auto luminanceOf = [&] { return (base.display.toXyz * signal)[1]; };
        if (rendering.tone == Tone::reinhard) {
            const double factor = toneFactor(luminanceOf());
            for (double& s : signal)
                s *= factor;
        }
        const bool below =
            *std::min_element(
                signal.begin(),
                signal.end())<-tolerance, above = *std::max_element(signal.begin(), signal.end())> 1 +
            tolerance;
        if (below || above) ++picture.clipped;
        const double y = luminanceOf();
        const std::uint8_t level = grey(0.8 * y);
        const std::array<std::uint8_t, 3> mark{above ? std::uint8_t{255} : std::uint8_t{0}, 0,
                                               below ? std::uint8_t{255} : std::uint8_t{0}};
        const double share = rendering.gamut == GamutMapping::desaturate ? desaturation(signal, y) : 0;
        for (size_t c = 0; c < 3; ++c) {
            const double shown =
                std::clamp(signal[c] + share * (std::clamp(y, 0.0, 1.0) - signal[c]), 0.0, 1.0);
            result.signals.plane[c][i] = shown;
            picture.rgb[3 * i + c] = encoder(shown);
            result.map[3 * i + c] = below || above ? mark[c] : level;
        }
    }
    return result;
}

}  // namespace spectrad
