// What choosing by colour and choosing by bands share: the picture that settings are tried on.
#pragma once

#include "study/chooser.h"

namespace spectrad {

/// Of the bound: another computer's rounding is not to break it.
inline constexpr double toleranceMargin = 0.99;

struct Choosing {
    const Scene& scene;
    const ChooserSettings& settings;
    const Detector& observer;
    const Library& library;
    const Device& device;
    const Planner& planner;
    const Progress& progress;
    Tolerance tolerance;   ///< with the margin
    RenderSettings asked;  ///< size of the picture; no projection
    Wavelengths grid;      ///< the scene's, or as asked for
    int width = 0, height = 0;

    [[nodiscard]] double pixels() const { return double{1} * width * height; }
    [[nodiscard]] std::vector<int> sampleCounts() const;
    /// Nothing where a pass cannot be rendered so: few samples may miss the light that it is divided by.
    [[nodiscard]] std::optional<Plan> planned(const Scene& of, const RenderSettings& wanted) const;
    /// Of each pixel's error the figure that the tolerance bounds.
    [[nodiscard]] double summed(std::vector<double> errors) const;
    [[nodiscard]] Chosen nothingYet() const;  ///< with the picture's size
};

/// Pixels' columns, and the time that rendering alone took.
struct Columns {
    std::vector<std::vector<float>> plane;  ///< [column][pixel]
    double seconds = 0;
};
[[nodiscard]] Columns rendered(const Device& device, const Plan& plan);

[[nodiscard]] Chosen chooseForColour(const Choosing& choosing);
[[nodiscard]] Chosen chooseForBands(const Choosing& choosing);

}  // namespace spectrad
