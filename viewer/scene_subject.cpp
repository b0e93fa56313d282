#include "viewer/scene_subject.h"

#include "spectrum/projection.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace spectrad::view {

namespace {

/// Up to so many lights have terms of their own, so that each can change without the others. More share
/// terms, and a change plans the materials anew.
constexpr size_t mostLightsApart = 16;

Vec3 vertexAt(const World& world, const std::vector<Affine>& toWorld, std::uint32_t vertex) {
    const float* p = world.position.data() + size_t{3} * vertex;
    return toWorld[world.vertexDraw[vertex]].point({p[0], p[1], p[2]});
}

bool isPicture(const std::optional<TextureUse>& use) {
    return use && use->mapping == TextureMapping::picture;
}

/// Whether a picture depends on the camera's place beyond perspective: curved shapes are cut into triangles
/// as it sees them, mirrors and a backdrop show what was rendered for it.
bool followsCamera(const Scene& scene, const FlatScene& flat) {
    for (const FlatScene::Object& object : flat.objects)
        for (const ShapeUse& use : object.node->shapes)
            if (use.shape.kind != ShapeKind::box && use.shape.kind != ShapeKind::plane) return true;
    if (scene.background && isPicture(scene.background->texture)) return true;
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        return (m.gloss && isPicture(m.gloss->reflects)) || (m.specular && isPicture(m.specular->reflects)) ||
               (m.conductor && isPicture(m.conductor->reflects));
    });
}

}  // namespace

SceneSubject::SceneSubject(const std::filesystem::path& file, const LoadOptions& load,
                           const RenderSettings& settings, const Device& device, const Library& library,
                           Notes& notes)
    : library_(library),
      device_(device),
      notes_(notes),
      load_(load),
      settings_(settings),
      scene_(loadScene(file, library, load, notes)) {
    settings_.lightsApart = scene_.lights.size() <= mostLightsApart;
    const Shot shot = chooseShot(scene_, settings_);
    if (shot.scene != &scene_)
        throw InputError(shot.pass->where,
                         "pass '" + shot.pass->name + "' shows another file: open that one to view it");
    flat_ = shot.pass ? flatten(scene_, *shot.pass) : flatten(scene_);
    PassTextures passes(scene_, library_, device_, settings_, notes_);
    Plan made = makePlan(scene_, settings_, library_, passes, notes_);
    if (made.as != PassKind::radiance)
        throw InputError("pass '" + made.passName + "' is no radiance: view shows what an eye sees");
    if (made.faces > 1)
        throw InputError("camera '" + made.cameraName +
                         "' looks all around: view needs one that looks ahead");
    for (const Light& light : scene_.lights)
        if (light.emitter.texture)
            throw InputError(light.where, "a light of a pass's colour is not there in the viewer yet");
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
    view_ = made.view;
    live_ = std::make_unique<LiveImage>(device_, std::move(made));

    const Affine place = inverse(view_.worldToCamera);
    pose_.eye = place.point({0, 0, 0});
    pose_.up = place.direction({0, 1, 0});
    pose_.orthographic = view_.orthographic;
    pose_.pixelsPerSlopeOverHeight = view_.pixelsPerSlope / view_.height;
    const auto [middle, radius] = bounds();
    const Vec3 forward = place.direction({0, 0, -1});
    const double distance = std::max(dot(middle - pose_.eye, forward), 0.05 * radius);
    pose_.target = pose_.eye + forward * (distance > 0 ? distance : 1);
    home_ = pose_;
    follows_ = followsCamera(scene_, flat_);
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

void SceneSubject::place() {
    stale_ = follows_;
    live_->move(view_, scene_, flat_);
}

void SceneSubject::setPose(const Pose& pose) {
    pose_ = pose;
    view_.worldToCamera = inverse(Affine::lookAt(pose.eye, pose.target, pose.up));
    view_.orthographic = pose.orthographic;
    view_.pixelsPerSlope = pose.pixelsPerSlopeOverHeight * view_.height;
    place();
}

void SceneSubject::setSize(int width, int height) {
    if (width == view_.width && height == view_.height) return;
    view_.width = width;
    view_.height = height;
    view_.pixelsPerSlope = pose_.pixelsPerSlopeOverHeight * height;
    place();
}

std::pair<Vec3, double> SceneSubject::bounds() const {
    const World& world = live_->plan().world;
    constexpr double huge = 1e300;
    Vec3 low{huge, huge, huge}, high{-huge, -huge, -huge};
    for (std::uint32_t v = 0; v < world.vertexDraw.size(); ++v) {
        const Vec3 p = vertexAt(world, live_->drawToWorld(), v);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (low.x > high.x) return {{0, 0, 0}, 1};
    return {(low + high) * 0.5, std::max(0.5 * length(high - low), 1e-9)};
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

std::optional<SceneSubject::Moved> SceneSubject::moved() const {
    const auto same = [](Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
    if (same(pose_.eye, home_.eye) && same(pose_.target, home_.target) && same(pose_.up, home_.up) &&
        pose_.pixelsPerSlopeOverHeight == home_.pixelsPerSlopeOverHeight)
        return std::nullopt;
    const Affine toNode = inverse(cameraNode_);
    return Moved{
        camera_, toNode.point(pose_.eye), toNode.point(pose_.target), normalized(toNode.direction(pose_.up)),
        scene_.cameras[camera_].viewHeight * home_.pixelsPerSlopeOverHeight / pose_.pixelsPerSlopeOverHeight};
}

void SceneSubject::placeCamera(Scene& scene) const {
    const auto now = moved();
    if (!now) return;
    scene.cameras[now->camera].toNode = Affine::lookAt(now->eye, now->target, now->up);
    scene.cameras[now->camera].viewHeight = now->viewHeight;
}

Scene SceneSubject::changed(const Look& look) const {
    Scene scene = sceneOf(look);
    placeCamera(scene);
    return scene;
}

std::vector<LightGroup> SceneSubject::groupsOf(const Scene& changed) const {
    std::vector<sd_light> lights;
    return groupLights(
        changed, flat_, view_, standardObserver(library_), [](const Emitter& emitter) { return emitter; },
        lights, false, settings_.lightsApart);
}

void SceneSubject::plan(Table& table, const Look& look, const Scene& changed) {
    RenderSettings settings = settings_;
    settings.geometry = false;
    settings.eye = look.eye.get();
    Notes unsaid;  // what there is to say was said when the scene was opened
    settings.size = {view_.width, view_.height};
    PassTextures passes(changed, library_, device_, settings, unsaid);
    Plan made = makePlan(changed, settings, library_, passes, unsaid);
    table.recipes = made.terms.recipes;
    table.spectra = made.terms.spectra;
    table.colours = made.terms.preview;
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() &&
               std::equal(a.begin(), a.end(), b.begin(),
                          [](const auto& p, const auto& q) { return std::memcmp(&p, &q, sizeof p) == 0; });
    };
    const World& world = live_->plan().world;
    const bool shared = made.groups == live_->plan().groups && same(made.world.materials, world.materials) &&
                        same(made.world.lobes, world.lobes) && same(made.world.tables, world.tables) &&
                        same(made.world.textures, world.textures) && same(made.world.texels, world.texels);
    if (shared && settings_.lightsApart) return;
    live_->wear(std::move(made));
    tables_.clear();
    live_->move(view_, scene_, flat_);
}

void SceneSubject::follow() {
    if (!stale_ || samples() < finalSamples_) return;
    stale_ = false;
    Scene moved = scene_;
    placeCamera(moved);
    RenderSettings settings = settings_;
    settings.size = {view_.width, view_.height};
    Notes unsaid;
    PassTextures passes(moved, library_, device_, settings, unsaid);
    Plan made = makePlan(moved, settings, library_, passes, unsaid);
    live_ = std::make_unique<LiveImage>(device_, std::move(made));
    tables_.clear();
    live_->move(view_, scene_, flat_);
}

const SceneSubject::Table& SceneSubject::table(const Look& look) {
    follow();
    std::map<Index, std::string> worn;
    for (const auto& [material, reflectance] : look.reflectances)
        worn[material] = reflectance.text;
    const auto known = std::find_if(tables_.begin(), tables_.end(),
                                    [&](const Table& t) { return t.version == look.version; });
    if (known != tables_.end()) return *known;

    const Scene changed = this->changed(look);
    // The nearest there is: the same materials, so that only lights and eye may differ.
    const auto near = std::find_if(tables_.rbegin(), tables_.rend(),
                                   [&](const Table& t) { return t.reflectances == worn; });
    Table made;
    bool fresh = near == tables_.rend() || !settings_.lightsApart;
    if (!fresh) {
        made = *near;
        const std::vector<LightGroup> groups = groupsOf(changed);
        fresh = groups.size() != made.groups.size();
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
    made.eye = look.eye;
    if (fresh) {
        made.groups = groupsOf(changed);
        plan(made, look, changed);
    }
    constexpr size_t kept = 8;
    if (tables_.size() >= kept) tables_.erase(tables_.begin());
    tables_.push_back(std::move(made));
    return tables_.back();
}

void SceneSubject::resolve() {
    live_->resolve(samples());
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
    const Table& terms = table(look);
    showColours(terms.colours, shown, codes);
}

void SceneSubject::showMixed(const Look& a, const Look& b, double mix, const Shown& shown, Codes& codes) {
    std::vector<float> colours = table(a).colours;
    const std::vector<float>& other = table(b).colours;
    for (size_t i = 0; i < colours.size() && i < other.size(); ++i)
        colours[i] = static_cast<float>(
            std::lerp(static_cast<double>(colours[i]), static_cast<double>(other[i]), mix));
    showColours(colours, shown, codes);
}

ChannelImage SceneSubject::xyz(const Look& look) {
    const Table& terms = table(look);
    resolve();
    return live_->xyz(terms.colours);
}

std::vector<double> SceneSubject::spectrumAt(int x, int y, const Look& look) {
    const Table& terms = table(look);
    resolve();
    const Wavelengths& grid = wavelengths();
    std::vector<float> sum(grid.size(), 0.0f);
    const auto seen = live_->termsAt(x, y);
    if (seen.empty() && (x < 0 || y < 0 || x >= width() || y >= height())) return {};
    for (const auto& [term, g] : seen) {
        const TermRecipe& recipe = terms.recipes.at(term);
        std::vector<float> bands;
        if (recipe.group == TermRecipe::unknown) {
            const auto from = terms.spectra.begin() + static_cast<std::ptrdiff_t>(term * grid.size());
            bands.assign(from, from + static_cast<std::ptrdiff_t>(grid.size()));
        } else {
            std::vector<const Curve*> product;
            double factor = recipe.factor;
            if (recipe.group != TermRecipe::none) {
                product.push_back(&terms.groups.at(recipe.group).spectrum);
                factor *= terms.groups[recipe.group].factor;
            }
            for (const Curve& curve : recipe.response)
                product.push_back(&curve);
            for (double value : project(grid, product))
                bands.push_back(static_cast<float>(value * factor));
        }
        // The same sums as kernels/expand.cl.
        for (size_t band = 0; band < sum.size(); ++band)
            sum[band] = std::fma(bands[band], g, sum[band]);
    }
    return {sum.begin(), sum.end()};
}

White SceneSubject::white(const Look& look) {
    const Table& terms = table(look);
    if (!terms.groups.empty()) {
        const LightGroup& first = terms.groups.front();
        const std::array<const Curve*, 1> light{&first.spectrum};
        const Triple xyz = seenXyz(*look.eye, light);
        if (xyz[1] > 0) return {first.text, {xyz[0] / xyz[1], 1, xyz[2] / xyz[1]}, false};
    }
    const Curve equal = Curve::constant(1);
    const std::array<const Curve*, 1> light{&equal};
    const Triple xyz = seenXyz(*look.eye, light);
    return {"E", {xyz[0] / xyz[1], 1, xyz[2] / xyz[1]}, false};
}

double SceneSubject::whiteAmount(const Look& look) {
    const Table& terms = table(look);
    if (terms.groups.empty()) return 1;
    const std::array<const Curve*, 1> light{&terms.groups.front().spectrum};
    return terms.groups.front().factor * seenXyz(*look.eye, light)[1];
}

}  // namespace spectrad::view
