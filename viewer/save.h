// What the viewer shows, as files: the scene with what was changed, and the cube that the ordinary renderer
// makes of it.
#pragma once

#include "viewer/scene_subject.h"

namespace spectrad::view {

/// The scene's file with the look's lights and reflectances, and the camera where it stands, in place of its
/// own: only those attributes differ. Throws InputError for what stands in a foreign model and so cannot be
/// said in that file.
[[nodiscard]] std::string sceneText(const SceneSubject& subject, const Look& look);
/// Writes it; a scene that names files must stay beside them.
void saveScene(const SceneSubject& subject, const Look& look, const std::filesystem::path& target);

/// Renders the scene as it is looked at into x.exr or x.img. `software`: its name and version, for the file.
void saveCube(const SceneSubject& subject, const Look& look, const std::filesystem::path& target,
              const Library& library, const std::string& software, Notes& notes);

}  // namespace spectrad::view
