// <pass>: what is rendered, and into which file or texture.
#include "base/limits.h"
#include "base/text.h"
#include "scene/amounts.h"
#include "scene/pass_needs.h"
#include "scene/reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace spectrad {

namespace {

/// Most generations of a pass that sees itself.
constexpr int maxGenerations = 1000;

/// The place of what an attribute names among another scene's things.
template <typename Named>
Index nameIn(const std::vector<Named>& items, const std::string& name, const Element& element,
             const char* attribute, const Scene& scene) {
    std::vector<std::string> known;
    for (size_t i = 0; i < items.size(); ++i) {
        if (items[i].name == name) return static_cast<Index>(i);
        if (!items[i].name.empty()) known.push_back(items[i].name);
    }
    element.fail(attribute, fmt::format("{} names nothing of the kind '{}'{}", scene.file, name,
                                        didYouMean(name, known)));
}

/// A pass of another file: what that file would render by itself, its pass main, else its last, else its
/// first camera.
Pass passOfOther(const std::shared_ptr<const Scene>& other) {
    Pass pass;
    if (!other->passes.empty()) {
        auto shown = std::find_if(other->passes.begin(), other->passes.end(),
                                  [](const Pass& p) { return p.name == "main"; });
        if (shown == other->passes.end()) --shown;
        pass = *shown;
        pass.save.clear();
        if (!pass.scene) pass.base = static_cast<Index>(shown - other->passes.begin());
    }
    if (!pass.scene) pass.scene = other;
    return pass;
}

void readView(const Reading& reading, const Element& element, Pass& pass) {
    const std::shared_ptr<const Scene> other = pass.scene;
    if (element.has("camera"))
        pass.camera = other ? nameIn(other->cameras, element.text("camera"), element, "camera", *other)
                            : reading.cameras.find(element.text("camera"), element.where("camera"));
    if (element.has("of"))
        pass.of = other ? nameIn(other->nodes, element.text("of"), element, "of", *other)
                        : reading.nodes.find(element.text("of"), element.where("of"));
    if (element.has("mirror"))
        pass.mirror = other ? nameIn(other->nodes, element.text("mirror"), element, "mirror", *other)
                            : reading.nodes.find(element.text("mirror"), element.where("mirror"));
    if (!element.has("lights")) return;
    pass.lights.emplace();
    const std::string text = element.text("lights");
    for (const std::string_view name : words(text))
        pass.lights->push_back(other ? nameIn(other->lights, std::string(name), element, "lights", *other)
                                     : reading.lights.find(std::string(name), element.where("lights")));
}

/// through= a detector, onto display=.
std::optional<Screen> readScreen(Reading& reading, const Element& element) {
    if (!element.has("display")) {
        for (const char* attribute : {"through", "luminance"})
            element.refuse(attribute, "stands only beside 'display'");
        return std::nullopt;
    }
    if (!element.has("through"))
        element.fail("display", "needs 'through', the detector that takes the picture which is shown");
    Screen screen;
    screen.where = element.where("display");
    screen.detector =
        reading.scene.detectors[reading.detectors.find(element.text("through"), element.where("through"))]
            .sensitivity;
    screen.primaries = reading.spectrum(element, "display", Role::any);
    if (screen.primaries.curves.size() != 3)
        element.fail("display", fmt::format("a display has three primaries, this file has {} (allowed: "
                                            "displays/..., or a file of three columns)",
                                            screen.primaries.curves.size()));
    if (element.has("luminance")) {
        std::string complaint;
        const auto amount = parseAmount("luminance", element.text("luminance"), complaint);
        if (!amount) element.fail("luminance", complaint);
        if (!(amount->value > 0)) element.fail("luminance", "a display's white is above 0 cd/m2");
        screen.luminance = amount->value;
    } else if (screen.primaries.relative) {
        element.fail("display", "the primaries are relative: say the white's luminance=\"… cd/m2\"");
    }
    return screen;
}

Pass readPass(Reading& reading, const Element& element) {
    Pass pass;
    if (element.has("scene"))
        pass = passOfOther(
            reading.otherScene(reading.resolver.findFile(element.text("scene"), element.where("scene")),
                               element.where("scene")));
    pass.name = element.text("name");
    pass.where = element.where();
    readView(reading, element, pass);
    if (element.has("size")) pass.size = element.pixels("size", {});
    if (element.has("samples")) pass.samples = element.integer("samples", 1, 1, maxSamples);
    const Wavelengths& grid = pass.scene ? pass.scene->wavelengths : reading.scene.wavelengths;
    if (element.has("wavelengths")) {
        pass.wavelengths = parseWavelengths(element.text("wavelengths"), element.where("wavelengths"));
        pass.wavelengths->projection = grid.projection;
    }
    if (element.has("projection")) {
        if (!pass.wavelengths) pass.wavelengths = grid;
        pass.wavelengths->projection =
            parseProjection(element.text("projection"), element.where("projection"));
    }
    pass.as = element.choice<PassKind>("as",
                                       {{"radiance", PassKind::radiance},
                                        {"reflectance", PassKind::reflectance},
                                        {"transmittance", PassKind::transmittance},
                                        {"irradiance", PassKind::irradiance}},
                                       pass.as);
    if (const auto screen = readScreen(reading, element)) pass.screen = screen;
    if (pass.screen && pass.as != PassKind::radiance)
        element.fail("display", "a display shows radiances (as=\"radiance\")");
    if (pass.mirror && pass.as != PassKind::radiance)
        element.fail("mirror", "a mirror shows radiances (as=\"radiance\")");
    if (element.has("repeat")) pass.repeat = element.integer("repeat", 1, 1, maxGenerations);
    if (element.has("save")) {
        const std::string file = element.text("save");
        if (!file.ends_with(".exr") && !file.ends_with(".img"))
            element.fail("save", "expected a name that ends in .exr or .img (ENVI)");
        pass.save = reading.resolver.outputFile(file, element.where("save")).string();
        for (const std::string& read : reading.files.list())
            if (std::filesystem::path(read).lexically_normal() ==
                std::filesystem::path(pass.save).lexically_normal())
                element.fail("save", "this file is read by the scene");
    }
    return pass;
}

std::string_view nameOf(PassKind kind) {
    switch (kind) {
        case PassKind::reflectance:
            return "reflectance";
        case PassKind::transmittance:
            return "transmittance";
        case PassKind::irradiance:
            return "irradiance";
        case PassKind::radiance:
            break;
    }
    return "radiance";
}

PassKind kindFor(TextureRole role) {
    return role == TextureRole::reflectance  ? PassKind::reflectance
           : role == TextureRole::irradiance ? PassKind::irradiance
                                             : PassKind::radiance;
}

/// A pass must hold what the place where it is used is made of.
const Pass& checkedType(const Reading& reading, const TextureUse& use) {
    const Pass& pass = reading.scene.passes[reading.passes.find(use.passName(), use.where)];
    if (pass.as == kindFor(use.role)) return pass;
    throw InputError(use.where,
                     fmt::format("pass '{}' is as=\"{}\", but {}", pass.name, nameOf(pass.as),
                                 use.role == TextureRole::reflectance
                                     ? "a <diffuse> texture is a reflectance (as=\"reflectance\")"
                                 : use.role == TextureRole::irradiance
                                     ? "a directional light sends an irradiance (as=\"irradiance\")"
                                     : "what glows is a radiance (as=\"radiance\")"));
}

bool looksAround(const Reading& reading, const Pass& pass) {
    const Scene& shown = pass.scene ? *pass.scene : reading.scene;
    return pass.camera < shown.cameras.size() && shown.cameras[pass.camera].cube;
}

/// What a mirror or the background shows must be an image of the kind that it looks up.
void checkMapping(const Reading& reading, TextureUse& use, bool mirror) {
    if (!use.isPass()) {
        if (mirror) use.mapping = TextureMapping::cube;
        return;
    }
    const Pass& pass = checkedType(reading, use);
    const bool around = looksAround(reading, pass);
    if (mirror) {
        if (!around && !pass.mirror)
            throw InputError(use.where,
                             fmt::format("pass '{}' is no image for a mirror (allowed: a pass with "
                                         "mirror=, or with a camera of type cube)",
                                         pass.name));
        use.mapping = around ? TextureMapping::cube : TextureMapping::picture;
    } else if (around != (use.mapping == TextureMapping::cube)) {
        throw InputError(use.where, fmt::format("pass '{}' {} (mapping=\"{}\")", pass.name,
                                                around ? "looks all around" : "is one picture, not six faces",
                                                around ? "cube" : "picture"));
    }
}

void checkUses(Reading& reading) {
    Scene& scene = reading.scene;
    for (Material& material : scene.materials) {
        for (const TextureUse* use : texturesOf(material))
            if (use->isPass()) static_cast<void>(checkedType(reading, *use));
        if (material.gloss && material.gloss->reflects)
            checkMapping(reading, *material.gloss->reflects, true);
        if (material.specular && material.specular->reflects)
            checkMapping(reading, *material.specular->reflects, true);
        if (material.conductor && material.conductor->reflects)
            checkMapping(reading, *material.conductor->reflects, true);
    }
    for (const Light& light : scene.lights)
        if (light.emitter.texture) static_cast<void>(checkedType(reading, *light.emitter.texture));
    if (scene.background && scene.background->texture)
        checkMapping(reading, *scene.background->texture, false);
}

}  // namespace

void readPasses(Reading& reading) {
    for (const pugi::xml_node node : reading.document.root().children("pass")) {
        const Element element(reading.document, node);
        Pass pass = readPass(reading, element);
        if (pass.scene)
            for (const std::string& file : pass.scene->filesRead)
                reading.files.add(file);
        reading.passes.add(pass.name, static_cast<Index>(reading.scene.passes.size()), pass.where);
        reading.scene.passes.push_back(std::move(pass));
    }
    checkUses(reading);
    checkPasses(reading.scene);
}

}  // namespace spectrad
