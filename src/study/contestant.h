// Ways to render a scene that trade time for accuracy, and the ones that other renderers take.
#pragma once

#include "image/cube.h"
#include "render/plan.h"
#include "render/settings.h"
#include "study/three_channels.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

class Library;

/// What of a scene's rendering is varied.
enum class Knob { bands, samples, fresnel, texture, arithmetic, output, baseline };
[[nodiscard]] std::string_view name(Knob knob);

/// How the finished bands are kept.
struct OutputForm {
    bool half = false;
    int mantissaBits = 24;  ///< significant bits that are kept of a float, 8…24
    Compression compression = Compression::piz;
    bool operator==(const OutputForm&) const = default;
};

enum class Method { spectral, rgb, xyz, quadrature, linearModel, adaptive };

struct Contestant {
    std::string key;   ///< "slit-5nm", unique
    std::string what;  ///< one line for people
    Knob knob = Knob::bands;
    Method method = Method::spectral;
    int order = 0;  ///< wavelengths of a quadrature or adaptive ones, components of a linear model
    Wavelengths wavelengths;
    int samples = 16;
    bool schlick = false;
    std::optional<TextureFilter> filter;  ///< instead of the scene's own
    std::vector<std::string> switches;    ///< of the kernels: "CONTRACT", "FAST_MATH" (see opencl/program.h)
    OutputForm output;
};

/// The reference's grid: every nanometre from 360 to 830 nm.
[[nodiscard]] Wavelengths referenceGrid();

/// All that make sense for a scene, the most telling ones first: the program may run out of its budget.
/// `grid`: the scene's own range is kept.
[[nodiscard]] std::vector<Contestant> contestants(const Scene& scene, const Wavelengths& grid, int samples);

/// The scene with metals by Schlick's formula.
[[nodiscard]] Scene withSchlick(const Scene& scene);

/// A contestant made ready: a plan, and what takes its bands (or channels, or coefficients) to X Y Z.
struct Entry {
    Plan plan;
    DetectorWeights weights;
};
/// Makes a plan; the caller's way, so that it may render the scene's other passes.
using Planner = std::function<Plan(const Scene&, const RenderSettings&)>;
/// Nothing for a method that this scene's materials are beyond (see three_channels.h).
[[nodiscard]] std::optional<Entry> prepare(const Contestant& contestant, const Scene& scene,
                                           const RenderSettings& settings, const Detector& observer,
                                           const Library& library, const Planner& planner);

}  // namespace spectrad
