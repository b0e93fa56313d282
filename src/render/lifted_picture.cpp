#include "render/lifted_picture.h"

#include "base/parallel.h"
#include "spectrum/lift.h"
#include "spectrum/wavelengths.h"

#include <algorithm>
#include <unordered_map>

namespace spectrad {

namespace {

constexpr size_t part = 1024;  // colours, or texels, that a thread takes at a time

size_t partsOf(size_t count) {
    return (count + part - 1) / part;
}

/// A picture's colours, each once, and which of them each texel has.
struct Palette {
    std::vector<Triple> signals;  ///< 0 … 1
    std::vector<std::uint32_t> ofTexel;
};

Palette paletteOf(const PictureValues& picture) {
    Palette palette;
    const auto channels = static_cast<size_t>(picture.channels);
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    palette.ofTexel.reserve(picture.values.size() / channels);
    for (size_t i = 0; i < picture.values.size(); i += channels) {
        const std::uint16_t* p = picture.values.data() + i;
        const std::uint64_t r = p[0], g = channels < 3 ? r : p[1], b = channels < 3 ? r : p[2];
        const auto [found, isNew] =
            known.try_emplace(r << 32 | g << 16 | b, static_cast<std::uint32_t>(palette.signals.size()));
        if (isNew)
            palette.signals.push_back({static_cast<double>(r) / picture.most,
                                       static_cast<double>(g) / picture.most,
                                       static_cast<double>(b) / picture.most});
        palette.ofTexel.push_back(found->second);
    }
    return palette;
}

}  // namespace

LiftedPicture liftPicture(const PictureValues& picture, const PictureLight& light,
                          const std::array<double, 3>& tint, const Library& library) {
    const Palette palette = paletteOf(picture);
    LiftedPicture lifted;
    SpectralTexture& texture = lifted.texture;
    texture.width = picture.width;
    texture.height = picture.height;
    texture.nm = regularWavelengths(380, 780, 10, {}).nm;
    lifted.colours = palette.signals.size();
    std::vector<float> curves(lifted.colours * liftedBands);
    std::vector<double> missed(lifted.colours);
    const ColourLift lift(library, texture.nm);
    inParallel(partsOf(lifted.colours), [&](size_t number) {
        for (size_t i = number * part; i < std::min((number + 1) * part, lifted.colours); ++i) {
            Triple rgb = light.linearSrgb(palette.signals[i]);
            for (size_t k = 0; k < 3; ++k)
                rgb[k] *= tint[k];
            const ColourLift::Nearest nearest = lift.fitNearest(rgb);
            missed[i] = nearest.missed;
            for (size_t t = 0; t < liftedBands; ++t)
                curves[i * liftedBands + t] = static_cast<float>(nearest.colour.at(texture.nm[t]));
        }
    });
    constexpr double visible = 0.5;
    for (const double difference : missed) {
        lifted.missed += difference > visible;
        lifted.farthest = std::max(lifted.farthest, difference);
    }
    texture.texels.resize(palette.ofTexel.size() * liftedBands);
    inParallel(partsOf(palette.ofTexel.size()), [&](size_t number) {
        for (size_t i = number * part; i < std::min((number + 1) * part, palette.ofTexel.size()); ++i)
            std::copy_n(curves.begin() + static_cast<std::ptrdiff_t>(palette.ofTexel[i] * liftedBands),
                        liftedBands, texture.texels.begin() + static_cast<std::ptrdiff_t>(i * liftedBands));
    });
    return lifted;
}

}  // namespace spectrad
