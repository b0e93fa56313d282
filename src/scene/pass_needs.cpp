#include "scene/pass_needs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace spectrad {

std::vector<const TextureUse*> texturesOf(const Material& material) {
    std::vector<const TextureUse*> uses;
    if (material.diffuse && material.diffuse->texture) uses.push_back(&*material.diffuse->texture);
    if (material.emission && material.emission->texture) uses.push_back(&*material.emission->texture);
    if (const TextureUse* use = reflectionOf(material)) uses.push_back(use);
    return uses;
}

const TextureUse* reflectionOf(const Material& material) {
    if (material.gloss && material.gloss->reflects) return &*material.gloss->reflects;
    if (material.specular && material.specular->reflects) return &*material.specular->reflects;
    if (material.conductor && material.conductor->reflects) return &*material.conductor->reflects;
    return nullptr;
}

namespace {

bool usesPasses(const Scene& scene) {
    const auto shines = [](const Light& light) { return light.emitter.texture.has_value(); };
    if (scene.background && scene.background->texture) return true;
    if (std::any_of(scene.lights.begin(), scene.lights.end(), shines)) return true;
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
        const auto uses = texturesOf(material);
        return std::any_of(uses.begin(), uses.end(), [](const TextureUse* use) { return use->isPass(); });
    });
}

}  // namespace

std::vector<PassNeed> passesNeeded(const Scene& scene, const Pass* pass, bool baked) {
    std::vector<PassNeed> needs;
    const auto add = [&](const TextureUse& use) {
        if (!use.isPass()) return;
        const auto named = [&](const Pass& p) { return p.name == use.passName(); };
        const auto found = std::find_if(scene.passes.begin(), scene.passes.end(), named);
        if (found == scene.passes.end())
            throw InputError(use.where, "there is no pass '" + use.passName() + "'");
        const auto index = static_cast<Index>(found - scene.passes.begin());
        for (const PassNeed& need : needs)
            if (need.pass == index) return;
        needs.push_back({index, &use});
    };
    if (!usesPasses(scene)) return needs;
    const FlatScene flat = pass ? flatten(scene, *pass) : flatten(scene);
    std::vector<bool> seen(scene.materials.size(), false);
    const auto wear = [&](Index material) {
        if (seen[material]) return;
        seen[material] = true;
        for (const TextureUse* use : texturesOf(scene.materials[material]))
            add(*use);
    };
    if (const TextureUse* use = baked ? nullptr : backdropOf(scene, pass)) add(*use);
    for (const Placed& light : flat.lights)
        if (const auto& texture = scene.lights[light.index].emitter.texture) add(*texture);
    for (const FlatScene::Object& object : flat.objects) {
        for (const ShapeUse& use : object.node->shapes)
            wear(use.material);
        for (const MeshUse& use : object.node->meshes)
            wear(use.material);
    }
    return needs;
}

const TextureUse* backdropOf(const Scene& scene, const Pass* pass) {
    if (!scene.background || !scene.background->texture) return nullptr;
    const TextureUse& use = *scene.background->texture;
    const bool itself = pass && !pass->scene && use.isPass() && use.passName() == pass->name;
    return itself ? nullptr : &use;
}

void checkPasses(const Scene& scene) {
    enum class State { unseen, open, done };
    struct Frame {
        Index pass;
        std::vector<PassNeed> needs;
        size_t next = 0;
    };
    const auto needsOf = [&](Index pass) {
        // What a pass of another file needs was checked when that file was read.
        return scene.passes[pass].scene ? std::vector<PassNeed>{} : passesNeeded(scene, &scene.passes[pass]);
    };
    std::vector<State> state(scene.passes.size(), State::unseen);
    for (Index first = 0; first < scene.passes.size(); ++first) {
        if (state[first] != State::unseen) continue;
        std::vector<Frame> open{{first, needsOf(first)}};
        state[first] = State::open;
        while (!open.empty()) {
            Frame& frame = open.back();
            if (frame.next == frame.needs.size()) {
                state[frame.pass] = State::done;
                open.pop_back();
                continue;
            }
            const PassNeed need = frame.needs[frame.next++];
            // A mirror is cut off at its own plane: what it would show of itself is black.
            const Pass& needed = scene.passes[need.pass];
            if (need.pass == frame.pass && (needed.repeat > 0 || needed.mirror)) continue;
            if (state[need.pass] == State::open) {
                std::vector<std::string> chain;
                for (const Frame& f : open)
                    if (!chain.empty() || f.pass == need.pass) chain.push_back(scene.passes[f.pass].name);
                throw InputError(need.use->where,
                                 fmt::format("passes need each other: {} -> {}{}", fmt::join(chain, " -> "),
                                             scene.passes[need.pass].name,
                                             chain.size() == 1 ? " (repeat= lets a pass see itself)" : ""));
            }
            if (state[need.pass] == State::done) continue;
            state[need.pass] = State::open;
            open.push_back({need.pass, needsOf(need.pass)});
        }
    }
    for (Index i = 0; i < scene.passes.size(); ++i) {
        const Pass& pass = scene.passes[i];
        if (pass.repeat == 0 || pass.scene) continue;
        const auto needs = passesNeeded(scene, &pass);
        if (std::none_of(needs.begin(), needs.end(), [&](const PassNeed& n) { return n.pass == i; }))
            throw InputError(pass.where, fmt::format("pass '{}' repeats, but nothing that it shows is "
                                                     "textured with pass:{}",
                                                     pass.name, pass.name));
    }
}

}  // namespace spectrad
