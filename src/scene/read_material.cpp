// <material> and its lobes. What cannot be rendered yet is read and checked all the same: the plan refuses
// it, not we.
#include "base/text.h"
#include "scene/reading.h"

#include <fmt/format.h>

#include <algorithm>

namespace spectrad {

namespace {

Diffuse readDiffuse(Reading& reading, const Element& element) {
    std::vector<std::string> given;
    for (const char* source : {"reflectance", "texture", "select"})
        if (element.has(source)) given.push_back(fmt::format("'{}'", source));
    if (given.size() != 1)
        element.fail(given.empty() ? "needs the attribute 'reflectance', 'texture' or 'select'"
                                   : fmt::format("has both {} and {} (one is allowed)", given[0], given[1]));
    if (!element.has("select")) {
        element.refuse("values", "stands only beside 'select'");
        if (const auto choice = element.child("choose"))
            choice->fail("stands only in a <diffuse> with 'select'");
    }
    Diffuse diffuse;
    if (element.has("texture")) {
        diffuse.texture = readTexture(reading, element, TextureRole::reflectance);
    } else if (element.has("select")) {
        diffuse.select = readSelect(reading, element);
    } else {
        refuseSampling(element, "stands only beside 'texture' or 'select'");
        diffuse.reflectance = reading.spectrum(element, "reflectance", Role::reflectance);
    }
    diffuse.roughnessDegrees = element.number("roughness", 0, {0, 90, true, true});
    return diffuse;
}

/// What a mirror shows instead of nothing.
std::optional<TextureUse> readReflects(Reading& reading, const Element& element) {
    if (!element.has("reflects")) return std::nullopt;
    if (element.number("roughness", 0) > 0)
        element.fail("reflects", "only a mirror (roughness 0) shows an image");
    return readTexture(reading, element, TextureRole::radiance, "reflects");
}

/// An index of refraction; `curves` is 1 for a dielectric (n), 2 for a metal (n, k).
Spectrum readIndex(Reading& reading, const Element& element, size_t curves) {
    Spectrum index = reading.spectrum(element, "ior", Role::index);
    if (index.curves.size() != curves)
        element.fail(
            "ior",
            curves == 2
                ? "a conductor needs two columns, n and k (allowed: metals/..., or a file with them)"
                : fmt::format("a coat needs n alone, this has {} columns (for n and k use <conductor>)",
                              index.curves.size()));
    return index;
}

/// "0.3", or "0.3 0.1": along and across the texture coordinates' u. The square of GGX's alpha, the fourth
/// power of a roughness, has to be a float.
Roughness readRoughness(const Element& element) {
    constexpr double mostRatio = 5, leastRoughness = 1e-9;
    const auto check = [&](double value) {
        if (value > 0 && value < leastRoughness)
            element.fail("roughness", fmt::format("{} is too smooth (allowed: 0, or {} … 1)", shortest(value),
                                                  shortest(leastRoughness)));
        return value;
    };
    if (!element.has("roughness")) return {};
    if (element.text("roughness").find_first_of(" \t\n") == std::string::npos)
        return check(element.number("roughness", 0, zeroToOne));
    const std::vector<double> values = element.numbers("roughness", {2});
    for (double value : values)
        if (value < 0 || value > 1) element.fail("roughness", "expected numbers from 0 to 1");
    const Roughness roughness{check(values.front()), check(values.back())};
    const auto [low, high] = std::minmax(roughness.u, roughness.v);
    if (high > mostRatio * low * (1 + 1e-9))
        element.fail("roughness",
                     fmt::format("along and across differ too much (allowed: one up to {} times the other)",
                                 mostRatio));
    return roughness;
}

Fluorescence readFluorescence(Reading& reading, const Element& element) {
    Fluorescence result;
    result.where = element.where();
    if (element.has("mask"))
        result.mask = readPicture(reading, element, "mask");
    else
        refuseSampling(element, "stands only beside 'mask'");
    if (element.has("matrix")) {
        for (const char* attribute :
             {"excitation", "emission", "yield", "strength", "emission-unit", "anti-stokes"})
            element.refuse(attribute, "cannot stand beside 'matrix'");
        result.matrixFile = reading.file(element, "matrix").string();
        result.diagonalNone =
            element.choice<bool>("diagonal", {{"reflectance", false}, {"none", true}}, false);
        return result;
    }
    element.refuse("diagonal", "stands only beside 'matrix'");
    if (!element.has("excitation") || !element.has("emission"))
        element.fail("needs the attributes 'excitation' and 'emission', or 'matrix'");
    result.excitation = reading.spectrum(element, "excitation", Role::excitation);
    result.emission = reading.spectrum(element, "emission", Role::emission);
    result.yield = element.number("yield", 1, zeroToOne);
    result.strength = element.number("strength", 1, zeroToOne);
    result.emissionInPhotons =
        element.choice<bool>("emission-unit", {{"energy", false}, {"photons", true}}, false);
    result.antiStokes = element.boolean("anti-stokes", false);
    return result;
}

Relief readRelief(Reading& reading, const Element& element) {
    Relief relief;
    relief.heights = element.name() == "bump";
    relief.map = readPicture(reading, element, relief.heights ? "height" : "map");
    relief.amount = relief.heights ? reading.length(element, "depth", 0, anyNumber)
                                   : element.number("strength", 1, notNegative);
    return relief;
}

Material readMaterial(Reading& reading, const Element& element) {
    Material material;
    material.name = element.text("name");
    material.where = element.where();
    for (const pugi::xml_node node : element.node().children()) {
        const Element lobe(reading.document, node);
        const std::string_view kind = lobe.name();
        if (kind == "diffuse") {
            material.diffuse = readDiffuse(reading, lobe);
        } else if (kind == "gloss") {
            material.gloss = {readIndex(reading, lobe, 1), readRoughness(lobe), readReflects(reading, lobe)};
        } else if (kind == "specular") {
            material.specular = {reading.spectrum(lobe, "reflectance", Role::reflectance),
                                 readRoughness(lobe), readReflects(reading, lobe)};
        } else if (kind == "conductor") {
            material.conductor = {readIndex(reading, lobe, 2), readRoughness(lobe),
                                  lobe.choice<bool>("fresnel", {{"exact", false}, {"schlick", true}}, false),
                                  readReflects(reading, lobe)};
        } else if (kind == "fluorescence") {
            material.fluorescence.push_back(readFluorescence(reading, lobe));
        } else if (kind == "normal" || kind == "bump") {
            if (material.relief) lobe.fail("a material has one fine shape: <normal> or <bump>");
            material.relief = readRelief(reading, lobe);
        } else {
            material.emission = readGlow(reading, lobe, "an emission");
        }
    }
    if (element.node().first_child().empty())
        reading.notes.warn(material.where,
                           fmt::format("material '{}' has no lobe: it is black", material.name));
    for (const Fluorescence& fluorescence : material.fluorescence)
        if (material.diffuse && !fluorescence.matrixFile.empty() && !fluorescence.diagonalNone)
            throw InputError(
                fluorescence.where,
                "the matrix holds the reflectance in its diagonal, so <diffuse> cannot stand beside "
                "it (diagonal=\"none\" where it holds none)");
    return material;
}

}  // namespace

void readMaterials(Reading& reading) {
    for (const pugi::xml_node node : reading.document.root().children("material")) {
        const Element element(reading.document, node);
        const Index index = static_cast<Index>(reading.scene.materials.size());
        reading.materials.add(element.text("name"), index, element.where());
        reading.scene.materials.push_back(readMaterial(reading, element));
    }
    reading.materialUsed.assign(reading.scene.materials.size(), false);
}

}  // namespace spectrad
