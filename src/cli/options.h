// Options that several commands share, and how their values are read. A value that cannot be read is a
// UsageError that names the option.
#pragma once

#include "base/error.h"
#include "base/files.h"  // extensionOf
#include "render/settings.h"
#include "scene/load.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace spectrad {

/// Runs a parser of the library's, whose complaint about a file or a name is here one about the command line.
template <class Parse>
auto asUsage(const std::string& option, Parse parse) {
    try {
        return parse();
    } catch (const Error& error) {
        throw UsageError(option + ": " + error.what());
    }
}

/// A finite number within [least, most]; where `most` is the type's largest value, there is no such limit,
/// and the message names none.
[[nodiscard]] double parseNumber(const std::string& option, std::string_view text, double least, double most);
/// A whole number within [least, most], likewise.
[[nodiscard]] int parseCount(const std::string& option, std::string_view text, int least, int most);
/// "1280x720": both sides 1…largestSide.
[[nodiscard]] std::pair<int, int> parseSize(const std::string& option, std::string_view text);

/// Pixels to measure: those whose centres lie within `radius` (pixels) of the centre of pixel (x, y), (0,0)
/// top left.
struct Place {
    int x = 0, y = 0;
    double radius = 0;
};
/// "X,Y" or "X,Y,RADIUS", or nothing.
[[nodiscard]] std::optional<Place> readPlace(std::string_view text);
[[nodiscard]] Place parsePlace(const std::string& option, std::string_view text);

/// What chooses a picture of a scene; the same for every command that plans one.
struct SceneArguments {
    std::string file, wavelengths, projection, size, samples, camera, pass, only, device;
    std::vector<std::string> set;
    bool restricted = false;
};
void addSceneOptions(CLI::App& command, SceneArguments& arguments);
void addDeviceOption(CLI::App& command, std::string& device);
/// Those options as they were given, to be recorded with the result: " --size 640x480 --set lamp.spectrum=…".
/// Without --restrict, which comes last.
[[nodiscard]] std::string recorded(const SceneArguments& arguments);
[[nodiscard]] LoadOptions loadOptions(const SceneArguments& arguments);
[[nodiscard]] RenderSettings renderSettings(const SceneArguments& arguments);
[[nodiscard]] std::optional<int> deviceNumber(const std::string& device);

/// A place where a file may go: its folder can be written, and what stands there, if anything, is a file.
/// Found out before hours of rendering. Throws MachineError.
void requireWritable(const std::filesystem::path& target);
/// Throws UsageError if `target` is `input` itself.
void requireOther(const std::string& option, const std::filesystem::path& target,
                  const std::filesystem::path& input);

}  // namespace spectrad
