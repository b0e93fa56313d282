#include "render/scene_detector.h"

#include "base/text.h"
#include "scene/load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace spectrad {

std::optional<Detector> sceneDetector(const std::string& observer, const SpectrumResolver& resolver,
                                      const Library& library) {
    constexpr std::string_view mark = ".xml#";
    const size_t hash = observer.find(mark);
    if (hash == std::string::npos) return std::nullopt;
    const std::string file = resolver.findFile(observer.substr(0, hash + mark.size() - 1), {}).string(),
                      name = observer.substr(hash + mark.size());
    Notes unsaid;  // that a scene has no light is no concern of its detectors
    const Scene scene = loadScene(file, library, {}, unsaid);
    std::vector<std::string> known;
    for (const DetectorUse& use : scene.detectors) {
        if (use.name == name) {
            Detector detector = detectorFrom(use.sensitivity);
            detector.name = observer;
            return detector;
        }
        known.push_back(use.name);
    }
    throw InputError(
        SourceLocation{file},
        fmt::format("has no <detector name=\"{}\">{} (there are: {})", name, didYouMean(name, known),
                    known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

}  // namespace spectrad
