// Where a picture of its own size lies in the frame: whole, or nearer and moved by hand.
#pragma once

#include "viewer/subject.h"

#include <array>

namespace spectrad::view {

class PicturePlace {
  public:
    /// Sizes in pixels; the whole picture is in sight until somebody has moved it.
    void fit(int pictureWidth, int pictureHeight, int frameWidth, int frameHeight);
    void reset() { byHand_ = false; }
    void move(double right, double down);
    /// Nearer by `factor`, the frame's (x, y) stays where it is.
    void zoom(double factor, double x, double y);

    /// The pixel of the picture at one of the frame, perhaps outside the picture.
    [[nodiscard]] std::array<int, 2> pixelAt(int x, int y) const;
    /// Where a pixel's centre lies in the frame.
    [[nodiscard]] std::array<double, 2> frameOf(int x, int y) const {
        return {left_ + (x + 0.5) * scale_, top_ + (y + 0.5) * scale_};
    }
    /// The frame with the picture in it, nearest pixels, dark grey around it.
    void compose(const Codes& picture, Codes& frame) const;
    [[nodiscard]] double scale() const { return scale_; }

  private:
    int width_ = 0, height_ = 0, frameWidth_ = 0, frameHeight_ = 0;
    double scale_ = 1;           ///< pixels of the frame for one of the picture
    double left_ = 0, top_ = 0;  ///< of the picture in the frame
    bool byHand_ = false;
};

}  // namespace spectrad::view
