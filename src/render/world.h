// The world: everything that geometry kernels read, as flat arrays for one view. It knows no wavelength.
#pragma once

#include "scene/scene.h"
#include "types.h"

#include <cstdint>
#include <vector>

namespace spectrad {

/// A camera with its pixels. Camera space: x right, y up, looking down −z, metres.
struct View {
    bool orthographic = false;
    int width = 0, height = 0;  ///< pixels
    double pixelsPerSlope = 1;  ///< perspective: pixels per unit of x/depth; orthographic: pixels per metre
    Affine worldToCamera;
};
/// `toWorld`: of the node the camera stands in. Scale in it moves the eye and stretches an orthographic view,
/// nothing else.
[[nodiscard]] View makeView(const Camera& camera, const Affine& toWorld, int width, int height);

struct World {
    std::vector<float> position, normal;    ///< three a vertex, in the object space of the vertex's draw
    std::vector<float> uv;                  ///< two a vertex; empty if no material has a texture
    std::vector<std::uint32_t> vertexDraw;  ///< one a vertex
    std::vector<sd_draw> draws;
    std::vector<std::uint32_t> index;             ///< three a triangle
    std::vector<std::uint32_t> triangleMaterial;  ///< one a triangle, index into materials
    std::vector<sd_material> materials;           ///< [0] is the background
    std::vector<sd_lobe> lobes;
    std::vector<sd_piece> tables;
    std::vector<sd_light> lights;
    std::vector<sd_texture> textures;
    std::vector<float> texels;
};

/// Adds the triangles of all objects: shapes tessellated to a tenth of a pixel as this view sees them, meshes
/// as they are. Scene material m becomes world material materialNumber[m]. Throws InputError beyond 2^32 − 2
/// triangles or vertices. Texture coordinates are kept only where a texture wants them.
void addGeometry(World& world, const FlatScene& scene, const View& view,
                 const std::vector<std::uint32_t>& materialNumber);

}  // namespace spectrad
