#include "viewer/observers.h"

#include "render/scene_detector.h"

#include <algorithm>
#include <filesystem>

namespace spectrad::view {

void setObserver(Look& look, const std::string& name, const SpectrumResolver& resolver,
                 const Library& library) {
    const Detector standard = standardObserver(library);
    if (isFilm(name, library)) {
        look.film = std::make_shared<const FilmProjection>(filmFor(name, resolver, library), standard);
        const XyzMatrix asTheyAre{std::vector<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        look.eye = std::make_shared<const Eye>(Eye{look.film->film().layers, asTheyAre});
        return;
    }
    std::optional<Detector> detector = sceneDetector(name, resolver, library);
    if (!detector) detector = detectorOrFilmMeant(name, resolver, library);
    const XyzMatrix matrix = towardsXyz(*detector, standard);
    look.eye = std::make_shared<const Eye>(Eye{std::move(*detector), matrix});
    look.film.reset();
}

std::vector<std::string> observerNames(const Library& library, const Scene* scene) {
    std::vector<std::string> names;
    if (scene)
        for (const DetectorUse& use : scene->detectors)
            if (const std::filesystem::path file = scene->file; file.extension() == ".xml")
                names.push_back(file.filename().string() + "#" + use.name);
    for (const LibraryEntry& entry : library.list())
        if (entry.quantity == Quantity::sensitivity) names.push_back(entry.name);
    for (const std::string& film : filmNames(library))
        names.push_back(film.substr(film.find('/') + 1));
    return names;
}

}  // namespace spectrad::view
