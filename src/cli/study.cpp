// spectrad study: what a scene's settings cost, and what they err by.
#include "study/study.h"

#include "base/files.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/study_files.h"
#include "cli/study_size.h"
#include "colour/difference.h"
#include "image/picture.h"
#include "render/passes.h"
#include "spectrum/library.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

struct StudyArguments {
    SceneArguments scene;
    std::string folder, budget = "5min";
    std::vector<std::string> lights, observers;
    bool json = false, quiet = false;
};

/// "90s", "5min", "1h".
double secondsOf(const std::string& text) {
    const size_t digits = text.find_first_not_of("0123456789.");
    const std::string unit = digits == std::string::npos ? "" : text.substr(digits);
    const double factor = unit == "s" ? 1 : unit == "min" ? 60 : unit == "h" ? 3600 : 0;
    const std::optional<double> value = parseDouble(text.substr(0, digits));
    if (factor == 0 || !value || !(*value > 0))
        throw UsageError("--budget: '" + text + "' is not a time, such as 90s, 5min or 1h");
    return factor * *value;
}

void writeMap(const fs::path& folder, const StudyRow& row) {
    writePng(folder / mapName(row),
             {row.width, row.height, 3, falseColours(row.map, row.deltaMax > 0 ? row.deltaMax : 1)},
             {{"Description", "CIEDE2000 from 0 (dark blue) to " + rounded(row.deltaMax, 6) + " (yellow)"}});
}

std::string recordedCommand(const StudyArguments& arguments) {
    std::string text = "spectrad study " + arguments.scene.file;
    for (const std::string& light : arguments.lights)
        text += " --light " + light;
    for (const std::string& observer : arguments.observers)
        text += " --observer " + observer;
    return text + recorded(arguments.scene) + (arguments.scene.restricted ? " --restrict" : "");
}

void printTable(const StudyReport& report) {
    const StudyRow* above = nullptr;
    for (const StudyRow& row : report.rows) {
        if (!above || above->light != row.light || above->observer != row.observer)
            printText(fmt::format(
                "# light: {}, observer: {}\n{:>14} {:>5} {:>7} {:>9} {:>9} {:>9} {:>9}  what\n", row.light,
                row.observer, "setting", "bands", "ms", "mean dE00", "95 %", "99 %", "max"));
        printText(fmt::format("{:>14} {:>5} {:>7} {:>9} {:>9} {:>9} {:>9}  {}\n", row.key, row.bands,
                              rounded(1e3 * row.renderSeconds, 3), rounded(row.deltaMean, 3),
                              rounded(row.deltaP95, 3), rounded(row.deltaP99, 3), rounded(row.deltaMax, 3),
                              row.what));
        above = &row;
    }
}

ExitCode runStudy(const StudyArguments& arguments) {
    StudySettings settings;
    settings.budgetSeconds = secondsOf(arguments.budget);
    settings.render = renderSettings(arguments.scene);
    settings.lights = arguments.lights.empty() ? std::vector<std::string>{""} : arguments.lights;
    if (!arguments.observers.empty()) settings.observers = arguments.observers;
    settings.folder = arguments.folder;
    const std::optional<int> number = deviceNumber(arguments.scene.device);

    Console console(arguments.quiet);
    const Library library = Library::open();
    const Scene scene =
        loadScene(arguments.scene.file, library, loadOptions(arguments.scene), console.notes());
    const Device device = Device::open(number);
    // Contestants repeat what the scene's own plan has said already.
    Notes unheard;
    const Planner planner = [&](const Scene& asked, const RenderSettings& render) {
        PassTextures passes(asked, library, device, render, unheard);
        return makePlan(asked, render, library, passes, unheard);
    };
    PassTextures passes(scene, library, device, settings.render, console.notes());
    const Plan plan = makePlan(scene, settings.render, library, passes, console.notes());
    limitSize(settings.render, plan);
    console.printNotes();

    StudyFiles files(arguments.folder, {scene.sha256, recordedCommand(arguments),
                                        device.info().name + " (" + device.info().platform + ")"});
    ProgressBar bar("studying", arguments.quiet);
    StudyReport report = study(
        scene, settings, library, device, planner, files.done(),
        [&](const StudyRow& row) {
            writeMap(arguments.folder, row);
            files.add(row);
        },
        [&](double share) { bar.show(share); });
    bar.clear();
    const StudyReport& whole = files.finish(std::move(report), scene.file);
    if (arguments.json)
        printJson(described(whole));
    else if (!arguments.quiet)
        printTable(whole);
    if (!whole.leftOut.empty())
        console.notes().say(fmt::format("{} settings were left out, as the page says: {}{}",
                                        whole.leftOut.size(), whole.leftOut.front(),
                                        whole.leftOut.size() > 1 ? ", …" : ""));
    console.printNotes();
    return ExitCode::ok;
}

}  // namespace

void addStudy(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("study", "Measure what a scene's settings cost and what they err by");
    auto arguments = std::make_shared<StudyArguments>();
    command->add_option("SCENE", arguments->scene.file, "a scene (XML), or a model that Assimp reads")
        ->type_name("SCENE")
        ->required();
    command
        ->add_option(
            "-o,--output", arguments->folder,
            "folder for index.html, results.csv, results.json and maps of the errors; an unfinished study "
            "there is gone on with")
        ->type_name("DIR")
        ->required();
    command
        ->add_option("--budget", arguments->budget,
                     "time after which nothing new is begun: 90s, 5min, 1h; default: 5min")
        ->type_name("TIME");
    command
        ->add_option(
            "--light", arguments->lights,
            "study it with this spectrum in every light, their amounts kept; may be repeated; default: the "
            "scene's own")
        ->type_name("SPECTRUM")
        ->allow_extra_args(false);
    command
        ->add_option("--observer", arguments->observers,
                     "colour matching functions for CIEDE2000; may be repeated; default: cie1931-2")
        ->type_name("NAME|FILE")
        ->allow_extra_args(false);
    addSceneOptions(*command, arguments->scene);
    addDeviceOption(*command, arguments->scene.device);
    command->add_flag("--json", arguments->json, "print a JSON object: the rows of results.json");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks, no progress, no table");
    command->footer(
        "Renders the scene with bands of 1 to 40 nm (slit, box, point), 1 to 64 samples a pixel, Schlick's "
        "metals, "
        "textures filtered otherwise, kernels contracted and with fast mathematics, shorter floats, each "
        "compression, and by the methods of other renderers (RGB, XYZ, Gaussian quadrature, linear "
        "models), and "
        "compares each with every nanometre from 360 to 830 nm: CIEDE2000, seconds, bytes. Without --size "
        "pictures "
        "are at most 480 pixels wide or high.\n\n"
        "Examples:\n"
        "  spectrad study scenes/colorchecker.xml -o out/study --budget 2min\n"
        "  spectrad study chart.xml -o out/study --light illuminants/A --light illuminants/FL11");
    command->final_callback([&action, arguments] { action = [arguments] { return runStudy(*arguments); }; });
}

}  // namespace spectrad
