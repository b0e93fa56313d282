// Images that attributes name: cubes, pictures, passes; how they lie on surfaces; pictures that choose
// spectra.
#include "base/text.h"
#include "scene/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace spectrad {

namespace {

TextureFilter readFilter(const Element& element) {
    return element.choice<TextureFilter>("filter",
                                         {{"bilinear", TextureFilter::bilinear},
                                          {"nearest", TextureFilter::nearest},
                                          {"mip", TextureFilter::mip}},
                                         TextureFilter::bilinear);
}

/// How an image lies on texture coordinates.
TextureUse readSampling(const Element& element, const char* attribute) {
    TextureUse use;
    use.where = element.where(attribute);
    use.filter = readFilter(element);
    use.repeat = element.choice<bool>("wrap", {{"clamp", false}, {"repeat", true}}, false);
    if (element.has("offset")) {
        const std::vector<double> offset = element.numbers("offset", {2});
        use.offset = {offset[0], offset[1]};
    }
    if (element.has("scale")) {
        const std::vector<double> scale = element.numbers("scale", {1, 2});
        use.scale = {scale.front(), scale.back()};
        if (use.scale[0] == 0 || use.scale[1] == 0)
            element.fail("scale", "makes the whole image one point (allowed: numbers other than 0)");
    }
    use.rotateDegrees = element.number("rotate", 0);
    return use;
}

/// A value of a picture: 0…255 (0…65535 of 16 bits) of a grey one, #rrggbb of a coloured one.
std::uint32_t readPictureValue(const Element& element) {
    const std::string text = element.text("value");
    if (!startsWith(text, "#")) return static_cast<std::uint32_t>(element.integer("value", 0, 0, 65535));
    std::uint32_t rgb = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), rgb, 16);
    if (text.size() != 7 || error != std::errc() || end != text.data() + text.size())
        element.fail("value", "is no colour (allowed: 0 to 255, of 16 bits 0 to 65535, or #rrggbb)");
    return Select::colour | rgb;
}

}  // namespace

void refuseSampling(const Element& element, const std::string& why) {
    for (const char* attribute : {"filter", "wrap", "offset", "scale", "rotate"})
        element.refuse(attribute, why);
}

TextureUse readPicture(Reading& reading, const Element& element, const char* attribute) {
    TextureUse use = readSampling(element, attribute);
    use.source = reading.file(element, attribute).string();
    if (!use.source.ends_with(".png")) element.fail(attribute, "is not a picture (allowed: *.png)");
    return use;
}

TextureUse readTexture(Reading& reading, const Element& element, TextureRole role, const char* attribute) {
    TextureUse use;
    if (role == TextureRole::reflectance)
        use = readSampling(element, attribute);
    else if (element.has("texture"))
        use.filter = readFilter(element);  // scale= is the radiance's factor there
    use.role = role;
    use.where = element.where(attribute);
    use.source = element.text(attribute);
    if (!use.isPass()) use.source = reading.file(element, attribute).string();
    return use;
}

Select readSelect(Reading& reading, const Element& element) {
    Select select;
    select.map = readPicture(reading, element, "select");
    select.mix = element.choice<bool>("values", {{"pick", false}, {"mix", true}}, false);
    for (const pugi::xml_node node : element.node().children("choose")) {
        const Element choice(element.document(), node);
        select.choices.push_back({readPictureValue(choice),
                                  reading.spectrum(choice, "reflectance", Role::reflectance),
                                  choice.where()});
        if (select.mix && select.isColoured())
            choice.fail("value",
                        "is a colour, and colours have nothing between them (values=\"mix\" takes greys)");
    }
    if (select.choices.empty()) element.fail("'select' needs a <choose> for each value of the picture");
    std::stable_sort(select.choices.begin(), select.choices.end(),
                     [](const Select::Choice& a, const Select::Choice& b) { return a.value < b.value; });
    for (size_t i = 1; i < select.choices.size(); ++i)
        if (select.choices[i].value == select.choices[i - 1].value)
            throw InputError(select.choices[i].where, "a second <choose> for the same value");
    if (select.isColoured() && select.choices.front().value < Select::colour)
        throw InputError(select.choices.front().where,
                         "values are greys in one <choose> and colours in another (a picture has one kind)");
    return select;
}

}  // namespace spectrad
