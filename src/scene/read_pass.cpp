// <pass>: what is rendered, and into which file or texture.
#include "base/text.h"
#include "scene/pass_needs.h"
#include "scene/reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace spectrad {

namespace {

/// Most samples a pixel may have.
constexpr int maxSamples = 64;
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
    if (!element.has("lights")) return;
    pass.lights.emplace();
    const std::string text = element.text("lights");
    for (const std::string_view name : words(text))
        pass.lights->push_back(other ? nameIn(other->lights, std::string(name), element, "lights", *other)
                                     : reading.lights.find(std::string(name), element.where("lights")));
}

Pass readPass(const Reading& reading, const Element& element) {
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

/// A pass must hold what the place where it is used is made of.
void checkType(const Reading& reading, const TextureUse& use) {
    if (!use.isPass()) return;
    const Pass& pass = reading.scene.passes[reading.passes.find(use.passName(), use.where)];
    const bool reflectance = use.role == TextureRole::reflectance;
    if (pass.as == (reflectance ? PassKind::reflectance : PassKind::radiance)) return;
    throw InputError(use.where,
                     fmt::format("pass '{}' is as=\"{}\", {}", pass.name, nameOf(pass.as),
                                 reflectance ? "but a <diffuse> texture is a reflectance (as=\"reflectance\")"
                                             : "but what glows is a radiance (as=\"radiance\")"));
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
    for (const Material& material : reading.scene.materials)
        for (const TextureUse* use : texturesOf(material))
            checkType(reading, *use);
    checkPasses(reading.scene);
}

}  // namespace spectrad
