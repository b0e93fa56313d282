// What the viewer shows: a scene, or a cube that is there already. Each answers the same few questions.
#pragma once

#include "colour/develop.h"
#include "colour/observe.h"
#include "spectrum/wavelengths.h"
#include "viewer/look.h"

#include <cstdint>
#include <string>
#include <vector>

namespace spectrad::view {

/// Codes of a display: how XYZ become its signals.
struct Shown {
    Matrix3 toSignals{};  ///< absolute XYZ to linear signals (developMatrix)
    Display display = srgbDisplay();
};

class Subject {
  public:
    virtual ~Subject() = default;
    Subject() = default;
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    [[nodiscard]] virtual int width() const = 0;
    [[nodiscard]] virtual int height() const = 0;
    /// The bands that spectrumAt has.
    [[nodiscard]] virtual const Wavelengths& wavelengths() const = 0;
    /// "W.m^-2.sr^-1.nm^-1", or nothing for a ratio.
    [[nodiscard]] virtual std::string unit() const = 0;

    /// The picture as codes, 0xAABBGGRR, A = 254 where it lies outside the display's gamut. With two looks
    /// `mix` goes from the first (0) to the second (1) by mixing their lights' spectra.
    virtual void show(const Look& look, const Shown& shown, std::vector<std::uint32_t>& pixels) = 0;
    virtual void showMixed(const Look& a, const Look& b, double mix, const Shown& shown,
                           std::vector<std::uint32_t>& pixels) = 0;
    /// XYZ of all pixels, absolute.
    [[nodiscard]] virtual ChannelImage xyz(const Look& look) = 0;
    /// Band values of a pixel; empty outside the picture.
    [[nodiscard]] virtual std::vector<double> spectrumAt(int x, int y, const Look& look) = 0;
    /// The white of the look: its first light's chromaticity (E where there is none).
    [[nodiscard]] virtual White white(const Look& look) = 0;
    /// How much of that light there is, photometric, in the light's own unit: its weight in a mixture.
    [[nodiscard]] virtual double whiteAmount(const Look& look) = 0;
};

}  // namespace spectrad::view
