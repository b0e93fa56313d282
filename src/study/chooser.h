// The cheapest settings that keep an image of a scene within a tolerance.
#pragma once

#include "study/contestant.h"
#include "verify/tolerance.h"

namespace spectrad {

/// What the user has fixed already; the rest is chosen.
struct ChooserSettings {
    Tolerance tolerance;
    RenderSettings render;  ///< wavelengths, samples: fixed where they are given
    bool half = false;      ///< fixed where true
    bool mayHalf = true;    ///< false for files that have no half
};

struct Choice {
    std::string what, why;  ///< "12 bands", one line of reasons
};

struct Chosen {
    Wavelengths wavelengths;
    int samples = 64;
    bool half = false, schlick = false;
    bool met = false;
    double reached = 0;         ///< in the tolerance's own measure, on the picture that was tried
    int width = 0, height = 0;  ///< of that picture
    White white;                ///< of ΔE00
    std::vector<Choice> choices;
};

/// Tries settings on the scene's own picture (made smaller beyond 700 000 pixels, where edges count for
/// more; for `max:` beyond 4 million), against 64 samples with exact spectra. Throws InputError for what
/// cannot be certified.
[[nodiscard]] Chosen choose(const Scene& scene, const ChooserSettings& settings, const Detector& observer,
                            const Library& library, const Device& device, const Planner& planner,
                            const Progress& progress);

}  // namespace spectrad
