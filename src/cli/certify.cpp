// spectrad certify: an image held against its scene's reference, by anybody, later.
#include "base/text.h"
#include "cli/certificate_report.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "spectrum/library.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace spectrad {

namespace {

struct CertifyArguments {
    std::string image;
    SceneArguments scene;
    VerifyArguments verify{.share = "1%"};
    std::string tolerance;
    bool json = false, quiet = false;
};

/// What the file says of how it was rendered, where the command line does not say it anew.
void takeFrom(const CubeInfo& info, SceneArguments& scene) {
    const auto said = [&](const char* key) {
        const auto found = info.attributes.find(key);
        return found == info.attributes.end() ? std::string() : found->second;
    };
    scene.size = fmt::format("{}x{}", info.width, info.height);
    if (scene.set.empty() && !said("overrides").empty()) {
        const Json overrides = Json::parse(said("overrides"), nullptr, false);
        for (const Json& each : overrides)
            if (each.is_string()) scene.set.push_back(each.get<std::string>());
    }
    if (scene.only.empty()) scene.only = said("only");
    if (scene.pass.empty() && scene.camera.empty()) {
        scene.pass = said("pass");
        // A picture of no pass names its camera, so that a scene's passes are not taken instead.
        if (scene.pass.empty()) scene.camera = said("camera");
    }
}

Json described(const Certificate& certificate, const CertifyArguments& arguments,
               const std::vector<std::string>& changed, const std::optional<Verdict>& verdict) {
    Json out{{"image", arguments.image}, {"scene", arguments.scene.file}, {"changed", changed}};
    out.update(described(certificate));
    if (verdict) out["tolerance"] = {{"asked", arguments.tolerance}, {"verdict", name(*verdict)}};
    return out;
}

ExitCode certifyImage(CertifyArguments arguments) {
    Console console(arguments.quiet);
    std::optional<Tolerance> tolerance;
    if (!arguments.tolerance.empty())
        tolerance = asUsage("--tolerance", [&] { return parseTolerance(arguments.tolerance); });
    const double share = parseShare("--share", arguments.verify.share);
    const std::uint64_t seed = parseSeed(arguments.verify.seed);
    const std::optional<int> number = deviceNumber(arguments.scene.device);
    const Cube image = readCube(arguments.image, console.notes());
    if (image.info.kind != CubeKind::radiance)
        throw InputError(arguments.image + ": an image of " + std::string(name(image.info.kind)) +
                         " cannot be certified (radiance can)");
    takeFrom(image.info, arguments.scene);
    const RenderSettings settings = renderSettings(arguments.scene);
    const Library library = Library::open();
    const Scene scene =
        loadScene(arguments.scene.file, library, loadOptions(arguments.scene), console.notes());
    const auto sources = image.info.attributes.find("sources");
    std::vector<std::string> changed;
    if (sources == image.info.attributes.end())
        console.notes().warn(arguments.image + " does not say which files it was rendered from");
    else
        changed = changedSince(sources->second, scene);

    const Device device = Device::open(number);
    const SpectrumResolver resolver(library, {}, false, console.notes());
    const Detector observer =
        asUsage("--observer", [&] { return detectorFor(arguments.verify.observer, resolver, {}); });
    const Reference reference(scene, settings, image.info.wavelengths, observer, library, device);
    PixelSample sample(image.info, share, seed, observer, false);
    sample.add(0, image.info.height, image.values.data());
    const White white = defaultWhite(scene, settings, observer, library, device, sample.brightest());
    ProgressBar bar("certifying", arguments.quiet);
    const Certificate certificate =
        certify(sample, reference, observer, white, [&](double done) { bar.show(done); });
    bar.clear();
    console.printNotes();

    std::optional<Verdict> verdict;
    if (tolerance) verdict = judged(certificate, *tolerance);
    if (arguments.json)
        printJson(described(certificate, arguments, changed, verdict));
    else
        printText(
            inWords(certificate) +
            (verdict ? fmt::format("tolerance           {}: {}\n", tolerance->words(), name(*verdict)) : ""));
    for (const std::string& line : changed)
        printError("since the image was rendered, " + line);
    if (verdict == Verdict::refuted)
        printError(fmt::format("{} is beyond the tolerance: {}", arguments.image, tolerance->words()));
    return changed.empty() && verdict != Verdict::refuted ? ExitCode::ok : ExitCode::input;
}

}  // namespace

void addCertify(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("certify", "Hold a spectral image against its scene's reference");
    auto arguments = std::make_shared<CertifyArguments>();
    command->add_option("IMAGE", arguments->image, "spectral image, EXR or ENVI")
        ->type_name("IMAGE.exr")
        ->required();
    command->add_option("SCENE", arguments->scene.file, "what it was rendered from")
        ->type_name("SCENE")
        ->required();
    command
        ->add_option("--share", arguments->verify.share,
                     "of the pixels that are computed again, at least 1000; default: 1%")
        ->type_name("SHARE");
    command->add_option("--seed", arguments->verify.seed, "draws the pixels; default: 1")->type_name("N");
    command
        ->add_option("--observer", arguments->verify.observer,
                     "whose CIEDE2000 is stated; default: cie1931-2")
        ->type_name("NAME|FILE");
    command
        ->add_option("--tolerance", arguments->tolerance,
                     "exit with 1 if the image is beyond it: 0.5 (CIEDE2000 of 99 % of the pixels), max:0.5 "
                     "(of all), 1%rad (bands' radiance), max:1%rad")
        ->type_name("T");
    command->add_option("--camera", arguments->scene.camera, "default: what the image names")
        ->type_name("NAME");
    command->add_option("--pass", arguments->scene.pass, "default: what the image names")->type_name("NAME");
    command
        ->add_option("--set", arguments->scene.set, "as in render; default: what the image was rendered with")
        ->type_name("NODE.ATTR=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--restrict", arguments->scene.restricted,
                      "refuse every file outside the scene's own folder but the library");
    addDeviceOption(*command, arguments->scene.device);
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks and no progress");
    command->footer(
        "A random share of the pixels is computed again, scalar, in double precision, with 64 samples (4000 "
        "of them also with 1024) and the spectra on their own wavelengths. Exit code 1 where a file of the "
        "scene has changed since the "
        "image was rendered, or the tolerance is refuted.\n\n"
        "Examples:\n"
        "  spectrad certify chart.exr chart.xml\n"
        "  spectrad certify chart.exr chart.xml --share 5% --tolerance 0.5 --json");
    command->final_callback(
        [&action, arguments] { action = [arguments] { return certifyImage(*arguments); }; });
}

}  // namespace spectrad
