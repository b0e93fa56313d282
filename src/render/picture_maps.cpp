#include "render/picture_maps.h"

#include "image/picture_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

Texels emptyLike(const PictureValues& picture, size_t bands) {
    Texels map;
    map.width = picture.width;
    map.height = picture.height;
    map.bands = static_cast<int>(bands);
    map.texels.reserve(static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height) * bands);
    return map;
}

/// Grey where the picture is, red, green and blue alike.
bool isGrey(const PictureValues& picture, const std::uint16_t* p) {
    return picture.channels < 3 || (p[0] == p[1] && p[1] == p[2]);
}

std::string place(const PictureValues& picture, size_t pixel) {
    return fmt::format("pixel {},{}", pixel % static_cast<size_t>(picture.width),
                       pixel / static_cast<size_t>(picture.width));
}

/// Throws InputError for colours.
PictureValues greysOf(const TextureUse& use) {
    PictureValues picture = valuesOf(use);
    const auto channels = static_cast<size_t>(picture.channels);
    for (size_t i = 0; i < picture.values.size(); i += channels)
        if (!isGrey(picture, picture.values.data() + i))
            throw InputError(use.where, fmt::format("{}: {} is coloured (a mask is grey)", use.source,
                                                    place(picture, i / channels)));
    return picture;
}

/// As #rrggbb counts among the choices; of 16 bits only what 8 can say.
std::optional<std::uint32_t> colourOf(std::uint16_t most, std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    const std::uint32_t step = most / 255u;  // 257 · v is v in 16 bits
    if (r % step != 0 || g % step != 0 || b % step != 0) return std::nullopt;
    return Select::colour | (r / step) << 16 | (g / step) << 8 | b / step;
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
    const PictureValues picture = greysOf(use);
    Texels map = emptyLike(picture, 1);
    for (size_t i = 0; i < picture.values.size(); i += static_cast<size_t>(picture.channels))
        map.texels.push_back(static_cast<float>(picture.values[i]) / static_cast<float>(picture.most));
    return map;
}

Texels shareMap(const Select& select) {
    const TextureUse& use = select.map;
    const PictureValues picture = valuesOf(use);
    const auto channels = static_cast<size_t>(picture.channels);
    const bool coloured = select.isColoured();
    const int digits = picture.most == 255 ? 2 : 4;
    Texels map = emptyLike(picture, select.choices.size());
    std::vector<float> shares(select.choices.size());
    for (size_t i = 0; i < picture.values.size(); i += channels) {
        const std::uint16_t* p = picture.values.data() + i;
        const bool grey = isGrey(picture, p);
        const std::uint16_t g = grey ? p[0] : p[1], b = grey ? p[0] : p[2];
        const std::optional<std::uint32_t> value = coloured ? colourOf(picture.most, p[0], g, b) : p[0];
        const bool known = value && std::any_of(select.choices.begin(), select.choices.end(),
                                                [&](const Select::Choice& c) { return c.value == *value; });
        if ((!grey && !coloured) || (!known && !select.mix))
            throw InputError(
                use.where,
                fmt::format(
                    "{}: {} is {}, which no <choose> stands for{}", use.source, place(picture, i / channels),
                    coloured || !grey ? fmt::format("#{0:0{3}x}{1:0{3}x}{2:0{3}x}", p[0], g, b, digits)
                                      : fmt::format("{}", p[0]),
                    coloured || !grey ? "" : " (values=\"mix\" takes values between two choices)"));
        std::fill(shares.begin(), shares.end(), 0.0f);
        const auto [choice, further] = between(select, *value);
        shares[choice] = 1.0f - further;
        if (further > 0) shares[choice + 1] = further;
        map.texels.insert(map.texels.end(), shares.begin(), shares.end());
    }
    return map;
}

Texels reliefMap(const Relief& relief) {
    const TextureUse& use = relief.map;
    if (relief.heights) {
        // Slopes are differences of whole numbers: as floats, heights would lose what 16 bits tell apart.
        const PictureValues heights = greysOf(use);
        const double depth = relief.amount / heights.most;
        Texels slopes{heights.width, heights.height, 2, {}};
        const auto within = [&use](int i, int count) {
            return use.repeat ? (i + count) % count : std::clamp(i, 0, count - 1);
        };
        const auto at = [&](int column, int row) {
            const size_t texel =
                static_cast<size_t>(within(row, heights.height)) * static_cast<size_t>(heights.width) +
                static_cast<size_t>(within(column, heights.width));
            return static_cast<double>(heights.values[texel * static_cast<size_t>(heights.channels)]);
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
                slopes.texels.push_back(static_cast<float>(right * heights.width * depth));
                slopes.texels.push_back(static_cast<float>(up * heights.height * depth));
            }
        return slopes;
    }
    const PictureValues picture = valuesOf(use);
    if (picture.channels < 3)
        throw InputError(
            use.where,
            use.source + ": a normal map has colours, this picture is grey (<bump> takes heights)");
    Texels map = emptyLike(picture, 3);
    for (size_t i = 0; i < picture.values.size(); i += static_cast<size_t>(picture.channels)) {
        const auto component = [&](size_t c) { return picture.values[i + c] / (picture.most / 2.0) - 1; };
        // Never below the surface.
        const double x = component(0) * relief.amount, y = component(1) * relief.amount,
                     z = std::max(component(2), 0.0), length = std::sqrt(x * x + y * y + z * z);
        for (double value : {x, y, z})
            map.texels.push_back(length > 0 ? static_cast<float>(value / length) : 0.0f);
    }
    return map;
}

}  // namespace spectrad
