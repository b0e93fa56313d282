#include "study/chooser.h"

#include "colour/develop.h"
#include "render/columns.h"
#include "study/choosing.h"

#include <algorithm>
#include <cmath>

namespace spectrad {

std::vector<int> Choosing::sampleCounts() const {
    if (settings.render.samples) return {*settings.render.samples};
    return {1, 2, 4, 8, 16, 32, 64};
}

std::optional<Plan> Choosing::planned(const Scene& of, const RenderSettings& wanted) const {
    try {
        return planner(of, wanted);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

double Choosing::summed(std::vector<double> errors) const {
    if (tolerance.all) return *std::max_element(errors.begin(), errors.end());
    return quantile(errors, 0.99);
}

Chosen Choosing::nothingYet() const {
    Chosen chosen;
    chosen.width = width;
    chosen.height = height;
    return chosen;
}

Columns rendered(const Device& device, const Plan& plan) {
    Renderer renderer(device, plan);
    Columns out;
    out.plane = renderColumns(renderer, plan);
    out.seconds = renderer.times().render;
    return out;
}

Chosen choose(const Scene& scene, const ChooserSettings& settings, const Detector& observer,
              const Library& library, const Device& device, const Planner& planner,
              const Progress& progress) {
    RenderSettings plain = settings.render;
    plain.geometry = false;
    const Plan plan = planner(scene, plain);
    if (plan.as != PassKind::radiance || plan.faces != 1)
        throw InputError(scene.file + ": a tolerance is for radiance seen by one camera");
    Choosing choosing{scene,   settings, observer,           library,         device,
                      planner, progress, settings.tolerance, settings.render, plan.wavelengths};
    choosing.tolerance.bound *= toleranceMargin;
    const double pixels = double{1} * plan.view.width * plan.view.height;
    // Smaller pictures have more edges for their area, which is on the safe side for 99 % of the pixels; of
    // all pixels only all pixels tell.
    double most = choosing.tolerance.all ? 4e6 : 700000;
    if (choosing.tolerance.radiance)  // whole cubes are kept
        most = std::min(most, 4e7 / static_cast<double>(plan.wavelengths.size()));
    const double scale = std::min(1.0, std::sqrt(most / pixels));
    choosing.width = std::max(1, static_cast<int>(std::lround(scale * plan.view.width)));
    choosing.height = std::max(1, static_cast<int>(std::lround(scale * plan.view.height)));
    choosing.asked.size = {choosing.width, choosing.height};
    choosing.asked.projection.reset();
    return choosing.tolerance.radiance ? chooseForBands(choosing) : chooseForColour(choosing);
}

}  // namespace spectrad
