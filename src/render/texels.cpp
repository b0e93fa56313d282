#include "render/texels.h"

#include "render/resident.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spectrad {

namespace {

/// Which texels of a row of `from` one of a row of `to` covers, and with which shares.
struct Cover {
    int first = 0;
    std::vector<double> share;
};
std::vector<Cover> covers(int from, int to) {
    std::vector<Cover> all;
    for (int i = 0; i < to; ++i) {
        const double begin = static_cast<double>(i) * from / to, end = static_cast<double>(i + 1) * from / to;
        Cover cover;
        cover.first = static_cast<int>(begin);
        for (int k = cover.first; k < end; ++k)
            cover.share.push_back((std::min<double>(k + 1, end) - std::max<double>(k, begin)) /
                                  (end - begin));
        all.push_back(std::move(cover));
    }
    return all;
}

/// u' = place[0] u + place[1] v + place[2], v' likewise.
std::array<float, 6> placeOf(const TextureUse& use) {
    const double angle = use.rotateDegrees * std::numbers::pi / 180;
    // Quarter turns are exact.
    const bool quarters = std::fmod(use.rotateDegrees, 90) == 0;
    const double c = quarters ? std::round(std::cos(angle)) : std::cos(angle),
                 s = quarters ? std::round(std::sin(angle)) : std::sin(angle);
    const std::array<double, 6> place{c * use.scale[0], -s * use.scale[1], use.offset[0],
                                      s * use.scale[0], c * use.scale[1],  use.offset[1]};
    std::array<float, 6> result{};
    std::transform(place.begin(), place.end(), result.begin(),
                   [](double v) { return static_cast<float>(v); });
    return result;
}

bool placedAsIs(const sd_texture& t) {
    constexpr std::array<float, 6> still{1, 0, 0, 0, 1, 0};
    return t.wrap == SD_CLAMP && std::equal(still.begin(), still.end(), t.place);
}

/// An image of one level; where its texels are is said later.
sd_texture entryFor(const TextureUse& use, int width, int height, int bands) {
    sd_texture t{};
    t.width = width;
    t.height = height;
    t.bands = bands;
    t.filter = use.filter == TextureFilter::nearest ? SD_NEAREST
               : use.filter == TextureFilter::mip   ? SD_MIP
                                                    : SD_BILINEAR;
    t.wrap = use.repeat ? SD_REPEAT : SD_CLAMP;
    t.levels = 1;
    const std::array<float, 6> place = placeOf(use);
    std::copy(place.begin(), place.end(), t.place);
    return t;
}

}  // namespace

Texels halved(const Texels& image) {
    Texels half;
    half.width = std::max(image.width / 2, 1);
    half.height = std::max(image.height / 2, 1);
    half.bands = image.bands;
    half.texels.reserve(static_cast<size_t>(half.width) * static_cast<size_t>(half.height) *
                        static_cast<size_t>(half.bands));
    const std::vector<Cover> columns = covers(image.width, half.width),
                             rows = covers(image.height, half.height);
    std::vector<double> sum(static_cast<size_t>(image.bands));
    for (const Cover& row : rows) {
        for (const Cover& column : columns) {
            std::fill(sum.begin(), sum.end(), 0.0);
            for (size_t r = 0; r < row.share.size(); ++r) {
                for (size_t c = 0; c < column.share.size(); ++c) {
                    const double share = row.share[r] * column.share[c];
                    const float* texel = image.texels.data() + ((static_cast<size_t>(row.first) + r) *
                                                                    static_cast<size_t>(image.width) +
                                                                static_cast<size_t>(column.first) + c) *
                                                                   sum.size();
                    for (size_t b = 0; b < sum.size(); ++b)
                        sum[b] += share * static_cast<double>(texel[b]);
                }
            }
            for (double value : sum)
                half.texels.push_back(static_cast<float>(value));
        }
    }
    return half;
}

std::uint32_t addTexels(World& world, Texels image, const TextureUse& use) {
    sd_texture t = entryFor(use, image.width, image.height, image.bands);
    t.first = world.texels.size();
    world.texels.insert(world.texels.end(), image.texels.begin(), image.texels.end());
    while (t.filter == SD_MIP && (image.width > 1 || image.height > 1)) {
        image = halved(image);
        world.texels.insert(world.texels.end(), image.texels.begin(), image.texels.end());
        ++t.levels;
    }
    world.textures.push_back(t);
    return static_cast<std::uint32_t>(world.textures.size());
}

std::uint32_t addResident(World& world, std::shared_ptr<const ResidentTexels> image, const TextureUse& use) {
    sd_texture t = entryFor(use, image->width, image->height, static_cast<int>(image->nm.size()));
    if (t.filter == SD_MIP) t.levels = image->levels;
    world.textures.push_back(t);
    world.resident.push_back({world.textures.size() - 1, std::move(image)});
    return static_cast<std::uint32_t>(world.textures.size());
}

const ResidentTexels* residentOf(const World& world, std::uint32_t number) {
    const auto found =
        std::find_if(world.resident.begin(), world.resident.end(),
                     [&](const World::Resident& part) { return part.texture + 1 == size_t{number}; });
    return found == world.resident.end() ? nullptr : found->texels.get();
}

std::vector<float> finestLevel(const World& world, std::uint32_t number) {
    if (const ResidentTexels* resident = residentOf(world, number)) return resident->read(1);
    const sd_texture& t = world.textures[number - 1];
    const auto first = world.texels.begin() + static_cast<std::ptrdiff_t>(t.first);
    return {first, first + std::ptrdiff_t{t.width} * t.height * t.bands};
}

float largestTexel(const World& world, std::uint32_t number) {
    if (const ResidentTexels* resident = residentOf(world, number)) return largestOn(*resident);
    if (world.texels.empty()) return 0;
    const sd_texture& t = world.textures[number - 1];
    const auto first = world.texels.begin() + static_cast<std::ptrdiff_t>(t.first);
    return *std::max_element(first, first + std::ptrdiff_t{t.width} * t.height * t.bands);
}

void fetchTexels(World& world) {
    for (const World::Resident& part : world.resident) {
        sd_texture& t = world.textures[part.texture];
        t.first = world.texels.size();
        const std::vector<float> texels = part.texels->read(t.levels);
        world.texels.insert(world.texels.end(), texels.begin(), texels.end());
    }
    world.resident.clear();
}

std::vector<std::string> textureDefines(const World& world) {
    std::vector<std::string> defines;
    if (world.textures.empty()) return defines;
    defines.emplace_back("HAS_TEXTURE");
    const auto any = [](const auto& all, auto&& wanted) {
        return std::any_of(all.begin(), all.end(), wanted);
    };
    if (any(world.textures, [](const sd_texture& t) { return t.levels > 1; }))
        defines.emplace_back("HAS_MIP");
    if (any(world.textures, [](const sd_texture& t) { return !placedAsIs(t); }))
        defines.emplace_back("HAS_TEXTURE_PLACE");
    if (any(world.materials, [](const sd_material& m) { return m.relief != 0; }))
        defines.emplace_back("HAS_RELIEF");
    if (any(world.lobes, [](const sd_lobe& lobe) { return lobe.texture != 0 && lobe.inside != 0; }))
        defines.emplace_back("HAS_TEXTURE_CURVE");
    return defines;
}

}  // namespace spectrad
