// The world: everything that geometry kernels read, as flat arrays for one view. It knows no wavelength.
#pragma once

#include "render/mirror.h"
#include "scene/scene.h"
#include "types.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace spectrad {

/// A camera with its pixels. Camera space: x right, y up, looking down −z, metres.
struct View {
    bool orthographic = false;
    bool baked = false;  ///< the image is the square of texture coordinates; the camera is only the eye
    int width = 0, height = 0;  ///< pixels
    double pixelsPerSlope = 1;  ///< perspective: pixels per unit of x/depth; orthographic: pixels per metre
    Affine worldToCamera;
    std::optional<Plane> before;  ///< only what lies on its positive side is seen (a mirror's pass)
};
/// `toWorld`: of the node the camera stands in. Scale in it moves the eye and stretches an orthographic view,
/// nothing else.
[[nodiscard]] View makeView(const Camera& camera, const Affine& toWorld, int width, int height);

/// One face of a camera that looks all around: 90° wide, along the world's axes whichever way the camera is
/// turned; faces +x −x +y −y +z −z as someone inside sees them, their tops towards +y, but +z for +y and −z
/// for −y.
[[nodiscard]] View makeCubeView(const Camera& camera, const Affine& toWorld, int face, int side);

/// A mesh's place before the camera.
[[nodiscard]] sd_draw drawOf(const Affine& objectToCamera);

struct ResidentTexels;

struct World {
    std::vector<float> position, normal;  ///< three a vertex, in the object space of the vertex's draw
    std::vector<float> uv;                ///< two a vertex; empty if nothing asks for them
    std::vector<float>
        tangent;  ///< three a vertex, as normals; empty if all materials are the same all round
    std::vector<std::uint32_t> vertexDraw;  ///< one a vertex
    std::vector<sd_draw> draws;
    std::vector<std::uint32_t> index;             ///< three a triangle
    std::vector<std::uint32_t> triangleMaterial;  ///< one for each triangle that is drawn, index into
                                                  ///< materials; others follow, for their shadows
    /// Triangles that hide lights from others, by the leaves of the tree of boxes (render/casters.h); empty
    /// where no light asks for shadows.
    std::vector<std::uint32_t> casters;
    std::vector<sd_material> materials;  ///< [0] is the background
    std::vector<sd_lobe> lobes;
    std::vector<sd_piece> tables;
    std::vector<sd_light> lights;
    std::vector<sd_texture> textures;
    std::vector<float> texels;
    /// Textures whose texels a pass left on the device; their `first` is found when all are there.
    struct Resident {
        size_t texture;
        std::shared_ptr<const ResidentTexels> texels;
    };
    std::vector<Resident> resident;

    [[nodiscard]] size_t drawnTriangles() const { return triangleMaterial.size(); }
};

/// Adds the triangles of all objects: shapes tessellated to a tenth of a pixel as this view sees them, meshes
/// as they are. Scene material m becomes world material materialNumber[m]. Throws InputError beyond 2^32 − 2
/// triangles or vertices. Texture coordinates are kept only where a texture or a baked view wants them; a
/// baked view takes all of them within reach of its image, or throws InputError. Where lights that throw
/// shadows are there, finds what hides them.
void addGeometry(World& world, const FlatScene& scene, const View& view,
                 const std::vector<std::uint32_t>& materialNumber);

}  // namespace spectrad
