// spectrad render: a scene into a spectral image.
#include "base/text.h"
#include "cli/certificate_report.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/observation.h"
#include "cli/options.h"
#include "cli/verified_image.h"
#include "colour/develop.h"
#include "image/cube.h"
#include "image/picture.h"
#include "render/cube_info.h"
#include "render/cube_preview.h"
#include "render/passes.h"
#include "render/renderer.h"
#include "spectrum/library.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <sys/resource.h>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

struct RenderArguments {
    SceneArguments scene;
    std::string output, preview, format, compression;
    VerifyArguments verify;  ///< no share: nothing is verified
    std::string tolerance;
    bool half = false, json = false, quiet = false;
};

/// Where the cube goes and how; decided from the command line alone.
struct Output {
    fs::path cube, preview;
    bool envi = false, compressionAsked = false;
    WriteOptions options;
};

Output outputOf(const RenderArguments& arguments) {
    Output out;
    const std::string extension = extensionOf(arguments.output);
    if (!arguments.format.empty() && arguments.format != "exr" && arguments.format != "envi")
        throw UsageError("--format: '" + arguments.format + "' is not known (allowed: exr, envi)");
    if (arguments.format.empty() && !arguments.output.empty() && extension != ".exr" && extension != ".img")
        throw UsageError("-o: '" + arguments.output +
                         "' must end in .exr or .img (ENVI), or --format must say what it is");
    out.envi = arguments.format.empty() ? extension == ".img" : arguments.format == "envi";
    if ((out.envi && extension == ".exr") || (!out.envi && extension == ".img"))
        throw UsageError("-o: '" + arguments.output + "' does not go with --format " + arguments.format);
    if (out.envi && extension == ".hdr")
        throw UsageError("-o: name ENVI's data file (.img); its header (.hdr) is written beside it");
    if (out.envi && (arguments.half || !arguments.compression.empty()))
        throw UsageError("--half and --compression are EXR's; an ENVI file is plain float");

    const char* ending = out.envi ? ".img" : ".exr";
    out.cube =
        arguments.output.empty() ? fs::path(arguments.scene.file).stem().string() + ending : arguments.output;
    out.preview = arguments.preview;
    out.compressionAsked = !arguments.compression.empty();
    if (out.compressionAsked)
        out.options.compression =
            asUsage("--compression", [&] { return parseCompression(arguments.compression); });
    out.options.half = arguments.half;
    if (!arguments.preview.empty()) {
        if (extensionOf(out.preview) != ".png")
            throw UsageError("--preview: '" + arguments.preview + "' must end in .png");
        requireOther("--preview", out.preview, arguments.scene.file);
        requireWritable(out.preview);
    }
    requireOther("-o", out.cube, arguments.scene.file);
    requireWritable(out.cube);
    return out;
}

/// The part of the command line that decides what is in the file. Where it is written is left out: the same
/// picture under another name is the same file.
std::string recordedCommand(const RenderArguments& arguments) {
    std::string text = "spectrad render " + arguments.scene.file + recorded(arguments.scene);
    if (!arguments.compression.empty()) text += " --compression " + arguments.compression;
    if (arguments.half) text += " --half";
    if (!arguments.tolerance.empty())
        text += " --tolerance " + arguments.tolerance + " --observer " + arguments.verify.observer;
    if (arguments.scene.restricted) text += " --restrict";
    return text;
}

CubeInfo cubeInfo(const RenderArguments& arguments, const Scene& scene, const Plan& plan,
                  const Device& device) {
    CubeInfo info = cubeInfoOf(scene, plan, device, "Spectrad " SPECTRAD_VERSION, recordedCommand(arguments));
    info.attributes["sources"] = sourcesOf(scene);
    if (!arguments.scene.set.empty()) info.attributes["overrides"] = Json(arguments.scene.set).dump();
    if (!arguments.scene.only.empty()) info.attributes["only"] = arguments.scene.only;
    return info;
}

/// The picture for people: what `observe` makes of the cube by default, from the renderer's preview, whose
/// colours are those of the exact spectra whatever the bands.
class Preview {
  public:
    Preview(bool wanted, int width, int height) {
        if (wanted) xyz_.emplace(width, height, 3);
    }
    void add(int firstRow, int rows, const float* linear) {
        if (!xyz_) return;
        const auto width = static_cast<size_t>(xyz_->width);
        for (size_t row = 0; row < static_cast<size_t>(rows); ++row)
            for (size_t x = 0; x < width; ++x) {
                const float* rgb = linear + row * 3 * width + x;
                const Triple xyz = toXyz_ * Triple{rgb[0], rgb[width], rgb[2 * width]};
                const size_t pixel = (static_cast<size_t>(firstRow) + row) * width + x;
                for (size_t i = 0; i < 3; ++i)
                    xyz_->plane[i][pixel] = luminousEfficacy * xyz[i];
            }
    }
    void write(const fs::path& target, const White& white) const {
        if (!xyz_) return;
        DevelopSettings settings;
        settings.white = white;
        const DevelopedPicture picture = develop(*xyz_, settings);
        writePng(target, {picture.width, picture.height, 3, picture.rgb},
                 {{"Software", "spectrad " SPECTRAD_VERSION},
                  {"Description", fmt::format("white {}, {} cd/m2 shown as display white", white.name,
                                              rounded(picture.whiteLuminance, 6))}});
    }

  private:
    Matrix3 toXyz_ = srgbDisplay().toXyz;  // the preview is linear Rec.709, its XYZ without the 683 lm/W
    std::optional<ChannelImage> xyz_;
};

struct Seconds {
    double load = 0, choose = 0, plan = 0, verify = 0, build = 0, render = 0, write = 0, total = 0;
};

/// Seconds since the last call, or since construction.
class Laps {
  public:
    double lap() {
        const double now = clock_.seconds(), passed = now - last_;
        last_ = now;
        return passed;
    }
    [[nodiscard]] double total() const { return clock_.seconds(); }

  private:
    Stopwatch clock_;
    double last_ = 0;
};

std::uint64_t peakMemoryBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

std::unique_ptr<CubeWriter> openWriter(const Output& output, const CubeInfo& info, Notes& notes) {
    constexpr size_t queuedBytes = size_t{256} << 20;  // a strip is compressed while the next is rendered
    WriteOptions options = output.options;
    if (output.envi) return onOwnThread(createEnvi(output.cube, info), queuedBytes, info);
    options.compression = chooseCompression(info, options, output.compressionAsked, notes);
    return onOwnThread(createExr(output.cube, info, options), queuedBytes, info);
}

void sayLosses(const WriteReport& report, Notes& notes) {
    if (report.underflows > 0)
        notes.warn(fmt::format("{} values below the range of half became zero", report.underflows));
    if (report.previewClamped > 0)
        notes.say(fmt::format(
            "{} values of the RGB preview (no measurement) were held at the range of the pixel type",
            report.previewClamped));
}

Json described(const Output& output, const Plan& plan, const Device& device, const Seconds& seconds) {
    Json out{{"output", output.cube.string()}};
    if (!output.preview.empty()) out["preview"] = output.preview.string();
    out.update({{"width", plan.view.width},
                {"height", plan.view.height * plan.faces},
                {"wavelengths_nm", plan.wavelengths.nm},
                {"projection", name(plan.wavelengths.projection)},
                {"samples", plan.samples},
                {"camera", plan.cameraName},
                {"pass", plan.passName},
                {"seconds",
                 {{"load", seconds.load},
                  {"plan", seconds.plan},
                  {"build", seconds.build},
                  {"render", seconds.render},
                  {"write", seconds.write},
                  {"total", seconds.total}}},
                {"peak_rss_bytes", peakMemoryBytes()},
                {"device", device.info().name},
                {"triangles", plan.triangles()},
                {"lights", plan.lights()},
                {"terms", plan.terms.count()},
                {"features", plan.features},
                {"white", {{"name", plan.whiteName}, {"XYZ", plan.white}}}});
    return out;
}

void printSummary(const Output& output, const Plan& plan, const Seconds& seconds) {
    const std::vector<double>& nm = plan.wavelengths.nm;
    printText(fmt::format(
        "{}: {} x {} pixels, {} bands {} to {} nm, {} samples a pixel; {:.2f} s (load {:.2f}, plan {:.2f}, "
        "build {:.2f}, render {:.2f}, write {:.2f})\n",
        output.cube.string(), plan.view.width, plan.view.height * plan.faces, nm.size(),
        rounded(nm.front(), 9), rounded(nm.back(), 9), plan.samples, seconds.total, seconds.load,
        seconds.plan, seconds.build, seconds.render, seconds.write));
}

/// Where a pass asks to be written to as well (save=): as -o would write it.
Output savedAs(const Output& output, const Pass& pass) {
    Output saved = output;
    saved.cube = pass.save;
    saved.envi = extensionOf(saved.cube) == ".img";
    requireWritable(saved.cube);
    return saved;
}

/// All passes' files can be written: found out before anything renders.
void checkSaves(const std::vector<GraphNode>& graph, const Output& output) {
    for (const GraphNode& node : graph)
        if (node.shot.pass && !node.shot.pass->save.empty()) {
            const Output saved = savedAs(output, *node.shot.pass);
            if (fs::absolute(saved.cube).lexically_normal() == fs::absolute(output.cube).lexically_normal())
                throw UsageError("-o: '" + output.cube.string() + "' is where pass '" + node.shot.pass->name +
                                 "' is saved");
        }
}

/// Whether double precision judges the image.
bool isJudged(const RenderArguments& arguments) {
    return !arguments.verify.share.empty() || !arguments.tolerance.empty();
}

/// What says how it is judged is read before hours of rendering.
void checkJudgement(const RenderArguments& arguments) {
    if (!arguments.verify.share.empty()) (void)parseShare("--verify", arguments.verify.share);
    if (!arguments.tolerance.empty())
        (void)asUsage("--tolerance", [&] { return parseTolerance(arguments.tolerance); });
    (void)parseSeed(arguments.verify.seed);
}

/// Settings for --tolerance; changes what is asked for to what was chosen.
Chosen chooseSettings(const RenderArguments& arguments, Scene& scene, RenderSettings& settings,
                      Output& output, const Library& library, const Device& device) {
    ChooserSettings wanted;
    wanted.tolerance = asUsage("--tolerance", [&] { return parseTolerance(arguments.tolerance); });
    wanted.render = settings;
    wanted.half = output.options.half;
    wanted.mayHalf = !output.envi;
    Notes unheard;
    const Planner planner = [&](const Scene& asked, const RenderSettings& render) {
        PassTextures passes(asked, library, device, render, unheard);
        return makePlan(asked, render, library, passes, unheard);
    };
    ProgressBar bar("choosing", arguments.quiet);
    Chosen chosen = choose(scene, wanted, observerOf(arguments.verify, library), library, device, planner,
                           [&](double share) { bar.show(share); });
    settings.wavelengths = chosen.wavelengths;
    settings.projection.reset();
    settings.samples = chosen.samples;
    output.options.half = chosen.half;
    if (chosen.schlick) scene = withSchlick(scene);
    return chosen;
}

ExitCode render(const RenderArguments& arguments) {
    Laps clock;
    Seconds seconds;
    Console console(arguments.quiet);
    RenderSettings settings = renderSettings(arguments.scene);
    const std::optional<int> number = deviceNumber(arguments.scene.device);
    const bool isToBeJudged = isJudged(arguments);
    if (isToBeJudged) checkJudgement(arguments);
    Output output = outputOf(arguments);
    // A device that is asked for is missed at once; that there is none at all, only when the scene is known
    // to be sound.
    std::optional<Device> device;
    if (number) device = Device::open(number);

    const Library library = Library::open();
    if (isToBeJudged) (void)observerOf(arguments.verify, library);
    const Scene asked =
        loadScene(arguments.scene.file, library, loadOptions(arguments.scene), console.notes());
    Scene scene = asked;
    seconds.load = clock.lap();
    if (!device) device = Device::open(std::nullopt);
    std::optional<Chosen> chosen;
    if (!arguments.tolerance.empty()) {
        chosen = chooseSettings(arguments, scene, settings, output, library, *device);
        seconds.choose = clock.lap();
    }
    PassTextures passes(scene, library, *device, settings, console.notes(),
                        [&](const Pass& pass, const Plan& made, const Cube& cube) {
                            CubeInfo about = cubeInfo(arguments, scene, made, *device);
                            const std::unique_ptr<CubeWriter> saving =
                                openWriter(savedAs(output, pass), about, console.notes());
                            saving->write(about.height, cube.values.data(), previewOf(cube, library).data());
                            sayLosses(saving->finish(), console.notes());
                        });
    checkSaves(passes.graph(), output);
    const Plan plan = makePlan(scene, settings, library, passes, console.notes());
    seconds.plan = clock.lap();
    CubeInfo info = cubeInfo(arguments, scene, plan, *device);
    std::optional<VerifiedImage> judged;
    if (isToBeJudged) {
        VerifyArguments how = arguments.verify;
        if (how.share.empty()) how.share = "1%";
        judged = verified(how, asked, settings, plan, info, output.options.half, library, *device,
                          arguments.quiet);
        info.attributes.merge(attributesOf(judged->certificate));
        seconds.verify = clock.lap();
    }
    if (chosen) info.attributes.merge(attributesOf(*chosen, arguments.tolerance));
    std::vector<std::unique_ptr<CubeWriter>> writers;
    writers.push_back(openWriter(output, info, console.notes()));
    const Pass* target = passes.graph().back().shot.pass;
    if (target && !target->save.empty())
        writers.push_back(openWriter(savedAs(output, *target), info, console.notes()));
    console.printNotes();
    Preview preview(!output.preview.empty(), info.width, info.height);
    const auto deliver = [&](int firstRow, int rows, const float* bands, const float* linear) {
        const Stopwatch waiting;
        for (const auto& writer : writers)
            writer->write(rows, bands, linear);
        preview.add(firstRow, rows, linear);
        seconds.write += waiting.seconds();
    };
    if (judged && judged->kept) {
        const KeptImage& kept = *judged->kept;
        deliver(0, info.height, kept.bands.data(), kept.preview.data());
        seconds.build = kept.times.build;
        seconds.render = kept.times.render;
        seconds.verify -= kept.times.build + kept.times.render;
    } else if (plan.as == PassKind::radiance && plan.faces == 1 && !(target && target->screen)) {
        Renderer renderer(*device, plan);
        ProgressBar bar("rendering", arguments.quiet);
        renderer.render(deliver, [&](double share) { bar.show(share); });
        seconds.build = renderer.times().build;
        seconds.render = renderer.times().render;
    } else {
        const Cube cube = passes.render();
        seconds.render = clock.lap();
        deliver(0, info.height, cube.values.data(), previewOf(cube, library).data());
    }
    const Stopwatch finishing;
    for (const auto& writer : writers)
        sayLosses(writer->finish(), console.notes());
    preview.write(output.preview, {plan.whiteName, plan.white, false});
    seconds.write += finishing.seconds();
    seconds.total = clock.total();

    console.printNotes();
    if (arguments.json) {
        Json out = described(output, plan, *device, seconds);
        if (judged) {
            out["seconds"]["verify"] = seconds.verify;
            out["certificate"] = described(judged->certificate);
        }
        if (chosen) {
            out["seconds"]["choose"] = seconds.choose;
            out["tolerance"] = described(*chosen, judged->certificate, arguments.tolerance);
        }
        printJson(out);
    } else if (!arguments.quiet) {
        printSummary(output, plan, seconds);
        if (chosen) printText(inWords(*chosen, arguments.tolerance));
        if (judged) printText(inWords(judged->certificate));
    }
    if (chosen) return toleranceVerdict(*chosen, judged->certificate, arguments.tolerance);
    return ExitCode::ok;
}

}  // namespace

void addRender(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("render", "Render a scene into a spectral image");
    auto arguments = std::make_shared<RenderArguments>();
    command->add_option("SCENE", arguments->scene.file, "a scene (XML), or a model that Assimp reads")
        ->type_name("SCENE")
        ->required();
    command
        ->add_option("-o,--output", arguments->output,
                     "the spectral image; default: the scene's name with .exr, in the current folder")
        ->type_name("OUT.exr|OUT.img");
    addSceneOptions(*command, arguments->scene);
    command->add_option("--preview", arguments->preview, "also write a picture for people, 8-bit sRGB")
        ->type_name("OUT.png");
    addDeviceOption(*command, arguments->scene.device);
    command
        ->add_option("--format", arguments->format,
                     "OpenEXR in the spectral layout 1.0, or ENVI (x.img with x.hdr beside it); default: by "
                     "the name, else exr")
        ->type_name("exr|envi");
    command->add_option("--compression", arguments->compression, "of EXR, all lossless; default: piz")
        ->type_name("none|zips|zip|piz");
    command->add_flag("--half", arguments->half, "16-bit floats: 11 significant bits, up to 65504 (EXR)");
    command
        ->add_flag("--verify{1%}", arguments->verify.share,
                   "compute this share of the pixels again, in double precision with exact spectra and 64 "
                   "samples, and write into the file how far the image is from that; --verify alone: 1%, at "
                   "least 1000 pixels")
        ->type_name("SHARE");
    command
        ->add_option(
            "--tolerance", arguments->tolerance,
            "choose the cheapest settings that keep the image within it, and certify it: 0.5 "
            "(CIEDE2000 of 99 % of the pixels), max:0.5 (of all), 1%rad (radiance of the bands asked "
            "for), max:1%rad; exit code 1 where nothing does")
        ->type_name("T");
    command->add_option("--seed", arguments->verify.seed, "draws the pixels of --verify; default: 1")
        ->type_name("N");
    command
        ->add_option("--observer", arguments->verify.observer,
                     "whose CIEDE2000 --verify and --tolerance mean; default: cie1931-2")
        ->type_name("NAME|FILE");
    command->add_flag("--json", arguments->json,
                      "print a JSON object: sizes, seconds, peak_rss_bytes, the plan");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks, no progress, no summary");
    command->footer(
        "A band value is spectral radiance in W.m^-2.sr^-1.nm^-1, averaged under the band's slit function. "
        "Wavelengths are in nm, sizes in pixels, times in seconds. The file appears whole or not at all; the "
        "same scene, device and options give the same bytes.\n\n"
        "Examples:\n"
        "  spectrad render scene.xml --preview scene.png\n"
        "  spectrad render scene.xml -o warm.exr --set lamp.spectrum=illuminants/A\n"
        "  spectrad render scene.xml --wavelengths 400:700:10 --size 1920x1080 --samples 32 --json\n"
        "  spectrad render scene.xml -o scene.img --projection point");
    command->final_callback([&action, arguments, command] {
        for (const char* option : {"--seed", "--observer"})
            if (!isJudged(*arguments) && command->count(option) > 0)
                throw UsageError(std::string(option) + " needs --verify or --tolerance");
        action = [arguments] { return render(*arguments); };
    });
}

}  // namespace spectrad
