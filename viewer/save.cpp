#include "viewer/save.h"

#include "base/files.h"
#include "base/stopped.h"
#include "base/text.h"
#include "render/cube_info.h"
#include "render/renderer.h"
#include "scene/amounts.h"
#include "scene/scene_text.h"

#include <fmt/format.h>

namespace spectrad::view {

namespace fs = std::filesystem;

namespace {

constexpr int digits = 12;  // of what was turned and moved by hand

/// In the scene's unit.
std::string written(Vec3 v, double unit) {
    return fmt::format("{} {} {}", rounded(v.x / unit, digits), rounded(v.y / unit, digits),
                       rounded(v.z / unit, digits));
}

void requireOurs(const SceneSubject& subject, const SourceLocation& where, const std::string& what) {
    if (where.file != subject.scene().file)
        throw InputError(where, what + " stands in another file than '" + subject.scene().file +
                                    "': its change cannot be saved there");
}

void writeLight(const SceneSubject& subject, size_t number, const LightSetting& now, SceneText& text) {
    const Light& light = subject.scene().lights[number];
    const bool otherSpectrum = now.emitter.spectrum.text != light.emitter.spectrum.text;
    const double times = now.on ? now.times : 0;
    if (!otherSpectrum && times == 1) return;
    requireOurs(subject, light.where, "light '" + now.name + "'");
    if (otherSpectrum) text.set(light.where, "", "spectrum", now.emitter.spectrum.text);
    for (const std::string_view name : amountAttributes()) {
        const std::string attribute(name), stated = text.get(light.where, attribute);
        if (stated.empty()) continue;
        // "800 cd over 400:700": the number alone changes.
        const size_t from = stated.find_first_not_of(" \t\n\r"), to = stated.find_first_of(" \t\n\r", from);
        if (times != 1 && light.emitter.amount)
            text.set(light.where, "", attribute,
                     rounded(light.emitter.amount->value * times, digits) +
                         (to == std::string::npos ? std::string() : stated.substr(to)));
        return;
    }
    text.set(light.where, "", "scale", rounded(light.emitter.scale * times, digits));
}

void writeCamera(const SceneSubject& subject, const SceneSubject::Moved& now, SceneText& text) {
    const Scene& scene = subject.scene();
    const Camera& camera = scene.cameras[now.camera];
    const double unit = scene.metresPerUnit;
    if (camera.where.line == 0) {  // it framed the scene, which has none
        text.append(fmt::format(R"(<camera fov="{}" look-from="{}" look-at="{}" up="{}" size="{}x{}"/>)",
                                rounded(camera.fovDegrees, digits), written(now.eye, unit),
                                written(now.target, unit), written(now.up, 1), camera.width, camera.height));
        return;
    }
    requireOurs(subject, camera.where, "camera '" + camera.name + "'");
    text.set(camera.where, "", "look-from", written(now.eye, unit));
    text.set(camera.where, "", "look-at", written(now.target, unit));
    text.set(camera.where, "", "up", written(now.up, 1));
    if (camera.orthographic && now.viewHeight != camera.viewHeight)
        text.set(camera.where, "", "height", rounded(now.viewHeight / unit, digits));
}

}  // namespace

std::string sceneText(const SceneSubject& subject, const Look& look, const Pose& pose) {
    const Scene& scene = subject.scene();
    SceneText text(readFile(scene.file), scene.file);
    text.apply(subject.loadOptions().set);
    for (size_t i = 0; i < look.lights.size() && i < scene.lights.size(); ++i)
        writeLight(subject, i, look.lights[i], text);
    for (const auto& [number, reflectance] : look.reflectances) {
        const Material& material = scene.materials.at(number);
        if (material.diffuse && material.diffuse->reflectance &&
            material.diffuse->reflectance->text == reflectance.text)
            continue;
        requireOurs(subject, material.where, "material '" + material.name + "'");
        text.set(material.where, "diffuse", "reflectance", reflectance.text);
    }
    if (const auto moved = subject.moved(pose)) writeCamera(subject, *moved, text);
    return text.text();
}

void saveScene(const SceneSubject& subject, const Look& look, const Pose& pose, const fs::path& target) {
    if (target.extension() != ".xml")
        throw UsageError("'" + target.string() + "' must end in .xml to be a scene");
    const Scene& scene = subject.scene();
    const auto folder = [](const fs::path& file) {
        return fs::absolute(file).lexically_normal().parent_path();
    };
    if (folder(target) != folder(scene.file))
        throw UsageError("'" + target.string() +
                         "' must lie beside the scene, from where the names of its files count");
    writeFile(target, sceneText(subject, look, pose));
}

CubeOrder cubeOrder(const SceneSubject& subject, const Look& look, const Stand& stand, const fs::path& target,
                    const std::string& software) {
    if (target.extension() != ".exr" && target.extension() != ".img")
        throw UsageError("'" + target.string() + "' must end in .exr or .img to be a cube");
    CubeOrder order{subject.changed(look, stand), subject.settings(), subject.device().withOwnQueue(), target,
                    software};
    order.settings.lightsApart = false;
    order.settings.size = {stand.width, stand.height};
    order.settings.samples = subject.finalSamples();
    return order;
}

void writeCube(const CubeOrder& order, const Library& library, const Progress& progress,
               const std::stop_token& stop) {
    Notes unsaid;  // what there is to say was said when the scene was opened
    RenderSettings settings = order.settings;
    settings.stop = stop;
    PassTextures passes(order.scene, library, order.device, settings, unsaid);
    const Plan plan = makePlan(order.scene, settings, library, passes, unsaid);
    const CubeInfo info = cubeInfoOf(order.scene, plan, order.device, order.software,
                                     "spectrad view " + order.scene.file + " (as changed there)");
    const auto writer =
        order.target.extension() == ".img"
            ? createEnvi(order.target, info)
            : createExr(order.target, info, {chooseCompression(info, {}, false, unsaid), false});
    Renderer renderer(order.device, plan);
    renderer.render(
        [&](int, int rows, const float* bands, const float* preview) {
            throwIfStopped(stop);
            writer->write(rows, bands, preview);
        },
        progress);
    throwIfStopped(stop);
    (void)writer->finish();
}

}  // namespace spectrad::view
