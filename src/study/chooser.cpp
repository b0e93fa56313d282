#include "study/chooser.h"

#include "base/text.h"
#include "colour/develop.h"
#include "colour/difference.h"
#include "render/renderer.h"
#include "render/samples.h"
#include "study/band_choice.h"
#include "study/trial.h"

#include <fmt/format.h>

#include <Imath/half.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace spectrad {

Scene withSchlick(const Scene& scene) {
    Scene changed = scene;
    for (Material& material : changed.materials)
        if (material.conductor) material.conductor->schlick = true;
    return changed;
}

namespace {

/// Seconds to compress and write a band value (PIZ, a core; half: two thirds of the bytes' time). Only the
/// ratio to what rendering costs matters, and that is measured.
constexpr double writeSeconds = 30e-9, writeHalf = 0.7;
/// Of the bound: another computer's rounding is not to break it.
constexpr double margin = 0.99;

Plan withSamples(Plan plan, int samples) {
    plan.samples = samples;
    for (std::string& define : plan.defines)
        if (define.starts_with("SLOTS=")) define = fmt::format("SLOTS={}", lanePattern(samples, 1).slots);
    return plan;
}

/// A plan whose "bands" are given columns, [term][column].
Plan withColumns(Plan plan, std::vector<float> columns, size_t count) {
    plan.terms.bands = count;
    plan.terms.spectra = std::move(columns);
    plan.wavelengths = {};
    for (size_t k = 1; k <= count; ++k)
        plan.wavelengths.nm.push_back(static_cast<double>(k));
    return plan;
}

float asHalfFloat(float value) {
    return static_cast<float>(Imath::half(value));
}

struct Columns {
    std::vector<std::vector<float>> plane;  ///< [column][pixel]
    double seconds = 0;                     ///< rendering alone
};

Columns rendered(const Device& device, const Plan& plan) {
    const size_t count = plan.terms.bands, width = static_cast<size_t>(plan.view.width);
    Columns out;
    out.plane.assign(count, std::vector<float>(width * static_cast<size_t>(plan.view.height)));
    Renderer renderer(device, plan);
    renderer.render([&](int firstRow, int rows, const float* values, const float*) {
        for (size_t row = 0; row < static_cast<size_t>(rows); ++row)
            for (size_t c = 0; c < count; ++c)
                std::copy_n(values + (row * count + c) * width, width,
                            out.plane[c].data() + (static_cast<size_t>(firstRow) + row) * width);
    });
    out.seconds = renderer.times().render;
    return out;
}

/// Of a hat of the reference's grid, nm: the outermost are one-sided.
double areaOf(size_t band, size_t bands) {
    return band == 0 || band + 1 == bands ? 0.5 : 1.0;
}

/// Alike: the same shape in eight parts of the spectrum, to a 25th of the whole, and the same brightness to a
/// factor of two.
std::array<int, 9> kindOf(const std::vector<double>& moments) {
    std::array<double, 8> part{};
    double total = 0;
    for (size_t n = 0; n < moments.size(); ++n) {
        part[n * 8 / moments.size()] += moments[n];
        total += moments[n];
    }
    std::array<int, 9> kind{};
    for (size_t k = 0; k < 8; ++k)
        kind[k] = static_cast<int>(std::lround(25 * part[k] / total));
    kind[8] = static_cast<int>(std::lround(std::log2(total)));
    return kind;
}

class Chooser {
  public:
    Chooser(const Scene& scene, const ChooserSettings& settings, const Detector& observer,
            const Library& library, const Device& device, const Planner& planner, const Progress& progress)
        : scene_(scene),
          settings_(settings),
          observer_(observer),
          library_(library),
          device_(device),
          planner_(planner),
          progress_(progress),
          tolerance_(settings.tolerance) {
        tolerance_.bound *= margin;
    }

    Chosen chosen() {
        limitSize();
        if (tolerance_.radiance)
            chooseForBands();
        else
            chooseForColour();
        return out_;
    }

  private:
    void limitSize() {
        RenderSettings plain = settings_.render;
        plain.geometry = false;
        const Plan plan = planner_(scene_, plain);
        if (plan.as != PassKind::radiance || plan.faces != 1)
            throw InputError(scene_.file + ": a tolerance is for radiance seen by one camera");
        const double pixels = double{1} * plan.view.width * plan.view.height;
        double most = 700000;
        if (tolerance_.radiance)  // whole cubes are kept
            most = std::min(most, 4e7 / static_cast<double>(plan.wavelengths.size()));
        const double scale = std::min(1.0, std::sqrt(most / pixels));
        out_.width = std::max(1, static_cast<int>(std::lround(scale * plan.view.width)));
        out_.height = std::max(1, static_cast<int>(std::lround(scale * plan.view.height)));
        asked_ = settings_.render;
        asked_.size = {out_.width, out_.height};
        asked_.projection.reset();
        grid_ = plan.wavelengths;
    }

    [[nodiscard]] std::vector<int> sampleCounts() const {
        if (settings_.render.samples) return {*settings_.render.samples};
        return {1, 2, 4, 8, 16, 32, 64};
    }
    [[nodiscard]] double pixels() const { return double{1} * out_.width * out_.height; }
    /// What so many samples and bands cost, seconds.
    [[nodiscard]] double cost(double renderSeconds, size_t bands, bool asHalf) const {
        return renderSeconds +
               pixels() * static_cast<double>(bands) * writeSeconds * (asHalf ? writeHalf : 1);
    }

    // ---- colour

    [[nodiscard]] double colourError(const Columns& columns, size_t first) const {
        std::vector<double> differences(reference_.size());
        for (size_t i = 0; i < reference_.size(); ++i) {
            const Triple xyz{columns.plane[first][i], columns.plane[first + 1][i],
                             columns.plane[first + 2][i]};
            differences[i] = deltaE00(reference_[i], lab(xyz, out_.white.xyz));
        }
        return summed(std::move(differences));
    }
    [[nodiscard]] double summed(std::vector<double> differences) const {
        if (tolerance_.all) return *std::max_element(differences.begin(), differences.end());
        return quantile(differences, 0.99);
    }

    void planFine() {
        RenderSettings fine = asked_;
        fine.samples = 64;
        fine.wavelengths = referenceGrid();
        fine.exact = &observer_;
        fine_ = planner_(scene_, fine);
    }
    /// XYZ of each term, exact.
    [[nodiscard]] std::vector<float> exactColumns() const {
        return {fine_.terms.exactChannels.begin(), fine_.terms.exactChannels.end()};
    }

    void renderReference() {
        const Columns exact = rendered(device_, withColumns(fine_, exactColumns(), 3));
        const double brightest = *std::max_element(exact.plane[1].begin(), exact.plane[1].end());
        out_.white = defaultWhite(scene_, asked_, observer_, library_, device_, brightest);
        for (size_t i = 0; i < exact.plane[0].size(); ++i)
            reference_.push_back(
                lab({exact.plane[0][i], exact.plane[1][i], exact.plane[2][i]}, out_.white.xyz));
    }

    [[nodiscard]] Palette palette() const {
        RenderSettings small = asked_;
        const double scale = std::min(1.0, std::sqrt(8000 / pixels()));
        small.size = {std::max(1, static_cast<int>(out_.width * scale)),
                      std::max(1, static_cast<int>(out_.height * scale))};
        small.samples = 1;
        small.wavelengths = referenceGrid();
        const Columns spectra = rendered(device_, planner_(scene_, small));
        const size_t bands = spectra.plane.size(), count = spectra.plane[0].size();
        struct Kind {
            size_t first = 0, count = 0;
        };
        std::map<std::array<int, 9>, Kind> kinds;
        const auto momentsAt = [&](size_t i) {
            std::vector<double> m(bands);
            for (size_t b = 0; b < bands; ++b)
                m[b] = spectra.plane[b][i] * areaOf(b, bands);
            return m;
        };
        for (size_t i = 0; i < count; ++i) {
            const std::vector<double> m = momentsAt(i);
            if (!std::any_of(m.begin(), m.end(), [](double v) { return v > 0; })) continue;
            Kind& kind = kinds[kindOf(m)];
            if (kind.count++ == 0) kind.first = i;
        }
        std::vector<Kind> common;
        for (const auto& [kind, seen] : kinds)
            common.push_back(seen);
        std::stable_sort(common.begin(), common.end(),
                         [](const Kind& a, const Kind& b) { return a.count > b.count; });
        constexpr size_t most = 150;
        if (common.size() > most) common.resize(most);
        Palette out;
        const HatDetector detector(referenceGrid(), observer_);
        std::vector<size_t> every(bands);
        for (size_t b = 0; b < bands; ++b)
            every[b] = b;
        const auto weights = detector.weights(every);
        double total = 0;
        for (const Kind& kind : common)
            total += static_cast<double>(kind.count);
        for (const Kind& kind : common) {
            out.moments.push_back(momentsAt(kind.first));
            out.share.push_back(static_cast<double>(kind.count) / total);
            Triple xyz{};
            for (size_t b = 0; b < bands; ++b)
                for (size_t c = 0; c < 3; ++c)
                    xyz[c] += weights[b][c] * out.moments.back()[b];
            out.xyz.push_back(xyz);
        }
        if (out.moments.empty()) throw InputError("the image is black: there is no colour to keep");
        return out;
    }

    /// The terms' X Y Z as seen through bands over these nodes, appended to [term][column].
    [[nodiscard]] std::vector<float> columnsOf(const std::vector<const BandSet*>& sets) const {
        const HatDetector detector(referenceGrid(), observer_);
        const size_t terms = fine_.terms.count(), bands = fine_.terms.bands, count = 3 * (sets.size() + 1);
        std::vector<float> columns(terms * count);
        for (size_t t = 0; t < terms; ++t)
            for (size_t c = 0; c < 3; ++c)
                columns[t * count + c] = static_cast<float>(fine_.terms.exactChannels[3 * t + c]);
        for (size_t k = 0; k < sets.size(); ++k) {
            const auto weights = detector.weights(sets[k]->nodes);
            for (size_t t = 0; t < terms; ++t)
                for (size_t c = 0; c < 3; ++c) {
                    double sum = 0;
                    for (size_t b = 0; b < bands; ++b)
                        sum += weights[b][c] * areaOf(b, bands) * double{fine_.terms.spectra[t * bands + b]};
                    columns[t * count + 3 * (k + 1) + c] = static_cast<float>(sum);
                }
        }
        return columns;
    }

    /// Those worth a trial: from the fewest bands that may do on the palette.
    [[nodiscard]] std::vector<const BandSet*> worthATrial(const std::vector<BandSet>& sets) const {
        size_t first = 0;
        while (first + 1 < sets.size() && sets[first].error > 1.3 * tolerance_.bound)
            ++first;
        std::vector<const BandSet*> some;
        for (size_t step : {0, 1, 2, 3, 5, 8, 13, 21, 40}) {
            const size_t at = std::min(first + step, sets.size() - 1);
            if (some.empty() || some.back() != &sets[at]) some.push_back(&sets[at]);
        }
        if (some.back() != &sets.back()) some.push_back(&sets.back());
        return some;
    }

    /// Samples and bands to be confirmed, cheapest first.
    struct Candidate {
        int samples;
        Wavelengths grid;
        std::string how;
        double error, cost;
    };

    std::vector<Candidate> candidates() {
        std::vector<BandSet> sets;
        std::vector<const BandSet*> some;
        const bool fixed = settings_.render.wavelengths.has_value();
        if (!fixed) {
            sets = bandSets(referenceGrid(), HatDetector(referenceGrid(), observer_), palette(),
                            out_.white.xyz, tolerance_.all);
            some = worthATrial(sets);
        }
        progress_(0.4);
        std::vector<Candidate> found;
        const std::vector<float> columns = columnsOf(some);
        for (int samples : sampleCounts()) {
            const Columns xyz =
                rendered(device_, withColumns(withSamples(fine_, samples), columns, 3 * (some.size() + 1)));
            const double exact = colourError(xyz, 0);
            sampling_[samples] = exact;
            if (fixed)
                found.push_back(
                    {samples, grid_, "as asked for", exact, cost(xyz.seconds, grid_.size(), false)});
            bool fewest = false;
            for (size_t k = 0; k < some.size(); ++k) {
                const double error = colourError(xyz, 3 * (k + 1));
                Wavelengths grid;
                for (size_t node : some[k]->nodes)
                    grid.nm.push_back(referenceGrid().nm[node]);
                if (error <= tolerance_.bound && k == 0) fewest = true;
                found.push_back({samples, grid, some[k]->how, error, cost(xyz.seconds, grid.size(), false)});
            }
            progress_(0.4 + 0.4 * samples / 64);
            // More samples would not save another band.
            if (fewest) break;
        }
        std::stable_sort(found.begin(), found.end(), [&](const Candidate& a, const Candidate& b) {
            const bool am = a.error <= tolerance_.bound, bm = b.error <= tolerance_.bound;
            if (am != bm) return am;
            return am ? a.cost < b.cost : a.error < b.error;
        });
        return found;
    }

    /// The real thing: bands rendered and kept as the file would, seen by the observer.
    struct Real {
        double error = 0, seconds = 0;
    };
    Real confirmed(const Scene& scene, const Candidate& candidate, bool asHalf) {
        RenderSettings real = asked_;
        real.samples = candidate.samples;
        real.wavelengths = candidate.grid;
        Entry entry{planner_(scene, real), {}};
        entry.weights = weightsOn(entry.plan.wavelengths, observer_);
        TrialSettings once;
        once.rounds = 1;
        const Trial trial = tryOut(device_, entry, {asHalf, 24}, once);
        std::vector<double> differences(reference_.size());
        for (size_t i = 0; i < reference_.size(); ++i)
            differences[i] = deltaE00(reference_[i], lab(trial.xyz.triple(i), out_.white.xyz));
        const bool finite =
            std::all_of(differences.begin(), differences.end(), [](double d) { return std::isfinite(d); });
        return {finite ? summed(std::move(differences)) : std::numeric_limits<double>::infinity(),
                trial.renderSeconds};
    }

    void chooseForColour() {
        planFine();
        renderReference();
        progress_(0.2);
        const std::vector<Candidate> all = candidates();
        const Candidate* taken = nullptr;
        Real best;
        constexpr size_t tries = 6;
        for (size_t i = 0; i < std::min(tries, all.size()) && !out_.met; ++i) {
            const Real real = confirmed(scene_, all[i], settings_.half);
            if (!taken || real.error < best.error) taken = &all[i], best = real;
            out_.met = real.error <= tolerance_.bound;
        }
        out_.wavelengths = taken->grid;
        out_.samples = taken->samples;
        out_.half = settings_.half;
        out_.reached = best.error;
        explainSamples();
        out_.choices.push_back(
            {fmt::format("{} bands, {} to {} nm", taken->grid.size(), rounded(taken->grid.nm.front(), 9),
                         rounded(taken->grid.nm.back(), 9)),
             fmt::format("{}; with these samples CIEDE2000 {}", taken->how, rounded(best.error, 3))});
        tryShortcuts(*taken, best);
    }

    void explainSamples() {
        std::string why;
        for (const auto& [samples, error] : sampling_)
            if (samples <= out_.samples)
                why += fmt::format("{}{}: {}", why.empty() ? "with exact spectra, CIEDE2000 of " : ", ",
                                   samples, rounded(error, 3));
        out_.choices.push_back({fmt::format("{} samples", out_.samples), why});
    }

    void tryShortcuts(const Candidate& taken, Real best) {
        const bool metals =
            std::any_of(scene_.materials.begin(), scene_.materials.end(),
                        [](const Material& m) { return m.conductor && !m.conductor->schlick; });
        if (metals) {
            const Real real = confirmed(withSchlick(scene_), taken, settings_.half);
            out_.schlick = out_.met && real.error <= tolerance_.bound && real.seconds < best.seconds;
            if (out_.schlick) out_.reached = real.error;
            out_.choices.push_back({out_.schlick ? "metals by Schlick's formula" : "metals exact",
                                    fmt::format("Schlick's formula: CIEDE2000 {}, {} of the rendering time",
                                                rounded(real.error, 3),
                                                rounded(real.seconds / std::max(best.seconds, 1e-9), 2))});
        }
        if (!settings_.mayHalf || settings_.half) return;
        const Real real = confirmed(out_.schlick ? withSchlick(scene_) : scene_, taken, true);
        out_.half = out_.met && real.error <= tolerance_.bound;
        if (out_.half) out_.reached = real.error;
        out_.choices.push_back({out_.half ? "half floats" : "whole floats",
                                fmt::format("with half floats CIEDE2000 {}", rounded(real.error, 3))});
    }

    // ---- bands

    /// Of each pixel the largest error of a band ÷ the image's largest value in that band.
    [[nodiscard]] double bandError(const Columns& right, const Columns& got, bool asHalf) const {
        std::vector<double> worst(right.plane[0].size(), 0.0);
        for (size_t b = 0; b < right.plane.size(); ++b) {
            const std::vector<float>&wanted = right.plane[b], &band = got.plane[b];
            double largest = 0;
            for (float value : band)
                largest = std::max(largest, std::abs(double{value}));
            if (!(largest > 0)) continue;
            for (size_t i = 0; i < worst.size(); ++i) {
                const double value = asHalf ? double{asHalfFloat(band[i])} : double{band[i]};
                worst[i] = std::max(worst[i], std::abs(value - double{wanted[i]}) / largest);
            }
        }
        return summed(std::move(worst));
    }

    void chooseForBands() {
        RenderSettings own = asked_;
        own.wavelengths = grid_;
        own.samples = 64;
        const Plan plan = planner_(scene_, own);
        const Columns right = rendered(device_, plan);
        progress_(0.5);
        Columns got;
        double error = 0;
        for (int samples : sampleCounts()) {
            got = rendered(device_, withSamples(plan, samples));
            error = sampling_[samples] = bandError(right, got, settings_.half);
            out_.samples = samples;
            out_.met = error <= tolerance_.bound;
            if (out_.met) break;
        }
        out_.reached = error;
        out_.wavelengths = grid_;
        out_.half = settings_.half;
        std::string why;
        for (const auto& [samples, reached] : sampling_)
            why += fmt::format("{}{}: {} %", why.empty() ? "band errors of " : ", ", samples,
                               rounded(100 * reached, 3));
        out_.choices.push_back({fmt::format("{} samples", out_.samples), why});
        out_.choices.push_back({fmt::format("{} bands", grid_.size()), "the grid that was asked for"});
        if (!settings_.mayHalf || settings_.half) return;
        const double asHalf = bandError(right, got, true);
        out_.half = out_.met && asHalf <= tolerance_.bound;
        if (out_.half) out_.reached = asHalf;
        out_.choices.push_back({out_.half ? "half floats" : "whole floats",
                                fmt::format("with half floats {} %", rounded(100 * asHalf, 3))});
    }

    const Scene& scene_;
    const ChooserSettings& settings_;
    const Detector& observer_;
    const Library& library_;
    const Device& device_;
    const Planner& planner_;
    const Progress& progress_;
    Tolerance tolerance_;
    RenderSettings asked_;
    Wavelengths grid_;  ///< the scene's, or as asked for
    Plan fine_;
    std::vector<Triple> reference_;  ///< Lab of each pixel
    std::map<int, double> sampling_;
    Chosen out_;
};

}  // namespace

Chosen choose(const Scene& scene, const ChooserSettings& settings, const Detector& observer,
              const Library& library, const Device& device, const Planner& planner,
              const Progress& progress) {
    return Chooser(scene, settings, observer, library, device, planner, progress).chosen();
}

}  // namespace spectrad
