// What each feature of a scene costs, and what the picture would be without it.
#pragma once

#include "study/contestant.h"
#include "verify/certificate.h"

namespace spectrad {

class TextureLoader;

/// A scene without one of its features.
struct Simpler {
    std::string feature;  ///< named as in a plan
    std::string instead;  ///< what stands in its place
    Scene scene;
};
/// One for each feature that the plan has and that can be left out, and for exact metals and dispersion.
/// Textures become their mean reflectance, metals matt surfaces of their reflectance at normal incidence.
[[nodiscard]] std::vector<Simpler> simplerScenes(const Scene& scene, const Plan& plan,
                                                 TextureLoader& textures);

/// Of rendering: with a feature − without it. `uncertainty`: two standard errors; a difference within it is
/// 0.
struct TimeDifference {
    double seconds = 0, uncertainty = 0;
};
/// The median of pairs measured in turn, and what their scatter leaves of it in doubt.
[[nodiscard]] TimeDifference timeDifference(const std::vector<double>& with,
                                            const std::vector<double>& without);

struct FeatureCost {
    std::string feature, instead;
    TimeDifference time;
    std::int64_t stripBytes = 0;  ///< the same of a strip's buffers on the device
    std::int64_t triangles = 0, terms = 0;
    double deltaMean = 0, deltaP99 = 0, deltaMax = 0;  ///< ΔE00 between the pictures with and without it
};
struct CostReport {
    double seconds = 0;  ///< of rendering all
    std::uint64_t stripBytes = 0;
    int width = 0, height = 0;
    White white;
    std::vector<FeatureCost> features;
    std::vector<std::string> leftOut;  ///< "FEATURE: why it cannot do without", one line each
};
/// `settings`: size and bands of the pictures that are compared.
[[nodiscard]] CostReport costOf(const Scene& scene, const RenderSettings& settings, const Detector& observer,
                                const Library& library, const Device& device, const Planner& planner,
                                TextureLoader& textures);

}  // namespace spectrad
