// spectrad compare: how far two cubes are apart, over their bands and to an eye.
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/observation.h"
#include "cli/options.h"
#include "colour/develop.h"
#include "colour/difference.h"
#include "image/cube.h"
#include "image/picture.h"
#include "verify/tolerance.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace spectrad {

namespace {

struct CompareArguments {
    std::string a, b, maxDeltaE, tolerance, map, adapt = "cat16";
    ObserverArguments observer;
    std::vector<std::string> observers;  ///< of A and of B, each adapted to its own white
    bool colours = false;                ///< not the bands: they may be others
    bool json = false, quiet = false;
};

struct Bands {
    BandDifference all;
    /// Of each pixel the largest error of a band ÷ A's largest value in that band.
    double mean = 0, p95 = 0, p99 = 0;
};

struct Result {
    std::optional<Bands> bands;              ///< nothing with --colours
    std::optional<ColourDifference> colour;  ///< nothing where A is black and --white has no luminance
    White white;
};

void requireComparable(const CubeInfo& a, const CubeInfo& b, bool bands, Notes& notes) {
    if (a.width != b.width || a.height != b.height)
        throw InputError(fmt::format("the sizes differ: A has {} x {} pixels, B {} x {}", a.width, a.height,
                                     b.width, b.height));
    if (a.kind != b.kind)
        throw InputError(fmt::format("the quantities differ: A holds {}, B {}", name(a.kind), name(b.kind)));
    if (!bands) return;
    const std::vector<double>&nmA = a.wavelengths.nm, &nmB = b.wavelengths.nm;
    if (nmA.size() != nmB.size())
        throw InputError(
            fmt::format("the wavelengths differ: A has {} bands, B {} (--colours compares only "
                        "what an observer sees of them)",
                        nmA.size(), nmB.size()));
    constexpr double tolerance = 1e-4;  // nm: other programs write three to six decimals
    for (size_t band = 0; band < nmA.size(); ++band)
        if (std::abs(nmA[band] - nmB[band]) > tolerance)
            throw InputError(fmt::format("the wavelengths differ: band {} is {} nm in A, {} nm in B",
                                         band + 1, shortest(nmA[band]), shortest(nmB[band])));
    if (a.wavelengths.projection != b.wavelengths.projection)
        notes.warn(fmt::format("the bands mean different things: {} in A, {} in B",
                               name(a.wavelengths.projection), name(b.wavelengths.projection)));
}

Bands bandDifference(const Cube& a, const Cube& b) {
    BandDifferenceMeter meter(a.info.wavelengths.size(), a.info.width);
    for (int y = 0; y < a.info.height; ++y)
        meter.add(a.row(y, 0), b.row(y, 0));
    std::vector<double> errors;
    for (int y = 0; y < a.info.height; ++y)
        meter.relativeErrors(a.row(y, 0), b.row(y, 0), errors);
    const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
    return {meter.result(), sum / static_cast<double>(errors.size()), quantile(errors, 0.95),
            quantile(errors, 0.99)};
}

/// XYZ of a cube seen by one observer, adapted from its own white to equal energy; the white's luminance, or
/// the brightest pixel's, becomes 100.
ChannelImage adapted(const ObserverArguments& observer, Adaptation method, const Cube& cube, Notes& notes,
                     White& white) {
    const Observation sees(observer, cube.info, notes);
    ChannelImage xyz = sees.xyz(sees.channels(cube));
    white = sees.white(xyz);
    if (!white.hasLuminance) white = withLuminance(white, brightest(xyz));
    if (!(white.xyz[1] > 0)) throw InputError("a black cube has no white to adapt from");
    const double scale = 100 / white.xyz[1];
    const Matrix3 toEqual = adaptation(method, white.xyz, {1, 1, 1}) * diagonal({scale, scale, scale});
    for (size_t i = 0; i < xyz.pixels(); ++i) {
        const Triple seen = toEqual * xyz.triple(i);
        for (size_t k = 0; k < 3; ++k)
            xyz.plane[k][i] = seen[k];
    }
    return xyz;
}

/// What two observers make of two cubes (or of one), or one observer of two lights, each adapted.
Result compareObservers(const CompareArguments& arguments, const Cube& a, const Cube& b, Notes& notes) {
    Result result;
    const Adaptation method = asUsage("--adapt", [&] { return parseAdaptation(arguments.adapt); });
    ObserverArguments first = arguments.observer, second = arguments.observer;
    first.observer = arguments.observers[0];
    second.observer = arguments.observers[1];
    for (ObserverArguments* one : {&first, &second})
        if (!namesFilm(one->observer)) one->projector = one->viewer = "";
    White whiteA, whiteB;
    const ChannelImage xyzA = adapted(first, method, a, notes, whiteA),
                       xyzB = adapted(second, method, b, notes, whiteB);
    result.white = {whiteA.name + " and " + whiteB.name + ", adapted to E", {100, 100, 100}, true};
    result.colour = colourDifference(xyzA, xyzB, result.white.xyz);
    return result;
}

Result compareCubes(const CompareArguments& arguments, const Cube& a, const Cube& b, Notes& notes) {
    Result result;
    const Observation seesA(arguments.observer, a.info, notes), seesB(arguments.observer, b.info, notes);
    const ChannelImage xyzA = seesA.xyz(seesA.channels(a)), xyzB = seesB.xyz(seesB.channels(b));
    result.white = seesA.white(xyzA);
    const double brightestA = brightest(xyzA);
    if (!result.white.hasLuminance && !(brightestA > 0)) {
        notes.warn("A is black: there is no white for a colour difference (--white X,Y,Z gives one)");
        return result;
    }
    result.white = withLuminance(result.white, brightestA);
    if (std::any_of(result.white.xyz.begin(), result.white.xyz.end(), [](double v) { return !(v > 0); })) {
        notes.warn(
            fmt::format("{} has no {}: it cannot be the white of a colour difference (--white gives "
                        "another)",
                        result.white.name, result.white.xyz[0] > 0 ? "Z" : "X"));
        return result;
    }
    result.colour = colourDifference(xyzA, xyzB, result.white.xyz);
    return result;
}

void writeMap(const std::string& file, const CubeInfo& info, const ColourDifference& colour) {
    writePng(file, {info.width, info.height, 3, falseColours(colour.map, colour.max > 0 ? colour.max : 1)},
             {{"Description", "CIEDE2000 from 0 (dark blue) to " + rounded(colour.max, 6) + " (yellow)"}});
}

/// Bands' figures are undefined with --colours, and the shapes' where no pixel has a shape in both.
Json described(const Result& result, const CompareArguments& arguments) {
    const BandDifference* bands = result.bands ? &result.bands->all : nullptr;
    const bool shapes = bands && bands->compared > 0;
    Json out{{"band_rmse", bands ? Json(bands->rmse) : Json()},
             {"band_relative_max", bands ? Json(bands->relativeMax) : Json()},
             {"band_relative", bands ? Json{{"mean", result.bands->mean},
                                            {"p95", result.bands->p95},
                                            {"p99", result.bands->p99},
                                            {"max", bands->relativeMax}}
                                     : Json()},
             {"gfc_min", shapes ? Json(bands->gfcMin) : Json()},
             {"spectral_angle_max_rad", shapes ? Json(bands->spectralAngleMax) : Json()},
             {"black_in_one", bands ? Json(bands->blackInOne) : Json()}};
    if (result.colour) {
        const ColourDifference& colour = *result.colour;
        out["deltae00"] = {{"mean", colour.mean},
                           {"p95", colour.p95},
                           {"p99", colour.p99},
                           {"max", colour.max},
                           {"max_at", {colour.maxX, colour.maxY}}};
        out["deltae76"] = {{"mean", colour.mean76}, {"max", colour.max76}};
    } else {
        out["deltae00"] = {
            {"mean", nullptr}, {"p95", nullptr}, {"p99", nullptr}, {"max", nullptr}, {"max_at", nullptr}};
        out["deltae76"] = {{"mean", nullptr}, {"max", nullptr}};
    }
    out["observer"] = arguments.observer.observer;
    if (!arguments.observers.empty()) out["observers"] = arguments.observers;
    out["white"] = {{"name", result.white.name}, {"XYZ", result.white.xyz}};
    if (!arguments.map.empty() && result.colour)
        out["map"] = {{"file", arguments.map}, {"deltae00_from", 0}, {"deltae00_to", result.colour->max}};
    return out;
}

void printBands(const Bands& of, const CubeInfo& info) {
    const BandDifference& bands = of.all;
    printText(fmt::format("band rmse            {} {}\n", rounded(bands.rmse, 6), unit(info.kind)));
    if (std::isfinite(bands.relativeMax))
        printText(fmt::format(
            "band relative max    {} (at {} nm); of pixels' largest: mean {}, 95 % {}, 99 % {}\n",
            rounded(bands.relativeMax, 6), rounded(info.wavelengths.nm.at(bands.relativeMaxBand), 9),
            rounded(of.mean, 4), rounded(of.p95, 4), rounded(of.p99, 4)));
    else
        printText(fmt::format("band relative max    undefined (A is zero at {} nm, B is not)\n",
                              rounded(info.wavelengths.nm.at(bands.relativeMaxBand), 9)));
    if (bands.compared > 0)
        printText(fmt::format("gfc min              {}\nspectral angle max   {} rad\n",
                              rounded(bands.gfcMin, 9), rounded(bands.spectralAngleMax, 6)));
    if (bands.blackInOne > 0) printText(fmt::format("black in one only    {} pixels\n", bands.blackInOne));
}

void printTable(const Result& result, const CompareArguments& arguments, const CubeInfo& info) {
    if (result.bands) printBands(*result.bands, info);
    if (!result.colour) return;
    const ColourDifference& colour = *result.colour;
    printText(fmt::format(
        "CIEDE2000            mean {}, 95 % {}, 99 % {}, max {} at {},{} (white {} at Y = {}, {})\n",
        rounded(colour.mean, 4), rounded(colour.p95, 4), rounded(colour.p99, 4), rounded(colour.max, 4),
        colour.maxX, colour.maxY, result.white.name, rounded(result.white.xyz[1], 5),
        arguments.observers.empty() ? arguments.observer.observer
                                    : arguments.observers[0] + " and " + arguments.observers[1]));
    if (!arguments.map.empty())
        printText(fmt::format("map                  {}: CIEDE2000 from 0 (dark blue) to {} (yellow)\n",
                              arguments.map, rounded(colour.max, 4)));
}

/// Beyond the bound, or without a difference to hold against it although the cubes are not the same.
ExitCode judged(const Result& result, double bound) {
    if (!result.colour) {
        if (result.bands && result.bands->all.rmse == 0) return ExitCode::ok;
        printError("the colour difference is undefined, so it is not within the bound");
        return ExitCode::input;
    }
    if (result.colour->max <= bound) return ExitCode::ok;
    printError(fmt::format("CIEDE2000 is {} at {},{}, beyond the bound of {}", rounded(result.colour->max, 6),
                           result.colour->maxX, result.colour->maxY, shortest(bound)));
    return ExitCode::input;
}

/// The largest or the 99 % figure of the pair that the tolerance is about.
ExitCode judged(const Result& result, const Tolerance& tolerance) {
    if (!tolerance.radiance && !result.colour) return judged(result, tolerance.bound);
    const double got = tolerance.radiance
                           ? (tolerance.all ? result.bands->all.relativeMax : result.bands->p99)
                           : (tolerance.all ? result.colour->max : result.colour->p99);
    if (got <= tolerance.bound) return ExitCode::ok;
    printError(fmt::format("beyond the tolerance ({}): {}", tolerance.words(),
                           tolerance.radiance ? rounded(100 * got, 6) + " %" : rounded(got, 6)));
    return ExitCode::input;
}

ExitCode compare(const CompareArguments& arguments) {
    constexpr double infinity = std::numeric_limits<double>::max();
    const double bound = arguments.maxDeltaE.empty()
                             ? infinity
                             : parseNumber("--max-deltae", arguments.maxDeltaE, 0, infinity);
    std::optional<Tolerance> tolerance;
    if (!arguments.tolerance.empty())
        tolerance = asUsage("--tolerance", [&] { return parseTolerance(arguments.tolerance); });
    if (tolerance && tolerance->radiance && arguments.colours)
        throw UsageError("--tolerance: bands are not compared with --colours");
    if (!arguments.map.empty()) {
        if (extensionOf(arguments.map) != ".png")
            throw UsageError("--map: '" + arguments.map + "' must end in .png");
        requireWritable(arguments.map);
    }
    Console console(arguments.quiet);
    const bool two = !arguments.observers.empty();
    if (arguments.b.empty() && !two)
        throw UsageError("compare needs two cubes, or one and --observers; see 'spectrad compare --help'");
    const Cube a = readCube(arguments.a, console.notes()),
               b = readCube(arguments.b.empty() ? arguments.a : arguments.b, console.notes());
    requireComparable(a.info, b.info, !arguments.colours, console.notes());
    Result result = two ? compareObservers(arguments, a, b, console.notes())
                        : compareCubes(arguments, a, b, console.notes());
    if (!arguments.colours) result.bands = bandDifference(a, b);
    console.printNotes();
    if (!arguments.map.empty() && result.colour) writeMap(arguments.map, a.info, *result.colour);
    if (arguments.json)
        printJson(described(result, arguments));
    else
        printTable(result, arguments, a.info);
    const ExitCode far = arguments.maxDeltaE.empty() ? ExitCode::ok : judged(result, bound);
    return far == ExitCode::ok && tolerance ? judged(result, *tolerance) : far;
}

}  // namespace

void addCompare(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("compare", "Compare two cubes: bands, spectral shapes, CIEDE2000");
    auto arguments = std::make_shared<CompareArguments>();
    command->add_option("A", arguments->a, "spectral image, EXR or ENVI")->type_name("A.exr")->required();
    command
        ->add_option("B", arguments->b, "another of the same size and wavelengths (with --colours, of any)")
        ->type_name("B.exr");
    addObserverOptions(*command, arguments->observer);
    command
        ->add_option("--observers", arguments->observers,
                     "who sees A and who sees B (A again where there is no B), each adapted from its own "
                     "white to equal "
                     "energy: two detectors, or with twice the same, two lights")
        ->type_name("NAME NAME")
        ->expected(2);
    command->add_option("--adapt", arguments->adapt, "the adaptation of --observers; default: cat16")
        ->type_name("cat16|bradford|vonkries|none");
    command
        ->add_option("--max-deltae", arguments->maxDeltaE,
                     "exit with 1 if CIEDE2000 of any pixel is beyond this")
        ->type_name("X");
    command
        ->add_option("--tolerance", arguments->tolerance,
                     "exit with 1 beyond it: 0.5 (CIEDE2000 of 99 % of the pixels), max:0.5 (of all), 1%rad "
                     "(bands' radiance), max:1%rad")
        ->type_name("T");
    command
        ->add_option("--map", arguments->map,
                     "write CIEDE2000 of each pixel in false colours; the range is printed")
        ->type_name("OUT.png");
    command->add_flag("--colours", arguments->colours,
                      "compare what the observer sees, not the bands: A and B may have other wavelengths");
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    command->footer(
        "band rmse: root mean square of A - B over pixels and bands, in the cubes' unit "
        "(W.m^-2.sr^-1.nm^-1). band relative max: the largest |A - B| of a band by A's largest value in it; "
        "each pixel has one such band: their mean and quantiles. "
        "gfc: goodness of fit, the cosine between two pixels' spectra; spectral angle: in rad. A white "
        "without luminance counts at A's brightest Y.\n\n"
        "Examples:\n"
        "  spectrad compare reference.exr new.exr --max-deltae 0.5\n"
        "  spectrad compare reference.exr new.exr --tolerance 1%rad\n"
        "  spectrad compare every-nm.exr ten-bands.exr --colours --json\n"
        "  spectrad compare a.exr --observers cie1931-2 nikon-5100 --map camera.png\n"
        "  spectrad compare daylight.exr tungsten.exr --observers cie1931-2 cie1931-2\n"
        "  spectrad compare a.exr b.exr --observer cie1964-10 --map difference.png --json");
    command->final_callback([&action, arguments] { action = [arguments] { return compare(*arguments); }; });
}

}  // namespace spectrad
