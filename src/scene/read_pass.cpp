// <pass>: what is rendered, and into which file or texture.
#include "base/text.h"
#include "scene/reading.h"

namespace spectrad {

namespace {

/// Most samples a pixel may have.
constexpr int maxSamples = 64;

Pass readPass(const Reading& reading, const Element& element) {
    Pass pass;
    pass.name = element.text("name");
    pass.where = element.where();
    if (element.has("camera"))
        pass.camera = reading.cameras.find(element.text("camera"), element.where("camera"));
    if (element.has("of")) pass.of = reading.nodes.find(element.text("of"), element.where("of"));
    if (element.has("size")) pass.size = element.pixels("size", {});
    if (element.has("samples")) pass.samples = element.integer("samples", 1, 1, maxSamples);
    if (element.has("wavelengths"))
        pass.wavelengths = parseWavelengths(element.text("wavelengths"), element.where("wavelengths"));
    if (element.has("wavelengths")) pass.wavelengths->projection = reading.scene.wavelengths.projection;
    if (element.has("projection")) {
        if (!pass.wavelengths) pass.wavelengths = reading.scene.wavelengths;
        pass.wavelengths->projection =
            parseProjection(element.text("projection"), element.where("projection"));
    }
    pass.as = element.choice<PassKind>("as",
                                       {{"radiance", PassKind::radiance},
                                        {"reflectance", PassKind::reflectance},
                                        {"transmittance", PassKind::transmittance},
                                        {"irradiance", PassKind::irradiance}},
                                       PassKind::radiance);
    pass.save = element.text("save");
    return pass;
}

}  // namespace

void readPasses(Reading& reading) {
    for (const pugi::xml_node node : reading.document.root().children("pass")) {
        Pass pass = readPass(reading, Element(reading.document, node));
        reading.passes.add(pass.name, static_cast<Index>(reading.scene.passes.size()), pass.where);
        reading.scene.passes.push_back(std::move(pass));
    }
    static constexpr std::string_view prefix = "pass:";
    for (const Material& material : reading.scene.materials) {
        if (!material.diffuse || !material.diffuse->texture) continue;
        const TextureUse& texture = *material.diffuse->texture;
        if (startsWith(texture.source, prefix))
            static_cast<void>(reading.passes.find(texture.source.substr(prefix.size()), texture.where));
    }
}

}  // namespace spectrad
