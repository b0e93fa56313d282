// Where in an image a pixel is.
#pragma once

namespace spectrad {

struct PixelPlace {
    int x = 0, y = 0;  ///< (0,0) top left
    [[nodiscard]] bool operator==(const PixelPlace&) const = default;
};

}  // namespace spectrad
