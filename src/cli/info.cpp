// spectrad info: what a scene needs, what a cube holds, what a spectrum is, or what the library has.
#include "cli/info.h"

#include "base/files.h"
#include "camera/film.h"
#include "cli/commands.h"
#include "image/cube.h"
#include "spectrum/library.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

struct InfoArguments {
    SceneArguments scene;
    std::string reradiation, output;
    bool list = false, cost = false, json = false, quiet = false;
};

enum class Kind { scene, cube, spectrum, film };

/// Files that hold curves; any other file that is no cube is read as a scene or a model.
constexpr std::array<std::string_view, 8> spectrumExtensions{".csv", ".tsv", ".txt",   ".spd",
                                                             ".sp",  ".dat", ".cgats", ".ti3"};
constexpr std::array<std::string_view, 4> cubeExtensions{".exr", ".img", ".hdr", ".bil"};

template <size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

Kind kindOf(const std::string& text) {
    const std::string extension = extensionOf(text);
    std::error_code ignored;
    // A scene's name is enough: with scene.img and scene.hdr beside it, it would look like their cube.
    if (extension == ".xml") return Kind::scene;
    if (isFilm(text, Library::open())) return Kind::film;
    if (isFile(text)) {
        if (looksLikeCube(text)) return Kind::cube;
        return contains(spectrumExtensions, extension) ? Kind::spectrum : Kind::scene;
    }
    if (contains(cubeExtensions, extension)) return Kind::cube;
    return fs::is_directory(text, ignored) ? Kind::scene : Kind::spectrum;
}

/// Options that choose a scene's picture say nothing of cubes, spectra and lists.
void requireNoneOfScenes(const InfoArguments& arguments, const std::string& about) {
    const std::string given = recorded(arguments.scene) + (arguments.scene.restricted ? " --restrict" : "");
    if (!given.empty()) throw UsageError("info" + given + ": that is for scenes, and " + about);
}

ExitCode inform(const InfoArguments& arguments) {
    Console console(arguments.quiet);
    const std::string& what = arguments.scene.file;
    if (arguments.list) {
        if (arguments.cost || !arguments.reradiation.empty() || !arguments.output.empty())
            throw UsageError("--list goes with neither --cost nor --reradiation");
        requireNoneOfScenes(arguments, "--list is of the library");
        printLibrary(Library::open(), what, arguments.json);
        return ExitCode::ok;
    }
    if (what.empty()) throw UsageError("info needs a SCENE, a CUBE, a SPECTRUM or a FILM, or --list");
    const Kind kind = kindOf(what);
    if (arguments.cost && kind != Kind::scene)
        throw UsageError("--cost is for scenes, and '" + what + "' is none");
    if (!arguments.reradiation.empty() || !arguments.output.empty()) {
        if (arguments.reradiation.empty() || arguments.output.empty())
            throw UsageError("--reradiation MATERIAL and -o FILE belong together");
        if (kind != Kind::scene) throw UsageError("--reradiation is for scenes, and '" + what + "' is none");
        if (arguments.cost) throw UsageError("--cost and --reradiation do not go together");
        writeReradiation(arguments.scene, arguments.reradiation, arguments.output, arguments.json, console);
        return ExitCode::ok;
    }
    if (kind != Kind::scene) requireNoneOfScenes(arguments, "'" + what + "' is none");
    switch (kind) {
        case Kind::scene:
            if (arguments.cost)
                printSceneCost(arguments.scene, arguments.json, console);
            else
                printSceneInfo(arguments.scene, arguments.json, console);
            break;
        case Kind::cube:
            printCubeInfo(what, arguments.json, console);
            break;
        case Kind::spectrum:
            printSpectrumInfo(what, Library::open(), arguments.json, console);
            break;
        case Kind::film:
            printFilmInfo(what, Library::open(), arguments.json, console);
            break;
    }
    return ExitCode::ok;
}

}  // namespace

void addInfo(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("info", "Describe a scene's plan, a cube, a spectrum, or list the library");
    auto arguments = std::make_shared<InfoArguments>();
    command
        ->add_option(
            "WHAT", arguments->scene.file,
            "a scene or model file; a spectral image (EXR or ENVI); a spectrum as scenes write it, such as "
            "illuminants/D65, lamp.csv#3 or blackbody:2856; a film (generic-reversal, or x.film); with "
            "--list a prefix of names")
        ->type_name("SCENE|CUBE|SPECTRUM|FILM");
    command->add_flag("--list", arguments->list,
                      "list the library's spectra and films, with WHAT only those whose names start so");
    command->add_flag("--cost", arguments->cost,
                      "of a scene: render it without each of its features in turn, and print what each costs "
                      "in time and memory and changes in CIEDE2000");
    command
        ->add_option("--reradiation", arguments->reradiation,
                     "of a scene: write this fluorescent material as a Donaldson matrix, which <fluorescence "
                     "matrix=…> reads, on --wavelengths (default: 300:780:5)")
        ->type_name("MATERIAL");
    command
        ->add_option("-o,--output", arguments->output, "that matrix's file: EXR (bispectral layout) or CSV")
        ->type_name("OUT.exr|OUT.csv");
    command->add_flag("--json", arguments->json, "print one JSON value");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    addSceneOptions(*command, arguments->scene);
    addDeviceOption(*command, arguments->scene.device);
    command->footer(
        "Of a scene: triangles, lights, materials, terms (light x lobe x material), features, bands, samples "
        "a pixel, and on the device the rows of a strip and its bytes; of its materials the fluorophores' "
        "peaks, Stokes shift (nm) and quantum yield, what was changed in measured matrices, the largest "
        "total "
        "radiance factor, the error of the Fresnel terms, what comes back of white light. Of a cube: size in "
        "pixels, "
        "wavelengths in nm, the smallest and largest value of each band (radiance in W.m^-2.sr^-1.nm^-1, "
        "reflectance 0 to 1). Of a spectrum: quantity, unit, range in nm, integral (unit x nm); of a light "
        "its chromaticity, CCT in K and Duv (CIE 1931); of a "
        "reflectance its "
        "XYZ and CIELAB under D65 (white Y = 100); and a plot. Of a film: its projector, the densities of "
        "its "
        "layers, plots of layers and dyes.\n\n"
        "Examples:\n"
        "  spectrad info scene.xml\n"
        "  spectrad info scene.exr --json\n"
        "  spectrad info illuminants/FL11\n"
        "  spectrad info --list charts/colorchecker");
    command->final_callback([&action, arguments] { action = [arguments] { return inform(*arguments); }; });
}

}  // namespace spectrad
