#include "cli/verified_image.h"

#include "cli/options.h"
#include "image/cube_check.h"
#include "spectrum/resolver.h"
#include "verify/reference.h"

namespace spectrad {

Detector observerOf(const VerifyArguments& arguments, const Library& library) {
    Notes unheard;
    const SpectrumResolver resolver(library, {}, false, unheard);
    return asUsage("--observer", [&] { return detectorFor(arguments.observer, resolver, {}); });
}

VerifiedImage verified(const VerifyArguments& arguments, const Scene& scene, const RenderSettings& settings,
                       const Plan& plan, const CubeInfo& info, bool half, const Library& library,
                       const Device& device, bool quiet) {
    const Detector observer = observerOf(arguments, library);
    const Reference reference(scene, settings, plan.wavelengths, observer, library, device);
    PixelSample sample(info, parseShare("--verify", arguments.share), parseSeed(arguments.seed), observer,
                       half);
    const size_t pixels = static_cast<size_t>(info.width) * static_cast<size_t>(info.height);
    const double bytes = static_cast<double>(sizeof(float)) * static_cast<double>(pixels) *
                         static_cast<double>(plan.terms.bands + 3);
    VerifiedImage out;
    if (bytes <= 0.25 * static_cast<double>(availableMemory())) {
        out.kept.emplace();
        out.kept->bands.reserve(pixels * plan.terms.bands);
        out.kept->preview.reserve(pixels * 3);
    }
    ProgressBar bar("verifying", quiet);
    Renderer renderer(device, plan);
    renderer.render([&](int firstRow, int rows, const float* bands, const float* preview) {
        sample.add(firstRow, rows, bands);
        if (!out.kept) return;
        const size_t count = static_cast<size_t>(rows) * static_cast<size_t>(info.width);
        out.kept->bands.insert(out.kept->bands.end(), bands, bands + count * plan.terms.bands);
        out.kept->preview.insert(out.kept->preview.end(), preview, preview + count * 3);
    });
    if (out.kept) out.kept->times = renderer.times();
    const White white = defaultWhite(scene, settings, observer, library, device, sample.brightest());
    out.certificate = certify(sample, reference, observer, white, [&](double share) { bar.show(share); });
    return out;
}

}  // namespace spectrad
