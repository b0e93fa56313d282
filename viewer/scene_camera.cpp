// The camera of a scene that is looked at: where it stands, what it hits, and what is made anew for it.
#include "render/texels.h"
#include "viewer/scene_subject.h"

#include <algorithm>

namespace spectrad::view {

namespace {

Vec3 vertexAt(const World& world, const std::vector<Affine>& toWorld, std::uint32_t vertex) {
    const float* p = world.position.data() + size_t{3} * vertex;
    return toWorld[world.vertexDraw[vertex]].point({p[0], p[1], p[2]});
}

bool isPicture(const std::optional<TextureUse>& use) {
    return use && use->mapping == TextureMapping::picture;
}

/// Planar mirrors, which show a picture of this picture's shape.
bool hasMirror(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        return (m.gloss && isPicture(m.gloss->reflects)) || (m.specular && isPicture(m.specular->reflects)) ||
               (m.conductor && isPicture(m.conductor->reflects));
    });
}

}  // namespace

bool SceneSubject::followsCamera() const {
    for (const FlatScene::Object& object : flat_.objects)
        for (const ShapeUse& use : object.node->shapes)
            if (use.shape.kind != ShapeKind::box && use.shape.kind != ShapeKind::plane) return true;
    return hasMirror(scene_) || (scene_.background && isPicture(scene_.background->texture));
}

void SceneSubject::stand(const Stand& stand) {
    stand_.samples = stand.samples;
    const bool sized = stand.width != view_.width || stand.height != view_.height;
    if (!sized && same(stand.pose, stand_.pose)) return;
    stand_ = stand;
    const Pose& pose = stand.pose;
    view_.worldToCamera =
        same(pose, home_) ? homeView_ : inverse(Affine::lookAt(pose.eye, pose.target, pose.up));
    view_.width = stand.width;
    view_.height = stand.height;
    view_.orthographic = pose.orthographic;
    view_.pixelsPerSlope = pose.pixelsPerSlopeOverHeight * view_.height;
    stale_ = follows_;
    live_->move(view_, scene_, flat_);
}

void SceneSubject::measureBounds() {
    const World& world = live_->plan().world;
    constexpr double huge = 1e300;
    Vec3 low{huge, huge, huge}, high{-huge, -huge, -huge};
    for (std::uint32_t v = 0; v < world.vertexDraw.size(); ++v) {
        const Vec3 p = vertexAt(world, live_->drawToWorld(), v);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (low.x > high.x)
        bounds_ = {{0, 0, 0}, 1};
    else
        bounds_ = {(low + high) * 0.5, std::max(0.5 * length(high - low), 1e-9)};
}

std::optional<Hit> SceneSubject::hitAt(int x, int y) {
    resolve();
    const std::optional<std::uint32_t> triangle = live_->triangleAt(x, y);
    if (!triangle) return std::nullopt;
    const World& world = live_->plan().world;
    std::array<Vec3, 3> corner;
    for (size_t i = 0; i < 3; ++i)
        corner[i] = view_.worldToCamera.point(
            vertexAt(world, live_->drawToWorld(), world.index[size_t{3} * *triangle + i]));
    // The ray through the pixel's centre meets the triangle's plane.
    const double sx = (x + 0.5 - view_.width * 0.5) / view_.pixelsPerSlope,
                 sy = (view_.height * 0.5 - y - 0.5) / view_.pixelsPerSlope;
    const Vec3 from = view_.orthographic ? Vec3{sx, sy, 0} : Vec3{0, 0, 0};
    const Vec3 along = view_.orthographic ? Vec3{0, 0, -1} : Vec3{sx, sy, -1};
    const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double facing = dot(normal, along);
    Hit hit;
    const Vec3 place = facing != 0 ? from + along * (dot(normal, corner[0] - from) / facing) : corner[0];
    hit.place = inverse(view_.worldToCamera).point(place);

    // Draws stand in the order in which addGeometry meets shapes and meshes.
    const std::uint32_t wanted = world.vertexDraw[world.index[size_t{3} * *triangle]];
    std::uint32_t draw = 0;
    for (const FlatScene::Object& object : flat_.objects) {
        const auto meet = [&](Index material, bool empty) {
            if (empty) return;
            if (draw++ != wanted) return;
            hit.node = object.node->name;
            hit.materialIndex = material;
            hit.material = scene_.materials[material].name;
        };
        for (const ShapeUse& use : object.node->shapes)
            meet(use.material, false);
        for (const MeshUse& use : object.node->meshes)
            meet(use.material, use.mesh->index.empty());
    }
    return hit;
}

std::optional<SceneSubject::Moved> SceneSubject::moved(const Pose& pose) const {
    if (same(pose, home_)) return std::nullopt;
    const Affine toNode = inverse(cameraNode_);
    return Moved{
        camera_, toNode.point(pose.eye), toNode.point(pose.target), normalized(toNode.direction(pose.up)),
        scene_.cameras[camera_].viewHeight * home_.pixelsPerSlopeOverHeight / pose.pixelsPerSlopeOverHeight};
}

void SceneSubject::placeCamera(Scene& scene, const Stand& stand) const {
    if (hasMirror(scene_)) {
        scene.cameras[camera_].width = stand.width;
        scene.cameras[camera_].height = stand.height;
    }
    const auto now = moved(stand.pose);
    if (!now) return;
    scene.cameras[now->camera].toNode = Affine::lookAt(now->eye, now->target, now->up);
    scene.cameras[now->camera].viewHeight = now->viewHeight;
}

Scene SceneSubject::changed(const Look& look, const Stand& stand) const {
    Scene scene = sceneOf(look);
    placeCamera(scene, stand);
    return scene;
}

void SceneSubject::follow() {
    if (!stale_ || samples() < finalSamples_) return;
    Scene moved = scene_;
    placeCamera(moved, stand_);
    RenderSettings settings = settings_;
    settings.size = {view_.width, view_.height};
    settings.stop = stop();
    Notes unsaid;
    PassTextures passes(moved, library_, device_, settings, unsaid);
    Plan made = makePlan(moved, settings, library_, passes, unsaid);
    fetchTexels(made.world);
    live_ = std::make_unique<LiveImage>(device_, std::move(made));
    tables_.clear();
    live_->move(view_, scene_, flat_);
    stale_ = false;
}

}  // namespace spectrad::view
