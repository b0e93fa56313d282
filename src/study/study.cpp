#include "study/study.h"

#include "base/stopwatch.h"
#include "colour/develop.h"
#include "colour/difference.h"
#include "colour/white.h"
#include "spectrum/resolver.h"
#include "study/trial.h"

#include <algorithm>
#include <filesystem>

namespace spectrad {

namespace {

/// What a contestant is held against under one light and observer.
struct Condition {
    std::string light, observer;
    Scene scene;
    Detector detector;
    White white;
    /// Exact spectra: by the number of samples, since what is under trial is spectral unless it is the
    /// samples.
    std::map<int, ChannelImage> reference;
};

class Study {
  public:
    Study(const StudySettings& settings, const Library& library, const Device& device, const Planner& planner)
        : settings_(settings), library_(library), device_(device), planner_(planner) {}

    Condition condition(const Scene& scene, const std::string& light, const std::string& observer) {
        Condition c;
        c.light = light.empty() ? "scene" : light;
        c.observer = observer;
        c.scene = scene;
        Notes unheard;
        const SpectrumResolver resolver(library_, {}, false, unheard);
        c.detector = detectorFor(observer, resolver, {});
        if (!c.detector.tristimulus)
            throw InputError("observer '" + observer + "' has no X, Y, Z: colour differences need them");
        if (!light.empty()) {
            const Spectrum spectrum = resolver.resolve(light, Role::light, {});
            for (Light& l : c.scene.lights) {
                l.emitter.spectrum = spectrum;
                l.emitter.texture.reset();
            }
        }
        const Plan plan = planner_(c.scene, settings_.render);
        if (plan.as != PassKind::radiance)
            throw InputError("a study wants an image of radiance; this pass is none");
        if (plan.lights() == 0 && !c.scene.background)
            throw InputError(scene.file + ": a scene without light has no colours to study");
        c.white = c.scene.lights.empty()
                      ? whiteFor("E", c.detector, {}, resolver, {})
                      : whiteOf(c.scene.lights.front().emitter.spectrum.text,
                                c.scene.lights.front().emitter.spectrum.curve(), c.detector, {}, {});
        return c;
    }

    StudyRow row(Condition& condition, const Contestant& contestant, const Entry& entry) {
        StudyRow row;
        row.light = condition.light;
        row.observer = condition.observer;
        row.key = contestant.key;
        row.knob = name(contestant.knob);
        row.what = contestant.what;
        row.bands = static_cast<int>(entry.plan.terms.bands);
        row.samples = contestant.samples;
        const bool written = contestant.knob == Knob::output || contestant.knob == Knob::bands;
        const bool compared = contestant.method == Method::spectral && entry.plan.wavelengths.size() > 1;
        TrialSettings how;
        how.keepCube = compared;
        if (written) how.file = std::filesystem::path(settings_.folder) / "trial.exr";
        const Trial trial = tryOut(device_, entry, contestant.output, how);
        row.renderSeconds = trial.renderSeconds;
        row.writeSeconds = trial.writeSeconds;
        row.stripBytes = trial.stripBytes;
        row.fileBytes = trial.fileBytes;
        const ChannelImage& reference = referenceFor(condition, contestant);
        const ColourDifference colour = colourDifference(reference, trial.xyz, condition.white.xyz);
        row.deltaMean = colour.mean;
        row.deltaP95 = colour.p95;
        row.deltaP99 = colour.p99;
        row.deltaMax = colour.max;
        row.worstX = colour.maxX;
        row.worstY = colour.maxY;
        row.map = colour.map;
        row.width = trial.xyz.width;
        row.height = trial.xyz.height;
        if (compared) addBands(row, condition, contestant, trial.cube);
        return row;
    }

    [[nodiscard]] std::optional<Entry> entryOf(const Condition& condition,
                                               const Contestant& contestant) const {
        return prepare(contestant, condition.scene, settings_.render, condition.detector, library_, planner_);
    }

    std::vector<StudySpectrum> spectraAt(const Condition& condition, const StudyRow& worst,
                                         const std::vector<Contestant>& all) {
        std::vector<StudySpectrum> spectra;
        const auto add = [&](const std::string& key, const Entry& entry) {
            spectra.push_back({condition.light, condition.observer, key, worst.worstX, worst.worstY,
                               entry.plan.wavelengths.nm,
                               spectrumAt(device_, entry, worst.worstX, worst.worstY)});
        };
        add("reference", referenceEntry(condition, worst.samples));
        for (const Contestant& contestant : all)
            if (contestant.key == "slit-10nm" || contestant.key == "point-10nm")
                add(contestant.key, entryOf(condition, contestant).value());
        return spectra;
    }

  private:
    /// What is under trial is spectral, and judged with its own samples, unless it is the samples or a
    /// texture's filter, which does samples' work.
    static int referenceSamples(const Contestant& contestant) {
        constexpr int manySamples = 64;
        return contestant.knob == Knob::samples || contestant.knob == Knob::texture ? manySamples
                                                                                    : contestant.samples;
    }

    Entry referenceEntry(const Condition& condition, int samples) const {
        Contestant contestant;
        contestant.wavelengths = referenceGrid();
        contestant.samples = samples;
        return entryOf(condition, contestant).value();
    }

    const ChannelImage& referenceFor(Condition& condition, const Contestant& contestant) {
        const int samples = referenceSamples(contestant);
        const auto found = condition.reference.find(samples);
        if (found != condition.reference.end()) return found->second;
        TrialSettings once;
        once.rounds = 1;
        ChannelImage image = tryOut(device_, referenceEntry(condition, samples), {}, once).xyz;
        double brightest = 0;
        for (double y : image.plane[1])
            brightest = std::max(brightest, y);
        if (!(brightest > 0)) throw InputError("the image is black: there is no colour to study");
        condition.white = withLuminance(condition.white, brightest);
        return condition.reference.emplace(samples, std::move(image)).first->second;
    }

    /// Against what a slit records at these wavelengths; a contestant that is just that is not rendered
    /// again.
    void addBands(StudyRow& row, const Condition& condition, const Contestant& contestant, const Cube& cube) {
        Contestant exact = contestant;
        exact.wavelengths.projection = Projection::slit;
        exact.schlick = false;
        exact.filter.reset();
        exact.switches.clear();
        exact.output = {};
        exact.samples = referenceSamples(contestant);
        const bool itself = contestant.wavelengths.projection == Projection::slit && !contestant.schlick &&
                            !contestant.filter && contestant.switches.empty() &&
                            contestant.output == OutputForm{} && contestant.samples == exact.samples;
        TrialSettings how;
        how.rounds = 1;
        how.keepCube = true;
        const Cube rendered =
            itself ? Cube{} : tryOut(device_, entryOf(condition, exact).value(), {}, how).cube;
        const Cube& right = itself ? cube : rendered;
        BandDifferenceMeter meter(cube.info.wavelengths.size(), cube.info.width);
        for (int y = 0; y < cube.info.height; ++y)
            meter.add(right.row(y, 0), cube.row(y, 0));
        const BandDifference difference = meter.result();
        row.hasBands = true;
        row.bandRelativeMax = difference.relativeMax;
        row.spectralAngleMax = difference.spectralAngleMax;
    }

    const StudySettings& settings_;
    const Library& library_;
    const Device& device_;
    const Planner& planner_;
};

}  // namespace

std::string doneName(const std::string& light, const std::string& observer, const std::string& key) {
    return light + "/" + observer + "/" + key;
}

StudyReport study(const Scene& scene, const StudySettings& settings, const Library& library,
                  const Device& device, const Planner& planner, const std::set<std::string>& done,
                  const RowSink& sink, const Progress& progress) {
    const Stopwatch start;
    StudyReport report;
    Study work(settings, library, device, planner);
    std::vector<Condition> conditions;
    for (const std::string& light : settings.lights)
        for (const std::string& observer : settings.observers)
            conditions.push_back(work.condition(scene, light, observer));
    const Wavelengths grid = planner(scene, settings.render).wavelengths;
    const std::vector<Contestant> all = contestants(scene, grid, settings.render.samples.value_or(16));
    // Contestant by contestant, so that a short budget still tells of every light.
    size_t finished = 0;
    for (const Contestant& contestant : all) {
        for (Condition& condition : conditions) {
            progress(static_cast<double>(finished++) / static_cast<double>(all.size() * conditions.size()));
            const std::string name = doneName(condition.light, condition.observer, contestant.key);
            if (done.contains(name)) continue;
            if (start.seconds() > settings.budgetSeconds) {
                report.leftOut.push_back(name + ": beyond the budget");
                continue;
            }
            const Stopwatch planning;
            const std::optional<Entry> entry = work.entryOf(condition, contestant);
            if (!entry) {
                report.leftOut.push_back(name + ": the scene's textures have no three numbers");
                continue;
            }
            const double planSeconds = planning.seconds();
            report.rows.push_back(work.row(condition, contestant, *entry));
            report.rows.back().planSeconds = planSeconds;
            sink(report.rows.back());
            if (contestant.key == "point-10nm")
                for (StudySpectrum& spectrum : work.spectraAt(condition, report.rows.back(), all))
                    report.spectra.push_back(std::move(spectrum));
        }
    }
    report.seconds = start.seconds();
    return report;
}

}  // namespace spectrad
