#include "verify/reference.h"

#include "base/parallel.h"
#include "colour/observe.h"
#include "render/passes.h"
#include "render/texels.h"
#include "spectrum/library.h"
#include "verify/scalar_shade.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>

namespace spectrad {

Wavelengths referenceWavelengths(const Wavelengths& grid) {
    return regularWavelengths(std::min(360.0, std::floor(grid.nm.front())),
                              std::max(830.0, std::ceil(grid.nm.back())), 1, {});
}

namespace {

template <typename T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameLobes(const World& a, const World& b) {
    return sameBytes(a.materials, b.materials) && sameBytes(a.lobes, b.lobes) &&
           sameBytes(a.tables, b.tables) && sameBytes(a.lights, b.lights) &&
           sameBytes(a.textures, b.textures) && sameBytes(a.texels, b.texels);
}

void requireJudgeable(const Scene& scene, const Plan& plan, const Pass* target) {
    const auto refuse = [&](const std::string& what) {
        throw InputError(scene.file + ": " + what + " cannot be certified (radiance of one camera can)");
    };
    if (plan.as != PassKind::radiance)
        refuse("a pass as " + std::string(plan.as == PassKind::reflectance     ? "reflectance"
                                          : plan.as == PassKind::transmittance ? "transmittance"
                                                                               : "irradiance"));
    if (plan.faces != 1) refuse("a camera of type cube");
    if (target && target->screen) refuse("a display's picture");
}

}  // namespace

Reference::Reference(const Scene& scene, const RenderSettings& settings, const Wavelengths& grid,
                     const Detector& observer, const Library& library, const Device& device) {
    if (!observer.tristimulus)
        throw InputError("observer '" + observer.name + "' has no X, Y, Z: colour differences need them");
    const Eye eye{observer, towardsXyz(observer, observer)};
    RenderSettings finest = settings;
    finest.samples = referenceSamples;
    finest.wavelengths = referenceWavelengths(grid);
    finest.projection.reset();
    finest.exact = &observer;
    finest.eye = &eye;
    RenderSettings asked = finest;
    asked.wavelengths = grid;
    Notes unheard;  // the image's own plan has said it all
    const auto planned = [&](const RenderSettings& wanted) {
        PassTextures passes(scene, library, device, finest, unheard);
        const Pass* target = passes.graph().back().shot.pass;
        taken_.clear();
        for (const GraphNode& node : passes.graph())
            if (&node != &passes.graph().back())
                taken_.push_back("pass '" + (node.shot.pass ? node.shot.pass->name : std::string()) +
                                 "' as the renderer makes it");
        Plan plan = makePlan(scene, wanted, library, passes, unheard);
        requireJudgeable(scene, plan, target);
        fetchTexels(plan.world);  // shaded here, not on the device
        plan.samples = referenceSamples;
        return plan;
    };
    wide_ = planned(finest);
    own_ = planned(asked);
    sameLobes_ = sameLobes(wide_.world, own_.world);
    frame_ = scalar::frameOf(wide_);
    vertices_ = scalar::transform<double>(wide_.world, frame_);
    occluders_ = {wide_.world, vertices_};
}

void Reference::shadePixel(const Plan& plan, const PixelPlace& place, const SamplePattern& pattern,
                           const std::uint32_t* seen, std::vector<double>& g) const {
    g.assign(plan.terms.count(), 0.0);
    const World& world = plan.world;
    const size_t samples = pattern.x.size();
    for (size_t k = 0; k < samples; ++k) {
        const double x = place.x * SD_SUBPIXEL - frame_.width * (SD_SUBPIXEL / 2) + pattern.x[k],
                     y = place.y * SD_SUBPIXEL - frame_.height * (SD_SUBPIXEL / 2) + pattern.y[k];
        const sd_material& material =
            world.materials[seen[k] == scalar::noTriangle ? 0 : world.triangleMaterial[seen[k]]];
        const auto add = [&](size_t, std::uint32_t term, double value, bool) {
            g[material.first_term + term] += value;
        };
        scalar::shadeSample<double>(plan, vertices_, occluders_, frame_, material, seen[k], x, y, add);
    }
    for (double& value : g)
        value /= static_cast<double>(samples);
}

std::vector<ReferencePixel> Reference::at(std::span<const PixelPlace> places, int samples,
                                          const Progress& progress) const {
    // Pixels whose samples a thread keeps at once.
    const size_t chunk = std::max<size_t>(1, 1024 * size_t{referenceSamples} / static_cast<size_t>(samples));
    const SamplePattern pattern = samplePattern(samples);
    std::vector<ReferencePixel> out(places.size());
    std::mutex reporting;
    size_t done = 0;
    inParallel((places.size() + chunk - 1) / chunk, [&](size_t part) {
        const size_t first = part * chunk;
        const auto some = places.subspan(first, std::min(chunk, places.size() - first));
        const std::vector<std::uint32_t> seen = trianglesSeen(wide_.world, vertices_, frame_, pattern, some);
        std::vector<double> g;
        for (size_t i = 0; i < some.size(); ++i)
            out[first + i] = pixelAt(some[i], pattern, seen.data() + i * pattern.x.size(), g);
        const std::lock_guard lock(reporting);
        done += some.size();
        if (progress) progress(static_cast<double>(done) / static_cast<double>(places.size()));
    });
    return out;
}

ReferencePixel Reference::pixelAt(const PixelPlace& place, const SamplePattern& pattern,
                                  const std::uint32_t* seen, std::vector<double>& g) const {
    ReferencePixel pixel;
    shadePixel(wide_, place, pattern, seen, g);
    for (size_t t = 0; t < g.size(); ++t)
        for (size_t c = 0; c < 3 && g[t] != 0; ++c)
            pixel.xyz[c] += g[t] * wide_.terms.exactChannels[3 * t + c];
    if (!sameLobes_) shadePixel(own_, place, pattern, seen, g);
    const size_t bands = own_.terms.bands;
    pixel.bands.assign(bands, 0.0);
    for (size_t t = 0; t < g.size(); ++t)
        for (size_t b = 0; b < bands && g[t] != 0; ++b)
            pixel.bands[b] += g[t] * own_.terms.exactSpectra[t * bands + b];
    return pixel;
}

}  // namespace spectrad
