#include "viewer/save.h"

#include "base/files.h"
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

std::string sceneText(const SceneSubject& subject, const Look& look) {
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
    if (const auto moved = subject.moved()) writeCamera(subject, *moved, text);
    return text.text();
}

void saveScene(const SceneSubject& subject, const Look& look, const fs::path& target) {
    if (target.extension() != ".xml")
        throw UsageError("'" + target.string() + "' must end in .xml to be a scene");
    const Scene& scene = subject.scene();
    const auto folder = [](const fs::path& file) {
        return fs::absolute(file).lexically_normal().parent_path();
    };
    if (folder(target) != folder(scene.file))
        throw UsageError("'" + target.string() +
                         "' must lie beside the scene, from where the names of its files count");
    writeFile(target, sceneText(subject, look));
}

void saveCube(const SceneSubject& subject, const Look& look, const fs::path& target, const Library& library,
              const std::string& software, Notes& notes) {
    if (target.extension() != ".exr" && target.extension() != ".img")
        throw UsageError("'" + target.string() + "' must end in .exr or .img to be a cube");
    const Scene scene = subject.changed(look);
    RenderSettings settings = subject.settings();
    settings.lightsApart = false;
    settings.size = {subject.width(), subject.height()};
    settings.samples = subject.finalSamples();
    PassTextures passes(scene, library, subject.device(), settings, notes);
    const Plan plan = makePlan(scene, settings, library, passes, notes);
    const CubeInfo info = cubeInfoOf(scene, plan, subject.device(), software,
                                     "spectrad view " + scene.file + " (as changed there)");
    const auto writer = target.extension() == ".img"
                            ? createEnvi(target, info)
                            : createExr(target, info, {chooseCompression(info, {}, false, notes), false});
    Renderer renderer(subject.device(), plan);
    renderer.render([&](int, int rows, const float* bands, const float* preview) {
        writer->write(rows, bands, preview);
    });
    (void)writer->finish();
}

}  // namespace spectrad::view
