// The study of a scene: every contestant against the reference, under several lights and observers.
#pragma once

#include "opencl/device.h"
#include "study/contestant.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace spectrad {

struct StudySettings {
    std::vector<std::string> lights;  ///< spectra that every light wears in turn; "" is the scene's own
    std::vector<std::string> observers{"cie1931-2"};  ///< tristimulus
    RenderSettings render;                            ///< size, samples, camera, pass
    double budgetSeconds = 300;  ///< what is begun is finished; what does not fit any more is left out
    std::string folder;          ///< where files are tried out
};

/// One contestant under one light, for one observer.
struct StudyRow {
    std::string light, observer, key, knob, what;
    int bands = 0, samples = 0;
    double planSeconds = 0, renderSeconds = 0, writeSeconds = 0;
    std::uint64_t stripBytes = 0, fileBytes = 0;
    double deltaMean = 0, deltaP95 = 0, deltaP99 = 0, deltaMax = 0;  ///< ΔE00 against the reference
    int worstX = 0, worstY = 0;
    /// Of the bands, against the slit averages at the same wavelengths: see BandDifference. Only where
    /// `hasBands`.
    bool hasBands = false;
    double bandRelativeMax = 0, spectralAngleMax = 0;
    std::vector<float> map;  ///< ΔE00 of each pixel, row by row
    int width = 0, height = 0;
};

/// The spectrum of the pixel that is worst for points, as instruments of several kinds have it.
struct StudySpectrum {
    std::string light, observer, key;
    int x = 0, y = 0;
    std::vector<double> nm, radiance;  ///< W·m⁻²·sr⁻¹·nm⁻¹
};

struct StudyReport {
    std::vector<StudyRow> rows;
    std::vector<StudySpectrum> spectra;
    std::vector<std::string> leftOut;  ///< "LIGHT / OBSERVER / KEY: why", one line each
    double seconds = 0;
};

/// Hears of each row as soon as it is there, so that nothing is lost when the program is stopped.
using RowSink = std::function<void(const StudyRow&)>;

/// The name under which a row was done already: "LIGHT/OBSERVER/KEY".
[[nodiscard]] std::string doneName(const std::string& light, const std::string& observer,
                                   const std::string& key);

/// `done`: rows of an earlier run that need not be done again. Throws InputError for a scene without light,
/// or one whose picture is no radiance.
[[nodiscard]] StudyReport study(const Scene& scene, const StudySettings& settings, const Library& library,
                                const Device& device, const Planner& planner,
                                const std::set<std::string>& done, const RowSink& sink,
                                const Progress& progress);

}  // namespace spectrad
