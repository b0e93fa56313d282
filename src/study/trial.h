// One rendering, timed, and how far it is from another.
#pragma once

#include "colour/difference.h"
#include "colour/observe.h"
#include "image/cube.h"
#include "opencl/device.h"
#include "study/contestant.h"

#include <filesystem>

namespace spectrad {

/// A rendered entry.
struct Trial {
    ChannelImage xyz;
    Cube cube;                     ///< kept only when asked for
    double renderSeconds = 0;      ///< the best of the rounds, kernels compiled and geometry uploaded before
    std::uint64_t stripBytes = 0;  ///< device memory of a strip's buffers
    double writeSeconds = 0;       ///< to an EXR, PIZ; 0 where none was asked for
    std::uint64_t fileBytes = 0;
};

struct TrialSettings {
    int rounds = 2;
    bool keepCube = false;
    std::filesystem::path file;  ///< written and removed again, for its time and size; empty: none
};
[[nodiscard]] Trial tryOut(const Device& device, const Entry& entry, const OutputForm& form,
                           const TrialSettings& settings);

/// The spectrum of one pixel, a value a band.
[[nodiscard]] std::vector<double> spectrumAt(const Device& device, const Entry& entry, int x, int y);

/// A float with only its first `bits` significant bits, rounded to nearest.
[[nodiscard]] float keepBits(float value, int bits);

}  // namespace spectrad
