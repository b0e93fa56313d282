// What the viewer shows, as files: the scene with what was changed, and the cube that the ordinary renderer
// makes of it.
#pragma once

#include "viewer/scene_subject.h"

namespace spectrad::view {

/// The scene's file with the look's lights and reflectances, and the camera where it stands, in place of its
/// own: only those attributes differ. Throws InputError for what stands in a foreign model and so cannot be
/// said in that file.
[[nodiscard]] std::string sceneText(const SceneSubject& subject, const Look& look, const Pose& pose);
/// Writes it; a scene that names files must stay beside them.
void saveScene(const SceneSubject& subject, const Look& look, const Pose& pose,
               const std::filesystem::path& target);

/// All that a cube is rendered from, so that nothing else is asked while that is done.
struct CubeOrder {
    Scene scene;
    RenderSettings settings;
    Device device;  ///< with a queue of its own
    std::filesystem::path target;
    std::string software;  ///< its name and version, for the file
};
/// The scene as it is looked at, into x.exr or x.img. Throws UsageError for other names.
[[nodiscard]] CubeOrder cubeOrder(const SceneSubject& subject, const Look& look, const Stand& stand,
                                  const std::filesystem::path& target, const std::string& software);
/// Renders it. Throws as render does, and Stopped when it is asked to stop; then there is no file.
void writeCube(const CubeOrder& order, const Library& library, const Progress& progress,
               const std::stop_token& stop);

}  // namespace spectrad::view
