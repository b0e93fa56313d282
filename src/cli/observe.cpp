// spectrad observe: a picture of a cube for a display, or a detector's own channels.
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/observation.h"
#include "cli/options.h"
#include "colour/develop.h"
#include "image/picture.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace spectrad {

namespace {

struct ObserveArguments {
    std::string cube, output, adapt = "cat16", display = "srgb", exposure = "0";
    ObserverArguments observer;
    bool json = false, quiet = false;
};

Exposure parseExposure(const std::string& text) {
    constexpr double mostStops = 1000;
    if (text == "auto") return {0, true};
    return {parseNumber("--exposure", text, -mostStops, mostStops), false};
}

/// Everything that the command line alone decides, before the cube is read.
struct Task {
    bool picture = true;
    DevelopSettings settings;
};

Task taskOf(const ObserveArguments& arguments) {
    Task task;
    const std::string extension = extensionOf(arguments.output);
    if (extension != ".png" && extension != ".exr")
        throw UsageError("-o: '" + arguments.output +
                         "' must end in .png (a picture) or .exr (the detector's channels)");
    task.picture = extension == ".png";
    task.settings.adaptation = asUsage("--adapt", [&] { return parseAdaptation(arguments.adapt); });
    task.settings.display = displayFor(arguments.display);
    task.settings.exposure = parseExposure(arguments.exposure);
    requireOther("-o", arguments.output, arguments.cube);
    requireWritable(arguments.output);
    return task;
}

Json writePicture(const ObserveArguments& arguments, DevelopSettings settings, const Observation& observation,
                  const ChannelImage& channels, Notes& notes) {
    const ChannelImage xyz = observation.xyz(channels);
    const White white = settings.white = observation.white(xyz);
    const DevelopedPicture picture = develop(xyz, settings);
    writePng(arguments.output, {picture.width, picture.height, 3, picture.rgb},
             {{"Software", "spectrad " SPECTRAD_VERSION},
              {"Description",
               fmt::format("{} seen by {}, white {} at {} cd/m2, {} adaptation, for {}", arguments.cube,
                           observation.detector().name, white.name, rounded(picture.whiteLuminance, 6),
                           arguments.adapt, settings.display.name)}},
             arguments.display == "srgb");
    constexpr double worthSaying = 0.02;  // the percentile of auto exposure alone clips 1 %
    if (picture.clippedShare() > worthSaying)
        notes.say(fmt::format(
            "{:.1f} % of the pixels lie outside the display's range and were clipped (--exposure changes it)",
            picture.clippedShare() * 100));
    return {{"white", {{"name", white.name}, {"XYZ", white.xyz}, {"has_luminance", white.hasLuminance}}},
            {"white_luminance_cd_m2", picture.whiteLuminance},
            {"clipped_pixels", picture.clipped},
            {"display", settings.display.name},
            {"adapt", arguments.adapt}};
}

Json writeChannels(const ObserveArguments& arguments, const Observation& observation,
                   const ChannelImage& channels) {
    const Detector& detector = observation.detector();
    std::string unit = detector.tristimulus ? "cd.m^-2 (Y)" : "W.m^-2.sr^-1 x sensitivity";
    if (observation.light()) unit = "perfect diffuser under " + observation.light()->text + ": Y = 100";
    writeChannelsExr(arguments.output, channels.width, channels.height, detector.channels,
                     floatPlanes(channels, detector.channels),
                     {{"observer", detector.name},
                      {"unit", unit},
                      {"cube", arguments.cube},
                      {"program", "spectrad " SPECTRAD_VERSION}});
    return {{"channels", detector.channels}, {"unit", unit}};
}

ExitCode observe(const ObserveArguments& arguments) {
    Console console(arguments.quiet);
    Task task = taskOf(arguments);
    const Cube cube = readCube(arguments.cube, console.notes());
    const bool film = namesFilm(arguments.observer.observer);
    ObserverArguments observer = arguments.observer;
    if (film) observer.filmStops = -std::exchange(task.settings.exposure, Exposure{}).ev;
    const Observation observation(observer, cube.info, console.notes());
    console.printNotes();
    const ChannelImage channels = observation.channels(cube);
    const Json details = task.picture
                             ? writePicture(arguments, task.settings, observation, channels, console.notes())
                             : writeChannels(arguments, observation, channels);
    if (!arguments.json) return ExitCode::ok;
    Json out{{"output", arguments.output},
             {"width", channels.width},
             {"height", channels.height},
             {"observer", observation.detector().name}};
    out.update(details);
    printJson(out);
    return ExitCode::ok;
}

}  // namespace

void addObserve(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("observe", "Show a cube to a detector: a picture for a display, or its channels");
    auto arguments = std::make_shared<ObserveArguments>();
    command->add_option("CUBE", arguments->cube, "spectral image, EXR or ENVI")
        ->type_name("CUBE.exr")
        ->required();
    command
        ->add_option(
            "-o,--output", arguments->output,
            "x.png: a picture for the display; x.exr: the detector's own channels, absolute and unadapted")
        ->type_name("OUT.png|OUT.exr")
        ->required();
    addObserverOptions(*command, arguments->observer);
    command
        ->add_option("--adapt", arguments->adapt,
                     "chromatic adaptation from the white to the display's, complete; none keeps "
                     "chromaticities; default: cat16")
        ->type_name("cat16|bradford|vonkries|none");
    command
        ->add_option(
            "--display", arguments->display,
            "the display, or a file of its primaries' chromaticities, white and gamma; default: srgb")
        ->type_name("srgb|p3|rec2020|FILE");
    command
        ->add_option("--exposure", arguments->exposure,
                     "stops: the white's luminance x 2^-EV is shown as display white; auto, and a white "
                     "without luminance: "
                     "the 99th percentile of Y is; default: 0")
        ->type_name("EV|auto");
    command->add_flag("--json", arguments->json, "print a JSON object about what was written");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    command->footer(
        "XYZ are absolute, Y in cd/m2 (683.002 lm/W). A slit cube meets the detector by least-squares "
        "projection, a point cube by the trapezoid rule. A camera's or the cones' channels reach a display "
        "through the matrix to XYZ that fits their sensitivities best.\n\n"
        "Examples:\n"
        "  spectrad observe scene.exr -o scene.png\n"
        "  spectrad observe scene.exr -o tungsten.png --white illuminants/A --exposure 1\n"
        "  spectrad observe scene.exr -o wide.png --display p3 --white at:120,80\n"
        "  spectrad observe scene.exr -o cones.exr --observer stockman-sharpe-2");
    command->final_callback([&action, arguments] { action = [arguments] { return observe(*arguments); }; });
}

}  // namespace spectrad
