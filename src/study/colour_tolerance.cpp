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
#include <optional>
#include <thread>

namespace spectrad {

namespace {

/// Processor time to compress and write a band value, seconds (PIZ; measured on three scenes: float 24 to
/// 42 ns, half 6 to 10). Only the ratio to what rendering costs matters, and that is measured.
constexpr double writeFloat = 30e-9, writeHalf = 8e-9;

/// a + b·x, neither negative, through points (x, y > 0) with the least sum of squared relative deviations:
/// rendering takes what geometry takes, and so much a sample; a single measurement of a few milliseconds is
/// noise.
struct Line {
    double a = 0, b = 0;
    [[nodiscard]] double at(double x) const { return a + b * x; }
};
Line fitted(const std::map<int, double>& points) {
    double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
    for (const auto& [x, y] : points) {
        const double weight = 1 / (y * y);
        w += weight;
        wx += weight * x;
        wxx += weight * x * x;
        wy += weight * y;
        wxy += weight * x * y;
    }
    const double determinant = w * wxx - wx * wx;
    Line line{wy / w, 0};
    if (points.size() > 1 && determinant > 0) line.b = std::max(0.0, (w * wxy - wx * wy) / determinant);
    line.a = (wy - line.b * wx) / w;
    if (line.a < 0) line = {0, wxy / wxx};
    return line;
}

class ColourChooser {
  public:
    explicit ColourChooser(const Choosing& choosing) : choosing_(choosing), out_(choosing.nothingYet()) {}

    Chosen chosen() {
        planFine();
        renderReference();
        choosing_.progress(0.2);
        const Taken taken = confirmedBest(candidates());
        out_.met = taken.met;
        out_.wavelengths = taken.candidate.grid;
        out_.samples = taken.candidate.samples;
        out_.half = taken.half;
        out_.reached = taken.error;
        explainSamples();
        const std::vector<double>& nm = out_.wavelengths.nm;
        out_.choices.push_back(
            {fmt::format("{} bands, {} to {} nm", nm.size(), rounded(nm.front(), 9), rounded(nm.back(), 9)),
             fmt::format("{}; with these samples CIEDE2000 {}", taken.candidate.how,
                         rounded(taken.candidate.error, 3))});
        trySchlick(taken.candidate);
        if (choosing_.settings.mayHalf && !choosing_.settings.half && taken.asHalf)
            out_.choices.push_back({out_.half ? "half floats" : "whole floats",
                                    fmt::format("with half floats CIEDE2000 {}", rounded(*taken.asHalf, 3))});
        return out_;
    }

  private:
    /// What rendering and writing cost, seconds.
    [[nodiscard]] double cost(double renderSeconds, size_t bands, bool asHalf) const {
        return renderSeconds + choosing_.pixels() * static_cast<double>(bands) *
                                   (asHalf ? writeHalf : writeFloat) /
                                   std::max(1u, std::thread::hardware_concurrency());
    }
    [[nodiscard]] bool mayHalf() const { return choosing_.settings.half || choosing_.settings.mayHalf; }

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
        small.wavelengths = referenceGrid();
        small.samples = 1;
        std::optional<Plan> plan = choosing_.planned(choosing_.scene, small);
        if (!plan) {
            small.samples = 64;
            plan = choosing_.planner(choosing_.scene, small);
        }
        const Columns spectra = rendered(choosing_.device, *plan);
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

    /// Samples and bands to be confirmed.
    struct Candidate {
        int samples;
        Wavelengths grid;
        std::string how;
        double error;        ///< with whole floats
        double seconds = 0;  ///< of rendering
    };

    /// The best of three: a first rendering wakes the device, and other programs disturb.
    Columns timed(const Plan& plan) {
        Columns best = rendered(choosing_.device, plan);
        for (int round = 1; round < 3 && best.seconds < 0.2; ++round)
            best.seconds = std::min(best.seconds, rendered(choosing_.device, plan).seconds);
        return best;
    }

    /// Scenes whose passes need more samples than that are left out.
    [[nodiscard]] bool possible(int samples) const {
        if (choosing_.scene.passes.empty()) return true;
        RenderSettings wanted = choosing_.asked;
        wanted.samples = samples;
        return choosing_.planned(choosing_.scene, wanted).has_value();
    }

    /// Cheapest first; behind them those that are beyond the bound, best first.
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
        std::map<int, double> seconds;
        const std::vector<float> columns = columnsOf(some);
        for (int samples : choosing_.sampleCounts()) {
            if (!possible(samples)) continue;
            const Columns xyz =
                timed(withColumns(withSamples(fine_, samples), columns, 3 * (some.size() + 1)));
            seconds[samples] = std::max(xyz.seconds, 1e-6);
            const double exact = colourError(xyz, 0);
            sampling_[samples] = exact;
            if (fixed) found.push_back({samples, choosing_.grid, "as asked for", exact});
            bool fewest = false;
            for (size_t k = 0; k < some.size(); ++k) {
                const double error = colourError(xyz, 3 * (k + 1));
                Wavelengths grid;
                for (size_t node : some[k]->nodes)
                    grid.nm.push_back(referenceGrid().nm[node]);
                if (error <= choosing_.tolerance.bound && k == 0) fewest = true;
                found.push_back({samples, grid, some[k]->how, error});
            }
            choosing_.progress(0.4 + 0.4 * samples / 64);
            // More samples would not save another band.
            if (fewest) break;
        }
        const Line line = fitted(seconds);
        for (Candidate& candidate : found)
            candidate.seconds = line.at(candidate.samples);
        const auto costOf = [&](const Candidate& c) { return cost(c.seconds, c.grid.size(), mayHalf()); };
        std::stable_sort(found.begin(), found.end(), [&](const Candidate& a, const Candidate& b) {
            const bool am = a.error <= choosing_.tolerance.bound, bm = b.error <= choosing_.tolerance.bound;
            if (am != bm) return am;
            return am ? costOf(a) < costOf(b) : a.error < b.error;
        });
        return found;
    }

    /// The real thing: bands rendered and kept as the file would, seen by the observer.
    struct Real {
        double error = 0, seconds = 0;
    };
    Real confirmed(const Scene& scene, const Candidate& candidate, bool asHalf, int rounds = 1) {
        constexpr double impossible = std::numeric_limits<double>::infinity();
        RenderSettings real = choosing_.asked;
        real.samples = candidate.samples;
        real.wavelengths = candidate.grid;
        const std::optional<Plan> plan = choosing_.planned(scene, real);
        if (!plan) return {impossible, 0};
        Entry entry{*plan, {}};
        entry.weights = weightsOn(entry.plan.wavelengths, choosing_.observer);
        TrialSettings how;
        how.rounds = rounds;
        const Trial trial = tryOut(choosing_.device, entry, {asHalf, 24}, how);
        std::vector<double> differences(reference_.size());
        for (size_t i = 0; i < reference_.size(); ++i)
            differences[i] = deltaE00(reference_[i], lab(trial.xyz.triple(i), out_.white.xyz));
        const bool finite =
            std::all_of(differences.begin(), differences.end(), [](double d) { return std::isfinite(d); });
        return {finite ? choosing_.summed(std::move(differences)) : impossible, trial.renderSeconds};
    }

    struct Taken {
        Candidate candidate;
        bool half = false, met = false;
        double error = 0, cost = 0;
        std::optional<double> asHalf;  ///< the error with half floats, where that was tried
    };
    [[nodiscard]] static bool better(const Taken& a, const Taken& b) {
        if (a.met != b.met) return a.met;
        return a.met ? a.cost < b.cost : a.error < b.error;
    }

    /// Tries the real thing, cheapest first: half floats, which are a quarter of the work to write, and whole
    /// ones where halves break the tolerance. One more band in halves may be cheaper than none in floats.
    Taken confirmedBest(const std::vector<Candidate>& all) {
        std::optional<Taken> best;
        constexpr size_t tries = 8;
        for (size_t i = 0; i < std::min(tries, all.size()); ++i) {
            const Candidate& candidate = all[i];
            const size_t bands = candidate.grid.size();
            if (best && best->met &&
                (candidate.error > choosing_.tolerance.bound ||
                 cost(candidate.seconds, bands, mayHalf()) >= best->cost))
                break;
            Taken taken{candidate, false, false, 0, 0, {}};
            const auto tryAs = [&](bool half) {
                taken.half = half;
                taken.error = confirmed(choosing_.scene, candidate, half).error;
                if (half) taken.asHalf = taken.error;
                taken.met = taken.error <= choosing_.tolerance.bound;
                taken.cost = cost(candidate.seconds, bands, half);
                if (!best || better(taken, *best)) best = taken;
                return taken.met;
            };
            if (mayHalf() && tryAs(true)) break;
            if (!choosing_.settings.half) tryAs(false);
        }
        return *best;
    }

    void explainSamples() {
        std::string why;
        for (const auto& [samples, error] : sampling_)
            if (samples <= out_.samples)
                why += fmt::format("{}{}: {}", why.empty() ? "with exact spectra, CIEDE2000 of " : ", ",
                                   samples, rounded(error, 3));
        out_.choices.push_back({fmt::format("{} samples", out_.samples), why});
    }

    void trySchlick(const Candidate& taken) {
        const bool metals =
            std::any_of(choosing_.scene.materials.begin(), choosing_.scene.materials.end(),
                        [](const Material& m) { return m.conductor && !m.conductor->schlick; });
        if (!metals) return;
        constexpr int rounds = 3;
        const Real exact = confirmed(choosing_.scene, taken, out_.half, rounds),
                   real = confirmed(withSchlick(choosing_.scene), taken, out_.half, rounds);
        // What is not worth a twentieth of the time is noise.
        out_.schlick =
            out_.met && real.error <= choosing_.tolerance.bound && real.seconds < 0.95 * exact.seconds;
        if (out_.schlick) out_.reached = real.error;
        out_.choices.push_back(
            {out_.schlick ? "metals by Schlick's formula" : "metals exact",
             fmt::format("{}CIEDE2000 {}, {} of the rendering time",
                         out_.schlick ? "" : "by Schlick's formula ", rounded(real.error, 3),
                         rounded(real.seconds / std::max(exact.seconds, 1e-9), 2))});
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
