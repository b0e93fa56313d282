#include "image/picture_light.h"

#include <fmt/format.h>

#include <cmath>

namespace spectrad {

namespace {

/// ITU-T H.273 (2021), tables 2 and 3.
enum Primaries : std::uint8_t { bt709 = 1, bt2020 = 9, p3Theatre = 11, p3D65 = 12 };

Display ofPrimaries(std::uint8_t code) {
    switch (code) {
        case bt709:
            return srgbDisplay();
        case bt2020:
            return rec2020Display();
        case p3D65:
            return p3Display();
        case p3Theatre:
            return displayFromPrimaries({{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}}}, {0.314, 0.351},
                                        Display::Transfer::gamma, 2.6);
        default:
            throw InputError(
                fmt::format("colour primaries {} of cICP are not known (allowed: 1, 9, 11, 12)", code));
    }
}

void takeTransfer(Display& display, std::uint8_t code) {
    const auto power = [&](double gamma) {
        display.transfer = Display::Transfer::gamma;
        display.gamma = gamma;
    };
    switch (code) {
        case 1:  // BT.709, BT.601 and BT.2020 with 10 and 12 bits share a curve
        case 6:
        case 14:
        case 15:
            display.transfer = Display::Transfer::rec2020;
            return;
        case 4:
            return power(2.2);
        case 5:
            return power(2.8);
        case 8:
            return power(1);
        case 13:
            display.transfer = Display::Transfer::srgb;
            return;
        default:
            throw InputError(fmt::format(
                "transfer characteristics {} of cICP are not known (allowed: 1, 4, 5, 6, 8, 13, 14, 15)",
                code));
    }
}

}  // namespace

Display displayOf(const PictureColour& colour) {
    Display display = srgbDisplay();
    if (colour.codes) {
        display = ofPrimaries((*colour.codes)[0]);
        takeTransfer(display, (*colour.codes)[1]);
    } else if (!colour.srgb) {
        if (const auto& xy = colour.chromaticities)
            display =
                displayFromPrimaries({{{(*xy)[2], (*xy)[3]}, {(*xy)[4], (*xy)[5]}, {(*xy)[6], (*xy)[7]}}},
                                     {(*xy)[0], (*xy)[1]}, Display::Transfer::srgb, 2.2);
        constexpr double ofSrgb = 1 / 0.45455, rounding = 1e-4;
        if (colour.gamma && std::abs(*colour.gamma - ofSrgb) > rounding) {
            display.transfer = Display::Transfer::gamma;
            display.gamma = *colour.gamma;
        }
    }
    return display;
}

PictureLight::PictureLight() : display_(srgbDisplay()), hasSrgbPrimaries_(true) {}

PictureLight::PictureLight(const PictureValues& picture, const std::string& file, const SourceLocation& where,
                           Notes& notes)
    : PictureLight() {
    const Display srgb = srgbDisplay();
    try {
        if (!picture.colour.codes && !picture.misread.empty()) throw InputError(picture.misread);
        if (!picture.colour.codes && !picture.profile.empty()) {
            profile_.emplace(picture.profile, picture.channels < 3 ? 1 : 3);
            toSrgb_ = srgb.fromXyz * adaptation(Adaptation::bradford, IccProfile::white(), srgb.white);
            hasSrgbPrimaries_ = false;
            return;
        }
        display_ = displayOf(picture.colour);
        toSrgb_ = srgb.fromXyz * adaptation(Adaptation::cat16, display_.white, srgb.white) * display_.toXyz;
        hasSrgbPrimaries_ = display_.name == srgb.name;
    } catch (const InputError& error) {
        *this = PictureLight();
        notes.warn(where, fmt::format("{}: {}: its colours are taken as sRGB", file, error.what()));
    }
}

Triple PictureLight::linearSrgb(const Triple& signals) const {
    if (profile_) {
        const Triple xyz = profile_->xyz(signals);
        if (!std::isfinite(xyz[0] + xyz[1] + xyz[2]))
            throw InputError("its ICC profile makes colours that are not finite");
        return toSrgb_ * xyz;
    }
    Triple linear{};
    for (size_t k = 0; k < 3; ++k)
        linear[k] = decode(display_, signals[k]);
    return hasSrgbPrimaries_ ? linear : toSrgb_ * linear;
}

}  // namespace spectrad
