// SCENE.xml#NAME: a <detector> of a scene as an observer.
#pragma once

#include "colour/detector.h"

#include <optional>
#include <string>

namespace spectrad {

/// Nothing where `observer` is not of that form; its file is looked for by the resolver. Throws InputError
/// for a scene that cannot be read, and where it has no such detector.
[[nodiscard]] std::optional<Detector> sceneDetector(const std::string& observer,
                                                    const SpectrumResolver& resolver, const Library& library);

}  // namespace spectrad
