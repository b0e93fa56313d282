// spectrad expose: a cube through a camera's signal chain, to raw counts and a rendered picture.
#include "base/text.h"
#include "camera/colour_fit.h"
#include "camera/mosaic.h"
#include "camera/sensor.h"
#include "cli/camera_commands.h"
#include "cli/console.h"
#include "cli/observation.h"
#include "cli/options.h"
#include "colour/develop.h"
#include "image/picture.h"
#include "image/picture_colour.h"
#include "image/png16.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace spectrad {

namespace {

struct ExposeArguments {
    std::string cube, output, picture, fNumber = "4", time = "0.01", pitch = "4", readNoise = "0",
                                       darkCurrent = "0", fullWell, bits, black = "0", seed = "1", mosaic,
                                       chart = "charts/colorchecker", display = "srgb";
    ObserverArguments observer{
        "qe:sensors/ccd * filters/ir-cut * (R = filters/red, G = filters/green, B = filters/blue)", ""};
    bool noShotNoise = false, json = false, quiet = false;
};

Sensor sensorOf(const ExposeArguments& arguments) {
    constexpr double most = 1e12;
    Sensor sensor;
    Shutter shutter;
    shutter.fNumber = parseNumber("--f-number", arguments.fNumber, 0.5, 1000);
    shutter.seconds = parseNumber("--time", arguments.time, 1e-9, 1e6);
    shutter.pitchMicrometres = parseNumber("--pitch", arguments.pitch, 0.01, 1e5);
    sensor.electronsPerSignal = shutter.electronsPerSignal();
    sensor.seconds = shutter.seconds;
    sensor.shotNoise = !arguments.noShotNoise;
    sensor.readNoise = parseNumber("--read-noise", arguments.readNoise, 0, most);
    sensor.darkCurrent = parseNumber("--dark-current", arguments.darkCurrent, 0, most);
    if (!arguments.fullWell.empty())
        sensor.fullWell = parseNumber("--full-well", arguments.fullWell, 1, most);
    if (!arguments.bits.empty()) sensor.bits = parseCount("--bits", arguments.bits, 1, 16);
    sensor.black = parseNumber("--black", arguments.black, 0, 65535);
    sensor.seed = static_cast<std::uint64_t>(parseCount("--seed", arguments.seed, 0, 2'147'483'647));
    if (!sensor.bits && sensor.black != 0)
        throw UsageError("--black is a count: it needs --bits and --full-well");
    if (sensor.bits && !sensor.fullWell)
        throw UsageError("--bits needs --full-well: the electrons that become the last count");
    if (sensor.bits && sensor.black >= std::exp2(*sensor.bits) - 1)
        throw UsageError("--black: '" + arguments.black + "' leaves no counts for light");
    return sensor;
}

/// What made the raw values, as a camera's file says it.
std::map<std::string, std::string> takenWith(const ExposeArguments& arguments, const Sensor& sensor) {
    std::map<std::string, std::string> said{{"observer", arguments.observer.observer},
                                            {"unit", sensor.bits ? "counts" : "electrons"},
                                            {"f-number", arguments.fNumber},
                                            {"time s", arguments.time},
                                            {"pitch um", arguments.pitch},
                                            {"read noise electrons", arguments.readNoise},
                                            {"dark current electrons/s", arguments.darkCurrent},
                                            {"shot noise", sensor.shotNoise ? "yes" : "no"},
                                            {"seed", arguments.seed},
                                            {"cube", arguments.cube},
                                            {"program", "spectrad " SPECTRAD_VERSION}};
    if (!arguments.mosaic.empty()) said["mosaic"] = arguments.mosaic;
    if (sensor.fullWell) said["full well electrons"] = arguments.fullWell;
    if (sensor.bits) {
        said["bits"] = arguments.bits;
        said["black count"] = arguments.black;
        said["gain counts/electron"] = shortest(countsPerElectron(sensor));
    }
    return said;
}

void writeRaw(const ExposeArguments& arguments, const ChannelImage& raw,
              const std::vector<std::string>& channels, const Sensor& sensor,
              const std::map<std::string, std::string>& said) {
    if (extensionOf(arguments.output) == ".exr") {
        writeChannelsExr(arguments.output, raw.width, raw.height, channels, floatPlanes(raw, channels), said);
        return;
    }
    Picture16 picture{raw.width, raw.height, static_cast<int>(raw.plane.size()), {}, *sensor.bits};
    for (size_t i = 0; i < raw.pixels(); ++i)
        for (const std::vector<double>& plane : raw.plane)
            picture.pixels.push_back(
                static_cast<std::uint16_t>(std::clamp(std::round(plane[i]), 0.0, 65535.0)));
    writePng16(arguments.output, picture, said);
}

/// Channels balanced on the white, through the matrix fitted to the chart under it. Where one channel is full
/// all are cut as low: what is brighter than the sensor can tell is white, not the colour of the others.
DevelopedPicture rendered(const ExposeArguments& arguments, const ChannelImage& electrons,
                          double fullElectrons, const Observation& observation, const Curve& light) {
    const Detector &detector = observation.detector(), &eye = observation.standard();
    const Spectrum chart = observation.resolver().resolve(arguments.chart, Role::any, {});
    if (chart.quantity != Quantity::reflectance && chart.quantity != Quantity::unknown)
        throw InputError("--chart: '" + arguments.chart + "' is no chart of reflectances");
    std::vector<Curve> patches;
    for (const Curve& patch : chart.curves)
        patches.push_back(patch.withOutside(Outside::hold));
    const XyzMatrix matrix = fittedMatrix(detector, eye, light, patches);
    const std::array<const Curve*, 1> alone{&light};
    const std::vector<double> white = respond(detector, alone);
    const double full = fullElectrons / *std::max_element(white.begin(), white.end());
    ChannelImage balanced = electrons;
    for (size_t c = 0; c < white.size(); ++c)
        for (double& value : balanced.plane[c])
            value = std::min(value / white[c], full);
    DevelopSettings settings;
    settings.white = {"", respondXyz(eye, alone), false};
    settings.display = displayFor(arguments.display);
    settings.exposure.automatic = true;
    return develop(toXyz(matrix, balanced), settings);
}

/// Electrons are counted by what says how many a photon frees.
void requireElectrons(const Detector& detector) {
    if (!detector.electrons)
        throw InputError(
            fmt::format("--observer: '{0}' has no quantum efficiency, so nothing says how many electrons its "
                        "signal is{1} "
                        "(a product with one does, as 'qe:sensors/ccd * filters/ir-cut')",
                        detector.name,
                        detector.channels == std::vector<std::string>{"R", "G", "B"}
                            ? fmt::format("; 'qe:{}' takes its curves as one", detector.name)
                            : ""));
}

/// The spectrum that the picture is balanced on. Throws InputError where it is not known.
Spectrum whiteLight(const ExposeArguments& arguments, const CubeInfo& info, const Observation& observation) {
    if (observation.light()) return *observation.light();
    const SpectrumResolver& resolver = observation.resolver();
    const std::string& wanted = arguments.observer.white;
    if (!wanted.empty()) return resolver.resolve(wanted, Role::light, {});
    const auto name = info.attributes.find(attribute::white);
    if (name == info.attributes.end()) return resolver.resolve("constant:1", Role::light, {});
    if (!info.attributes.contains(attribute::whiteXyz))
        return resolver.resolve(name->second, Role::light, {});
    if (auto stated = statedLight(info, observation.standard(), resolver)) return *stated;
    throw InputError(
        fmt::format("the spectrum of the scene's first light, '{}', is not known here: --picture "
                    "needs --white LIGHT",
                    name->second));
}

ExitCode exposeCube(const ExposeArguments& arguments) {
    const Sensor sensor = sensorOf(arguments);
    const std::string extension = extensionOf(arguments.output);
    if (extension != ".png" && extension != ".exr")
        throw UsageError("-o: '" + arguments.output + "' must end in .exr or .png (16 bits)");
    if (extension == ".png" && !sensor.bits)
        throw UsageError("-o: a PNG holds counts, which --bits and --full-well make");
    if (!arguments.picture.empty() && extensionOf(arguments.picture) != ".png")
        throw UsageError("--picture: '" + arguments.picture + "' must end in .png");
    requireWritable(arguments.output);
    if (!arguments.picture.empty()) requireWritable(arguments.picture);
    if (namesFilm(arguments.observer.observer))
        throw UsageError("--observer: a film has no counts (observe shows it)");
    if (!arguments.observer.white.empty() && !namesLight(arguments.observer.white))
        throw UsageError("--white: a picture's matrix is fitted under a light's spectrum: '" +
                         arguments.observer.white + "' is none");

    Console console(arguments.quiet);
    const Cube cube = readCube(arguments.cube, console.notes());
    if (arguments.picture.empty() && !arguments.observer.white.empty() && !needsLight(cube.info.kind))
        throw UsageError("--white: of a radiance only --picture has a white");
    if (cube.info.kind == CubeKind::irradiance)
        throw InputError(arguments.cube + ": an irradiance is no light that a lens sees (radiance is)");
    const Observation observation(arguments.observer, cube.info, console.notes());
    const Detector& detector = observation.detector();
    requireElectrons(detector);
    std::optional<Spectrum> light;
    if (!arguments.picture.empty()) light = whiteLight(arguments, cube.info, observation);
    std::optional<Mosaic> mosaic;
    if (!arguments.mosaic.empty()) mosaic.emplace(arguments.mosaic, detector.channels);
    if (extension == ".png" && !mosaic && detector.size() != 1 && detector.size() != 3)
        throw UsageError(fmt::format("-o: a PNG takes 1 or 3 channels, the detector has {} (write .exr)",
                                     detector.size()));
    if (observation.light())
        console.notes().say(fmt::format("'{}' lights it with as much as gives a perfect diffuser {} cd/m2",
                                        observation.light()->text, diffuserY));
    if (detector.relative)
        console.notes().say(
            "of some of the camera's curves only the shape is known: electrons are in proportion, "
            "not in number");
    const ChannelImage signals = observation.channels(cube);
    RawImage raw = mosaic ? expose(sampled(signals, *mosaic), sensor) : expose(signals, sensor);
    if (raw.fullPixels > 0)
        console.notes().say(fmt::format("{} of {} pixels are full", raw.fullPixels, signals.pixels()));
    const std::map<std::string, std::string> said = takenWith(arguments, sensor);
    const std::vector<std::string> channels = mosaic ? std::vector<std::string>{"raw"} : detector.channels;
    writeRaw(arguments, raw.values, channels, sensor, said);
    Json out{{"output", arguments.output},
             {"unit", sensor.bits ? "counts" : "electrons"},
             {"electrons_per_signal", sensor.electronsPerSignal},
             {"full_pixels", raw.fullPixels},
             {"taken_with", said},
             {"channels", channels}};
    if (!arguments.picture.empty()) {
        const ChannelImage electrons = electronsOf(std::move(raw.values), sensor);
        const DevelopedPicture picture =
            rendered(arguments, mosaic ? demosaiced(electrons, *mosaic) : electrons, fullElectrons(sensor),
                     observation, light->curve());
        writePng(arguments.picture, {picture.width, picture.height, 3, picture.rgb},
                 {{"Software", "spectrad " SPECTRAD_VERSION}}, pictureColour(displayFor(arguments.display)));
        out["picture"] = arguments.picture;
        out["white"] = light->text;
    }
    console.printNotes();
    if (arguments.json) printJson(out);
    return ExitCode::ok;
}

}  // namespace

void addExpose(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand(
        "expose", "Put a cube through a camera's signal chain: raw counts, and a picture of them");
    auto arguments = std::make_shared<ExposeArguments>();
    command->add_option("CUBE", arguments->cube, "spectral image, EXR or ENVI")
        ->type_name("CUBE.exr")
        ->required();
    command
        ->add_option("-o,--output", arguments->output,
                     "x.exr: raw values as floats; x.png: counts in 16 bits")
        ->type_name("RAW.exr|RAW.png")
        ->required();
    command
        ->add_option("--observer", arguments->observer.observer,
                     "the camera: a product with a quantum efficiency (electrons per photon), as qe:CURVE or "
                     "'qe:CURVE * filters/red', or a detector of a scene; default: "
                     "qe:sensors/ccd behind filters/ir-cut and red, green, blue separation filters")
        ->type_name("NAME|FILE|PRODUCT");
    command->add_option("--f-number", arguments->fNumber, "of the lens; default: 4")->type_name("N");
    command->add_option("--time", arguments->time, "exposure in s; default: 0.01")->type_name("S");
    command->add_option("--pitch", arguments->pitch, "side of a pixel in micrometres; default: 4")
        ->type_name("UM");
    command->add_flag("--no-shot-noise", arguments->noShotNoise, "leave out the photons' noise");
    command->add_option("--read-noise", arguments->readNoise, "root mean square in electrons; default: 0")
        ->type_name("E");
    command->add_option("--dark-current", arguments->darkCurrent, "electrons per second; default: 0")
        ->type_name("E");
    command->add_option("--full-well", arguments->fullWell, "electrons that a pixel holds; default: no limit")
        ->type_name("E");
    command
        ->add_option("--bits", arguments->bits,
                     "quantise: the full well becomes 2^bits - 1; 1 to 16; default: electrons")
        ->type_name("N");
    command->add_option("--black", arguments->black, "count of no light, with --bits; default: 0")
        ->type_name("COUNT");
    command
        ->add_option("--seed", arguments->seed,
                     "of the noise; the same seed gives the same bytes; default: 1")
        ->type_name("N");
    command
        ->add_option("--mosaic", arguments->mosaic,
                     "one channel a pixel, as RGGB (R G over G B); the raw image has one plane")
        ->type_name("PATTERN");
    command
        ->add_option(
            "--picture", arguments->picture,
            "also a picture: demosaiced, balanced on the white, through a matrix fitted to the chart")
        ->type_name("OUT.png");
    command
        ->add_option("--white", arguments->observer.white,
                     "the light that the picture is balanced for; default: the scene's first light")
        ->type_name("LIGHT");
    command
        ->add_option("--chart", arguments->chart,
                     "reflectances that the matrix is fitted to; default: charts/colorchecker")
        ->type_name("NAME|FILE");
    command->add_option("--display", arguments->display, "of the picture; default: srgb")
        ->type_name("srgb|p3|rec2020|FILE");
    for (const char* option : {"--chart", "--display"})
        command->get_option(option)->needs("--picture");
    command->add_flag("--json", arguments->json, "print a JSON object about what was written");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    command->footer(
        "Electrons are the camera's signal times pi / (4 N^2) x pitch^2 x time, all over the picture (no "
        "vignetting; the pitch is --pitch, whatever the scene's camera is). Photons arrive by Poisson's "
        "law, reading adds a "
        "normal error; each pixel and channel draws from the seed by its own number, whatever the order.\n\n"
        "Examples:\n"
        "  spectrad expose scene.exr -o raw.exr --time 0.02 --f-number 2.8\n"
        "  spectrad expose scene.exr -o raw.png --bits 12 --read-noise 3 --mosaic RGGB --picture p.png");
    command->final_callback(
        [&action, arguments] { action = [arguments] { return exposeCube(*arguments); }; });
}

}  // namespace spectrad
