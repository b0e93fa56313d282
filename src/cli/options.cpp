#include "cli/options.h"

#include "base/files.h"
#include "base/limits.h"
#include "base/text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <limits>
#include <system_error>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

Only parseOnly(const std::string& text) {
    if (text == "reflection") return Only::reflection;
    if (text == "fluorescence") return Only::fluorescence;
    throw UsageError("--only: '" + text + "' is not known (allowed: reflection, fluorescence)");
}

/// "a number from 0 to 1", "a number from 0 on": a side at the type's largest value is none.
template <class Number>
std::string wanted(const char* what, Number least, Number most) {
    constexpr Number largest = std::numeric_limits<Number>::max();
    const std::string from = least <= -largest ? "" : fmt::format(" from {}", least);
    return what + from + (most < largest ? fmt::format(" to {}", most) : from.empty() ? "" : " on");
}

}  // namespace

double parseNumber(const std::string& option, std::string_view text, double least, double most) {
    const std::optional<double> value = parseDouble(text);
    if (!value || *value < least || *value > most)
        throw UsageError(fmt::format("{}: '{}' is not {}", option, text, wanted("a number", least, most)));
    return *value;
}

int parseCount(const std::string& option, std::string_view text, int least, int most) {
    const std::optional<long long> value = parseInteger(text);
    if (!value || *value < least || *value > most)
        throw UsageError(
            fmt::format("{}: '{}' is not {}", option, text, wanted("a whole number", least, most)));
    return static_cast<int>(*value);
}

std::pair<int, int> parseSize(const std::string& option, std::string_view text) {
    const std::vector<std::string_view> sides = split(text, 'x');
    if (sides.size() != 2)
        throw UsageError(
            fmt::format("{}: '{}' is not WIDTHxHEIGHT in pixels, such as 1280x720", option, text));
    return {parseCount(option, sides[0], 1, largestSide), parseCount(option, sides[1], 1, largestSide)};
}

std::optional<Place> readPlace(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() < 2 || parts.size() > 3) return std::nullopt;
    const std::optional<long long> x = parseInteger(parts[0]), y = parseInteger(parts[1]);
    const std::optional<double> radius = parts.size() == 3 ? parseDouble(parts[2]) : 0.0;
    const auto fits = [](const std::optional<long long>& v) {
        return v && *v >= 0 && *v < std::numeric_limits<int>::max();
    };
    if (!fits(x) || !fits(y) || !radius || *radius < 0) return std::nullopt;
    return Place{static_cast<int>(*x), static_cast<int>(*y), *radius};
}

Place parsePlace(const std::string& option, std::string_view text) {
    const std::optional<Place> place = readPlace(text);
    if (!place)
        throw UsageError(
            fmt::format("{}: '{}' is not X,Y or X,Y,RADIUS in pixels, (0,0) top left", option, text));
    return *place;
}

void addSceneOptions(CLI::App& command, SceneArguments& arguments) {
    command
        .add_option("--wavelengths", arguments.wavelengths,
                    "bands in nm, FROM:TO:STEP or a list A,B,C; default: the scene's (380:780:5)")
        ->type_name("NM");
    command
        .add_option(
            "--projection", arguments.projection,
            "what a band value is: average under a triangular slit or a box, or the value at the point; "
            "default: the scene's (slit)")
        ->type_name("slit|box|point");
    command.add_option("--size", arguments.size, "pixels; default: the camera's")->type_name("WIDTHxHEIGHT");
    command
        .add_option("--samples", arguments.samples, "samples a pixel, 1 to 64; default: the pass's, else 16")
        ->type_name("N");
    command.add_option("--camera", arguments.camera, "render this camera instead of a pass")
        ->type_name("NAME");
    command
        .add_option("--pass", arguments.pass,
                    "render this pass and what it needs; default: 'main', else the last")
        ->type_name("NAME");
    command
        .add_option(
            "--only", arguments.only,
            "of what comes from surfaces, only what is reflected or what fluoresces; default: everything")
        ->type_name("reflection|fluorescence");
    command
        .add_option("--set", arguments.set,
                    "set an attribute of a named element, e.g. lamp.spectrum=illuminants/A; with a kind in "
                    "front where "
                    "two share a name: light:lamp.spectrum=…; may be repeated")
        ->type_name("NODE.ATTR=VALUE")
        ->allow_extra_args(false);
    command.add_flag("--restrict", arguments.restricted,
                     "refuse every file outside the scene's own folder but the library");
}

void addDeviceOption(CLI::App& command, std::string& device) {
    command
        .add_option(
            "--device", device,
            "OpenCL device by its number in 'spectrad devices'; default: the first GPU, else the first")
        ->type_name("N");
}

std::string recorded(const SceneArguments& arguments) {
    std::string text;
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) text += std::string(" ") + option + " " + value;
    };
    add("--wavelengths", arguments.wavelengths);
    add("--projection", arguments.projection);
    add("--size", arguments.size);
    add("--samples", arguments.samples);
    add("--camera", arguments.camera);
    add("--pass", arguments.pass);
    add("--only", arguments.only);
    add("--device", arguments.device);
    for (const std::string& set : arguments.set)
        add("--set", set);
    return text;
}

LoadOptions loadOptions(const SceneArguments& arguments) {
    return {arguments.set, arguments.restricted};
}

RenderSettings renderSettings(const SceneArguments& arguments) {
    RenderSettings settings;
    if (!arguments.wavelengths.empty())
        settings.wavelengths =
            asUsage("--wavelengths", [&] { return parseWavelengths(arguments.wavelengths, {}); });
    if (!arguments.projection.empty())
        settings.projection =
            asUsage("--projection", [&] { return parseProjection(arguments.projection, {}); });
    if (!arguments.size.empty()) settings.size = parseSize("--size", arguments.size);
    if (!arguments.samples.empty())
        settings.samples = parseCount("--samples", arguments.samples, 1, maxSamples);
    if (!arguments.only.empty()) settings.only = parseOnly(arguments.only);
    settings.camera = arguments.camera;
    settings.pass = arguments.pass;
    return settings;
}

std::optional<int> deviceNumber(const std::string& device) {
    if (device.empty()) return std::nullopt;
    return parseCount("--device", device, 0, std::numeric_limits<int>::max());
}

void requireWritable(const fs::path& target) {
    std::error_code ignored;
    if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored) &&
        !fs::is_directory(target, ignored))
        throw MachineError("cannot write '" + target.string() + "': it is not a regular file");
    const PendingFile probe(target);
}

void requireOther(const std::string& option, const fs::path& target, const fs::path& input) {
    std::error_code ignored;
    if (fs::equivalent(target, input, ignored))
        throw UsageError(option + ": '" + target.string() + "' is the file that is read");
}

}  // namespace spectrad
