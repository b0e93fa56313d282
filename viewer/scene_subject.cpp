#include "viewer/scene_subject.h"

#include "render/emitter_colour.h"
#include "render/texels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace spectrad::view {

namespace {

/// Up to so many lights have terms of their own, so that each can change without the others. Of more, those
/// do that were changed; the first change of one plans the materials anew.
constexpr size_t mostLightsApart = 16;

/// A light that is in no group but its own is called by its number, too.
constexpr char alone = '\x1f';

std::string plainName(const std::string& text) {
    return text.substr(0, text.find(alone));
}

}  // namespace

SceneSubject::SceneSubject(const std::filesystem::path& file, const LoadOptions& load,
                           const RenderSettings& settings, const Device& device, const Library& library,
                           Notes& notes)
    : library_(library),
      device_(device.withOwnQueue()),
      reader_(device.withOwnQueue()),
      load_(load),
      settings_(settings),
      scene_(loadScene(file, library, load, notes)) {
    const Shot shot = chooseShot(scene_, settings_);
    if (shot.scene != &scene_)
        throw InputError(shot.pass->where,
                         "pass '" + shot.pass->name + "' shows another file: open that one to view it");
    flat_ = shot.pass ? flatten(scene_, *shot.pass) : flatten(scene_);
    settings_.lightsApart = flat_.lights.size() <= mostLightsApart;
    PassTextures passes(scene_, library_, device_, settings_, notes);
    const std::vector<GraphNode>& graph = passes.graph();
    passes_ = graph.size() > 1;
    pictures_ = std::any_of(graph.begin(), graph.end() - 1, [](const GraphNode& node) {
        return !node.shot.pass || node.shot.pass->as != PassKind::reflectance;
    });
    Plan made = makePlan(scene_, settings_, library_, passes, notes);
    fetchTexels(made.world);
    if (made.as != PassKind::radiance)
        throw InputError("pass '" + made.passName + "' is no radiance: view shows what an eye sees");
    if (made.faces > 1)
        throw InputError("camera '" + made.cameraName +
                         "' looks all around: view needs one that looks ahead");
    if (shot.pass && (shot.pass->screen || shot.pass->mirror))
        throw InputError(shot.pass->where, "pass '" + shot.pass->name + "' is a picture on a " +
                                               (shot.pass->screen ? "display" : "mirror") +
                                               ": render it, and view the cube");
    camera_ = shot.camera;
    const FlatScene whole = flatten(scene_);
    for (const Placed& placed : whole.cameras)
        if (placed.index == camera_) {
            cameraNode_ = placed.toWorld;
            break;
        }
    finalSamples_ = made.samples;
    wavelengths_ = made.wavelengths;
    view_ = made.view;
    homeView_ = view_.worldToCamera;
    width_ = view_.width;
    height_ = view_.height;
    live_ = std::make_unique<LiveImage>(device_, std::move(made));
    measureBounds();

    const Affine place = inverse(view_.worldToCamera);
    home_.eye = place.point({0, 0, 0});
    home_.up = place.direction({0, 1, 0});
    home_.orthographic = view_.orthographic;
    home_.pixelsPerSlopeOverHeight = view_.pixelsPerSlope / view_.height;
    const auto& [middle, radius] = bounds_;
    const Vec3 forward = place.direction({0, 0, -1});
    const double distance = std::max(dot(middle - home_.eye, forward), 0.05 * radius);
    home_.target = home_.eye + forward * (distance > 0 ? distance : 1);
    stand_ = {home_, width_, height_, std::nullopt};
    follows_ = followsCamera();
}

Look SceneSubject::firstLook() const {
    Look look;
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
        const Light& light = scene_.lights[i];
        look.lights.push_back(
            {light.name.empty() ? "light " + std::to_string(i + 1) : light.name, light.emitter, 1, true});
    }
    look.eye = std::make_shared<const Eye>(standardEye(library_));
    return look;
}

Scene SceneSubject::sceneOf(const Look& look) const {
    Scene changed = scene_;
    for (size_t i = 0; i < look.lights.size() && i < changed.lights.size(); ++i) {
        const LightSetting& setting = look.lights[i];
        Emitter& emitter = changed.lights[i].emitter;
        emitter = setting.emitter;
        const double times = setting.on ? setting.times : 0;
        if (emitter.amount)
            emitter.amount->value *= times;
        else
            emitter.scale *= times;
    }
    for (const auto& [material, reflectance] : look.reflectances)
        if (changed.materials.at(material).diffuse)
            changed.materials[material].diffuse->reflectance = reflectance;
    return changed;
}

std::vector<LightGroup> SceneSubject::groupsOf(const Scene& changed, const ResolveEmitter& resolved) {
    std::vector<sd_light> lights;
    return groupLights(changed, flat_, view_, standardObserver(library_), resolved, lights, false,
                       settings_.lightsApart);
}

void SceneSubject::plan(Table& table, const Look& look, const Scene& changed) {
    RenderSettings settings = settings_;
    settings.size = {view_.width, view_.height};
    settings.stop = stop();
    Notes unsaid;  // what there is to say was said when the scene was opened
    PassTextures passes(changed, library_, device_, settings, unsaid);
    settings.geometry = false;  // of the picture alone: passes want theirs
    settings.eye = look.eye.get();
    Plan made = makePlan(changed, settings, library_, passes, unsaid);
    fetchTexels(made.world);
    ++timesPlanned_;
    table.groups = groupsOf(changed, [&](const Emitter& emitter) { return withMeanColour(emitter, passes); });
    table.recipes = made.terms.recipes;
    table.spectra = made.terms.spectra;
    table.colours = made.terms.preview;
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() &&
               std::equal(a.begin(), a.end(), b.begin(),
                          [](const auto& p, const auto& q) { return std::memcmp(&p, &q, sizeof p) == 0; });
    };
    const World& world = live_->plan().world;
    // A light that is alone in its group has its amount in its terms, off or on.
    for (sd_light& light : made.world.lights)
        if (table.groups[light.group].text.find(alone) != std::string::npos) light.scale = 1;
    const bool shared =
        made.groups == live_->plan().groups &&
        std::equal(
            made.world.lights.begin(), made.world.lights.end(), world.lights.begin(), world.lights.end(),
            [](const sd_light& p, const sd_light& q) { return p.group == q.group && p.scale == q.scale; }) &&
        same(made.world.materials, world.materials) && same(made.world.lobes, world.lobes) &&
        same(made.world.tables, world.tables) && same(made.world.textures, world.textures) &&
        same(made.world.texels, world.texels);
    if (shared) return;
    live_->wear(std::move(made));
    tables_.clear();
    live_->move(view_, scene_, flat_);
}

bool SceneSubject::apart() {
    return settings_.lightsApart || apart_.size() <= mostLightsApart;
}

Scene SceneSubject::grouped(const Look& look) {
    Scene scene = changed(look, stand_);
    if (settings_.lightsApart) return scene;
    const size_t before = apart_.size();
    for (size_t i = 0; i < look.lights.size() && i < scene.lights.size(); ++i) {
        const LightSetting& setting = look.lights[i];
        if (setting.times != 1 || !setting.on ||
            setting.emitter.spectrum.text != scene_.lights[i].emitter.spectrum.text)
            apart_.insert(i);
    }
    if (apart_.size() > before) tables_.clear();
    if (apart())
        for (const size_t i : apart_)
            scene.lights[i].emitter.spectrum.text += alone + std::to_string(i);
    return scene;
}

std::shared_ptr<const SceneSubject::Table> SceneSubject::table(const Look& look) {
    follow();
    std::map<Index, std::string> worn;
    for (const auto& [material, reflectance] : look.reflectances)
        worn[material] = reflectance.text;
    std::vector<double> amounts;
    std::vector<std::string> lamps;
    for (const LightSetting& light : look.lights) {
        amounts.push_back(light.on ? light.times : 0);
        lamps.push_back(light.emitter.spectrum.text);
    }
    const auto known = std::find_if(tables_.begin(), tables_.end(),
                                    [&](const auto& t) { return t->version == look.version; });
    if (known != tables_.end()) return *known;

    const Scene changed = grouped(look);
    // The nearest there is: the same materials, so that only lights and eye may differ.
    const auto near = std::find_if(tables_.rbegin(), tables_.rend(),
                                   [&](const auto& t) { return t->reflectances == worn; });
    Table made;
    bool fresh = near == tables_.rend() || !apart();
    if (!fresh) {
        made = **near;
        const bool otherLamps = (*near)->lamps != lamps, otherAmounts = (*near)->amounts != amounts;
        // A light of a pass's colour has that of the last plan, which is its own while no lamp changes.
        const bool ofPass = std::any_of(changed.lights.begin(), changed.lights.end(),
                                        [](const Light& light) { return light.emitter.texture.has_value(); });
        const std::vector<LightGroup> groups =
            ofPass ? made.groups : groupsOf(changed, [](const Emitter& emitter) { return emitter; });
        // Lamps may shine in other passes alone.
        fresh = ((passes_ || ofPass) && otherAmounts) || ((pictures_ || ofPass) && otherLamps);
        fresh = fresh || groups.size() != made.groups.size();
        for (size_t t = 0; t < made.recipes.size() && !fresh; ++t) {
            const TermRecipe& recipe = made.recipes[t];
            const bool lit = recipe.group < groups.size();
            const bool otherLight = lit && (groups[recipe.group].text != made.groups[recipe.group].text ||
                                            groups[recipe.group].factor != made.groups[recipe.group].factor);
            if (recipe.group == TermRecipe::unknown)
                fresh = true;
            else if (otherLight || made.eye != look.eye) {
                const std::array<float, 3> colour =
                    relit(recipe, lit ? groups[recipe.group] : LightGroup{}, *look.eye);
                std::copy(colour.begin(), colour.end(),
                          made.colours.begin() + static_cast<std::ptrdiff_t>(3 * t));
            }
        }
        made.groups = groups;
    }
    made.version = look.version;
    made.reflectances = worn;
    made.amounts = amounts;
    made.lamps = lamps;
    made.eye = look.eye;
    if (fresh) plan(made, look, changed);
    constexpr size_t kept = 8;
    if (tables_.size() >= kept) tables_.erase(tables_.begin());
    tables_.push_back(std::make_shared<const Table>(std::move(made)));
    return tables_.back();
}

void SceneSubject::resolve() {
    live_->resolve(samples(), stop());
}

void SceneSubject::showColours(const std::vector<float>& colours, const Shown& shown, Codes& codes) {
    resolve();
    // The device has one matrix and thresholds; what bends colours is done here.
    if (shown.tone == Tone::linear && shown.gamut == GamutMapping::clip)
        live_->show(colours, shownThrough(shown.toSignals, shown.display), codes);
    else
        encodeCodes(live_->xyz(colours), shown, codes);
}

void SceneSubject::show(const Look& look, const Shown& shown, Codes& codes) {
    showColours(table(look)->colours, shown, codes);
}

void SceneSubject::showMixed(const Look& a, const Look& b, double mix, const Shown& shown, Codes& codes) {
    std::vector<float> colours = table(a)->colours;
    const std::shared_ptr<const Table> with = table(b);
    const std::vector<float>& other = with->colours;
    for (size_t i = 0; i < colours.size() && i < other.size(); ++i)
        colours[i] = static_cast<float>(
            std::lerp(static_cast<double>(colours[i]), static_cast<double>(other[i]), mix));
    showColours(colours, shown, codes);
}

ChannelImage SceneSubject::xyz(const Look& look) {
    const std::shared_ptr<const Table> terms = table(look);
    resolve();
    return live_->xyz(terms->colours);
}

White SceneSubject::white(const Look& look) {
    const std::shared_ptr<const Table> terms = table(look);
    if (!terms->groups.empty()) {
        const LightGroup& first = terms->groups.front();
        const std::array<const Curve*, 1> light{&first.spectrum};
        const Triple xyz = seenXyz(*look.eye, light);
        if (xyz[1] > 0) return {plainName(first.text), {xyz[0] / xyz[1], 1, xyz[2] / xyz[1]}, false};
    }
    const Curve equal = Curve::constant(1);
    const std::array<const Curve*, 1> light{&equal};
    const Triple xyz = seenXyz(*look.eye, light);
    return {"E", {xyz[0] / xyz[1], 1, xyz[2] / xyz[1]}, false};
}

double SceneSubject::whiteAmount(const Look& look) {
    const std::shared_ptr<const Table> terms = table(look);
    if (terms->groups.empty()) return 1;
    const std::array<const Curve*, 1> light{&terms->groups.front().spectrum};
    return terms->groups.front().factor * seenXyz(*look.eye, light)[1];
}

}  // namespace spectrad::view
