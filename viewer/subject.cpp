#include "viewer/subject.h"

namespace spectrad::view {

void encodeCodes(const ChannelImage& xyz, const Shown& shown, Codes& codes) {
    const Encoder8 encoder(shown.display);
    codes.resize(xyz.pixels());
    for (size_t i = 0; i < codes.size(); ++i) {
        const ShownSignals pixel =
            shownSignals(shown.toSignals * xyz.triple(i), shown.display, shown.tone, shown.gamut);
        const std::uint32_t alpha = pixel.below || pixel.above ? 254u : 255u;
        codes[i] = alpha << 24 | std::uint32_t{encoder(pixel.signals[2])} << 16 |
                   std::uint32_t{encoder(pixel.signals[1])} << 8 | encoder(pixel.signals[0]);
    }
}

}  // namespace spectrad::view
