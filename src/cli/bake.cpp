// spectrad bake: what a surface sends out, receives or reflects, as a spectral texture of its own.
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "image/cube.h"
#include "render/cube_preview.h"
#include "render/passes.h"
#include "spectrum/library.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace spectrad {

namespace {

struct BakeArguments {
    SceneArguments scene;
    std::string output, node, as = "radiance", size = "512x512", gutter = "4";
    bool json = false, quiet = false;
};

PassKind kindOf(const std::string& text) {
    if (text == "radiance") return PassKind::radiance;
    if (text == "irradiance") return PassKind::irradiance;
    if (text == "reflectance") return PassKind::reflectance;
    throw UsageError("--as: '" + text + "' is not known (allowed: radiance, irradiance, reflectance)");
}

RenderSettings settingsOf(const BakeArguments& arguments) {
    RenderSettings settings = renderSettings(arguments.scene);
    constexpr int mostGutter = 1024;  // texels
    settings.bake =
        Bake{arguments.node, kindOf(arguments.as), parseCount("--gutter", arguments.gutter, 0, mostGutter)};
    settings.size = parseSize("--size", arguments.size);
    return settings;
}

std::string recordedCommand(const BakeArguments& arguments) {
    return fmt::format("spectrad bake {} --node {} --as {} --size {} --gutter {}{}{}", arguments.scene.file,
                       arguments.node, arguments.as, arguments.size, arguments.gutter,
                       recorded(arguments.scene), arguments.scene.restricted ? " --restrict" : "");
}

ExitCode bake(const BakeArguments& arguments) {
    const Stopwatch clock;
    Console console(arguments.quiet);
    const RenderSettings settings = settingsOf(arguments);
    if (extensionOf(arguments.output) != ".exr" && extensionOf(arguments.output) != ".img")
        throw UsageError("-o: '" + arguments.output + "' must end in .exr or .img (ENVI)");
    requireOther("-o", arguments.output, arguments.scene.file);
    requireWritable(arguments.output);

    const Library library = Library::open();
    const Scene scene =
        loadScene(arguments.scene.file, library, loadOptions(arguments.scene), console.notes());
    const Device device = Device::open(deviceNumber(arguments.scene.device));
    PassTextures passes(scene, library, device, settings, console.notes());
    Cube cube = passes.render();
    cube.info.attributes = {{"software", "Spectrad " SPECTRAD_VERSION},
                            {"scene", scene.file},
                            {"sceneSha256", scene.sha256},
                            {"commandLine", recordedCommand(arguments)},
                            {"node", arguments.node},
                            {"device", device.info().name + " (" + device.info().platform + ")"}};
    const bool envi = extensionOf(arguments.output) == ".img";
    WriteOptions options;
    if (!envi) options.compression = chooseCompression(cube.info, options, false, console.notes());
    const std::unique_ptr<CubeWriter> writer =
        envi ? createEnvi(arguments.output, cube.info) : createExr(arguments.output, cube.info, options);
    writer->write(cube.info.height, cube.values.data(), previewOf(cube, library).data());
    static_cast<void>(writer->finish());
    console.printNotes();
    if (arguments.json)
        printJson({{"output", arguments.output},
                   {"node", arguments.node},
                   {"as", arguments.as},
                   {"width", cube.info.width},
                   {"height", cube.info.height},
                   {"wavelengths_nm", cube.info.wavelengths.nm},
                   {"seconds", {{"total", clock.seconds()}}},
                   {"device", device.info().name}});
    else if (!arguments.quiet)
        printText(fmt::format("{}: {} of node '{}', {} x {} texels, {} bands; {:.2f} s\n", arguments.output,
                              arguments.as, arguments.node, cube.info.width, cube.info.height,
                              cube.info.wavelengths.size(), clock.seconds()));
    return ExitCode::ok;
}

}  // namespace

void addBake(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("bake", "Render a surface into a spectral texture of its own");
    auto arguments = std::make_shared<BakeArguments>();
    SceneArguments& scene = arguments->scene;
    command->add_option("SCENE", scene.file, "a scene (XML), or a model that Assimp reads")
        ->type_name("SCENE")
        ->required();
    command
        ->add_option(
            "--node", arguments->node,
            "the node (or instance, import) whose surfaces are baked, all into the one square of their "
            "texture coordinates")
        ->type_name("NAME")
        ->required();
    command->add_option("-o,--output", arguments->output, "the spectral texture")
        ->type_name("OUT.exr|OUT.img")
        ->required();
    command
        ->add_option("--as", arguments->as,
                     "what the texels hold: radiance sent towards the camera, irradiance that arrives, or "
                     "reflectance; default: radiance")
        ->type_name("radiance|irradiance|reflectance");
    command->add_option("--size", arguments->size, "texels; default: 512x512")->type_name("WIDTHxHEIGHT");
    command
        ->add_option("--gutter", arguments->gutter,
                     "texels filled around what the surface covers, so that filters find no black beside it; "
                     "default: 4")
        ->type_name("N");
    command
        ->add_option("--wavelengths", scene.wavelengths,
                     "bands in nm, FROM:TO:STEP or a list A,B,C; default: the scene's")
        ->type_name("NM");
    command->add_option("--projection", scene.projection, "what a band value is; default: the scene's (slit)")
        ->type_name("slit|box|point");
    command->add_option("--samples", scene.samples, "samples a texel, 1 to 64; default: 16")->type_name("N");
    command
        ->add_option("--camera", scene.camera, "the eye that gloss is seen from; default: the first camera")
        ->type_name("NAME");
    command->add_option("--set", scene.set, "change the scene, as for render; may be repeated")
        ->type_name("NODE.ATTR=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--restrict", scene.restricted,
                      "refuse every file outside the scene's own folder but the library");
    addDeviceOption(*command, scene.device);
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks, no summary");
    command->footer(
        "All lights of the scene count, on the outside of the surface; the whole scene throws shadows on it "
        "where "
        "they ask for that. Radiance is in "
        "W.m^-2.sr^-1.nm^-1, irradiance in W.m^-2.nm^-1. A later scene uses the file as texture=.\n\n"
        "Examples:\n"
        "  spectrad bake room.xml --node wall -o wall.exr --as irradiance --size 1024x512\n"
        "  spectrad bake vase.xml --node vase -o vase.exr --as reflectance");
    command->final_callback([&action, arguments] { action = [arguments] { return bake(*arguments); }; });
}

}  // namespace spectrad
