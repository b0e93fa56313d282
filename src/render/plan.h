// The plan: what this scene needs, before anything is compiled. Everything later reads only this.
#pragma once

#include "render/settings.h"
#include "render/term_table.h"
#include "render/world.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace spectrad {

class Library;

struct Plan {
    PassKind as = PassKind::radiance;
    std::string cameraName, passName;
    View view;
    int faces = 1;  ///< 6 where the camera looks all around: one image below the other
    World world;
    std::uint32_t groups = 0;  ///< of lights with one spectrum each
    TermTable terms;           ///< the spectra of all (light, lobe, material) terms on the output's bands
    Wavelengths wavelengths;
    int samples = 16;
    std::vector<std::string>
        features;  ///< elements and attributes that need something: "diffuse", "gloss", "point" …
    std::vector<std::string> defines;  ///< -D switches of the kernels
    std::uint64_t stripBytes = 0;      ///< asked for, or 0
    std::string whiteName;             ///< the first light's spectrum as the user named it, or "E"
    std::array<double, 3> white{};     ///< its XYZ at Y = 1 (CIE 1931)
    /// The same of the first light that CIELAB can have as its white: X and Z of at least 0.1 % of Y (a line
    /// beyond 650 nm has no Z at all).
    std::string labWhiteName;
    std::array<double, 3> labWhite{};

    [[nodiscard]] size_t triangles() const { return world.drawnTriangles(); }
    [[nodiscard]] size_t lights() const { return world.lights.size(); }
};

/// The same plan for another number of samples.
[[nodiscard]] Plan withSamples(Plan plan, int samples);

/// What is rendered: a pass, or a whole scene through a camera.
struct Shot {
    const Scene* scene = nullptr;  ///< that is shown: another file's where the pass says so
    const Pass* pass = nullptr;
    std::optional<Index> number;  ///< of the pass among the shown scene's, if it is one of them
    Index camera = 0;
};
/// The pass or camera that the settings name, else the scene's choice. Throws InputError for unknown names.
[[nodiscard]] Shot chooseShot(const Scene& scene, const RenderSettings& settings);
[[nodiscard]] Shot shotOf(const Scene& scene, const Pass& pass);
/// The bands that it is rendered on.
[[nodiscard]] Wavelengths gridOf(const Shot& shot, const RenderSettings& settings);

/// Its size in pixels; of a cube camera, a face's.
[[nodiscard]] std::pair<int, int> sizeOf(const Shot& shot, const RenderSettings& settings);

/// Throws InputError for what the scene asks and this version cannot do ("not yet"), and for limits exceeded.
[[nodiscard]] Plan makePlan(const Scene& scene, const RenderSettings& settings, const Library& library,
                            Notes& notes);
/// The same with textures from `textures`, which can render passes.
[[nodiscard]] Plan makePlan(const Scene& scene, const RenderSettings& settings, const Library& library,
                            TextureLoader& textures, Notes& notes);
[[nodiscard]] Plan makePlan(const Shot& shot, const RenderSettings& settings, const Library& library,
                            TextureLoader& textures, Notes& notes);

}  // namespace spectrad
