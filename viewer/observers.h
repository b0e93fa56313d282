// Who can look: eyes, cameras, a scene's detectors, films.
#pragma once

#include "viewer/look.h"

namespace spectrad::view {

/// Puts the observer into the look, named as observe --observer names it. Throws InputError.
void setObserver(Look& look, const std::string& name, const SpectrumResolver& resolver,
                 const Library& library);
/// The library's, and those of `scene` if there is one.
[[nodiscard]] std::vector<std::string> observerNames(const Library& library, const Scene* scene);

}  // namespace spectrad::view
