#include "scene/graft_materials.h"

#include "base/text.h"

#include <algorithm>

namespace spectrad {

namespace {

/// What an emission of 1 is taken as where the format states no unit: a display's white.
constexpr double luminanceOfGlow = 100;
constexpr double paintIndex = 1.5;
/// What Assimp adds for meshes without a material; where all have one, it is not in the file.
constexpr std::string_view assimpsOwn = "DefaultMaterial";

std::string rgbText(const std::array<double, 3>& c) {
    return "rgb:" + shortest(c[0]) + "," + shortest(c[1]) + "," + shortest(c[2]);
}

}  // namespace

double luminanceShare(const std::array<double, 3>& c) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

Spectrum colourOfLamp(std::array<double, 3> c, const SpectrumResolver& resolver,
                      const SourceLocation& where) {
    const double most = std::max({c[0], c[1], c[2]});
    for (double& v : c)
        v /= most;
    return resolver.resolve(rgbText(c), Role::light, where);
}

bool matches(std::string_view pattern, std::string_view text) {
    // Greedy, with one place to come back to: after the last star, a character further each time.
    size_t p = 0, t = 0, star = std::string_view::npos, afterStar = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            afterStar = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++afterStar;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

GraftedMaterials::GraftedMaterials(Scene& scene, const ImportedScene& model, const GraftOptions& options,
                                   const SpectrumResolver& resolver, SourceLocation where)
    : scene_(scene),
      model_(model),
      options_(options),
      resolver_(resolver),
      where_(std::move(where)),
      pictures_(scene, model, resolver, where_),
      number_(model.materials.size()) {
    for (size_t i = 0; i < number_.size(); ++i) {
        number_[i] = options.material;
        for (const Binding& binding : options.bindings)
            if (!number_[i] && matches(binding.pattern, model.materials[i].name))
                number_[i] = binding.material;
    }
}

Index GraftedMaterials::of(std::uint32_t imported) {
    std::optional<Index>& number = number_[imported];
    if (!number) {
        Material material = lifted(model_.materials[imported]);
        number = static_cast<Index>(scene_.materials.size());
        scene_.materials.push_back(std::move(material));
    }
    return *number;
}

Spectrum GraftedMaterials::reflectance(const std::array<double, 3>& linearSrgb) {
    const auto known = lifted_.find(linearSrgb);
    if (known != lifted_.end()) return known->second;
    return lifted_.emplace(linearSrgb, resolver_.resolve(rgbText(linearSrgb), Role::reflectance, where_))
        .first->second;
}

Material GraftedMaterials::lifted(const ImportedMaterial& from) {
    Material material;
    material.name = uniqueName(from.name);
    material.where = where_;
    std::optional<TextureUse> colours;
    if (from.colours) colours = pictures_.use(*from.colours);
    if (from.metal && !colours) {
        material.specular = Specular{reflectance(*from.metal), from.roughness};
    } else {
        material.diffuse = Diffuse{};
        std::optional<double> ior = from.ior;
        if (colours) {
            // A metal has one colour here: with a picture it is taken as painted.
            if (from.metal) {
                pictures_.remark("material '" + from.name + "': a metal with a picture is shown as painted");
                ior = paintIndex;
            }
            colours->tint = from.tint;
            material.diffuse->texture = std::move(colours);
        } else {
            material.diffuse->reflectance = reflectance(from.diffuse);
        }
        if (ior) {
            // A model's colours are those that a surface shows, its gloss a highlight on top.
            material.diffuse->isSeenThroughCoat = true;
            material.gloss = Gloss{resolver_.resolve(shortest(*ior), Role::index, where_), from.roughness};
        }
    }
    if (from.normals)
        if (const auto normals = pictures_.use(*from.normals))
            material.relief = Relief{*normals, false, from.normals->amount};
    const double glow = luminanceShare(from.emissive);
    if (glow > 0) {
        const Amount amount{AmountUnit::candelaPerSquareMetre,
                            glow * (model_.photometric ? 1 : luminanceOfGlow), std::nullopt};
        material.emission = Emitter{colourOfLamp(from.emissive, resolver_, where_), amount, 1, where_};
    }
    return material;
}

std::string GraftedMaterials::uniqueName(const std::string& name) const {
    const auto taken = [&](const std::string& candidate) {
        return std::any_of(scene_.materials.begin(), scene_.materials.end(),
                           [&](const Material& m) { return m.name == candidate; });
    };
    if (name.empty() || !taken(name)) return name;
    int number = 2;
    while (taken(name + "." + std::to_string(number)))
        ++number;
    return name + "." + std::to_string(number);
}

void GraftedMaterials::warnOfIdleBindings(Notes& notes) const {
    std::vector<std::string> names;
    for (size_t i = 0; i < model_.materials.size(); ++i) {
        const std::string& name = model_.materials[i].name;
        const bool worn =
            std::find(model_.meshMaterial.begin(), model_.meshMaterial.end(), i) != model_.meshMaterial.end();
        if (worn || name != assimpsOwn) names.push_back(name);
    }
    for (const Binding& binding : options_.bindings) {
        if (std::any_of(names.begin(), names.end(),
                        [&](const std::string& n) { return matches(binding.pattern, n); }))
            continue;
        constexpr size_t most = 12;
        std::string list;
        for (size_t i = 0; i < std::min(names.size(), most); ++i)
            list += (i > 0 ? ", " : "") + names[i];
        if (names.size() > most) list += ", …";
        notes.warn(binding.where, "no material of the model matches '" + binding.pattern + "'" +
                                      didYouMean(binding.pattern, names) + " (there are: " + list + ")");
    }
}

}  // namespace spectrad
