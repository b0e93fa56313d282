// Foreign models as scenes of their own: the camera and the lamp that a file without them gets.
#include "scene/graft.h"
#include "scene/reading.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace spectrad {

namespace {

struct Box {
    static constexpr double far = std::numeric_limits<double>::infinity();
    Vec3 low{far, far, far}, high{-far, -far, -far};

    void add(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    void add(const Box& box, const Affine& transform) {
        if (box.empty()) return;
        for (int i = 0; i < 8; ++i)
            add(transform.point(box.corner(i)));
    }
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    [[nodiscard]] Vec3 corner(int i) const {
        return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    }
};

Box boxOf(const Mesh& mesh) {
    Box box;
    for (const std::uint32_t i : mesh.index) {
        const auto& p = mesh.position[i];
        box.add(mesh.origin + Vec3{p[0], p[1], p[2]});
    }
    return box;
}

/// World box around the meshes' own boxes: never too small, and exact where things stand upright. A mesh is
/// measured once however often it is shown.
Box boxOf(const Scene& scene) {
    Box box;
    std::unordered_map<const Mesh*, Box> known;
    for (const FlatScene::Object& object : flatten(scene).objects) {
        for (const MeshUse& use : object.node->meshes) {
            const auto [entry, isNew] = known.try_emplace(use.mesh.get());
            if (isNew) entry->second = boxOf(*use.mesh);
            box.add(entry->second, object.toWorld);
        }
        for (const ShapeUse& use : object.node->shapes) {
            const double r = boundingRadius(use.shape);
            box.add(Box{{-r, -r, -r}, {r, r, r}}, object.toWorld);
        }
    }
    return box;
}

/// Where the first camera looks, in the world.
Vec3 firstView(const Scene& scene) {
    const std::vector<Placed> cameras = flatten(scene).cameras;
    if (cameras.empty()) return {0, 0, -1};
    const Affine toWorld = cameras.front().toWorld * scene.cameras[cameras.front().index].toNode;
    return normalized(toWorld.direction({0, 0, -1}));
}

Light headlight(const Scene& scene, const SpectrumResolver& resolver) {
    Light light;
    light.name = "daylight";
    light.type = LightType::directional;
    light.emitter.spectrum = resolver.resolve("illuminants/D65", Role::light, {});
    light.emitter.amount = Amount{AmountUnit::lux, 1000, std::nullopt};
    light.direction = firstView(scene);
    return light;
}

}  // namespace

Camera framingCamera(const Scene& scene) {
    constexpr double elevation = 15;  // degrees above the horizon
    constexpr double margin = 0.05;   // of the picture, on each side

    Box box = boxOf(scene);
    if (box.empty()) box = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
    const Vec3 centre = box.low * 0.5 + box.high * 0.5;

    Camera camera;
    camera.name = "camera";
    const double up = elevation * std::numbers::pi / 180;
    const Vec3 back{0, std::sin(up), std::cos(up)};
    const Affine turn = Affine::lookAt({}, back * -1, {0, 1, 0});
    const Affine toView = inverse(turn);
    const double tanY = (1 - 2 * margin) * std::tan(camera.fovDegrees / 2 * std::numbers::pi / 180);
    const double tanX = tanY * camera.width / camera.height;
    // The nearest place from which every corner of the box is within the picture's margins.
    double distance = 0;
    for (int i = 0; i < 8; ++i) {
        const Vec3 p = toView.direction(box.corner(i) - centre);
        distance = std::max(distance, p.z + std::max(std::abs(p.x) / tanX, std::abs(p.y) / tanY));
    }
    if (!(distance > 0)) distance = 1;  // all in one point
    camera.toNode = Affine::translation(centre + back * distance) * turn;
    return camera;
}

Scene sceneFromModel(const std::filesystem::path& path, const SpectrumResolver& resolver, bool restricted,
                     Notes& notes) {
    const ImportedScene model = importModel(path, restricted);
    Scene scene = emptyScene();
    scene.file = path.string();
    scene.filesRead = model.filesRead;
    scene.wavelengths = regularWavelengths(380, 780, 5, {});
    graft(scene, 0, model, GraftOptions{}, resolver, notes);
    if (scene.cameras.empty()) {
        scene.cameras.push_back(framingCamera(scene));
        scene.nodes[0].cameras.push_back(0);
        notes.say(path.string() + ": no camera in it: framed from the front, a little above");
    }
    if (scene.lights.empty()) {
        scene.lights.push_back(headlight(scene, resolver));
        scene.nodes[0].lights.push_back(0);
        notes.say(path.string() + ": no light in it: illuminants/D65 from behind the camera, 1000 lx");
    }
    return scene;
}

}  // namespace spectrad
