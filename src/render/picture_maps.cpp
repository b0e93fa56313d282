#include "render/picture_maps.h"

#include "image/picture.h"

#include <fmt/format.h>

#include <algorithm>

namespace spectrad {

namespace {

Texels emptyLike(const Picture8& picture, size_t bands) {
    Texels map;
    map.width = picture.width;
    map.height = picture.height;
    map.bands = static_cast<int>(bands);
    map.texels.reserve(static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height) * bands);
    return map;
}

/// Grey where the picture is, red, green and blue alike.
bool isGrey(const Picture8& picture, const std::uint8_t* p) {
    return picture.channels < 3 || (p[0] == p[1] && p[1] == p[2]);
}

std::string place(const Picture8& picture, size_t pixel) {
    return fmt::format("pixel {},{}", pixel % static_cast<size_t>(picture.width),
                       pixel / static_cast<size_t>(picture.width));
}

/// The choice of a value, and how far it is to the next one.
std::pair<size_t, float> between(const Select& select, std::uint32_t value) {
    const auto& choices = select.choices;
    const auto above = std::find_if(choices.begin(), choices.end(),
                                    [&](const Select::Choice& c) { return c.value >= value; });
    if (above == choices.end()) return {choices.size() - 1, 0.0f};
    const auto i = static_cast<size_t>(above - choices.begin());
    if (above->value == value || i == 0) return {i, 0.0f};
    const std::uint32_t below = choices[i - 1].value;
    return {i - 1, static_cast<float>(value - below) / static_cast<float>(above->value - below)};
}

}  // namespace

Texels strengthMap(const TextureUse& use) {
    const Picture8 picture = readPng(use.source);
    Texels map = emptyLike(picture, 1);
    const auto channels = static_cast<size_t>(picture.channels);
    for (size_t i = 0; i < picture.pixels.size(); i += channels) {
        if (!isGrey(picture, picture.pixels.data() + i))
            throw InputError(use.where, fmt::format("{}: {} is coloured (a mask is grey)", use.source,
                                                    place(picture, i / channels)));
        map.texels.push_back(static_cast<float>(picture.pixels[i]) / 255.0f);
    }
    return map;
}

Texels shareMap(const Select& select) {
    const TextureUse& use = select.map;
    const Picture8 picture = readPng(use.source);
    const auto channels = static_cast<size_t>(picture.channels);
    const bool coloured = select.choices.back().value > 255;
    Texels map = emptyLike(picture, select.choices.size());
    std::vector<float> shares(select.choices.size());
    for (size_t i = 0; i < picture.pixels.size(); i += channels) {
        const std::uint8_t* p = picture.pixels.data() + i;
        const bool grey = isGrey(picture, p);
        const std::uint32_t rgb =
            grey ? 0x10101u * p[0] : static_cast<std::uint32_t>(p[0] << 16 | p[1] << 8 | p[2]);
        const std::uint32_t value = coloured ? 0x1000000u | rgb : p[0];
        const bool known = std::any_of(select.choices.begin(), select.choices.end(),
                                       [&](const Select::Choice& c) { return c.value == value; });
        if ((!grey && !coloured) || (!known && !select.mix))
            throw InputError(
                use.where,
                fmt::format("{}: {} is {}, which no <choose> stands for{}", use.source,
                            place(picture, i / channels),
                            coloured || !grey ? fmt::format("#{:06x}", rgb) : fmt::format("{}", value),
                            coloured || !grey ? "" : " (values=\"mix\" takes values between two choices)"));
        std::fill(shares.begin(), shares.end(), 0.0f);
        const auto [choice, further] = between(select, value);
        shares[choice] = 1.0f - further;
        if (further > 0) shares[choice + 1] = further;
        map.texels.insert(map.texels.end(), shares.begin(), shares.end());
    }
    return map;
}

}  // namespace spectrad
