#include "render/plan.h"

#include "base/text.h"
#include "colour/detector.h"
#include "render/range_check.h"
#include "render/samples.h"
#include "spectrum/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace spectrad {

namespace {

constexpr int maxSide = 65536;  ///< pixels

/// What is rendered: a camera, and a pass if one was asked for or stands in the scene.
struct Choice {
    const Camera* camera = nullptr;
    Index cameraIndex = 0;
    const Pass* pass = nullptr;
};

template <typename Named>
std::vector<std::string> namesOf(const std::vector<Named>& items) {
    std::vector<std::string> names;
    for (const Named& item : items)
        names.push_back(item.name);
    return names;
}

template <typename Named>
const Named& byName(const std::vector<Named>& items, const std::string& name, const char* kind) {
    for (const Named& item : items)
        if (item.name == name) return item;
    const auto names = namesOf(items);
    std::string known;
    for (const std::string& n : names)
        known += (known.empty() ? "" : ", ") + n;
    throw InputError(fmt::format("the scene has no {} '{}'{}{}", kind, name, didYouMean(name, names),
                                 known.empty() ? "" : " (there is: " + known + ")"));
}

Choice choose(const Scene& scene, const RenderSettings& settings) {
    Choice choice;
    if (!settings.pass.empty()) {
        choice.pass = &byName(scene.passes, settings.pass, "pass");
    } else if (settings.camera.empty() && !scene.passes.empty()) {
        choice.pass = &scene.passes.back();
        for (const Pass& pass : scene.passes)
            if (pass.name == "main") choice.pass = &pass;
    }
    if (!settings.camera.empty()) {
        choice.camera = &byName(scene.cameras, settings.camera, "camera");
    } else if (choice.pass) {
        choice.camera = &scene.cameras.at(choice.pass->camera);
    } else if (!scene.cameras.empty()) {
        choice.camera = &scene.cameras.front();
    } else {
        throw InputError(scene.file + ": the scene has no camera");
    }
    choice.cameraIndex = static_cast<Index>(choice.camera - scene.cameras.data());
    return choice;
}

Affine placeOf(const Scene& scene, const FlatScene& flat, Index camera) {
    for (const Placed& placed : flat.cameras)
        if (placed.index == camera) return placed.toWorld;
    // A pass of a subtree may look with a camera outside it.
    for (const Placed& placed : flatten(scene).cameras)
        if (placed.index == camera) return placed.toWorld;
    throw InputError(scene.cameras[camera].where,
                     "camera '" + scene.cameras[camera].name + "' stands in no node of the scene");
}

void checkSize(int width, int height) {
    if (width < 1 || height < 1 || width > maxSide || height > maxSide)
        throw InputError(
            fmt::format("an image of {}x{} pixels is not possible (1…{} on a side)", width, height, maxSide));
}

std::vector<const Material*> materialsWorn(const Scene& scene, const FlatScene& flat,
                                           std::vector<std::uint32_t>& number) {
    std::vector<bool> worn(scene.materials.size(), false);
    for (const FlatScene::Object& object : flat.objects) {
        for (const ShapeUse& use : object.node->shapes)
            worn[use.material] = true;
        for (const MeshUse& use : object.node->meshes)
            worn[use.material] = true;
    }
    std::vector<const Material*> materials;
    number.assign(scene.materials.size(), 0);
    for (size_t m = 0; m < worn.size(); ++m) {
        if (!worn[m]) continue;
        materials.push_back(&scene.materials[m]);
        number[m] = static_cast<std::uint32_t>(materials.size());  // 0 is the background
    }
    return materials;
}

Material substituted(const Material& material, Substitute substitute) {
    Material worn = material;
    if (substitute == Substitute::none) return worn;
    worn.emission.reset();
    if (substitute == Substitute::whiteDiffuser) {
        worn = {};
        worn.name = material.name;
        worn.where = material.where;
        worn.diffuse.emplace();
        worn.diffuse->reflectance.emplace();
        worn.diffuse->reflectance->curves = {Curve::constant(1)};
    } else if (substitute == Substitute::coverage) {
        worn = {};
        worn.name = material.name;
        worn.emission.emplace();
        worn.emission->spectrum.curves = {Curve::constant(1)};
    } else if (!worn.fluorescence.empty()) {
        throw InputError(material.where, "material '" + material.name +
                                             "' is fluorescent: what it sends out depends on the lamp, so no "
                                             "reflectance can carry it (as=\"radiance\" can)");
    }
    return worn;
}

std::vector<std::string> featuresOf(const std::vector<const Material*>& materials, const World& world,
                                    bool background) {
    std::set<std::string> features;
    for (const Material* m : materials) {
        if (m->diffuse) features.insert("diffuse");
        if (m->gloss) features.insert("gloss");
        if (m->emission) features.insert("emission");
        if (m->diffuse && m->diffuse->texture) features.insert("texture");
        if (m->specular) features.insert("specular");
        if (m->conductor) features.insert("conductor");
        if (!m->fluorescence.empty()) features.insert("fluorescence");
        if (m->diffuse && m->diffuse->roughnessDegrees > 0) features.insert("diffuse roughness");
    }
    for (const sd_light& light : world.lights) {
        static constexpr std::array<const char*, 6> names{"",        "point",     "spot", "directional",
                                                          "ambient", "background"};
        features.insert(names[static_cast<size_t>(light.type)]);
    }
    if (background) features.insert("background");
    return {features.begin(), features.end()};
}

/// Kernel switches, from what the world really holds: a feature that it lacks costs no instruction.
std::vector<std::string> definesOf(const World& world, int samples) {
    std::set<std::string> defines{fmt::format("SLOTS={}", lanePattern(samples, 1).slots)};
    for (const sd_light& light : world.lights) {
        static constexpr std::array<const char*, 6> switches{
            "", "HAS_POINT", "HAS_SPOT", "HAS_DIRECTIONAL", "HAS_UNIFORM", "HAS_UNIFORM"};
        defines.insert(switches[static_cast<size_t>(light.type)]);
    }
    for (const sd_lobe& lobe : world.lobes) {
        if (lobe.type == SD_LOBE_ROUGH) defines.insert("HAS_ROUGH");
        if (lobe.type == SD_LOBE_COATED) defines.insert("HAS_COATED");
        if (lobe.type == SD_LOBE_FACETS) defines.insert("HAS_FACETS");
    }
    if (!world.textures.empty()) defines.insert("HAS_TEXTURE");
    return {defines.begin(), defines.end()};
}

}  // namespace

Plan makePlan(const Scene& scene, const RenderSettings& settings, const Library& library, Notes& notes) {
    TextureLoader textures(scene, library, notes);
    return makePlan(scene, settings, library, textures, notes);
}

Plan makePlan(const Scene& scene, const RenderSettings& settings, const Library& library,
              TextureLoader& textures, Notes& notes) {
    const Choice choice = choose(scene, settings);
    Plan plan;
    plan.as = choice.pass ? choice.pass->as : PassKind::radiance;
    plan.cameraName = choice.camera->name;
    plan.passName = choice.pass ? choice.pass->name : "";
    plan.stripBytes = settings.stripBytes;

    plan.wavelengths = settings.wavelengths                      ? *settings.wavelengths
                       : choice.pass && choice.pass->wavelengths ? *choice.pass->wavelengths
                                                                 : scene.wavelengths;
    if (settings.projection) plan.wavelengths.projection = *settings.projection;
    plan.samples = settings.samples                      ? *settings.samples
                   : choice.pass && choice.pass->samples ? *choice.pass->samples
                                                         : 16;
    if (plan.samples < 1 || plan.samples > maxSamples)
        throw InputError(
            fmt::format("{} samples per pixel are not possible (1…{})", plan.samples, maxSamples));
    std::pair<int, int> size{choice.camera->width, choice.camera->height};
    if (choice.pass && choice.pass->size) size = *choice.pass->size;
    if (settings.size) size = *settings.size;
    checkSize(size.first, size.second);

    const FlatScene flat = flatten(scene, choice.pass ? choice.pass->of : std::nullopt);
    plan.view = makeView(*choice.camera, placeOf(scene, flat, choice.cameraIndex), size.first, size.second);

    const Detector observer = standardObserver(library);
    std::vector<LightGroup> groups = groupLights(scene, flat, plan.view, observer, plan.world.lights,
                                                 settings.substitute != Substitute::none);
    if (settings.substitute == Substitute::none) checkRange(plan.wavelengths, groups, observer, notes);

    std::vector<std::uint32_t> number;
    const std::vector<const Material*> materials = materialsWorn(scene, flat, number);
    noteExtensions(plan.wavelengths, materials, notes);
    if (!groups.empty()) {
        plan.whiteName = groups.front().text;
        const std::array<const Curve*, 1> light{&groups.front().spectrum};
        plan.white = respondXyz(observer, light);
    }
    if (!(plan.white[1] > 0)) {
        plan.whiteName = "E";
        plan.white = {1, 1, 1};
    }
    const double y = plan.white[1];
    for (double& value : plan.white)
        value /= y;

    plan.groups = static_cast<std::uint32_t>(groups.size());
    TermBuilder builder(plan.wavelengths, observer, std::move(groups), settings.only, textures, plan.world,
                        plan.terms, notes);
    const bool asGiven = settings.substitute == Substitute::none;
    const Emitter* background = asGiven && scene.background ? &*scene.background : nullptr;
    builder.addBackground(background, background ? absoluteFactor(*background, observer) : 0);
    for (const Material* material : materials) {
        const Material worn = substituted(*material, settings.substitute);
        builder.add(worn, worn.emission ? absoluteFactor(*worn.emission, observer) : 0);
    }
    addGeometry(plan.world, flat, plan.view, number);

    plan.features = featuresOf(materials, plan.world, background != nullptr);
    plan.defines = definesOf(plan.world, plan.samples);
    return plan;
}

}  // namespace spectrad
