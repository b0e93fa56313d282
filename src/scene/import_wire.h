// An imported model as bytes, from the child process that ran Assimp to the parent, which trusts none of
// them.
#pragma once

#include "scene/import.h"
#include "scene/import_isolate.h"

#include <string_view>

namespace spectrad {

void sendScene(const ImportedScene& scene, const ByteSink& sink);
void sendError(const std::string& message, const ByteSink& sink);

/// Throws InputError with what sendError was given, or if the bytes are no whole, consistent scene: sizes,
/// indices, finite numbers, a tree of nodes.
[[nodiscard]] ImportedScene receiveScene(std::string_view bytes);

}  // namespace spectrad
