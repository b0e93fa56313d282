// Settings for a tolerance of the bands' radiance: samples, and half floats.
#include "base/text.h"
#include "study/choosing.h"

#include <fmt/format.h>

#include <Imath/half.h>
#include <algorithm>
#include <cmath>
#include <map>

namespace spectrad {

namespace {

float asHalfFloat(float value) {
    return static_cast<float>(Imath::half(value));
}

double largestOf(const std::vector<float>& values) {
    double largest = 0;
    for (float value : values)
        largest = std::max(largest, std::abs(double{value}));
    return largest;
}

/// Of each pixel the largest error of a band ÷ the largest value in that band of the image or of what is
/// right, whichever is less: the bound is kept by either measure.
double bandError(const Choosing& choosing, const Columns& right, const Columns& got, bool asHalf) {
    std::vector<double> worst(right.plane[0].size(), 0.0);
    for (size_t b = 0; b < right.plane.size(); ++b) {
        const std::vector<float>&wanted = right.plane[b], &band = got.plane[b];
        const double inBand = largestOf(band), inWanted = largestOf(wanted),
                     largest =
                         inBand > 0 && inWanted > 0 ? std::min(inBand, inWanted) : std::max(inBand, inWanted);
        if (!(largest > 0)) continue;
        for (size_t i = 0; i < worst.size(); ++i) {
            const double value = asHalf ? double{asHalfFloat(band[i])} : double{band[i]};
            worst[i] = std::max(worst[i], std::abs(value - double{wanted[i]}) / largest);
        }
    }
    return choosing.summed(std::move(worst));
}

}  // namespace

Chosen chooseForBands(const Choosing& choosing) {
    Chosen out = choosing.nothingYet();
    std::map<int, double> sampling;
    RenderSettings own = choosing.asked;
    own.wavelengths = choosing.grid;
    own.samples = 64;
    const Plan plan = choosing.planner(choosing.scene, own);
    const Columns right = rendered(choosing.device, plan);
    choosing.progress(0.5);
    Columns got;
    double error = 0;
    for (int samples : choosing.sampleCounts()) {
        own.samples = samples;
        // Passes have as many samples as the picture, so they are rendered anew.
        const std::optional<Plan> wanted = choosing.scene.passes.empty()
                                               ? withSamples(plan, samples)
                                               : choosing.planned(choosing.scene, own);
        if (!wanted) continue;
        got = rendered(choosing.device, *wanted);
        error = sampling[samples] = bandError(choosing, right, got, choosing.settings.half);
        out.samples = samples;
        out.met = error <= choosing.tolerance.bound;
        if (out.met) break;
    }
    out.reached = error;
    out.wavelengths = choosing.grid;
    out.half = choosing.settings.half;
    std::string why;
    for (const auto& [samples, reached] : sampling)
        why += fmt::format("{}{}: {} %", why.empty() ? "band errors of " : ", ", samples,
                           rounded(100 * reached, 3));
    out.choices.push_back({fmt::format("{} samples", out.samples), why});
    out.choices.push_back({fmt::format("{} bands", choosing.grid.size()), "the grid that was asked for"});
    if (!choosing.settings.mayHalf || choosing.settings.half) return out;
    const double asHalf = bandError(choosing, right, got, true);
    out.half = out.met && asHalf <= choosing.tolerance.bound;
    if (out.half) out.reached = asHalf;
    out.choices.push_back({out.half ? "half floats" : "whole floats",
                           fmt::format("with half floats {} %", rounded(100 * asHalf, 3))});
    return out;
}

}  // namespace spectrad
