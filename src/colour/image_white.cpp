#include "colour/image_white.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>

namespace spectrad {

namespace {

constexpr const char* ofImage = "image";

White meanOf(const ChannelImage& image) {
    Triple mean{};
    for (size_t k = 0; k < 3; ++k)
        for (const double value : image.plane[k])
            mean[k] += value / static_cast<double>(image.pixels());
    if (!(mean[1] > 0)) throw InputError("the white 'image' is the mean of a black image");
    return {ofImage, {mean[0] / mean[1], 1, mean[2] / mean[1]}, false};
}

}  // namespace

bool isPlace(const std::string& white) {
    return startsWith(white, "at:");
}

bool isOfImage(const std::string& white) {
    return white == ofImage || isPlace(white);
}

White whiteOfImage(const std::string& white, const ChannelImage& xyz) {
    if (white == ofImage) return meanOf(xyz);
    const std::vector<std::string_view> place = split(std::string_view(white).substr(3), ',');
    const auto x = parseInteger(place[0]), y = place.size() == 2 ? parseInteger(place[1]) : std::nullopt;
    if (!x || !y) throw UsageError("--white: '" + white + "' is not at:X,Y in pixels, (0,0) top left");
    constexpr long long beyond = 1 << 30;  // outside every image, and inside int
    return whiteAt(xyz, static_cast<int>(std::clamp(*x, -1LL, beyond)),
                   static_cast<int>(std::clamp(*y, -1LL, beyond)));
}

}  // namespace spectrad
