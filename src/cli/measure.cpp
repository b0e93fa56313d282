// spectrad measure: the spectroradiometer: spectra and colorimetry of places in a cube.
#include "base/text.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/observation.h"
#include "cli/options.h"
#include "colour/cct.h"
#include "image/cube.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spectrad {

namespace {

struct MeasureArguments {
    std::string cube;
    std::vector<std::string> at;
    ObserverArguments observer;
    bool json = false, quiet = false;
};

struct Reading {
    Place place;
    size_t pixels = 0;
    std::vector<double> bands;
    Triple xyz{};
    std::vector<double> channels;  ///< of a detector that is no observer; else empty
    std::optional<Triple> rendered,
        renderedLab;                  ///< what such a detector's picture shows, against its own white
    std::optional<double> luminance;  ///< cd/m²
    std::optional<std::array<double, 2>> xy, uv;
    std::optional<Cct> cct;
    std::optional<Triple> lab;
};

/// --at takes several places in a row, and so swallows a CUBE that follows them: what is no place is the
/// cube.
void findCube(MeasureArguments& arguments) {
    const auto stray = std::find_if(arguments.at.begin(), arguments.at.end(),
                                    [](const std::string& text) { return !readPlace(text); });
    if (arguments.cube.empty() && stray != arguments.at.end()) {
        arguments.cube = *stray;
        arguments.at.erase(stray);
    }
    if (arguments.cube.empty()) throw UsageError("measure needs a CUBE; see 'spectrad measure --help'");
    if (arguments.at.empty())
        throw UsageError("measure needs at least one place, --at X,Y; see 'spectrad measure --help'");
}

/// Mean of the pixels within the radius, and of no others.
Reading averaged(const Cube& cube, const Place& place) {
    const CubeInfo& info = cube.info;
    if (place.x >= info.width || place.y >= info.height)
        throw InputError(fmt::format("the place {},{} lies outside the image (allowed: 0,0 to {},{})",
                                     place.x, place.y, info.width - 1, info.height - 1));
    Reading reading;
    reading.place = place;
    reading.bands.resize(info.wavelengths.size());
    const auto reach =
        static_cast<int>(std::min(place.radius, static_cast<double>(std::max(info.width, info.height))));
    for (int y = std::max(0, place.y - reach); y <= std::min(info.height - 1, place.y + reach); ++y)
        for (int x = std::max(0, place.x - reach); x <= std::min(info.width - 1, place.x + reach); ++x) {
            if (std::hypot(x - place.x, y - place.y) > place.radius) continue;
            ++reading.pixels;
            for (size_t band = 0; band < reading.bands.size(); ++band)
                reading.bands[band] += static_cast<double>(cube.row(y, band)[x]);
        }
    for (double& value : reading.bands)
        value /= static_cast<double>(reading.pixels);
    return reading;
}

Triple tripleOf(const std::vector<double>& channels) {
    return {channels.at(0), channels.at(1), channels.at(2)};
}

/// The white for CIELAB, which needs a luminance.
White labWhite(const Observation& observation, const Cube& cube, Notes& notes) {
    const ChannelImage xyz = observation.channels(cube);
    White white = observation.white(xyz);
    if (!white.hasLuminance) {
        const double y = brightest(xyz);
        if (!(y > 0)) throw InputError("the image is black: --white needs X,Y,Z with a luminance");
        notes.say(fmt::format("the white '{}' has no luminance: the brightest pixel's, {} cd/m2, is taken",
                              white.name, rounded(y, 6)));
        white = withLuminance(white, y);
    }
    if (*std::min_element(white.xyz.begin(), white.xyz.end()) <= 0)
        throw InputError("the white '" + white.name + "' lacks X, Y or Z: CIELAB is undefined for it");
    return white;
}

/// The detector asked for, and CIE 1931, which defines luminance, CCT and Duv. A camera or cones have no XYZ
/// of their own: then the colours are CIE 1931's, and its channels are said beside them.
struct Bench {
    Bench(const ObserverArguments& arguments, const CubeInfo& info, Notes& notes)
        : named(arguments, info, notes), standard({"cie1931-2", arguments.white}, info, notes) {}
    [[nodiscard]] const Observation& observer() const {
        return named.detector().tristimulus ? named : standard;
    }

    Observation named, standard;
};

std::vector<Reading> readAll(const MeasureArguments& arguments, const Cube& cube, const Bench& bench,
                             Notes& notes) {
    std::vector<Reading> readings;
    for (const std::string& place : arguments.at)
        readings.push_back(averaged(cube, parsePlace("--at", place)));
    const PlanckianLocus locus(bench.standard.detector());
    std::optional<White> white;
    if (!arguments.observer.white.empty()) white = labWhite(bench.observer(), cube, notes);

    double metered = 1;
    std::optional<White> renderedWhite;
    if (!bench.named.detector().tristimulus) {
        ChannelImage channels = bench.named.channels(cube);
        metered = bench.named.metered(channels);
        const ChannelImage xyz = bench.named.xyz(std::move(channels));
        renderedWhite = withLuminance(bench.named.white(xyz), brightest(xyz));
    }

    for (Reading& reading : readings) {
        const Triple standard = tripleOf(bench.standard.channels(reading.bands));
        reading.xyz = tripleOf(bench.observer().channels(reading.bands));
        if (renderedWhite) {
            reading.channels = bench.named.channels(reading.bands);
            reading.rendered = bench.named.xyz(reading.channels, metered);
            const Triple& against = renderedWhite->xyz;
            if (*std::min_element(against.begin(), against.end()) > 0)
                reading.renderedLab = lab(*reading.rendered, against);
        }
        if (cube.info.kind == CubeKind::radiance) reading.luminance = standard[1];
        reading.xy = chromaticity(reading.xyz);
        reading.uv = uvPrime(reading.xyz);
        reading.cct = locus.nearest(standard);
        if (white) reading.lab = lab(reading.xyz, white->xyz);
    }
    return readings;
}

Json described(const Reading& reading, const CubeInfo& info, const std::vector<std::string>& channelNames) {
    Json out{{"x", reading.place.x},
             {"y", reading.place.y},
             {"radius", reading.place.radius},
             {"pixels", reading.pixels},
             {"quantity", name(info.kind)},
             {"wavelengths_nm", info.wavelengths.nm},
             {"radiance", reading.bands},
             {"XYZ", reading.xyz},
             {"xy", orNull(reading.xy)},
             {"uv_prime", orNull(reading.uv)},
             {"luminance_cd_m2", orNull(reading.luminance)},
             {"cct_K", reading.cct ? Json(reading.cct->kelvin) : Json()},
             {"duv", reading.cct ? Json(reading.cct->duv) : Json()}};
    for (size_t i = 0; i < reading.channels.size(); ++i)
        out["channels"][channelNames[i]] = reading.channels[i];
    if (reading.rendered) {
        out["rendered"]["XYZ"] = *reading.rendered;
        out["rendered"]["Lab"] = orNull(reading.renderedLab);
    }
    if (reading.lab) out["Lab"] = *reading.lab;
    return out;
}

std::string numbers(std::span<const double> values) {
    std::string out;
    for (double value : values)
        out += " " + rounded(value, 6);
    return out;
}

std::string colorimetry(const Reading& reading, const std::vector<std::string>& channelNames) {
    const Place& place = reading.place;
    std::string out =
        fmt::format("# at {},{}, radius {} ({} pixel{}): XYZ{}", place.x, place.y, shortest(place.radius),
                    reading.pixels, reading.pixels == 1 ? "" : "s", numbers(reading.xyz));
    if (reading.xy) out += "; xy" + numbers(*reading.xy);
    if (reading.uv) out += "; u'v'" + numbers(*reading.uv);
    if (reading.luminance) out += "; luminance " + rounded(*reading.luminance, 6) + " cd/m2";
    if (reading.cct) out += fmt::format("; CCT {:.1f} K; Duv {:.5f}", reading.cct->kelvin, reading.cct->duv);
    if (reading.lab) out += "; Lab" + numbers(*reading.lab);
    for (size_t i = 0; i < reading.channels.size(); ++i)
        out += "; " + channelNames[i] + " " + rounded(reading.channels[i], 6);
    if (reading.rendered) out += "; rendered XYZ" + numbers(*reading.rendered);
    if (reading.renderedLab) out += "; rendered Lab" + numbers(*reading.renderedLab);
    return out + "\n";
}

void printCsv(const std::vector<Reading>& readings, const CubeInfo& info, const std::string& file,
              const Detector& detector) {
    printText(fmt::format("# measured in: {}\n# quantity: {}\n# unit: {}\n# observer: {}\n", file,
                          name(info.kind), unit(info.kind).empty() ? "1" : unit(info.kind), detector.name));
    for (const Reading& reading : readings)
        printText(colorimetry(reading, detector.channels));
    std::string lines = "wavelength_nm";
    for (const Reading& reading : readings) {
        lines += fmt::format(",{}", columnName(info.kind));
        if (readings.size() > 1) lines += fmt::format(" at {} {}", reading.place.x, reading.place.y);
    }
    lines += '\n';
    for (size_t band = 0; band < info.wavelengths.size(); ++band) {
        lines += shortest(info.wavelengths.nm[band]);
        for (const Reading& reading : readings)
            lines += "," + rounded(reading.bands[band], std::numeric_limits<float>::max_digits10);
        lines += '\n';
    }
    printText(lines);
}

ExitCode measure(MeasureArguments arguments) {
    findCube(arguments);
    Console console(arguments.quiet);
    const Cube cube = readCube(arguments.cube, console.notes());
    const Bench bench(arguments.observer, cube.info, console.notes());
    const std::vector<Reading> readings = readAll(arguments, cube, bench, console.notes());
    console.printNotes();
    const Detector& detector = bench.named.detector();
    if (!arguments.json) {
        printCsv(readings, cube.info, arguments.cube, detector);
        return ExitCode::ok;
    }
    Json out = Json::array();
    for (const Reading& reading : readings)
        out.push_back(described(reading, cube.info, detector.channels));
    printJson(out);
    return ExitCode::ok;
}

}  // namespace

void addMeasure(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("measure", "Measure places of a cube: spectra, XYZ, chromaticity, CCT, CIELAB");
    auto arguments = std::make_shared<MeasureArguments>();
    command->add_option("CUBE", arguments->cube, "spectral image, EXR or ENVI")->type_name("CUBE.exr");
    command
        ->add_option("--at", arguments->at,
                     "a pixel, (0,0) top left; with RADIUS (pixels) the mean of the pixels whose centres lie "
                     "within it; may "
                     "be repeated")
        ->type_name("X,Y[,RADIUS]");
    addObserverOptions(*command, arguments->observer);
    command->add_flag("--json", arguments->json, "print an array, one object a place");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    command->footer(
        "Prints CSV: wavelength in nm, then a column of radiance in W.m^-2.sr^-1.nm^-1 for each place "
        "(irradiance in W.m^-2.nm^-1, reflectance 0 to 1), after # lines with the colorimetry. XYZ are "
        "absolute, Y in cd/m2. Luminance (cd/m2), CCT (K) and Duv are defined for CIE 1931 and computed with "
        "it whatever the observer; a camera or cones add their own channels. CIELAB is printed with --white; "
        "a white without luminance gets the brightest pixel's Y.\n\n"
        "Examples:\n"
        "  spectrad measure scene.exr --at 320,180\n"
        "  spectrad measure scene.exr --at 320,180,4 --at 20,20,4 --white at:20,20 --json\n"
        "  spectrad measure scene.exr --at 320,180 > patch.csv");
    command->final_callback([&action, arguments] { action = [arguments] { return measure(*arguments); }; });
}

}  // namespace spectrad
