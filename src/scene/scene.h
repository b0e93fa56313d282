// The scene graph as plain data: what the XML or a foreign file says, checked, spectra resolved, lengths in
// metres; nothing of cameras' pixels, devices or bands' products yet. Indices refer to the vectors of Scene.
#pragma once

#include "base/error.h"
#include "base/vec.h"
#include "scene/batch.h"
#include "scene/mesh.h"
#include "scene/shapes.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelengths.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

using Index = std::uint32_t;

// ---- amounts
// -------------------------------------------------------------------------------------------------------

enum class AmountUnit {
    candela,
    wattPerSteradian,  // intensity
    lumen,
    watt,  // power
    lux,
    wattPerSquareMetre,  // illuminance, irradiance
    candelaPerSquareMetre,
    wattPerSquareMetreSteradian,  // luminance, radiance
};
[[nodiscard]] bool isPhotometric(AmountUnit unit);

/// "800 cd", "100 W/m2 over 400:700".
struct Amount {
    AmountUnit unit = AmountUnit::candela;
    double value = 0;
    std::optional<std::pair<double, double>>
        over;  ///< nm: integrate the spectrum over this range (constant spectra need one)
};

/// What a texture's values must be where it is used.
enum class TextureRole { reflectance, radiance, irradiance };
enum class TextureFilter { nearest, bilinear, mip };
/// How a place finds its texel: by the surface's coordinates, by its pixel in the picture, or by a direction
/// in six faces (Camera::cube).
enum class TextureMapping { surface, picture, cube };
/// An image on a surface: where it comes from, and how it lies on the surface's texture coordinates.
struct TextureUse {
    std::string source;  ///< file name, or "pass:NAME"
    /// A picture inside a model's file, byte by byte; `source` then only names it.
    std::shared_ptr<const std::string> bytes{};
    bool isPlainSrgb = false;             ///< a picture whose file is not asked what its colours are
    std::array<double, 3> tint{1, 1, 1};  ///< what the linear sRGB components of a picture are multiplied by
    TextureFilter filter = TextureFilter::bilinear;
    bool repeat = false;  ///< beyond 0…1; else the border goes on
    /// Coordinates are scaled, then rotated (degrees, from u to v), then moved.
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    double rotateDegrees = 0;
    TextureRole role = TextureRole::reflectance;
    TextureMapping mapping = TextureMapping::surface;
    SourceLocation where;

    [[nodiscard]] bool isPass() const { return source.starts_with("pass:"); }
    [[nodiscard]] std::string passName() const { return source.substr(5); }
};

/// A source's spectrum: shape × amount, or absolute × scale (docs/format.md, "Amounts").
struct Emitter {
    Spectrum spectrum;
    std::optional<Amount>
        amount;  ///< nothing: the spectrum counts as it stands, in the light's own unit per nm
    double scale = 1;
    SourceLocation where;
    /// Instead of the spectrum: radiances from place to place × scale; of a light, their mean.
    std::optional<TextureUse> texture{};
};

// ---- materials
// -----------------------------------------------------------------------------------------------------

/// A picture whose values stand for measured reflectances.
struct Select {
    static constexpr std::uint32_t colour = 0x1000000;  ///< marks a value as one of a coloured picture
    struct Choice {
        std::uint32_t value =
            0;  ///< 0…255 of a grey picture, 0…65535 of 16 bits; 0x1RRGGBB of a coloured one
        Spectrum reflectance;
        SourceLocation where;
    };
    TextureUse map;
    bool mix = false;  ///< a value between two choices' is a mixture of the two; else it is an error
    std::vector<Choice> choices;  ///< values ascending

    [[nodiscard]] bool isColoured() const { return choices.back().value >= colour; }
};

struct Diffuse {
    std::optional<Spectrum> reflectance;  ///< exactly one of reflectance, texture, select
    std::optional<TextureUse> texture;
    std::optional<Select> select;
    double roughnessDegrees = 0;  ///< Oren–Nayar's σ; 0 is Lambert
    /// The reflectance is that seen through the coat: bounces between coat and base are in it already.
    bool isSeenThroughCoat = false;
};
/// Of a glossy surface, 0…1; GGX alpha is its square. Along the texture coordinates' u and across it.
struct Roughness {
    double u = 0, v = 0;
    Roughness() = default;
    Roughness(double both) : u(both), v(both) {}
    Roughness(double along, double across) : u(along), v(across) {}
    [[nodiscard]] bool isMirror() const { return u == 0; }
};
/// Dielectric coat.
struct Gloss {
    Spectrum ior;
    Roughness roughness;
    std::optional<TextureUse> reflects{};  ///< of a mirror (roughness 0): what it shows
};
struct Specular {
    Spectrum reflectance;  ///< at normal incidence
    Roughness roughness;
    std::optional<TextureUse> reflects{};  ///< of a mirror (roughness 0): what it shows
};
struct Conductor {
    Spectrum ior;  ///< two curves, n and k
    Roughness roughness;
    bool schlick = false;
    std::optional<TextureUse> reflects{};  ///< of a mirror (roughness 0): what it shows
};
struct Fluorescence {
    std::optional<Spectrum> excitation, emission;
    bool emissionInPhotons = false, antiStokes = false;
    double yield = 1, strength = 1;
    std::string matrixFile;  ///< instead of the three above
    bool diagonalNone = false;
    std::optional<TextureUse> mask;  ///< grey picture 0…1 that multiplies the strength
    SourceLocation where;
};

/// A surface's fine shape: its normals are bent, nothing else.
struct Relief {
    TextureUse map;
    bool heights = false;  ///< a grey picture of heights; else a normal map as in glTF
    double amount = 1;     ///< metres from black to white; or what tilts are multiplied by
};

struct Material {
    std::string name;
    SourceLocation where;
    std::optional<Diffuse> diffuse;
    std::optional<Gloss> gloss;
    std::optional<Specular> specular;
    std::optional<Conductor> conductor;
    std::vector<Fluorescence> fluorescence;
    std::optional<Emitter> emission;
    std::optional<Relief> relief;
};

// ---- graph
// ---------------------------------------------------------------------------------------------------------

struct ShapeUse {
    Shape shape;
    Index material = 0;
};
/// A mesh whose triangles all wear one material; a file of several parts is several of these.
struct MeshUse {
    std::shared_ptr<const Mesh> mesh;  ///< normals as asked already
    Index material = 0;
};

struct Node {
    std::string name;  ///< may be empty
    SourceLocation where;
    Affine local;               ///< to the parent's space; lengths in metres
    bool throwsShadows = true;  ///< what stands in it hides lights that are told to throw shadows
    std::vector<Index> children;
    std::vector<ShapeUse> shapes;
    std::vector<MeshUse> meshes;
    std::vector<Index> lights, cameras;
    std::optional<Index> instanceOf;  ///< shows that node's content (not its transform) under `local`
};

enum class LightType { point, spot, directional, ambient };
struct Light {
    std::string name;
    LightType type = LightType::point;
    Emitter emitter;
    Vec3 position;             ///< point, spot; in the node's space, metres
    Vec3 direction{0, -1, 0};  ///< spot, directional: where the light goes, unit vector in the node's space
    double angle = 30;         ///< spot: full opening angle of the cone, degrees
    double blend = 0;          ///< spot: share of the cone's angle over which it fades out, 0…1
    bool shadows = false;      ///< surfaces keep it from others; never of ambient light
    SourceLocation where;
};

struct Camera {
    std::string name;
    bool orthographic = false;
    bool cube = false;               ///< looks all around: six square faces, `width` pixels each
    double fovDegrees = 40;          ///< vertical
    double viewHeight = 1;           ///< orthographic, metres
    Affine toNode;                   ///< camera space (looks down −z, y up) to the node's space, rigid
    int width = 1280, height = 720;  ///< pixels
    SourceLocation where;
};

struct DetectorUse {
    std::string name, observer;  ///< as the scene writes it; empty for a product of its own curves
    Spectrum sensitivity;        ///< a curve a channel
    SourceLocation where;
};

enum class PassKind { radiance, reflectance, transmittance, irradiance };
struct Scene;
/// A camera and a display between a scene and its picture.
struct Screen {
    Spectrum detector;     ///< takes the picture
    Spectrum primaries;    ///< three curves, radiances of the display's red, green and blue at full drive
    double luminance = 0;  ///< cd/m² of all three together; 0: as they are
    SourceLocation where;
};
struct Pass {
    std::string name;
    std::shared_ptr<const Scene> scene;  ///< another file's; camera, of and lights are then its own
    std::optional<Index> base;           ///< then: the pass of that scene from which this one was made
    Index camera = 0;
    std::optional<Index> of;                   ///< node
    std::optional<Index> mirror;               ///< a node: what its x–y plane mirrors
    std::optional<std::vector<Index>> lights;  ///< only these count, wherever they stand
    std::optional<std::pair<int, int>> size;
    std::optional<int> samples;
    std::optional<Wavelengths> wavelengths;
    PassKind as = PassKind::radiance;
    std::optional<Screen> screen;  ///< the radiance is that of a display which shows it
    int repeat = 0;    ///< generations, each of which sees the one before as its own texture; 0: not said
    std::string save;  ///< file to write as well; may be empty
    SourceLocation where;
};

struct Scene {
    std::string file;    ///< as the user named it
    std::string sha256;  ///< of the scene file and every file it read, in order of reading
    std::vector<std::string> filesRead;
    Wavelengths wavelengths;
    double metresPerUnit = 1;
    bool shadows = false;             ///< of lights that do not say themselves whether they throw any
    std::vector<Material> materials;  ///< [0] is the default: grey, reflectance 0.5
    std::vector<Node> nodes;          ///< [0] is the root
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<DetectorUse> detectors;
    std::vector<Pass> passes;
    std::vector<Region> regions;
    std::vector<Sweep> sweeps;
    std::optional<Emitter> background;
};

/// A light's, camera's or node content's place in the world; instances make one per occurrence.
struct Placed {
    Index index;
    Affine toWorld;
};
/// Everything below `root` (without an argument: the whole scene), in document order, instances expanded;
/// without recursion.
struct FlatScene {
    struct Object {
        const Node* node;
        Affine toWorld;
        bool throwsShadows = true;  ///< it, and all nodes that it stands in
        bool drawn = true;          ///< false: it is there for its shadow
    };
    std::vector<Object> objects;  ///< nodes with shapes or meshes
    std::vector<Placed> lights;
    std::vector<Placed> cameras;
};
[[nodiscard]] FlatScene flatten(const Scene& scene, std::optional<Index> root = std::nullopt);
/// What a pass shows: its subtree, with the lights inside it or those it names.
[[nodiscard]] FlatScene flatten(const Scene& scene, const Pass& pass);
/// A node's own place in the world.
[[nodiscard]] Affine placeOf(const Scene& scene, Index node);

}  // namespace spectrad
