// spectrad info SCENE --cost: what each feature costs in time and memory, and changes in the picture.
#include "base/text.h"
#include "cli/info.h"
#include "cli/study_size.h"
#include "render/passes.h"
#include "study/feature_cost.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace spectrad {

namespace {

Json described(const CostReport& report, const Plan& plan) {
    Json features = Json::array();
    for (const FeatureCost& f : report.features)
        features.push_back({{"feature", f.feature},
                            {"instead", f.instead},
                            {"seconds", f.time.seconds},
                            {"seconds_uncertainty", f.time.uncertainty},
                            {"bytes_per_strip", f.stripBytes},
                            {"terms", f.terms},
                            {"deltae00", {{"mean", f.deltaMean}, {"p99", f.deltaP99}, {"max", f.deltaMax}}}});
    return {{"width", report.width},
            {"height", report.height},
            {"bands", plan.wavelengths.size()},
            {"samples", plan.samples},
            {"seconds", report.seconds},
            {"bytes_per_strip", report.stripBytes},
            {"white", {{"name", report.white.name}, {"XYZ", report.white.xyz}}},
            {"features", features},
            {"left_out", report.leftOut}};
}

void printTable(const CostReport& report, const Plan& plan) {
    printText(
        fmt::format("{} x {} pixels, {} bands, {} samples a pixel: {} ms, {:.1f} MiB a strip; CIEDE2000 "
                    "of the picture without (white {} at Y = {})\n",
                    report.width, report.height, plan.wavelengths.size(), plan.samples,
                    rounded(1e3 * report.seconds, 3), static_cast<double>(report.stripBytes) / (1 << 20),
                    report.white.name, rounded(report.white.xyz[1], 5)));
    printText(fmt::format("{:<18} {:>8} {:>8} {:>9} {:>6} {:>9} {:>9} {:>9}  instead\n", "feature", "ms", "±",
                          "MiB", "terms", "mean dE00", "99 %", "max"));
    for (const FeatureCost& f : report.features)
        printText(fmt::format("{:<18} {:>8} {:>8} {:>9.1f} {:>6} {:>9} {:>9} {:>9}  {}\n", f.feature,
                              rounded(1e3 * f.time.seconds, 3), rounded(1e3 * f.time.uncertainty, 2),
                              static_cast<double>(f.stripBytes) / (1 << 20), f.terms, rounded(f.deltaMean, 3),
                              rounded(f.deltaP99, 3), rounded(f.deltaMax, 3), f.instead));
    for (const std::string& line : report.leftOut)
        printText(line + "\n");
}

}  // namespace

void printSceneCost(const SceneArguments& arguments, bool json, Console& console) {
    RenderSettings settings = renderSettings(arguments);
    const Library library = Library::open();
    const Scene scene = loadScene(arguments.file, library, loadOptions(arguments), console.notes());
    const Device device = Device::open(deviceNumber(arguments.device));
    Notes unheard;
    const Planner planner = [&](const Scene& asked, const RenderSettings& render) {
        PassTextures passes(asked, library, device, render, unheard);
        return makePlan(asked, render, library, passes, unheard);
    };
    PassTextures textures(scene, library, device, settings, console.notes());
    const Plan plan = makePlan(scene, settings, library, textures, console.notes());
    limitSize(settings, plan);
    console.printNotes();
    PassTextures means(scene, library, device, settings, unheard);
    const CostReport report =
        costOf(scene, settings, standardObserver(library), library, device, planner, means);
    if (json)
        printJson(described(report, plan));
    else
        printTable(report, plan);
}

}  // namespace spectrad
