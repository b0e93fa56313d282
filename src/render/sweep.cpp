#include "render/sweep.h"

#include "render/columns.h"

#include <fmt/format.h>

#include <cstring>

namespace spectrad {

namespace {

constexpr char separator = '\n';  // in no spectrum's text
constexpr size_t mostColumns = 10'000;

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// What geometry, visibility and g are made from.
bool sameGeometry(const Plan& a, const Plan& b) {
    const World &x = a.world, &y = b.world;
    return a.view.width == b.view.width && a.view.height == b.view.height && a.samples == b.samples &&
           a.groups == b.groups && a.terms.count() == b.terms.count() && same(x.position, y.position) &&
           same(x.draws, y.draws) && same(x.index, y.index) && same(x.triangleMaterial, y.triangleMaterial) &&
           same(x.casters, y.casters) && same(x.materials, y.materials) && same(x.lobes, y.lobes) &&
           same(x.tables, y.tables) && same(x.lights, y.lights) && same(x.textures, y.textures) &&
           same(x.texels, y.texels);
}

}  // namespace

size_t SweepPlan::column(size_t variant, size_t detector) const {
    size_t each = 0, before = 0;
    for (size_t d = 0; d < channels.size(); ++d) {
        if (d < detector) before += channels[d];
        each += channels[d];
    }
    return variant * each + before;
}

SweepPlan sweepPlan(std::vector<Plan> variants, const std::vector<std::string>& names,
                    std::span<const DetectorWeights> detectors) {
    SweepPlan sweep;
    size_t each = 0;
    for (const DetectorWeights& detector : detectors) {
        sweep.channels.push_back(detector.weights.size());
        each += detector.weights.size();
    }
    const size_t columns = each * variants.size(), terms = variants.front().terms.count(),
                 bands = variants.front().terms.bands;
    if (columns > mostColumns)
        throw InputError(fmt::format("a sweep of {} variants with {} channels has {} columns (allowed: {})",
                                     variants.size(), each, columns, mostColumns));
    std::vector<float> spectra(terms * columns);
    for (size_t v = 0; v < variants.size(); ++v) {
        if (!sameGeometry(variants.front(), variants[v]))
            throw InputError(fmt::format(
                "the variant '{}' changes more than spectra: it cannot be swept with the others (render it "
                "on its own)",
                names[v]));
        size_t column = v * each;
        for (const DetectorWeights& detector : detectors)
            for (const std::vector<double>& weights : detector.weights) {
                for (size_t term = 0; term < terms; ++term) {
                    const float* c = variants[v].terms.spectra.data() + term * bands;
                    double sum = 0;
                    for (size_t j = 0; j < bands; ++j)
                        sum += weights[j] * static_cast<double>(c[j]);
                    spectra[term * columns + column] = static_cast<float>(sum);
                }
                ++column;
            }
    }
    sweep.plan = withColumns(std::move(variants.front()), std::move(spectra), columns);
    return sweep;
}

void separateLights(Scene& scene) {
    for (size_t i = 0; i < scene.lights.size(); ++i)
        scene.lights[i].emitter.spectrum.text += separator + std::to_string(i);
}

std::string withoutMarks(const std::string& text) {
    std::string result;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != separator) {
            result += text[i];
            continue;
        }
        while (i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9')
            ++i;
    }
    return result;
}

}  // namespace spectrad
