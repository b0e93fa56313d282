#include "render/picture_maps.h"

#include "image/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    const Picture8 picture = pictureOf(use);
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
    const Picture8 picture = pictureOf(use);
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

Texels reliefMap(const Relief& relief) {
    const TextureUse& use = relief.map;
    if (relief.heights) {
        const Texels heights = strengthMap(use);
        Texels slopes{heights.width, heights.height, 2, {}};
        const auto within = [&use](int i, int count) {
            return use.repeat ? (i + count) % count : std::clamp(i, 0, count - 1);
        };
        const auto at = [&](int column, int row) {
            return double{heights.texels[static_cast<size_t>(within(row, heights.height)) *
                                             static_cast<size_t>(heights.width) +
                                         static_cast<size_t>(within(column, heights.width))]};
        };
        // Central differences; at a border that does not go on to the other side, between it and its
        // neighbour.
        const auto reach = [&use](int i, int count) {
            return use.repeat || (i > 0 && i + 1 < count) ? 2.0 : 1.0;
        };
        for (int row = 0; row < heights.height; ++row)
            for (int column = 0; column < heights.width; ++column) {
                const double right =
                                 (at(column + 1, row) - at(column - 1, row)) / reach(column, heights.width),
                             up = (at(column, row - 1) - at(column, row + 1)) / reach(row, heights.height);
                slopes.texels.push_back(static_cast<float>(right * heights.width * relief.amount));
                slopes.texels.push_back(static_cast<float>(up * heights.height * relief.amount));
            }
        return slopes;
    }
    const Picture8 picture = pictureOf(use);
    if (picture.channels < 3)
        throw InputError(
            use.where,
            use.source + ": a normal map has colours, this picture is grey (<bump> takes heights)");
    Texels map = emptyLike(picture, 3);
    for (size_t i = 0; i < picture.pixels.size(); i += static_cast<size_t>(picture.channels)) {
        const auto component = [&](size_t c) { return picture.pixels[i + c] / 127.5 - 1; };
        // Never below the surface.
        const double x = component(0) * relief.amount, y = component(1) * relief.amount,
                     z = std::max(component(2), 0.0), length = std::sqrt(x * x + y * y + z * z);
        for (double value : {x, y, z})
            map.texels.push_back(length > 0 ? static_cast<float>(value / length) : 0.0f);
    }
    return map;
}

}  // namespace spectrad
