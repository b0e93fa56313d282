// Imported models as parts of a scene, or as a scene of their own.
#pragma once

#include "scene/import.h"
#include "scene/scene.h"
#include "spectrum/resolver.h"

namespace spectrad {

/// <bind material="Wall*" to="ink"/>: imported materials whose name matches the pattern (* and ?) wear a
/// scene material.
struct Binding {
    std::string pattern;
    Index material = 0;
    SourceLocation where;
};

struct GraftOptions {
    double metresPerUnit = 1;  ///< of the model's lengths
    Normals normals = Normals::file;
    std::optional<Index> material;  ///< one material for everything
    std::vector<Binding> bindings;
    bool lightsAndCameras = true;
};

/// Adds the model's nodes, meshes, materials (lifted from their RGB; names made unique), lights and cameras
/// below `parent`; the pictures that worn materials show join scene.filesRead. A binding that matches nothing
/// is a warning with the names there are, and so is a picture that cannot be shown.
void graft(Scene& scene, Index parent, const ImportedScene& model, const GraftOptions& options,
           const SpectrumResolver& resolver, Notes& notes);

/// A foreign model as a scene: without a camera the whole is framed from the front, a little above; without
/// lights, D65 from behind the camera; both said in the notes.
[[nodiscard]] Scene sceneFromModel(const std::filesystem::path& path, const SpectrumResolver& resolver,
                                   bool restricted, Notes& notes);

/// Camera that sees the whole scene from the front, a little above (used where a scene has none).
[[nodiscard]] Camera framingCamera(const Scene& scene);

}  // namespace spectrad
