// What a picture's numbers are as colours, by what its file says of them.
#pragma once

#include "base/error.h"
#include "colour/display.h"
#include "image/icc_profile.h"
#include "image/picture_values.h"

#include <optional>
#include <string>

namespace spectrad {

/// The display that a PNG's chunks describe: sRGB where they say nothing; the primaries and curves of ITU-T
/// H.273 that a reflectance can be in; else primaries, white and gamma. A gamma of 1 / 0.45455 is sRGB's
/// curve, whose nearest power programs write there. Throws InputError, a clause without a file's name.
[[nodiscard]] Display displayOf(const PictureColour& colour);

class PictureLight {
  public:
    /// sRGB, whatever the file says.
    PictureLight();
    /// As the file says; `file` and `where` are for a warning where that cannot be read and sRGB is taken.
    PictureLight(const PictureValues& picture, const std::string& file, const SourceLocation& where,
                 Notes& notes);

    /// Linear sRGB of signals 0 … 1, white (1, 1, 1), adapted to D65 (an ICC profile's by Bradford, as it was
    /// made; else by CAT16); beyond 0 … 1 for colours that sRGB lacks. Throws InputError,
    /// a clause without a file's name, where a profile makes what is not finite.
    [[nodiscard]] Triple linearSrgb(const Triple& signals) const;

  private:
    std::optional<IccProfile> profile_;  ///< instead of the display's primaries and curve
    Display display_;
    Matrix3 toSrgb_{};  ///< linear components of the display, or the profile's XYZ, to linear sRGB
    bool hasSrgbPrimaries_ = false;
};

}  // namespace spectrad
