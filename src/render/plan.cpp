#include "render/plan.h"

#include "base/text.h"
#include "colour/observe.h"
#include "render/casters.h"
#include "render/emitter_colour.h"
#include "render/range_check.h"
#include "render/samples.h"
#include "render/texels.h"
#include "scene/pass_needs.h"
#include "spectrum/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace spectrad {

namespace {

constexpr int maxSide = 65536;  ///< pixels

template <typename Named>
std::vector<std::string> namesOf(const std::vector<Named>& items) {
    std::vector<std::string> names;
    for (const Named& item : items)
        if (!item.name.empty()) names.push_back(item.name);
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
        if (!object.drawn) continue;
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

bool isEqualEnergy(Substitute substitute) {
    return substitute != Substitute::none && substitute != Substitute::irradiance;
}

Material substituted(const Material& material, Substitute substitute) {
    Material worn = material;
    if (substitute == Substitute::none) return worn;
    worn.emission.reset();
    // A mirror's image is light of its own, no reflectance.
    if (worn.gloss) worn.gloss->reflects.reset();
    if (worn.specular) worn.specular->reflects.reset();
    if (worn.conductor) worn.conductor->reflects.reset();
    if (substitute == Substitute::whiteDiffuser || substitute == Substitute::irradiance) {
        worn = {};
        worn.name = material.name;
        worn.where = material.where;
        worn.relief = material.relief;  // light that a bent normal takes is no property of the paint
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
        if (reflectionOf(*m)) features.insert("reflects");
        if (m->diffuse) features.insert("diffuse");
        if (m->gloss) features.insert("gloss");
        if (m->emission) features.insert("emission");
        if (!texturesOf(*m).empty()) features.insert("texture");
        if (m->diffuse && m->diffuse->select) features.insert("select");
        if (m->relief) features.insert(m->relief->heights ? "bump" : "normal");
        for (const Fluorescence& part : m->fluorescence)
            if (part.mask) features.insert("mask");
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
    if (throwShadows(world.lights)) features.insert("shadows");
    if (background) features.insert("background");
    return {features.begin(), features.end()};
}

std::string slotsDefine(int samples) {
    return fmt::format("SLOTS={}", lanePattern(samples, 1).slots);
}

/// Kernel switches, from what the world really holds: a feature that it lacks costs no instruction.
std::vector<std::string> definesOf(const World& world, int samples, bool baked) {
    std::set<std::string> defines{slotsDefine(samples)};
    for (const sd_light& light : world.lights) {
        static constexpr std::array<const char*, 6> switches{
            "", "HAS_POINT", "HAS_SPOT", "HAS_DIRECTIONAL", "HAS_UNIFORM", "HAS_UNIFORM"};
        defines.insert(switches[static_cast<size_t>(light.type)]);
    }
    if (throwShadows(world.lights)) {
        defines.insert("HAS_SHADOWS");
        defines.insert(fmt::format("SHADOW_WORDS={}", (world.lights.size() + 31) / 32));
    }
    for (const sd_lobe& lobe : world.lobes) {
        if (lobe.type == SD_LOBE_ROUGH || lobe.type == SD_LOBE_ROUGH_COATED) defines.insert("HAS_ROUGH");
        if (lobe.type == SD_LOBE_ROUGH_COATED) defines.insert("HAS_ROUGH_COATED");
        if (lobe.type == SD_LOBE_COATED) defines.insert("HAS_COATED");
        if (lobe.type == SD_LOBE_FACETS) defines.insert("HAS_FACETS");
        if (lobe.alpha_v != 0) defines.insert("HAS_ANISOTROPY");
    }
    for (const std::string& define : textureDefines(world))
        defines.insert(define);
    for (const sd_lobe& lobe : world.lobes)
        if (lobe.mapping != SD_MAP_SURFACE) defines.insert("HAS_MAPPING");
    if (baked) defines.insert("BAKE");
    return {defines.begin(), defines.end()};
}

}  // namespace

Plan withSamples(Plan plan, int samples) {
    plan.samples = samples;
    for (std::string& define : plan.defines)
        if (define.starts_with("SLOTS=")) define = slotsDefine(samples);
    return plan;
}

Shot shotOf(const Scene& scene, const Pass& pass) {
    Shot shot;
    shot.pass = &pass;
    shot.scene = pass.scene ? pass.scene.get() : &scene;
    if (pass.scene)
        shot.number = pass.base;
    else
        shot.number = static_cast<Index>(&pass - scene.passes.data());
    shot.camera = pass.camera;
    if (shot.camera >= shot.scene->cameras.size())
        throw InputError(pass.where, shot.scene->file + ": the scene has no camera");
    return shot;
}

Shot chooseShot(const Scene& scene, const RenderSettings& settings) {
    const Pass* pass = nullptr;
    if (!settings.pass.empty()) {
        pass = &byName(scene.passes, settings.pass, "pass");
    } else if (settings.camera.empty() && !settings.bake && !scene.passes.empty()) {
        pass = &scene.passes.back();
        for (const Pass& each : scene.passes)
            if (each.name == "main") pass = &each;
    }
    Shot shot{&scene, nullptr, std::nullopt, 0};
    if (pass) shot = shotOf(scene, *pass);
    if (!settings.camera.empty())
        shot.camera = static_cast<Index>(&byName(shot.scene->cameras, settings.camera, "camera") -
                                         shot.scene->cameras.data());
    if (shot.scene->cameras.empty()) throw InputError(scene.file + ": the scene has no camera");
    return shot;
}

Wavelengths gridOf(const Shot& shot, const RenderSettings& settings) {
    Wavelengths grid = settings.wavelengths                  ? *settings.wavelengths
                       : shot.pass && shot.pass->wavelengths ? *shot.pass->wavelengths
                                                             : shot.scene->wavelengths;
    if (settings.projection) grid.projection = *settings.projection;
    return grid;
}

std::pair<int, int> sizeOf(const Shot& shot, const RenderSettings& settings) {
    const Camera& camera = shot.scene->cameras.at(shot.camera);
    if (settings.size) return *settings.size;
    return shot.pass && shot.pass->size ? *shot.pass->size : std::pair{camera.width, camera.height};
}

Plan makePlan(const Scene& scene, const RenderSettings& settings, const Library& library, Notes& notes) {
    const Shot shot = chooseShot(scene, settings);
    TextureLoader textures(*shot.scene, library, notes);
    return makePlan(shot, settings, library, textures, notes);
}

Plan makePlan(const Scene& scene, const RenderSettings& settings, const Library& library,
              TextureLoader& textures, Notes& notes) {
    return makePlan(chooseShot(scene, settings), settings, library, textures, notes);
}

namespace {

/// The camera's view; for a mirror the view of its mirror image.
View viewOf(const Shot& shot, const RenderSettings& settings, const FlatScene& flat,
            std::pair<int, int> size) {
    const Scene& scene = *shot.scene;
    const Camera& camera = scene.cameras[shot.camera];
    const Affine place = placeOf(scene, flat, shot.camera);
    View view = camera.cube ? makeCubeView(camera, place, settings.cubeFace, size.first)
                            : makeView(camera, place, size.first, size.second);
    if (settings.bake) {
        view.baked = true;
        view.width = size.first;
        view.height = size.second;
    }
    if (!shot.pass || !shot.pass->mirror) return view;
    view.before =
        mirrorPlane(placeOf(scene, *shot.pass->mirror), inverse(view.worldToCamera).point({0, 0, 0}));
    if (!view.before)
        throw InputError(shot.pass->where, "pass '" + shot.pass->name +
                                               "': the camera lies in the plane of the mirror '" +
                                               scene.nodes[*shot.pass->mirror].name + "'");
    view.worldToCamera = view.worldToCamera * reflection(*view.before);
    return view;
}

/// The surfaces of a node, where they stand; after them those of all others, for their shadows.
std::vector<FlatScene::Object> objectsToBake(const Scene& scene, const Bake& bake) {
    const Node& node = byName(scene.nodes, bake.node, "node");
    auto objects = flatten(scene, static_cast<Index>(&node - scene.nodes.data())).objects;
    if (objects.empty()) throw InputError(node.where, "node '" + bake.node + "' has no surface to bake");
    const auto same = [](const FlatScene::Object& a, const FlatScene::Object& b) {
        return a.node == b.node && a.toWorld.m == b.toWorld.m;
    };
    const size_t baked = objects.size();
    for (FlatScene::Object object : flatten(scene).objects) {
        const auto end = objects.begin() + static_cast<std::ptrdiff_t>(baked);
        const auto found =
            std::find_if(objects.begin(), end, [&](const auto& own) { return same(own, object); });
        if (found != end) {
            found->throwsShadows = object.throwsShadows;
            continue;
        }
        object.drawn = false;
        objects.push_back(object);
    }
    return objects;
}

/// `seen`: a light's X, Y, Z.
void setWhites(Plan& plan, const std::vector<LightGroup>& groups,
               const std::function<Triple(const Curve&)>& seen) {
    plan.whiteName = plan.labWhiteName = "E";
    plan.white = plan.labWhite = {1, 1, 1};
    for (const LightGroup& group : groups) {
        Triple xyz = seen(group.spectrum);
        const double y = xyz[1];
        const bool first = &group == &groups.front();
        if (!(y > 0)) continue;
        for (double& value : xyz)
            value /= y;
        if (first) {
            plan.whiteName = group.text;
            plan.white = xyz;
        }
        constexpr double least = 1e-3;
        if (xyz[0] < least || xyz[2] < least) continue;
        plan.labWhiteName = group.text;
        plan.labWhite = xyz;
        return;
    }
}

}  // namespace

Plan makePlan(const Shot& shot, const RenderSettings& settings, const Library& library,
              TextureLoader& textures, Notes& notes) {
    const Scene& scene = *shot.scene;
    const Camera& camera = scene.cameras.at(shot.camera);
    Plan plan;
    plan.as = settings.bake ? settings.bake->as : shot.pass ? shot.pass->as : PassKind::radiance;
    plan.cameraName = camera.name;
    plan.passName = shot.pass ? shot.pass->name : "";
    plan.stripBytes = settings.stripBytes;

    plan.wavelengths = gridOf(shot, settings);
    plan.samples = settings.samples                  ? *settings.samples
                   : shot.pass && shot.pass->samples ? *shot.pass->samples
                                                     : 16;
    if (plan.samples < 1 || plan.samples > maxSamples)
        throw InputError(
            fmt::format("{} samples per pixel are not possible (1…{})", plan.samples, maxSamples));
    const std::pair<int, int> size = sizeOf(shot, settings);
    checkSize(size.first, size.second);
    if (camera.cube && !settings.bake && size.first != size.second)
        throw InputError(camera.where, fmt::format("the faces of a cube camera are square, not {}x{} pixels",
                                                   size.first, size.second));

    FlatScene flat = shot.pass ? flatten(scene, *shot.pass) : flatten(scene);
    plan.view = viewOf(shot, settings, flat, size);
    plan.faces = camera.cube && !settings.bake ? 6 : 1;
    if (settings.bake) flat.objects = objectsToBake(scene, *settings.bake);

    const Detector observer = standardObserver(library);
    const auto resolved = [&](const Emitter& emitter) { return withMeanColour(emitter, textures); };
    std::vector<LightGroup> groups =
        groupLights(scene, flat, plan.view, observer, resolved, plan.world.lights,
                    isEqualEnergy(settings.substitute), settings.lightsApart);
    if (!isEqualEnergy(settings.substitute)) checkRange(plan.wavelengths, groups, observer, notes);

    std::vector<std::uint32_t> number;
    const std::vector<const Material*> materials = materialsWorn(scene, flat, number);
    noteExtensions(plan.wavelengths, materials, notes);
    setWhites(plan, groups, [&](const Curve& spectrum) {
        const std::array<const Curve*, 1> light{&spectrum};
        return settings.eye ? seenXyz(*settings.eye, light) : respondXyz(observer, light);
    });

    plan.groups = static_cast<std::uint32_t>(groups.size());
    const Eye standard = standardEye(library);
    TermBuilder builder(plan.wavelengths, settings.eye ? *settings.eye : standard, std::move(groups),
                        settings.only, textures, plan.world, plan.terms, notes, settings.exact);
    const bool asGiven = settings.substitute == Substitute::none;
    const Emitter* background = asGiven && !settings.bake && scene.background ? &*scene.background : nullptr;
    const TextureUse* backdrop = background ? backdropOf(scene, shot.pass) : nullptr;
    if (background && background->texture) background = nullptr;
    if (backdrop)
        builder.addBackdrop(*backdrop, scene.background->scale);
    else
        builder.addBackground(background, background ? absoluteFactor(*background, observer) : 0);
    for (const Material* material : materials) {
        const Material worn = substituted(*material, settings.substitute);
        builder.add(worn, worn.emission ? absoluteFactor(*worn.emission, observer) : 0);
    }
    builder.noteLost();
    if (settings.geometry) addGeometry(plan.world, flat, plan.view, number);

    plan.features = featuresOf(materials, plan.world, background || backdrop);
    plan.defines = definesOf(plan.world, plan.samples, plan.view.baked);
    return plan;
}

}  // namespace spectrad
