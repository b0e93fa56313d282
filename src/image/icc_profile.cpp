#include "image/icc_profile.h"

#include "base/error.h"

#include <lcms2.h>

namespace spectrad {

namespace {

std::shared_ptr<void> closing(cmsHPROFILE profile) {
    return {profile, [](void* p) {
                if (p) cmsCloseProfile(p);
            }};
}

}  // namespace

IccProfile::IccProfile(const std::string& bytes, int channels) {
    const std::shared_ptr<void> from =
        closing(cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
    if (!from) throw InputError("its ICC profile is damaged");
    const bool grey = channels == 1;
    if (cmsGetColorSpace(from.get()) != (grey ? cmsSigGrayData : cmsSigRgbData))
        throw InputError(grey ? "its ICC profile is not for grey pictures"
                              : "its ICC profile is not for pictures in red, green and blue");
    const std::shared_ptr<void> to = closing(cmsCreateXYZProfile());
    // No cache: it would be written to by every thread.
    transform_ = {cmsCreateTransform(from.get(), grey ? TYPE_GRAY_DBL : TYPE_RGB_DBL, to.get(), TYPE_XYZ_DBL,
                                     INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE),
                  [](void* p) {
                      if (p) cmsDeleteTransform(p);
                  }};
    if (!transform_) throw InputError("its ICC profile does not say what its colours are");
}

std::array<double, 3> IccProfile::xyz(const std::array<double, 3>& signals) const {
    std::array<double, 3> xyz{};
    cmsDoTransform(transform_.get(), signals.data(), xyz.data(), 1);
    return xyz;
}

std::array<double, 3> IccProfile::white() {
    return {cmsD50_XYZ()->X, cmsD50_XYZ()->Y, cmsD50_XYZ()->Z};
}

}  // namespace spectrad
