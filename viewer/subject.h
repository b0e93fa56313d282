// What the viewer shows: a scene, or a cube that is there already. Each answers the same few questions.
//
// Who may ask: const members say what never changes after opening, and any thread may call them; all others
// belong to whoever holds the subject (viewer/painter.h).
#pragma once

#include "colour/observe.h"
#include "image/cube.h"
#include "spectrum/wavelengths.h"
#include "viewer/still.h"
#include "viewer/wish.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace spectrad::view {

/// How XYZ become a display's codes.
struct Shown {
    Matrix3 toSignals{};  ///< absolute XYZ to linear signals (renderingMatrix)
    Display display = srgbDisplay();
    Tone tone = Tone::linear;
    GamutMapping gamut = GamutMapping::clip;
};

/// A picture of codes, 0xAABBGGRR, A = 254 where a colour lies outside the display's gamut.
using Codes = std::vector<std::uint32_t>;

/// As observe makes them.
void encodeCodes(const ChannelImage& xyz, const Shown& shown, Codes& codes);

class Subject {
  public:
    virtual ~Subject() = default;
    Subject() = default;
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    /// The file that was opened, and every file that it was made of.
    [[nodiscard]] virtual std::filesystem::path file() const = 0;
    [[nodiscard]] virtual std::vector<std::filesystem::path> files() const = 0;
    [[nodiscard]] virtual Look firstLook() const = 0;
    /// Its own size; a scene can be looked at in others.
    [[nodiscard]] virtual int width() const = 0;
    [[nodiscard]] virtual int height() const = 0;
    /// The bands of its spectra.
    [[nodiscard]] virtual const Wavelengths& wavelengths() const = 0;
    /// What its values are.
    [[nodiscard]] virtual CubeKind kind() const = 0;

    /// How it is looked at from now on.
    virtual void stand(const Stand&) {}
    /// What follows ends with Stopped (base/stopped.h) once that is asked for.
    void heed(std::stop_token stop) { stop_ = std::move(stop); }

    /// The picture as codes. With two looks `mix` goes from the first (0) to the second (1) by mixing their
    /// lights' spectra.
    virtual void show(const Look& look, const Shown& shown, Codes& codes) = 0;
    virtual void showMixed(const Look& a, const Look& b, double mix, const Shown& shown, Codes& codes) = 0;
    /// XYZ of all pixels, absolute.
    [[nodiscard]] virtual ChannelImage xyz(const Look& look) = 0;
    /// What show() has shown, for the meter.
    [[nodiscard]] virtual std::shared_ptr<Still> still(const Look& look) = 0;
    /// The white of the look: its first light's chromaticity (E where there is none).
    [[nodiscard]] virtual White white(const Look& look) = 0;
    /// How much of that light there is, photometric, in the light's own unit: its weight in a mixture.
    [[nodiscard]] virtual double whiteAmount(const Look& look) = 0;

  protected:
    [[nodiscard]] const std::stop_token& stop() const { return stop_; }

  private:
    std::stop_token stop_;
};

}  // namespace spectrad::view
