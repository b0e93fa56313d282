// Reading scenes: our XML, or a foreign model as a scene of its own.
#pragma once

#include "scene/scene.h"
#include "spectrum/resolver.h"

#include <filesystem>
#include <string>
#include <vector>

namespace spectrad {

struct LoadOptions {
    std::vector<std::string>
        set;  ///< "NODE.ATTR=VALUE" or "kind:NODE.ATTR=VALUE", applied to the XML before it is read
    bool restricted = false;  ///< no file outside the scene's folder but the library's
};

/// Whole scene, checked. Throws InputError with place; remarks (unused definitions, default lamp, framed
/// camera) go to notes.
[[nodiscard]] Scene loadScene(const std::filesystem::path& path, const Library& library,
                              const LoadOptions& options, Notes& notes);

}  // namespace spectrad
