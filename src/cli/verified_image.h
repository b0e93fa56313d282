// An image held against its reference before it is written: the file's header comes first.
#pragma once

#include "cli/certificate_report.h"
#include "opencl/device.h"
#include "render/renderer.h"

namespace spectrad {

class Library;

/// A rendered image that waits in memory to be written, as a strip of all its rows.
struct KeptImage {
    std::vector<float> bands, preview;
    RenderTimes times;
};
struct VerifiedImage {
    Certificate certificate;
    std::optional<KeptImage> kept;  ///< nothing where it would take more than a quarter of the free memory
};

[[nodiscard]] Detector observerOf(const VerifyArguments& arguments, const Library& library);

/// Renders and certifies. `scene`, `settings`: what the reference is of; `plan`: what is rendered; `half`:
/// how it will be stored.
[[nodiscard]] VerifiedImage verified(const VerifyArguments& arguments, const Scene& scene,
                                     const RenderSettings& settings, const Plan& plan, const CubeInfo& info,
                                     bool half, const Library& library, const Device& device, bool quiet);

}  // namespace spectrad
