// spectrad sweep: one scene under many lights, with many materials, seen by many detectors, from one render.
#include "render/sweep.h"

#include "base/files.h"
#include "base/text.h"
#include "cli/camera_commands.h"
#include "cli/console.h"
#include "cli/observation.h"
#include "cli/options.h"
#include "colour/develop.h"
#include "image/picture.h"
#include "render/renderer.h"
#include "spectrum/library.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace spectrad {

namespace {

struct SweepArguments {
    SceneArguments scene;
    std::string output, format = "png";
    std::vector<std::string> vary, observers, regions;
    bool json = false, quiet = false;
};

/// "A.x+B.y=one|two": attributes that take each value together.
struct Axis {
    std::vector<std::string> attributes, values;
};

Axis axisOf(const std::string& text) {
    const size_t equals = text.find('=');
    Axis axis;
    if (equals != std::string::npos) {
        for (const std::string_view attribute : split(std::string_view(text).substr(0, equals), '+'))
            axis.attributes.emplace_back(attribute);
        for (const std::string_view value : split(std::string_view(text).substr(equals + 1), '|'))
            axis.values.emplace_back(value);
    }
    const auto empty = [](const std::string& s) { return s.empty(); };
    if (equals == std::string::npos || std::any_of(axis.attributes.begin(), axis.attributes.end(), empty) ||
        std::any_of(axis.values.begin(), axis.values.end(), empty))
        throw UsageError("--vary: '" + text +
                         "' is not NODE.ATTR[+NODE.ATTR]=VALUE|VALUE…, as in "
                         "key.spectrum+fill.spectrum=illuminants/A|illuminants/D65");
    return axis;
}

struct Variant {
    std::string name;              ///< its values with dashes, for files
    std::vector<std::string> set;  ///< --set for it
};

std::string fileName(const std::string& value) {
    std::string name = value;
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return !(std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-'); }, '_');
    return name;
}

/// All combinations, the last axis fastest.
std::vector<Variant> variantsOf(const std::vector<std::string>& vary) {
    std::vector<Variant> variants{{}};
    for (const std::string& text : vary) {
        const Axis axis = axisOf(text);
        std::vector<Variant> next;
        for (const Variant& before : variants)
            for (const std::string& value : axis.values) {
                Variant variant = before;
                variant.name += (variant.name.empty() ? "" : "-") + fileName(value);
                for (const std::string& attribute : axis.attributes)
                    variant.set.push_back(attribute + "=" + value);
                next.push_back(std::move(variant));
            }
        variants = std::move(next);
    }
    return variants;
}

struct Region {
    std::string name;
    int x = 0, y = 0, width = 0, height = 0;
};

/// "NAME=X,Y,WIDTH,HEIGHT" in pixels.
Region regionOf(const std::string& text) {
    const size_t equals = text.find('=');
    std::vector<long long> numbers;
    if (equals != std::string::npos)
        for (const std::string_view piece : split(std::string_view(text).substr(equals + 1), ','))
            numbers.push_back(parseInteger(piece).value_or(-1));
    if (numbers.size() != 4 || *std::min_element(numbers.begin(), numbers.end()) < 0 || numbers[2] == 0 ||
        numbers[3] == 0 || *std::max_element(numbers.begin(), numbers.end()) > 65'536 || equals == 0)
        throw UsageError("--region: '" + text + "' is not NAME=X,Y,WIDTH,HEIGHT in pixels, (0,0) top left");
    return {text.substr(0, equals), static_cast<int>(numbers[0]), static_cast<int>(numbers[1]),
            static_cast<int>(numbers[2]), static_cast<int>(numbers[3])};
}

/// What a detector's images need to become colours.
struct Eye {
    Detector detector;
    XyzMatrix toXyz;
    std::string name;  ///< for files
};

std::vector<double> meanOf(const ChannelImage& image, const Region& region) {
    std::vector<double> mean;
    for (const std::vector<double>& plane : image.plane) {
        double sum = 0;
        for (int y = region.y; y < region.y + region.height; ++y)
            for (int x = region.x; x < region.x + region.width; ++x)
                sum +=
                    plane[static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)];
        mean.push_back(sum / (static_cast<double>(region.width) * region.height));
    }
    return mean;
}

/// One row of the table.
Json rowOf(const std::string& variant, const Eye& eye, const Region& region, const ChannelImage& channels,
           const White& white) {
    const std::vector<double> mean = meanOf(channels, region);
    const Triple xyz = eye.detector.tristimulus ? Triple{mean[0], mean[1], mean[2]} : toXyz(eye.toXyz, mean);
    Json row{{"variant", variant}, {"detector", eye.detector.name}, {"region", region.name}, {"XYZ", xyz}};
    const auto xy = chromaticity(xyz);
    row["xy"] = xy ? Json(*xy) : Json();
    const bool whole = *std::min_element(white.xyz.begin(), white.xyz.end()) > 0;
    row["Lab"] = whole ? Json(lab(xyz, white.xyz)) : Json();
    for (size_t c = 0; c < mean.size(); ++c)
        row["channels"][eye.detector.channels[c]] = mean[c];
    return row;
}

std::string csvOf(const Json& rows) {
    std::string text = "variant,detector,region,X,Y,Z,x,y,L,a,b\n";
    for (const Json& row : rows) {
        text += fmt::format("{},\"{}\",{}", row.at("variant").get<std::string>(),
                            row.at("detector").get<std::string>(), row.at("region").get<std::string>());
        for (const auto& [key, count] : {std::pair{"XYZ", 3}, std::pair{"xy", 2}, std::pair{"Lab", 3}})
            for (int i = 0; i < count; ++i)
                text += row.at(key).is_null()
                            ? ","
                            : "," + rounded(row.at(key)[static_cast<size_t>(i)].get<double>(), 9);
        text += '\n';
    }
    return text;
}

class Sweep {
  public:
    Sweep(const SweepArguments& arguments, Console& console)
        : arguments_(arguments),
          library_(Library::open()),
          resolver_(library_, ".", false, console.notes()),
          standard_(standardObserver(library_)) {
        for (const std::string& observer : arguments.observers) {
            Eye eye{detectorFor(observer, resolver_, {}), {}, fileName(observer)};
            if (!eye.detector.tristimulus) eye.toXyz = towardsXyz(eye.detector, standard_);
            eyes_.push_back(std::move(eye));
        }
        for (const std::string& region : arguments.regions)
            regions_.push_back(regionOf(region));
        const std::vector<Variant> variants = variantsOf(arguments.vary);
        std::vector<Plan> plans;
        std::vector<std::string> names;
        const RenderSettings settings = renderSettings(arguments.scene);
        for (const Variant& variant : variants) {
            LoadOptions options = loadOptions(arguments.scene);
            options.set.insert(options.set.end(), variant.set.begin(), variant.set.end());
            Scene scene = loadScene(arguments.scene.file, library_, options, console.notes());
            light_.push_back(scene.lights.empty() ? Curve::constant(1)
                                                  : scene.lights.front().emitter.spectrum.curve());
            separateLights(scene);
            Notes notes;
            plans.push_back(makePlan(scene, settings, library_, notes));
            for (const std::string& line : notes.lines())
                console.notes().say(withoutMarks(line));
            if (plans.back().as != PassKind::radiance)
                throw InputError("a sweep shows radiance; the pass asks for something else");
            names.push_back(variant.name.empty() ? "scene" : variant.name);
        }
        const Plan& first = plans.front();
        for (const Region& region : regions_)
            if (region.x + region.width > first.view.width || region.y + region.height > first.view.height)
                throw InputError(fmt::format("the region '{}' lies outside the image of {} x {} pixels",
                                             region.name, first.view.width, first.view.height));
        std::vector<DetectorWeights> weights;
        for (const Eye& eye : eyes_)
            weights.push_back(weightsOn(first.wavelengths, eye.detector));
        names_ = names;
        sweep_ = sweepPlan(std::move(plans), names, weights);
    }

    /// Renders once; returns the table.
    Json run(const Device& device) {
        const Plan& plan = sweep_.plan;
        std::vector<std::vector<ChannelImage>> images;
        for (size_t v = 0; v < names_.size(); ++v) {
            images.emplace_back();
            for (const Eye& eye : eyes_)
                images.back().emplace_back(plan.view.width, plan.view.height, eye.detector.size());
        }
        Renderer renderer(device, plan);
        renderer.render([&](int firstRow, int rows, const float* columns, const float*) {
            const auto width = static_cast<size_t>(plan.view.width);
            for (size_t v = 0; v < names_.size(); ++v)
                for (size_t d = 0; d < eyes_.size(); ++d)
                    for (size_t c = 0; c < eyes_[d].detector.size(); ++c)
                        for (size_t row = 0; row < static_cast<size_t>(rows); ++row) {
                            const float* from =
                                columns + (row * plan.terms.bands + sweep_.column(v, d) + c) * width;
                            std::copy(from, from + width,
                                      images[v][d].plane[c].begin() +
                                          static_cast<std::ptrdiff_t>((static_cast<size_t>(firstRow) + row) *
                                                                      width));
                        }
        });
        build = renderer.times().build;
        rendering = renderer.times().render;
        const Stopwatch clock;
        Json rows = Json::array();
        for (size_t v = 0; v < names_.size(); ++v)
            for (size_t d = 0; d < eyes_.size(); ++d)
                finish(v, eyes_[d], images[v][d], rows);
        writing = clock.seconds();
        return rows;
    }

    double build = 0, rendering = 0, writing = 0;

  private:
    void finish(size_t variant, const Eye& eye, const ChannelImage& channels, Json& rows) {
        const std::string base =
            (std::filesystem::path(arguments_.output) / (names_[variant] + "-" + eye.name)).string();
        const ChannelImage xyz = eye.detector.tristimulus ? channels : toXyz(eye.toXyz, channels);
        const White chromaticity = whiteOf("first light", light_[variant], eye.detector, eye.toXyz, {});
        if (arguments_.format != "none") {
            if (arguments_.format == "exr") {
                writeChannelsExr(base + ".exr", channels.width, channels.height, eye.detector.channels,
                                 floatPlanes(channels, eye.detector.channels),
                                 {{"observer", eye.detector.name}});
            } else {
                DevelopSettings settings;
                settings.white = chromaticity;
                const DevelopedPicture picture = develop(xyz, settings);
                writePng(base + ".png", {picture.width, picture.height, 3, picture.rgb},
                         {{"Software", "spectrad " SPECTRAD_VERSION}});
            }
        }
        if (regions_.empty()) return;
        const double bright = brightest(xyz);
        const White white = withLuminance(chromaticity, bright > 0 ? bright : 1);
        for (const Region& region : regions_)
            rows.push_back(rowOf(names_[variant], eye, region, channels, white));
    }

    const SweepArguments& arguments_;
    Library library_;
    SpectrumResolver resolver_;
    Detector standard_;
    std::vector<Eye> eyes_;
    std::vector<Region> regions_;
    std::vector<Curve> light_;  ///< of each variant: its first light
    std::vector<std::string> names_;
    SweepPlan sweep_;
};

ExitCode sweepScene(SweepArguments arguments) {
    if (arguments.observers.empty()) arguments.observers = {"cie1931-2"};
    if (arguments.format != "png" && arguments.format != "exr" && arguments.format != "none")
        throw UsageError("--format: '" + arguments.format + "' is not known (allowed: png, exr, none)");
    Console console(arguments.quiet);
    const Stopwatch clock;
    const std::optional<int> number = deviceNumber(arguments.scene.device);
    Sweep sweep(arguments, console);
    const Device device = Device::open(number);
    std::error_code failed;
    std::filesystem::create_directories(arguments.output, failed);
    if (failed) throw MachineError("cannot make the folder '" + arguments.output + "': " + failed.message());
    const double planned = clock.seconds();
    const Json rows = sweep.run(device);
    if (!arguments.regions.empty()) {
        const std::filesystem::path folder = arguments.output;
        writeFile(folder / "sweep.csv", csvOf(rows));
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
    command->add_option("--observer", arguments->observers, "a detector, may be repeated; default: cie1931-2")
        ->type_name("NAME|FILE|PRODUCT")
        ->allow_extra_args(false);
    command->add_option("--region", arguments->regions, "a rectangle to measure, may be repeated")
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
        "Geometry is rasterized once, whatever the number of variants (a value may change spectra only). The "
        "table holds XYZ (Y in "
        "cd/m2), chromaticity and CIELAB against the first light at the image's brightest Y.\n\n"
        "Examples:\n"
        "  spectrad sweep scene.xml -o out --vary "
        "'key.spectrum+fill.spectrum=illuminants/A|illuminants/D65'\n"
        "  spectrad sweep scene.xml -o out --vary 'key.spectrum=illuminants/A|illuminants/FL11' \\\n"
        "           --observer cie1931-2 --observer nikon-5100 --region white=140,500,20,20\n"
        "  spectrad sweep scene.xml -o out --vary 'ink.diffuse.reflectance=a.csv|b.csv' --format exr");
    command->final_callback(
        [&action, arguments] { action = [arguments] { return sweepScene(*arguments); }; });
}

}  // namespace spectrad
