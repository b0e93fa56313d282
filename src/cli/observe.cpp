// spectrad observe: a picture of a cube for a display, or a detector's own channels.
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/observation.h"
#include "cli/options.h"
#include "colour/rendering.h"
#include "colour/spectral_display.h"
#include "image/picture.h"
#include "image/picture_colour.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace spectrad {

namespace {

struct ObserveArguments {
    std::string cube, output, adapt = "cat16", display = "srgb", exposure = "0", degree = "1",
                              tone = "linear", gamut = "clip", gamutMap, seenBy;
    ObserverArguments observer;
    std::vector<std::string> shaping;  ///< the options given that shape a picture for a display
    bool json = false, quiet = false;
};

Exposure parseExposure(const std::string& text) {
    if (text == "auto") return {0, true};
    return {parseNumber("--exposure", text, -mostStops, mostStops), false};
}

/// Everything that the command line alone decides, before the cube is read.
struct Task {
    bool picture = true;
    Rendering rendering;
    std::optional<SpectralDisplay> spectral;  ///< the display by its primaries' spectra
};

/// A display by its primaries' spectra (displays/… of the library, or a table with the columns R, G, B), else
/// by name or file.
void chooseDisplay(const ObserveArguments& arguments, Task& task) {
    if (arguments.display.starts_with("displays/") || extensionOf(arguments.display) == ".csv") {
        Notes notes;
        const Library library = Library::open();
        const SpectrumResolver resolver(library, ".", false, notes);
        task.spectral = spectralDisplay(resolver.resolve(arguments.display, Role::any, {}));
        task.rendering.base.display = task.spectral->seenBy(standardObserver(library));
    } else {
        task.rendering.base.display = displayFor(arguments.display);
    }
    if (!arguments.seenBy.empty() && !(task.picture && task.spectral))
        throw UsageError(
            "--seen-by needs a picture and a display by the spectra of its primaries, as --display "
            "displays/lcd-apple-studio");
}

Task taskOf(const ObserveArguments& arguments) {
    Task task;
    const std::string extension = extensionOf(arguments.output);
    if (extension != ".png" && extension != ".exr")
        throw UsageError("-o: '" + arguments.output +
                         "' must end in .png (a picture) or .exr (the detector's channels)");
    task.picture = extension == ".png";
    task.rendering.base.adaptation = asUsage("--adapt", [&] { return parseAdaptation(arguments.adapt); });
    task.rendering.base.exposure = parseExposure(arguments.exposure);
    task.rendering.degree = parseNumber("--degree", arguments.degree, 0, 1);
    task.rendering.tone = asUsage("--tone", [&] { return parseTone(arguments.tone); });
    task.rendering.gamut = asUsage("--gamut", [&] { return parseGamutMapping(arguments.gamut); });
    chooseDisplay(arguments, task);
    if (!arguments.gamutMap.empty()) {
        if (!task.picture || extensionOf(arguments.gamutMap) != ".png")
            throw UsageError("--gamut-map: '" + arguments.gamutMap + "' must end in .png, and so must -o");
        requireWritable(arguments.gamutMap);
    }
    requireOther("-o", arguments.output, arguments.cube);
    requireWritable(arguments.output);
    return task;
}

/// What a second observer sees on the display against what he sees of the scene, both as he is adapted.
Json secondLook(const ObserveArguments& arguments, const Task& task, const RenderedPicture& rendered,
                const Cube& cube, Notes& notes) {
    ObserverArguments second = arguments.observer;
    second.observer = arguments.seenBy;
    second.projector = second.viewer = "";
    const Observation observation(second, cube.info, notes);
    if (!observation.detector().tristimulus)
        throw InputError("--seen-by: '" + arguments.seenBy + "' is no observer with X, Y, Z");
    const Display display = task.spectral->seenBy(observation.detector());
    ChannelImage own = observation.channels(cube);
    Rendering his = task.rendering;
    his.base.display = display;
    his.base.white = observation.white(own);
    // His scene, in the display's XYZ for him: the same adaptation, exposure and tone as he sees them, but no
    // display in between.
    const Matrix3 toSignals = renderingMatrix(his, displayWhiteLuminance(own, his.base));
    for (size_t i = 0; i < own.pixels(); ++i) {
        const Triple xyz = display.toXyz * toned(toSignals * own.triple(i), display, his.tone);
        for (size_t k = 0; k < 3; ++k)
            own.plane[k][i] = xyz[k];
    }
    const ColourDifference difference = displayMetamerism(rendered.signals, display, own);
    notes.say(fmt::format("'{}' on {} for {}: CIEDE2000 mean {}, 95 % {}, max {} at {},{}", arguments.output,
                          task.spectral->name, arguments.seenBy, rounded(difference.mean, 4),
                          rounded(difference.p95, 4), rounded(difference.max, 4), difference.maxX,
                          difference.maxY));
    return {{"observer", arguments.seenBy},
            {"mean", difference.mean},
            {"p95", difference.p95},
            {"max", difference.max},
            {"max_at", {difference.maxX, difference.maxY}}};
}

Json writePicture(const ObserveArguments& arguments, Task task, const Observation& observation,
                  const Cube& cube, const ChannelImage& channels, Notes& notes) {
    const ChannelImage xyz = observation.xyz(channels);
    DevelopSettings& settings = task.rendering.base;
    // A file's chromaticities are CIE 1931's, whoever looks.
    const PictureColour colour = pictureColour(settings.display);
    if (task.spectral && observation.detector().tristimulus)
        settings.display = task.spectral->seenBy(observation.detector());
    const White white = settings.white = observation.white(xyz);
    const RenderedPicture rendered = render(xyz, task.rendering);
    const DevelopedPicture& picture = rendered.picture;
    if (!arguments.gamutMap.empty())
        writePng(arguments.gamutMap, {picture.width, picture.height, 3, rendered.map},
                 {{"Description", "outside the display's range: blue below 0, red above 1, magenta both"}});
    writePng(arguments.output, {picture.width, picture.height, 3, picture.rgb},
             {{"Software", "spectrad " SPECTRAD_VERSION},
              {"Description",
               fmt::format("{} seen by {}, white {} at {}, {} adaptation, for {}", arguments.cube,
                           observation.detector().name, white.name,
                           observation.light()
                               ? fmt::format("Y = {}", rounded(picture.whiteLuminance, 6))
                               : fmt::format("{} {}", rounded(picture.whiteLuminance, 6),
                                             cube.info.kind == CubeKind::irradiance ? "lx" : "cd/m2"),
                           arguments.adapt, settings.display.name)}},
             colour);
    constexpr double worthSaying = 0.02;  // the percentile of auto exposure alone clips 1 %
    if (picture.clippedShare() > worthSaying)
        notes.say(fmt::format(
            "{:.1f} % of the pixels lie outside the display's range and were clipped (--exposure changes it)",
            picture.clippedShare() * 100));
    Json out{{"white", {{"name", white.name}, {"XYZ", white.xyz}, {"has_luminance", white.hasLuminance}}},
             {"white_luminance_cd_m2", picture.whiteLuminance},
             {"clipped_pixels", picture.clipped},
             {"display", settings.display.name},
             {"adapt", arguments.adapt}};
    if (!arguments.seenBy.empty())
        out["display_metamerism"] = secondLook(arguments, task, rendered, cube, notes);
    return out;
}

/// A detector's own channels are absolute and unadapted; a film's alone know an exposure.
void sayWhatChannelsIgnore(std::vector<std::string> shaping, bool film, Notes& notes) {
    if (film) std::erase(shaping, "--exposure");
    if (!shaping.empty())
        notes.say(fmt::format("the detector's channels are absolute and unadapted: {} {} a picture only",
                              fmt::join(shaping, ", "), shaping.size() == 1 ? "shapes" : "shape"));
}

Json writeChannels(const ObserveArguments& arguments, const Observation& observation, CubeKind kind,
                   const ChannelImage& channels) {
    const Detector& detector = observation.detector();
    const bool irradiance = kind == CubeKind::irradiance;
    const char* photometric = irradiance ? "lx" : "cd.m^-2";
    std::string unit = detector.tristimulus ? fmt::format("{} (Y)", photometric)
                       : detector.luminous  ? fmt::format("{} (V of {})", photometric, detector.name)
                       : irradiance         ? "W.m^-2 x sensitivity"
                                            : "W.m^-2.sr^-1 x sensitivity";
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
    if (!task.picture) sayWhatChannelsIgnore(arguments.shaping, film, console.notes());
    if (film) observer.filmStops = std::exchange(task.rendering.base.exposure, Exposure{}).ev;
    const Observation observation(observer, cube.info, console.notes());
    console.printNotes();
    const ChannelImage channels = observation.channels(cube);
    const Json details = task.picture
                             ? writePicture(arguments, task, observation, cube, channels, console.notes())
                             : writeChannels(arguments, observation, cube.info.kind, channels);
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
                     "chromatic adaptation from the white to the display's; none keeps "
                     "chromaticities; default: cat16")
        ->type_name("cat16|bradford|vonkries|none");
    command
        ->add_option("--display", arguments->display,
                     "the display, a file of its primaries' chromaticities, white and gamma, or by the "
                     "spectra of its primaries: "
                     "displays/lcd-apple-studio, displays/crt-brainard-1997, x.csv with the columns R, G, B; "
                     "default: srgb")
        ->type_name("srgb|p3|rec2020|FILE");
    command
        ->add_option("--degree", arguments->degree, "degree of adaptation, D of CIECAM16, 0 to 1; default: 1")
        ->type_name("D");
    command
        ->add_option(
            "--tone", arguments->tone,
            "reinhard bends luminances up to four times the display's white into its range; default: linear")
        ->type_name("linear|reinhard");
    command
        ->add_option("--gamut", arguments->gamut,
                     "colours that the display lacks: each channel clipped, or moved towards the grey of the "
                     "same luminance; "
                     "default: clip")
        ->type_name("clip|desaturate");
    command
        ->add_option("--gamut-map", arguments->gamutMap,
                     "also a map of them: blue where a signal is below 0, red above 1, magenta both")
        ->type_name("OUT.png");
    command
        ->add_option("--seen-by", arguments->seenBy,
                     "how far the picture on a display given by spectra is from the scene for another "
                     "observer, in CIEDE2000")
        ->type_name("OBSERVER");
    command
        ->add_option("--exposure", arguments->exposure,
                     "stops: the white's luminance x 2^-EV is shown as display white; auto, and a white "
                     "without luminance: "
                     "the 99th percentile of Y is; a film is exposed by EV stops more; default: 0")
        ->type_name("EV|auto");
    command->add_flag("--json", arguments->json, "print a JSON object about what was written");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    command->footer(
        "XYZ are absolute, Y in cd/m2 (683 lm/W at 540 THz). A slit cube meets the detector by least-squares "
        "projection, a point cube by the trapezoid rule. A camera's or the cones' channels reach a display "
        "through the matrix to XYZ that fits their sensitivities best.\n\n"
        "Examples:\n"
        "  spectrad observe scene.exr -o scene.png\n"
        "  spectrad observe scene.exr -o tungsten.png --white illuminants/A --exposure 1\n"
        "  spectrad observe scene.exr -o wide.png --display p3 --white at:120,80\n"
        "  spectrad observe scene.exr -o cones.exr --observer stockman-sharpe-2");
    command->final_callback([&action, arguments, command] {
        for (const char* option : {"--adapt", "--degree", "--display", "--exposure", "--tone", "--gamut"})
            if (command->count(option) > 0) arguments->shaping.emplace_back(option);
        action = [arguments] { return observe(*arguments); };
    });
}

}  // namespace spectrad
