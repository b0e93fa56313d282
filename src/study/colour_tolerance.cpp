// Settings for a tolerance of ΔE00: bands, samples, and shortcuts.
#include "base/text.h"
#include "colour/develop.h"
#include "colour/difference.h"
#include "render/columns.h"
#include "study/choosing.h"
#include "study/palette.h"
#include "study/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace spectrad {

namespace {

/// Seconds to compress and write a band value (PIZ, a core; half: two thirds of the bytes' time). Only the
/// ratio to what rendering costs matters, and that is measured.
constexpr double writeSeconds = 30e-9, writeHalf = 0.7;

class ColourChooser {
  public:
    explicit ColourChooser(const Choosing& choosing) : choosing_(choosing), out_(choosing.nothingYet()) {}

    Chosen chosen() {
        chooseForColour();
        return out_;
    }

  private:
    /// What so many samples and bands cost, seconds.
    [[nodiscard]] double cost(double renderSeconds, size_t bands, bool asHalf) const {
        return renderSeconds +
               choosing_.pixels() * static_cast<double>(bands) * writeSeconds * (asHalf ? writeHalf : 1);
    }

    [[nodiscard]] double colourError(const Columns& columns, size_t first) const {
        std::vector<double> differences(reference_.size());
        for (size_t i = 0; i < reference_.size(); ++i) {
            const Triple xyz{columns.plane[first][i], columns.plane[first + 1][i],
                             columns.plane[first + 2][i]};
            differences[i] = deltaE00(reference_[i], lab(xyz, out_.white.xyz));
        }
        return choosing_.summed(std::move(differences));
    }
    void planFine() {
        RenderSettings fine = choosing_.asked;
        fine.samples = 64;
        fine.wavelengths = referenceGrid();
        fine.exact = &choosing_.observer;
        fine_ = choosing_.planner(choosing_.scene, fine);
    }
    /// XYZ of each term, exact.
    [[nodiscard]] std::vector<float> exactColumns() const {
        return {fine_.terms.exactChannels.begin(), fine_.terms.exactChannels.end()};
    }

    void renderReference() {
        const Columns exact = rendered(choosing_.device, withColumns(fine_, exactColumns(), 3));
        const double brightest = *std::max_element(exact.plane[1].begin(), exact.plane[1].end());
        out_.white = defaultWhite(choosing_.scene, choosing_.asked, choosing_.observer, choosing_.library,
                                  choosing_.device, brightest);
        for (size_t i = 0; i < exact.plane[0].size(); ++i)
            reference_.push_back(
                lab({exact.plane[0][i], exact.plane[1][i], exact.plane[2][i]}, out_.white.xyz));
    }

    [[nodiscard]] Palette palette() const {
        RenderSettings small = choosing_.asked;
        const double scale = std::min(1.0, std::sqrt(8000 / choosing_.pixels()));
        small.size = {std::max(1, static_cast<int>(out_.width * scale)),
                      std::max(1, static_cast<int>(out_.height * scale))};
        small.samples = 1;
        small.wavelengths = referenceGrid();
        const Columns spectra = rendered(choosing_.device, choosing_.planner(choosing_.scene, small));
        return paletteOf(spectra.plane, HatDetector(referenceGrid(), choosing_.observer));
    }

    /// The terms' X Y Z as seen through bands over these nodes, appended to [term][column].
    [[nodiscard]] std::vector<float> columnsOf(const std::vector<const BandSet*>& sets) const {
        const HatDetector detector(referenceGrid(), choosing_.observer);
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
                        sum += weights[b][c] * hatArea(b, bands) * double{fine_.terms.spectra[t * bands + b]};
                    columns[t * count + 3 * (k + 1) + c] = static_cast<float>(sum);
                }
        }
        return columns;
    }

    /// Those worth a trial: from the fewest bands that may do on the palette.
    [[nodiscard]] std::vector<const BandSet*> worthATrial(const std::vector<BandSet>& sets) const {
        size_t first = 0;
        while (first + 1 < sets.size() && sets[first].error > 1.3 * choosing_.tolerance.bound)
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
        const bool fixed = choosing_.settings.render.wavelengths.has_value();
        if (!fixed) {
            sets = bandSets(referenceGrid(), HatDetector(referenceGrid(), choosing_.observer), palette(),
                            out_.white.xyz, choosing_.tolerance.all);
            some = worthATrial(sets);
        }
        choosing_.progress(0.4);
        std::vector<Candidate> found;
        const std::vector<float> columns = columnsOf(some);
        for (int samples : choosing_.sampleCounts()) {
            const Columns xyz = rendered(
                choosing_.device, withColumns(withSamples(fine_, samples), columns, 3 * (some.size() + 1)));
            const double exact = colourError(xyz, 0);
            sampling_[samples] = exact;
            if (fixed)
                found.push_back({samples, choosing_.grid, "as asked for", exact,
                                 cost(xyz.seconds, choosing_.grid.size(), false)});
            bool fewest = false;
            for (size_t k = 0; k < some.size(); ++k) {
                const double error = colourError(xyz, 3 * (k + 1));
                Wavelengths grid;
                for (size_t node : some[k]->nodes)
                    grid.nm.push_back(referenceGrid().nm[node]);
                if (error <= choosing_.tolerance.bound && k == 0) fewest = true;
                found.push_back({samples, grid, some[k]->how, error, cost(xyz.seconds, grid.size(), false)});
            }
            choosing_.progress(0.4 + 0.4 * samples / 64);
            // More samples would not save another band.
            if (fewest) break;
        }
        std::stable_sort(found.begin(), found.end(), [&](const Candidate& a, const Candidate& b) {
            const bool am = a.error <= choosing_.tolerance.bound, bm = b.error <= choosing_.tolerance.bound;
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
        RenderSettings real = choosing_.asked;
        real.samples = candidate.samples;
        real.wavelengths = candidate.grid;
        Entry entry{choosing_.planner(scene, real), {}};
        entry.weights = weightsOn(entry.plan.wavelengths, choosing_.observer);
        TrialSettings once;
        once.rounds = 1;
        const Trial trial = tryOut(choosing_.device, entry, {asHalf, 24}, once);
        std::vector<double> differences(reference_.size());
        for (size_t i = 0; i < reference_.size(); ++i)
            differences[i] = deltaE00(reference_[i], lab(trial.xyz.triple(i), out_.white.xyz));
        const bool finite =
            std::all_of(differences.begin(), differences.end(), [](double d) { return std::isfinite(d); });
        return {finite ? choosing_.summed(std::move(differences)) : std::numeric_limits<double>::infinity(),
                trial.renderSeconds};
    }

    void chooseForColour() {
        planFine();
        renderReference();
        choosing_.progress(0.2);
        const std::vector<Candidate> all = candidates();
        const Candidate* taken = nullptr;
        Real best;
        constexpr size_t tries = 6;
        for (size_t i = 0; i < std::min(tries, all.size()) && !out_.met; ++i) {
            const Real real = confirmed(choosing_.scene, all[i], choosing_.settings.half);
            if (!taken || real.error < best.error) taken = &all[i], best = real;
            out_.met = real.error <= choosing_.tolerance.bound;
        }
        out_.wavelengths = taken->grid;
        out_.samples = taken->samples;
        out_.half = choosing_.settings.half;
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
            std::any_of(choosing_.scene.materials.begin(), choosing_.scene.materials.end(),
                        [](const Material& m) { return m.conductor && !m.conductor->schlick; });
        if (metals) {
            const Real real = confirmed(withSchlick(choosing_.scene), taken, choosing_.settings.half);
            out_.schlick = out_.met && real.error <= choosing_.tolerance.bound && real.seconds < best.seconds;
            if (out_.schlick) out_.reached = real.error;
            out_.choices.push_back({out_.schlick ? "metals by Schlick's formula" : "metals exact",
                                    fmt::format("Schlick's formula: CIEDE2000 {}, {} of the rendering time",
                                                rounded(real.error, 3),
                                                rounded(real.seconds / std::max(best.seconds, 1e-9), 2))});
        }
        if (!choosing_.settings.mayHalf || choosing_.settings.half) return;
        const Real real =
            confirmed(out_.schlick ? withSchlick(choosing_.scene) : choosing_.scene, taken, true);
        out_.half = out_.met && real.error <= choosing_.tolerance.bound;
        if (out_.half) out_.reached = real.error;
        out_.choices.push_back({out_.half ? "half floats" : "whole floats",
                                fmt::format("with half floats CIEDE2000 {}", rounded(real.error, 3))});
    }

    const Choosing& choosing_;
    Plan fine_;
    std::vector<Triple> reference_;  ///< Lab of each pixel
    std::map<int, double> sampling_;
    Chosen out_;
};

}  // namespace

Chosen chooseForColour(const Choosing& choosing) {
    return ColourChooser(choosing).chosen();
}

}  // namespace spectrad
