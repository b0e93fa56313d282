// All that a picture depends on, as plain values: whoever has a copy can paint it, on any thread.
#pragma once

#include "colour/rendering.h"
#include "colour/spectral_display.h"
#include "viewer/look.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace spectrad::view {

enum class Mode {
    single,      ///< look A
    split,       ///< A left of the divider, B right of it
    difference,  ///< ΔE00 between A and B, as false colours
    mixture      ///< lights part A's, part B's
};

/// What a cube shows: colours, or its bands as they are.
enum class Picture { observer, band, falseColour };

/// Bands as a picture: one is grey, three are red, green and blue.
struct BandPicture {
    std::array<size_t, 3> bands{};  ///< indices; all the same: grey
    double ev = 0;
    Display display = srgbDisplay();
    /// The value shown as white, a channel: 1 of a ratio, else the band's 99th percentile, both × 2^−ev.
    std::array<double, 3> white{};
};

/// Where the camera stands; kept apart from the scene's own so that the first picture is exactly its.
struct Pose {
    Vec3 eye, target, up;
    double pixelsPerSlopeOverHeight = 1;  ///< see View: zoom that does not depend on the window's size
    bool orthographic = false;
};
[[nodiscard]] bool same(const Pose& a, const Pose& b);

/// How a scene is looked at: from where, how large, how finely. Of no use to a cube.
struct Stand {
    Pose pose;
    int width = 0, height = 0;
    std::optional<int> samples;  ///< a pixel; the scene's own if not said
};

struct Wish {
    std::array<Look, 2> looks;
    Stand stand;
    Mode mode = Mode::single;
    double mix = 0.5;
    Adaptation adaptation = Adaptation::cat16;
    std::string white;              ///< as observe --white takes it; empty: the look's first light
    std::string display = "srgb";   ///< as observe --display takes it …
    Display codes = srgbDisplay();  ///< … what that is, unless it is one by its primaries:
    std::shared_ptr<const SpectralDisplay> primaries;
    std::optional<double>
        heldLuminance;       ///< cd/m² shown as display white before ± EV; nothing: to be measured
    bool automatic = false;  ///< exposure from the picture whatever the white
    double ev = 0, degree = 1;
    Tone tone = Tone::linear;
    GamutMapping mapping = GamutMapping::clip;
    Picture picture = Picture::observer;
    BandPicture bands;          ///< of a cube: its band is the first of them while one is shown
    double differenceTop = 10;  ///< ΔE00 drawn in the last colour

    /// The display as the look's eye sees it; `standard`: who sees it where the eye has not X, Y and Z.
    [[nodiscard]] Display displayFor(const Look& look, const Detector& standard) const;
    /// The same for the same picture.
    [[nodiscard]] std::string key() const;
};

}  // namespace spectrad::view
