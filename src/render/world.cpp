#include "render/world.h"

#include "base/error.h"
#include "render/casters.h"
#include "render/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// From the eye along a direction, to which a target beside a far eye would not be true.
Affine lookingAlong(Vec3 eye, Vec3 direction, Vec3 up) {
    return Affine::translation(eye) * Affine::lookAt({}, direction, up);
}

}  // namespace

View makeView(const Camera& camera, const Affine& toWorld, int width, int height) {
    const Affine place = toWorld * camera.toNode;
    // Only where it stands and which way it looks: scale or shear on the way do not bend the picture.
    const Vec3 back = normalized(place.direction({0, 0, 1})), up = place.direction({0, 1, 0});
    const Vec3 eye = place.point({0, 0, 0});
    View view;
    view.orthographic = camera.orthographic;
    view.width = width;
    view.height = height;
    view.worldToCamera = inverse(lookingAlong(eye, back * -1, up));
    if (camera.orthographic)
        view.pixelsPerSlope = height / (camera.viewHeight * length(up));
    else
        view.pixelsPerSlope = 0.5 * height / std::tan(camera.fovDegrees * std::numbers::pi / 360);
    return view;
}

View makeCubeView(const Camera& camera, const Affine& toWorld, int face, int side) {
    static constexpr std::array<Vec3, 6> along{
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    static constexpr std::array<Vec3, 6> up{
        {{0, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, 1, 0}}};
    const Vec3 eye = (toWorld * camera.toNode).point({0, 0, 0});
    const auto f = static_cast<size_t>(face);
    View view;
    view.width = view.height = side;
    view.worldToCamera = inverse(lookingAlong(eye, along[f], up[f]));
    view.pixelsPerSlope = 0.5 * side;
    return view;
}

sd_draw drawOf(const Affine& to) {
    sd_draw draw{};
    std::copy(to.m.begin(), to.m.end(), draw.to_camera);
    // Cofactors take normals along; their sign follows the determinant's, so mirrored objects keep their
    // outside. Scaled to stay in float's range whatever the lengths.
    const auto& m = to.m;
    const std::array<double, 9> cofactor{
        m[5] * m[10] - m[6] * m[9], m[6] * m[8] - m[4] * m[10], m[4] * m[9] - m[5] * m[8],
        m[2] * m[9] - m[1] * m[10], m[0] * m[10] - m[2] * m[8], m[1] * m[8] - m[0] * m[9],
        m[1] * m[6] - m[2] * m[5],  m[2] * m[4] - m[0] * m[6],  m[0] * m[5] - m[1] * m[4]};
    double largest = 0;
    for (double c : cofactor)
        largest = std::max(largest, std::abs(c));
    const double scale = (to.determinant() < 0 ? -1 : 1) / (largest > 0 ? largest : 1);
    for (size_t i = 0; i < 9; ++i)
        draw.normal[i] = static_cast<float>(cofactor[i] * scale);
    return draw;
}

namespace {

constexpr size_t most = 0xfffffffe;

/// Largest factor by which the transform stretches a length.
double stretch(const Affine& a) {
    double largest = 0;
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        largest = std::max(largest, length(a.direction(axis)));
    return largest;
}

/// How far a shape's mesh may lie from its true surface, in the shape's units: a tenth of a pixel where it is
/// nearest.
double tolerance(const Shape& shape, const Affine& toWorld, const View& view, bool drawn) {
    const double scale = stretch(toWorld), radius = boundingRadius(shape);
    // Baked, it fills the texture; its shadow on others does not.
    constexpr double round = 5e-4;
    if (view.baked)
        return std::max(0.2 * radius / std::max(view.width, view.height), drawn ? 0 : round * radius);
    double pixel = 1 / view.pixelsPerSlope;  // orthographic: metres; perspective: metres at a depth of 1 m
    if (!view.orthographic) {
        const Vec3 centre = view.worldToCamera.point(toWorld.point({0, 0, 0}));
        const double distance = length(centre) - radius * scale;
        pixel *= std::max(distance, 0.01 * radius * scale);
        // Off the axis, by the angle φ, a length across the line of sight fills 1 / cos²φ as many pixels as
        // on it; as far out as the picture sees it, were it 2.4 times as wide as high: how wide it is must
        // not matter.
        constexpr double widest = 2.4;
        const double corner = std::hypot(widest, 1.0) * view.height / 2 / view.pixelsPerSlope,
                     outermost = std::atan2(std::hypot(centre.x, centre.y), -centre.z) +
                                 std::asin(std::min(1.0, radius * scale / length(centre)));
        const double slope = outermost < std::atan(corner) ? std::tan(outermost) : corner;
        pixel /= 1 + slope * slope;
    }
    return std::max(0.1 * pixel / scale, 1e-7 * radius);
}

bool wantsTangents(const World& world) {
    return std::any_of(world.lobes.begin(), world.lobes.end(),
                       [](const sd_lobe& lobe) { return lobe.alpha_v != 0; });
}

/// A mesh to bake needs coordinates, and none so far out that the rasterizer would clip it.
void checkCoordinates(const Mesh& mesh, const View& view) {
    if (mesh.uv.empty())
        throw InputError("the mesh '" + mesh.name + "' has no texture coordinates to bake into");
    for (const auto& uv : mesh.uv)
        if (!(std::abs((uv[0] - 0.5) * view.width) < SD_GUARD) ||
            !(std::abs((uv[1] - 0.5) * view.height) < SD_GUARD))
            throw InputError("the mesh '" + mesh.name +
                             "' has texture coordinates too far outside 0…1 to be baked");
}

/// Of a mesh without material only the shadow is wanted.
void addMesh(World& world, const Mesh& given, const Affine& toWorld, const View& view,
             std::optional<std::uint32_t> material) {
    if (given.index.empty()) return;
    Mesh cut;
    // What lies behind a mirror is not seen in it, but hides lights.
    const bool isCut = view.before && material;
    if (isCut) {
        // Cut with the normals that the whole has.
        cut =
            before(given.normal.empty() ? withNormals(given, Normals::smooth) : given, toWorld, *view.before);
        if (cut.index.empty()) return;
    }
    const Mesh& mesh = isCut ? cut : given;
    if (view.baked && material) checkCoordinates(mesh, view);
    const size_t first = world.vertexDraw.size();
    if (first + mesh.position.size() > most || world.index.size() / 3 + mesh.triangles() > most)
        throw InputError("the scene has more than " + std::to_string(most) + " triangles or vertices");
    world.draws.push_back(drawOf(view.worldToCamera * toWorld * Affine::translation(mesh.origin)));
    const auto draw = static_cast<std::uint32_t>(world.draws.size() - 1);
    const Mesh* source = &mesh;
    Mesh smoothed;
    if (mesh.normal.empty()) {
        smoothed = withNormals(mesh, Normals::smooth);
        source = &smoothed;
    }
    for (const auto& p : source->position)
        world.position.insert(world.position.end(), p.begin(), p.end());
    for (const auto& n : source->normal)
        world.normal.insert(world.normal.end(), n.begin(), n.end());
    if (!world.textures.empty() || view.baked) {
        // A mesh without coordinates shows the texture's lower left corner everywhere.
        if (source->uv.empty()) world.uv.insert(world.uv.end(), 2 * source->position.size(), 0.0f);
        for (const auto& t : source->uv)
            world.uv.insert(world.uv.end(), t.begin(), t.end());
    }
    if (wantsTangents(world))
        for (const auto& t : tangentsOf(*source))
            world.tangent.insert(world.tangent.end(), t.begin(), t.end());
    world.vertexDraw.insert(world.vertexDraw.end(), source->position.size(), draw);
    for (std::uint32_t i : source->index)
        world.index.push_back(static_cast<std::uint32_t>(first) + i);
    if (material) world.triangleMaterial.insert(world.triangleMaterial.end(), source->triangles(), *material);
}

}  // namespace

void addGeometry(World& world, const FlatScene& scene, const View& view,
                 const std::vector<std::uint32_t>& materialNumber) {
    const bool shadows = throwShadows(world.lights);
    const auto add = [&](const FlatScene::Object& object, bool drawn, bool casts) {
        const auto first = static_cast<std::uint32_t>(world.index.size() / 3);
        const auto worn = [&](Index material) {
            return drawn ? std::optional(materialNumber[material]) : std::nullopt;
        };
        for (const ShapeUse& use : object.node->shapes)
            addMesh(world, tessellate(use.shape, tolerance(use.shape, object.toWorld, view, drawn)),
                    object.toWorld, view, worn(use.material));
        for (const MeshUse& use : object.node->meshes)
            addMesh(world, *use.mesh, object.toWorld, view, worn(use.material));
        for (std::uint32_t t = first; casts && t < world.index.size() / 3; ++t)
            world.casters.push_back(t);
    };
    const auto casts = [&](const FlatScene::Object& object) { return shadows && object.throwsShadows; };
    for (const FlatScene::Object& object : scene.objects)
        if (object.drawn) add(object, true, casts(object) && !view.before);
    for (const FlatScene::Object& object : scene.objects)
        if (casts(object) && (!object.drawn || view.before)) add(object, false, true);
    orderCasters(world);
}

}  // namespace spectrad
