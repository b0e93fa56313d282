// Degree of adaptation, tone and gamut; displays by spectra.
#include "colour/rendering.h"

#include "colour/spectral_display.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;
using Catch::Contains;

namespace {

ChannelImage pixel(const Triple& xyz) {
    ChannelImage image(1, 1, 3);
    for (size_t k = 0; k < 3; ++k)
        image.plane[k][0] = xyz[k];
    return image;
}

Rendering neutral() {
    Rendering rendering;
    rendering.base.white = {"D65", srgbDisplay().white, true};
    return rendering;
}

Triple signalOf(const Triple& xyz, const Rendering& rendering) {
    return render(pixel(xyz), rendering).signals.triple(0);
}

}  // namespace

TEST_CASE("Complete adaptation gives the published corresponding colours") {
    // The example of colour-science's documentation, D65 to D50.
    const Triple xyz{0.20654008, 0.12197225, 0.05136952}, d65{0.95045593, 1, 1.08905775},
        d50{0.96429568, 1, 0.82510460};
    const Triple bradford = adaptation(Adaptation::bradford, d65, d50) * xyz,
                 cat16 = adaptation(Adaptation::cat16, d65, d50) * xyz;
    const Triple wantedBradford{0.21666003, 0.12604777, 0.03855068},
        wantedCat16{0.21199326, 0.12236993, 0.03810008};
    for (size_t k = 0; k < 3; ++k) {
        CHECK(bradford[k] == Approx(wantedBradford[k]).epsilon(1e-6));
        CHECK(cat16[k] == Approx(wantedCat16[k]).epsilon(1e-6));
    }
}

TEST_CASE("A degree D of adaptation scales cone responses by D times the complete gain plus 1 - D") {
    Rendering rendering;
    rendering.base.white = {"A", {1.0985, 1, 0.35585}, true};
    const Matrix3 none = [&] {
        Rendering r = rendering;
        r.degree = 0;
        return renderingMatrix(r, 1);
    }();
    const Matrix3 whole = renderingMatrix(rendering, 1);
    rendering.degree = 0.3;
    const Matrix3 part = renderingMatrix(rendering, 1);
    // CAT16's cones of a colour, by its own matrix (Li et al. 2017).
    const Matrix3 cones{
        {{0.401288, 0.650173, -0.051461}, {-0.250268, 1.204414, 0.045854}, {-0.002079, 0.048952, 0.953127}}};
    const Triple colour{0.4, 0.3, 0.1};
    const Matrix3 toCones = cones * rendering.base.display.toXyz;
    const Triple before = toCones * (none * colour), after = toCones * (whole * colour),
                 middle = toCones * (part * colour);
    for (size_t k = 0; k < 3; ++k)
        CHECK(middle[k] / before[k] == Approx(0.3 * after[k] / before[k] + 0.7).epsilon(1e-9));
}

TEST_CASE("Reinhard's curve shows four times white as white, keeps black and the order of luminances") {
    Rendering rendering = neutral();
    rendering.tone = Tone::reinhard;
    const Triple white = srgbDisplay().white;
    const auto grey = [&](double y) { return signalOf({white[0] * y, y, white[2] * y}, rendering)[1]; };
    CHECK(grey(4) == Approx(1).epsilon(1e-6));
    CHECK(grey(0) == 0);
    CHECK(grey(1) == Approx((1 + 1 / 16.0) / 2).epsilon(1e-6));
    for (double y = 0.1; y < 4; y += 0.3)
        CHECK(grey(y) < grey(y + 0.3));
}

TEST_CASE("Desaturation brings a colour into the display at its own luminance; clipping does not keep it") {
    Rendering rendering = neutral();
    const Display display = srgbDisplay();
    const Triple xyz = display.toXyz * Triple{-0.2, 0.6, 0.3};  // a cyan that sRGB lacks
    const double y = xyz[1];
    const RenderedPicture clipped = render(pixel(xyz), rendering);
    CHECK(clipped.picture.clipped == 1);
    CHECK(clipped.map[0] == 0);
    CHECK(clipped.map[2] == 255);  // below 0: blue
    rendering.gamut = GamutMapping::desaturate;
    const Triple signal = signalOf(xyz, rendering);
    CHECK((display.toXyz * signal)[1] == Approx(y).epsilon(1e-9));
    CHECK(signal[0] == Approx(0).margin(1e-12));
    CHECK((display.toXyz * clipped.signals.triple(0))[1] > y * 1.02);
}

TEST_CASE("What the display can show is developed as without the choices, pixel for pixel") {
    const ChannelImage image = pixel(srgbDisplay().toXyz * Triple{0.2, 0.5, 0.7});
    const Rendering rendering = neutral();
    CHECK(render(image, rendering).picture.rgb == develop(image, rendering.base).rgb);
    CHECK_THROWS_WITH(parseTone("filmic"), Contains("reinhard"));
    CHECK_THROWS_WITH(parseGamutMapping("desaturat"), Contains("desaturate"));
}

TEST_CASE(
    "A display's spectra give its primaries to each observer, and what matches for one does not for "
    "another") {
    const Library library = Library::open();
    const SpectralDisplay lcd = spectralDisplay(library.find("displays/lcd-apple-studio").value());
    const Detector two = standardObserver(library),
                   ten = detectorFrom(library.find("observers/cie1964-10").value());
    const Display seen = lcd.seenBy(two), other = lcd.seenBy(ten);
    CHECK(seen.white[1] == Approx(1).epsilon(1e-12));
    for (size_t p = 0; p < 3; ++p) {
        const std::array<const Curve*, 1> light{&lcd.primaries[p]};
        const auto direct = *chromaticity(respondXyz(two, light));
        const auto column = *chromaticity({seen.toXyz[0][p], seen.toXyz[1][p], seen.toXyz[2][p]});
        CHECK(column[0] == Approx(direct[0]).epsilon(1e-12));
        CHECK(column[1] == Approx(direct[1]).epsilon(1e-12));
    }
    // The display's own light as a scene: what both see is what the display shows, so nothing differs.
    ChannelImage signals(1, 1, 3);
    signals.plane = {{0.3}, {0.6}, {0.2}};
    const Triple own = other.toXyz * signals.triple(0);
    CHECK(displayMetamerism(signals, other, pixel(own)).max < 1e-9);
    // A daylight of the display's white for the 2° observer, seen by the 10° one.
    const Curve light = library.find("illuminants/D65")->curve();
    const std::array<const Curve*, 1> day{&light};
    const Triple forTwo = respondXyz(two, day), forTen = respondXyz(ten, day);
    Triple match = seen.fromXyz * Triple{forTwo[0] / forTwo[1] / 2, 0.5, forTwo[2] / forTwo[1] / 2};
    for (size_t k = 0; k < 3; ++k)
        signals.plane[k][0] = match[k];
    const ColourDifference difference =
        displayMetamerism(signals, other, pixel({forTen[0] / forTen[1] / 2, 0.5, forTen[2] / forTen[1] / 2}));
    CHECK(difference.max > 0.5);
    CHECK_THROWS_WITH(spectralDisplay(library.find("observers/cie1931-2").value()), Contains("R, G, B"));
}
