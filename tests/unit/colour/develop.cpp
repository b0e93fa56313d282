// Pictures for a display.
#include "colour/develop.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;

namespace {

const Triple whiteA{1.09850, 1, 0.35585};

ChannelImage uniform(int width, int height, const Triple& xyz) {
    ChannelImage image(width, height, 3);
    for (size_t c = 0; c < 3; ++c)
        std::fill(image.plane[c].begin(), image.plane[c].end(), xyz[c]);
    return image;
}

DevelopSettings under(const Triple& white, double luminance) {
    DevelopSettings settings;
    settings.white = withLuminance({"test", white, false}, luminance);
    return settings;
}

}  // namespace

TEST_CASE("The white is shown as the display's white, whatever its colour, luminance and the method") {
    for (const Adaptation method : {Adaptation::cat16, Adaptation::bradford, Adaptation::vonKries})
        for (const double luminance : {1e-20, 100.0, 1e20}) {
            DevelopSettings settings = under(whiteA, luminance);
            settings.adaptation = method;
            const auto picture = develop(uniform(2, 1, settings.white.xyz), settings);
            CHECK(picture.rgb == std::vector<std::uint8_t>(6, 255));
            CHECK(picture.clipped == 0);
            CHECK(picture.whiteLuminance == luminance);
        }
}

TEST_CASE("A grey of 18 % of the white is sRGB's 118, one stop darker its 86") {
    DevelopSettings settings = under(whiteA, 1000);
    const Triple& w = settings.white.xyz;
    const ChannelImage image = uniform(1, 1, {0.18 * w[0], 0.18 * w[1], 0.18 * w[2]});
    CHECK(develop(image, settings).rgb == std::vector<std::uint8_t>(3, 118));  // 255 · 0.46136 = 117.6
    settings.exposure.ev = -1;  // display white is twice as bright: everything else is shown half as bright
    CHECK(develop(image, settings).rgb == std::vector<std::uint8_t>(3, 85));  // 255 · 0.33191 = 84.6
    settings.exposure.ev = 1;
    CHECK(develop(image, settings).rgb == std::vector<std::uint8_t>(3, 162));  // 255 · 0.63379 = 161.6
}

TEST_CASE("Without adaptation the colours of an sRGB signal come back as its codes") {
    const Display srgb = srgbDisplay();
    DevelopSettings settings = under(srgb.white, 80);
    settings.adaptation = Adaptation::none;
    ChannelImage image(3, 1, 3);
    const std::array<Triple, 3> codes{Triple{192, 64, 32}, Triple{0, 255, 0}, Triple{17, 34, 251}};
    for (size_t i = 0; i < 3; ++i) {
        Triple signal;
        for (size_t c = 0; c < 3; ++c)
            signal[c] = decode(srgb, codes[i][c] / 255);
        const Triple xyz = srgb.toXyz * signal;
        for (size_t c = 0; c < 3; ++c)
            image.plane[c][i] = 80 * xyz[c];
    }
    const auto picture = develop(image, settings);
    CHECK(picture.rgb == std::vector<std::uint8_t>{192, 64, 32, 0, 255, 0, 17, 34, 251});
    CHECK(picture.clipped == 0);
}

TEST_CASE("Out of gamut is clipped channel by channel, and counted") {
    DevelopSettings settings = under(srgbDisplay().white, 1);
    ChannelImage image = uniform(4, 1, settings.white.xyz);
    const Triple green = xyzFromChromaticity({0.17, 0.797}, 0.4);  // BT.2020's green: outside sRGB
    for (size_t c = 0; c < 3; ++c) {
        image.plane[c][1] = green[c];
        image.plane[c][2] = 3 * settings.white.xyz[c];
        image.plane[c][3] = 0;
    }
    const auto picture = develop(image, settings);
    CHECK(picture.clipped == 2);
    CHECK(picture.clippedShare() == 0.5);
    CHECK(picture.rgb[3] == 0);
    CHECK(picture.rgb[4] > 150);
    CHECK(picture.rgb[6] == 255);
    CHECK(picture.rgb[9] == 0);
}

TEST_CASE("Without a luminance, or with auto, the 99th percentile of Y is display white") {
    ChannelImage image(101, 1, 3);
    for (size_t i = 0; i <= 100; ++i)
        image.plane[0][i] = image.plane[1][i] = image.plane[2][i] = static_cast<double>(100 - i);
    DevelopSettings settings;
    CHECK(displayWhiteLuminance(image, settings) == 99);
    settings.exposure.ev = 2;
    CHECK(displayWhiteLuminance(image, settings) == 99.0 / 4);
    settings.exposure.ev = 0;
    settings.white = withLuminance(settings.white, 500);
    CHECK(displayWhiteLuminance(image, settings) == 500);
    settings.exposure.automatic = true;
    CHECK(displayWhiteLuminance(image, settings) == 99);
}

TEST_CASE("A mostly black image is exposed for what is there, a black one stays black") {
    ChannelImage image = uniform(200, 1, {0, 0, 0});
    CHECK(displayWhiteLuminance(image, DevelopSettings()) == 1);
    const auto black = develop(image, DevelopSettings());
    CHECK(black.rgb == std::vector<std::uint8_t>(600, 0));
    CHECK(black.clipped == 0);
    image.plane[1][7] = 42;
    CHECK(displayWhiteLuminance(image, DevelopSettings()) == 42);
}

TEST_CASE("A thousand stops are white or black, never no number") {
    DevelopSettings settings = under(srgbDisplay().white, 1e20);
    const ChannelImage image = uniform(1, 1, settings.white.xyz);
    settings.exposure.ev = 1000;
    CHECK(develop(image, settings).rgb == std::vector<std::uint8_t>(3, 255));
    settings.exposure.ev = -1000;
    CHECK(develop(image, settings).rgb == std::vector<std::uint8_t>(3, 0));
    CHECK(std::isfinite(displayWhiteLuminance(image, settings)));
}

TEST_CASE("Quantiles lie linearly between ranks") {
    std::vector<double> values{4, 1, 3, 2};
    CHECK(quantile(values, 0) == 1);
    CHECK(quantile(values, 1) == 4);
    CHECK(quantile(values, 0.5) == 2.5);
    CHECK(quantile(values, 0.95) == Approx(3.85));  // numpy.percentile([1, 2, 3, 4], 95)
    std::vector<double> one{7};
    CHECK(quantile(one, 0.99) == 7);
}
