#include "viewer/picture_place.h"

#include <algorithm>
#include <cmath>

namespace spectrad::view {

namespace {

constexpr std::uint32_t surround = 0xff1f1c1c;  // 0xAABBGGRR, as Canvas clears its frame

}  // namespace

void PicturePlace::fit(int pictureWidth, int pictureHeight, int frameWidth, int frameHeight) {
    width_ = pictureWidth;
    height_ = pictureHeight;
    frameWidth_ = frameWidth;
    frameHeight_ = frameHeight;
    if (byHand_) return;
    scale_ = std::min(static_cast<double>(frameWidth) / width_, static_cast<double>(frameHeight) / height_);
    if (scale_ > 1) scale_ = std::floor(scale_);  // pixels of one size
    left_ = std::floor(0.5 * (frameWidth - scale_ * width_));
    top_ = std::floor(0.5 * (frameHeight - scale_ * height_));
}

void PicturePlace::move(double right, double down) {
    left_ += right;
    top_ += down;
    byHand_ = true;
}

void PicturePlace::zoom(double factor, double x, double y) {
    constexpr double least = 1.0 / 1024, most = 256;
    const double next = std::clamp(scale_ * factor, least, most);
    left_ = x - (x - left_) * next / scale_;
    top_ = y - (y - top_) * next / scale_;
    scale_ = next;
    byHand_ = true;
}

std::array<int, 2> PicturePlace::pixelAt(int x, int y) const {
    // A place far outside is none, whatever the number.
    const auto along = [&](int at, double from) {
        return static_cast<int>(std::clamp(std::floor((at + 0.5 - from) / scale_), -1.0, 1e9));
    };
    return {along(x, left_), along(y, top_)};
}

void PicturePlace::compose(const Codes& picture, Codes& frame) const {
    const auto across = static_cast<size_t>(frameWidth_);
    frame.assign(across * static_cast<size_t>(frameHeight_), surround);
    std::vector<int> column(across);
    for (int x = 0; x < frameWidth_; ++x)
        column[static_cast<size_t>(x)] = pixelAt(x, 0)[0];
    for (int y = 0; y < frameHeight_; ++y) {
        const int from = pixelAt(0, y)[1];
        if (from < 0 || from >= height_) continue;
        const std::uint32_t* source =
            picture.data() + static_cast<size_t>(from) * static_cast<size_t>(width_);
        std::uint32_t* target = frame.data() + static_cast<size_t>(y) * across;
        for (size_t x = 0; x < across; ++x)
            if (column[x] >= 0 && column[x] < width_) target[x] = source[column[x]];
    }
}

}  // namespace spectrad::view
