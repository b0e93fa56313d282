// What the readers of a scene file share while the scene grows: one function a part of the format, each in a
// file of its own.
#pragma once

#include "scene/element.h"
#include "scene/import.h"
#include "scene/name_table.h"
#include "scene/scene.h"
#include "spectrum/resolver.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace spectrad {

/// Files in the order in which they were first read.
class FilesRead {
  public:
    void add(const std::filesystem::path& file);
    [[nodiscard]] const std::vector<std::string>& list() const { return list_; }

  private:
    std::vector<std::string> list_;
    std::set<std::string> known_;
};

/// Models that were read, so that a file used twice is imported once.
struct ModelCache {
    using Parts = std::vector<MeshUse>;
    std::map<std::filesystem::path, std::shared_ptr<const ImportedScene>> models;
    std::map<std::tuple<std::filesystem::path, Normals, bool>, std::shared_ptr<const Parts>> parts;
};

struct Reading {
    const XmlDocument& document;
    SpectrumResolver& resolver;
    Notes& notes;
    bool restricted = false;
    Scene scene{};
    FilesRead files{};
    NameTable materials{"material"}, nodes{"node"}, lights{"light"}, cameras{"camera"}, detectors{"detector"},
        passes{"pass"};
    std::vector<bool> materialUsed{};  ///< one per material that the scene file defines
    ModelCache cache{};
    /// Another scene's file, for a pass of it; throws InputError at the place for scenes that contain
    /// themselves.
    std::function<std::shared_ptr<const Scene>(const std::filesystem::path&, const SourceLocation&)>
        otherScene{};

    /// A length attribute in metres; the fallback is in the scene's unit.
    [[nodiscard]] double length(const Element& element, const char* attribute, double fallback,
                                Bounds bounds) const;
    /// A position or displacement in metres.
    [[nodiscard]] Vec3 position(const Element& element, const char* attribute, Vec3 fallback) const;
    /// Lengths that were read already, in metres; an error where they leave the range of numbers.
    [[nodiscard]] double metres(const Element& element, const char* attribute, double value) const;
    /// The spectrum that an attribute names, checked for what it is used as.
    [[nodiscard]] Spectrum spectrum(const Element& element, const char* attribute, Role role);
    /// The material that an attribute names; the default (grey) without the attribute.
    [[nodiscard]] Index material(const Element& element, const char* attribute);
    /// A file that an attribute names, found beside the scene.
    [[nodiscard]] std::filesystem::path file(const Element& element, const char* attribute);
};

/// An empty scene: the root node and the default material, grey of reflectance 0.5.
[[nodiscard]] Scene emptyScene();

void readHeader(Reading& reading);   ///< version, unit, wavelengths
void readSpectra(Reading& reading);  ///< every <spectrum>, those first that others name
void readMaterials(Reading& reading);
void readGraph(
    Reading& reading);  ///< nodes with shapes, meshes, lights, cameras, instances, imports; checks instances
void readBackground(Reading& reading);
void readDetectors(Reading& reading);
void readPasses(Reading& reading);  ///< also checks that textures name passes that are there, of their type

void readBatch(Reading& reading);  ///< regions and sweeps, after all that they name

/// Parts of the graph, called by readGraph.
[[nodiscard]] Light readLight(Reading& reading, const Element& element);
[[nodiscard]] Camera readCamera(Reading& reading, const Element& element);
[[nodiscard]] ShapeUse readShape(Reading& reading, const Element& element, ShapeKind kind);
[[nodiscard]] Affine readTransform(const Reading& reading, const Element& element);
void readMesh(Reading& reading, const Element& element, Index node);
void readImport(Reading& reading, const Element& element, Index node);

/// What a source's amount is an amount of, and so which attributes state it.
enum class SourceKind { intensity, irradiance, radiance };
[[nodiscard]] Emitter readEmitter(Reading& reading, const Element& element, SourceKind kind,
                                  const std::string& what);

/// texture="file | pass:NAME" with its filter=.
[[nodiscard]] TextureUse readTexture(Reading& reading, const Element& element, TextureRole role,
                                     const char* attribute = "texture");
/// A picture that an attribute names, and how it lies on the surface.
[[nodiscard]] TextureUse readPicture(Reading& reading, const Element& element, const char* attribute);
[[nodiscard]] Select readSelect(Reading& reading, const Element& element);
/// Where no image is, nothing says how one lies.
void refuseSampling(const Element& element, const std::string& why);
/// What glows: an emitter of radiance, or texture= with scale=.
[[nodiscard]] Emitter readGlow(Reading& reading, const Element& element, const std::string& what);

/// Throws InputError for instances that contain themselves (printing the chain), and for more placements than
/// maxPlacements once all are expanded.
void checkInstances(const Scene& scene);
inline constexpr double maxPlacements = 16'777'216;

}  // namespace spectrad
