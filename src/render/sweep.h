// Many spectra over one geometry: variants of a scene that differ in spectra only, seen by several detectors,
// in one render.
#pragma once

#include "colour/detector.h"
#include "render/plan.h"

#include <span>
#include <string>
#include <vector>

namespace spectrad {

/// A plan whose "bands" are the channels of every (variant, detector): geometry, visibility and g are those
/// of the first variant, and column (v, d, c) of the terms is what channel c of detector d makes of the
/// terms' spectra in variant v. So one render, with as many columns as there are channels in all, is the
/// whole sweep (L = Σ g · c, and a detector is linear).
struct SweepPlan {
    Plan plan;
    std::vector<size_t> channels;  ///< of each detector
    /// The first column of a variant's detector.
    [[nodiscard]] size_t column(size_t variant, size_t detector) const;
};

/// `detectors`: weights on the variants' bands, which are the same for all. Throws InputError where a variant
/// changes more than spectra (its name is said), and beyond the limit of columns.
[[nodiscard]] SweepPlan sweepPlan(std::vector<Plan> variants, const std::vector<std::string>& names,
                                  std::span<const DetectorWeights> detectors);

/// Gives every light a spectrum of its own name, so that lights of one spectrum are not made one group in
/// some variants and two in others.
void separateLights(Scene& scene);
/// A remark without what separateLights added to the spectra's names.
[[nodiscard]] std::string withoutMarks(const std::string& text);

}  // namespace spectrad
