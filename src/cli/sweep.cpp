// spectrad sweep: one scene under many lights, with many materials, seen by many detectors, from one render.
#include "render/sweep.h"

#include "base/files.h"
#include "base/machine.h"
#include "base/text.h"
#include "cli/camera_commands.h"
#include "cli/console.h"
#include "cli/observation.h"
#include "cli/options.h"
#include "cli/sweep_table.h"
#include "cli/sweep_variants.h"
#include "colour/develop.h"
#include "image/picture.h"
#include "render/columns.h"
#include "render/node_cover.h"
#include "render/passes.h"
#include "render/renderer.h"
#include "render/texels.h"
#include "spectrum/library.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

namespace spectrad {

namespace {

struct SweepArguments {
    SceneArguments scene;
    std::string output, sweep, format = "png";
    std::vector<std::string> vary, observers, regions;
    bool json = false, quiet = false;
};

/// A detector of the sweep.
struct Looker {
    std::unique_ptr<Observation> eye;
    std::string name;
};

/// The pictures' channels wait in memory, as floats, until the last row is there: exposure needs all of them.
void requireMemory(const Plan& plan, size_t columns) {
    constexpr double gibi = 1 << 30;
    const double bytes = sizeof(float) * static_cast<double>(columns) * plan.view.width * plan.view.height;
    const auto there = static_cast<double>(memoryOfMachine());
    if (bytes > there)
        throw InputError(
            fmt::format("{} channels of {} x {} pixels take {:.1f} GiB, this machine has {:.1f} "
                        "(fewer variants, fewer detectors or a smaller --size)",
                        columns, plan.view.width, plan.view.height, bytes / gibi, there / gibi));
}

/// A variant's fault is the command line's, or that of the scene's <vary>.
Scene loadVariant(const std::string& file, const Library& library, const LoadOptions& options,
                  const SourceLocation& where, Notes& notes) {
    try {
        return loadScene(file, library, options, notes);
    } catch (const UsageError& error) {
        if (where.file.empty()) throw;
        const std::string text = error.what(), option = "--set ";
        throw InputError(where, startsWith(text, option) ? text.substr(option.size()) : text);
    }
}

class Sweeping {
  public:
    Sweeping(SweepArguments arguments, Console& console, std::optional<int> device)
        : arguments_(std::move(arguments)), console_(console), library_(Library::open()) {
        std::vector<SweepAxis> axes;
        for (const std::string& text : arguments_.vary)
            axes.push_back(parseAxis(text));
        for (const std::string& text : arguments_.regions)
            wanted_.push_back(parseRegion(text));
        const Scene scene =
            loadScene(arguments_.scene.file, library_, loadOptions(arguments_.scene), unsaid_);
        const Sweep* asked = chooseSweep(scene, arguments_.sweep);
        if (asked && arguments_.scene.camera.empty() && arguments_.scene.pass.empty()) {
            arguments_.scene.camera = asked->camera;
            arguments_.scene.pass = asked->pass;
        }
        settings_ = renderSettings(arguments_.scene);
        device_ = Device::open(device);
        planVariants(axes.empty() && asked ? asked->axes : axes);
        addLookers(scene, asked);
        std::vector<DetectorWeights> weights;
        for (const Looker& looker : lookers_)
            weights.push_back(looker.eye->weights());
        requireMemory(plans_.front(), columnsOf(weights) * plans_.size());
        sweep_ = sweepPlan(std::move(plans_), names_, weights);
        addRegions(scene);
        for (const std::string& variant : names_)
            for (const Looker& looker : lookers_)
                files_.push_back(variant + "-" + fileName(looker.name));
        files_ = distinct(std::move(files_));
    }

    /// Renders once; returns the table.
    Json run() {
        coverRegions();
        Renderer renderer(*device_, sweep_.plan);
        {
            ProgressBar bar("rendering", arguments_.quiet);
            columns_ = renderColumns(renderer, sweep_.plan, [&](double share) { bar.show(share); });
        }
        build = renderer.times().build;
        rendering = renderer.times().render;
        const Stopwatch clock;
        Json rows = Json::array();
        ProgressBar bar("writing", arguments_.quiet);
        const auto pictures = static_cast<double>(names_.size() * lookers_.size());
        for (size_t v = 0; v < names_.size(); ++v)
            for (size_t d = 0; d < lookers_.size(); ++d) {
                finish(v, d, rows);
                bar.show(static_cast<double>(v * lookers_.size() + d + 1) / pictures);
            }
        writing = clock.seconds();
        return rows;
    }

    [[nodiscard]] bool measures() const { return !regions_.empty(); }

    double build = 0, rendering = 0, writing = 0;

  private:
    static size_t columnsOf(const std::vector<DetectorWeights>& weights) {
        size_t columns = 0;
        for (const DetectorWeights& detector : weights)
            columns += detector.weights.size();
        return columns;
    }

    void planVariants(const std::vector<SweepAxis>& axes) {
        for (const SweepVariant& variant : variantsOf(axes)) {
            LoadOptions options = loadOptions(arguments_.scene);
            options.set.insert(options.set.end(), variant.set.begin(), variant.set.end());
            Scene scene =
                loadVariant(arguments_.scene.file, library_, options, variant.where, console_.notes());
            light_.push_back(scene.lights.empty() ? Curve::constant(1)
                                                  : scene.lights.front().emitter.spectrum.curve());
            separateLights(scene);
            Notes notes;
            // What passes show is part of what all variants must have in common: compared on the host.
            PassTextures passes(scene, library_, *device_, settings_, notes);
            plans_.push_back(makePlan(scene, settings_, library_, passes, notes));
            fetchTexels(plans_.back().world);
            for (const std::string& line : notes.lines())
                console_.notes().say(withoutMarks(line));
            if (plans_.back().as != PassKind::radiance)
                throw InputError("a sweep shows radiance; the pass asks for something else");
            names_.push_back(variant.name);
            if (variant.numbered)
                console_.notes().say(fmt::format("variant '{}' is {} (its name was taken)", variant.name,
                                                 fmt::join(variant.set, ", ")));
        }
    }

    /// The command line's observers; else the scene's, which read what the scene may.
    void addLookers(const Scene& scene, const Sweep* asked) {
        std::vector<std::string> names = arguments_.observers;
        const bool own = names.empty() && asked && !asked->detectors.empty();
        if (own) names = asked->detectors;
        if (names.empty()) names = {"cie1931-2"};
        CubeInfo info;
        info.wavelengths = plans_.front().wavelengths;
        for (const std::string& name : names) {
            ObserverArguments observer;
            observer.observer = name;
            if (own) {
                observer.folder = std::filesystem::path(scene.file).parent_path();
                observer.restricted = arguments_.scene.restricted;
                for (const DetectorUse& use : scene.detectors)
                    if (use.name == name) observer.detector = detectorFrom(use.sensitivity);
            }
            if (observer.detector) observer.detector->name = name;
            try {
                auto eye = std::make_unique<Observation>(observer, info, console_.notes());
                lookers_.push_back({std::move(eye), name});
            } catch (const InputError& error) {
                if (!own) throw;
                throw InputError(asked->where, fmt::format("detector '{}': {}", name, error.what()));
            }
        }
    }

    void addRegions(const Scene& scene) {
        wanted_.insert(wanted_.begin(), scene.regions.begin(), scene.regions.end());
        const View& view = sweep_.plan.view;
        std::vector<Index> nodes;
        for (const Region& region : wanted_) {
            if (region.node) nodes.push_back(*region.node);
            const PixelRect rect = region.rect.value_or(PixelRect{});
            if (rect.x + rect.width > view.width || rect.y + rect.height > view.height)
                throw InputError(region.where,
                                 fmt::format("the region '{}' lies outside the image of {} x {} pixels",
                                             region.name, view.width, view.height));
        }
        if (nodes.empty()) return;
        RenderSettings settings = settings_;
        settings.wavelengths = coverWavelengths(nodes.size());
        settings.projection.reset();
        settings.only = Only::everything;
        Notes unsaid;
        cover_ = makePlan(coverScene(scene, nodes), settings, library_, unsaid);
    }

    /// Finds the regions' pixels: of a node those that it fills, since others show what stands behind, too.
    void coverRegions() {
        const View& view = sweep_.plan.view;
        const auto width = static_cast<size_t>(view.width), height = static_cast<size_t>(view.height);
        std::vector<std::vector<size_t>> filled;
        if (cover_) {
            constexpr float full = 1 - 1e-5F;
            const size_t count = cover_->terms.bands;
            filled.resize(count);
            Renderer(*device_, *cover_).render([&](int first, int rows, const float* values, const float*) {
                for (size_t row = 0; row < static_cast<size_t>(rows); ++row)
                    for (size_t i = 0; i < count; ++i)
                        for (size_t x = 0; x < width; ++x)
                            if (values[(row * count + i) * width + x] > full)
                                filled[i].push_back((static_cast<size_t>(first) + row) * width + x);
            });
        }
        size_t next = 0;
        for (const Region& region : wanted_) {
            MeasuredRegion measured{region.name, {}};
            if (region.node) {
                measured.pixels = std::move(filled[next++]);
                if (measured.pixels.empty())
                    throw InputError(region.where, fmt::format("the node of region '{}' fills no pixel of "
                                                               "this picture of {} x {}",
                                                               region.name, width, height));
            } else {
                for (int y = region.rect->y; y < region.rect->y + region.rect->height; ++y)
                    for (int x = region.rect->x; x < region.rect->x + region.rect->width; ++x)
                        measured.pixels.push_back(static_cast<size_t>(y) * width + static_cast<size_t>(x));
            }
            regions_.push_back(std::move(measured));
        }
    }

    /// Takes the picture's columns out of memory, writes it and measures it.
    void finish(size_t variant, size_t looker, Json& rows) {
        const Observation& eye = *lookers_[looker].eye;
        const Detector& detector = eye.detector();
        ChannelImage channels(sweep_.plan.view.width, sweep_.plan.view.height, detector.size());
        for (size_t c = 0; c < detector.size(); ++c) {
            std::vector<float>& column = columns_[sweep_.column(variant, looker) + c];
            channels.plane[c].assign(column.begin(), column.end());
            column = {};
        }
        const std::string base =
            (std::filesystem::path(arguments_.output) / files_[variant * lookers_.size() + looker]).string();
        const ChannelImage xyz = eye.xyz(channels);
        const White chromaticity = eye.whiteUnder("first light", light_[variant]);
        if (arguments_.format == "exr") {
            writeChannelsExr(base + ".exr", channels.width, channels.height, detector.channels,
                             floatPlanes(channels, detector.channels), {{"observer", detector.name}});
        } else if (arguments_.format == "png") {
            DevelopSettings settings;
            settings.white = chromaticity;
            const DevelopedPicture picture = develop(xyz, settings);
            writePng(base + ".png", {picture.width, picture.height, 3, picture.rgb},
                     {{"Software", "spectrad " SPECTRAD_VERSION}});
        }
        if (regions_.empty()) return;
        const double bright = brightest(xyz);
        const SweepImage image{names_[variant],
                               lookers_[looker].name,
                               eye,
                               channels,
                               withLuminance(chromaticity, bright > 0 ? bright : 1),
                               eye.metered(channels)};
        for (const MeasuredRegion& region : regions_)
            rows.push_back(sweepRow(image, region));
    }

    SweepArguments arguments_;
    Console& console_;
    std::optional<Device> device_;  ///< opened when the scene is known to be sound
    Notes unsaid_;                  ///< of the scene itself; its variants say the same
    Library library_;
    RenderSettings settings_;
    std::vector<Plan> plans_;
    std::vector<Curve> light_;                ///< of each variant: its first light
    std::vector<std::string> names_, files_;  ///< of variants; of pictures, each variant's detectors
    std::vector<Looker> lookers_;
    SweepPlan sweep_;
    std::vector<Region> wanted_;
    std::optional<Plan> cover_;  ///< of regions that are nodes
    std::vector<MeasuredRegion> regions_;
    std::vector<std::vector<float>> columns_;  ///< by sweep_.column()
};

ExitCode sweepScene(const SweepArguments& arguments) {
    if (arguments.format != "png" && arguments.format != "exr" && arguments.format != "none")
        throw UsageError("--format: '" + arguments.format + "' is not known (allowed: png, exr, none)");
    Console console(arguments.quiet);
    const Stopwatch clock;
    const std::optional<int> number = deviceNumber(arguments.scene.device);
    Sweeping sweep(arguments, console, number);
    std::error_code failed;
    std::filesystem::create_directories(arguments.output, failed);
    if (failed) throw MachineError("cannot make the folder '" + arguments.output + "': " + failed.message());
    const double planned = clock.seconds();
    const Json rows = sweep.run();
    if (sweep.measures()) {
        const std::filesystem::path folder = arguments.output;
        writeFile(folder / "sweep.csv", sweepCsv(rows));
        writeFile(folder / "sweep.json", rows.dump(2) + "\n");
    }
    console.printNotes();
    if (arguments.json)
        printJson({{"output", arguments.output},
                   {"seconds",
                    {{"plan", planned},
                     {"build", sweep.build},
                     {"render", sweep.rendering},
                     {"write", sweep.writing},
                     {"total", clock.seconds()}}},
                   {"regions", rows}});
    return ExitCode::ok;
}

}  // namespace

void addSweep(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("sweep", "Render a scene once for many lights, materials and detectors");
    auto arguments = std::make_shared<SweepArguments>();
    command->add_option("SCENE", arguments->scene.file, "a scene (XML)")->type_name("SCENE")->required();
    command->add_option("-o,--output", arguments->output, "folder for the images, sweep.csv and sweep.json")
        ->type_name("DIR")
        ->required();
    command
        ->add_option("--vary", arguments->vary,
                     "spectra to go through: attributes of --set with + between that change together, values "
                     "with | between; may be "
                     "repeated, then every combination")
        ->type_name("NODE.ATTR=VALUE|VALUE")
        ->allow_extra_args(false);
    command
        ->add_option("--sweep", arguments->sweep,
                     "which <sweep> of the scene, if it has several; --vary and --observer go before what it "
                     "says")
        ->type_name("NAME");
    command
        ->add_option("--observer", arguments->observers,
                     "a detector, camera or film, may be repeated; default: the sweep's, else cie1931-2")
        ->type_name("NAME|FILE|PRODUCT")
        ->allow_extra_args(false);
    command
        ->add_option("--region", arguments->regions,
                     "a rectangle to measure beside the scene's regions, may be repeated")
        ->type_name("NAME=X,Y,W,H")
        ->allow_extra_args(false);
    command
        ->add_option("--format", arguments->format,
                     "of the images; exr: the detectors' channels; default: png")
        ->type_name("png|exr|none");
    addSceneOptions(*command, arguments->scene);
    addDeviceOption(*command, arguments->scene.device);
    command->add_flag("--json", arguments->json, "print a JSON object: seconds, and the table");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    command->footer(
        "Geometry is rasterized once, whatever the number of variants (a value may change spectra only). A "
        "scene may hold all of it: <sweep>, <vary> and <region> (docs/format.md). The "
        "table holds XYZ (Y in "
        "cd/m2), chromaticity and CIELAB against the first light at the image's brightest Y.\n\n"
        "Examples:\n"
        "  spectrad sweep scene.xml -o out\n"
        "  spectrad sweep scene.xml -o out --vary "
        "'key.spectrum+fill.spectrum=illuminants/A|illuminants/D65'\n"
        "  spectrad sweep scene.xml -o out --vary 'key.spectrum=illuminants/A|illuminants/FL11' \\\n"
        "           --observer cie1931-2 --observer nikon-5100 --region white=140,500,20,20\n"
        "  spectrad sweep scene.xml -o out --vary 'ink.diffuse.reflectance=a.csv|b.csv' --format exr");
    command->final_callback(
        [&action, arguments] { action = [arguments] { return sweepScene(*arguments); }; });
}

}  // namespace spectrad
