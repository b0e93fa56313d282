// Pictures as textures: a colour that becomes a reflectance at 10 nm steps is that colour again under D65.
#include "colour/colour.h"
#include "render/lifted_picture.h"
#include "spectrum/library.h"
#include "spectrum/lift.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace spectrad;

namespace {

Library shipped() {
    return Library(std::filesystem::path(SPECTRAD_SOURCE) / "spectra");
}

/// What each node of a texture's curve adds to X, Y and Z under D65, per reflectance 1.
std::vector<Triple> weightsOf(const std::vector<double>& nm) {
    const Spectrum lamp = shipped().find("illuminants/D65").value(),
                   observer = shipped().find("observers/cie1931-2").value();
    std::vector<Triple> weights;
    for (size_t t = 0; t < nm.size(); ++t) {
        std::vector<double> at, value;
        if (t > 0) at.push_back(nm[t - 1]), value.push_back(0);
        at.push_back(nm[t]), value.push_back(1);
        if (t + 1 < nm.size()) at.push_back(nm[t + 1]), value.push_back(0);
        const Curve hat = Curve::table(at, value, Outside::hold);
        Triple xyz{};
        for (size_t c = 0; c < 3; ++c) {
            const Curve* product[] = {&lamp.curve(), &observer.curves[c], &hat};
            xyz[c] = integrate(product);
        }
        weights.push_back(xyz);
    }
    return weights;
}

}  // namespace

TEST_CASE(
    "a picture's colours, as textures lifted at 10 nm, come back under D65 within 0.001 CIEDE2000 over "
    "the whole sRGB cube") {
    // Every 15th of 0 … 255 in each component: 5832 colours, the cube's corners, edges and greys among them.
    PictureValues picture{18 * 18, 18, 3, 255, {}};
    for (int r = 0; r < 18; ++r)
        for (int g = 0; g < 18; ++g)
            for (int b = 0; b < 18; ++b)
                for (int v : {r, g, b})
                    picture.values.push_back(static_cast<std::uint16_t>(v * 15));
    const SpectralTexture texture = liftPicture(picture, PictureLight(), {1, 1, 1}, shipped()).texture;
    REQUIRE(texture.nm.size() == 41);
    const std::vector<Triple> weights = weightsOf(texture.nm);
    Triple white{};
    for (const Triple& w : weights)
        for (size_t c = 0; c < 3; ++c)
            white[c] += w[c];
    const auto linear = [](std::uint16_t encoded) {
        const double v = encoded / 255.0;
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const Triple srgbWhite = xyzOfLinearSrgb({1, 1, 1});
    double worst = 0, sum = 0;
    const size_t pixels = picture.values.size() / 3;
    for (size_t i = 0; i < pixels; ++i) {
        Triple xyz{};
        for (size_t t = 0; t < texture.nm.size(); ++t) {
            const double rho = texture.texels[i * texture.nm.size() + t];
            if (rho < 0 || rho > 1) FAIL("a reflectance of " << rho);
            for (size_t c = 0; c < 3; ++c)
                xyz[c] += rho * weights[t][c];
        }
        const std::uint16_t* p = picture.values.data() + 3 * i;
        const double difference = deltaE00(
            lab(xyz, white), lab(xyzOfLinearSrgb({linear(p[0]), linear(p[1]), linear(p[2])}), srgbWhite));
        worst = std::max(worst, difference);
        sum += difference;
    }
    INFO("mean " << sum / static_cast<double>(pixels) << ", worst " << worst);
    CHECK(worst < 0.001);
    CHECK(sum / static_cast<double>(pixels) < 1e-5);
}

TEST_CASE("a picture times a colour is the picture of the products of their linear components") {
    const auto linear = [](int v) {
        const double e = v / 255.0;
        return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
    };
    const auto lifted = [](std::vector<std::uint16_t> values, const Triple& tint) {
        return liftPicture({1, 1, 3, 255, std::move(values)}, PictureLight(), tint, shipped()).texture;
    };
    const SpectralTexture tinted = lifted({255, 255, 255}, {linear(200), linear(90), linear(30)}),
                          plain = lifted({200, 90, 30}, {1, 1, 1});
    CHECK(tinted.texels == plain.texels);
    CHECK(plain.texels.front() != plain.texels.back());
}

TEST_CASE("colours of 16 bits are kept as fine as they are; those of no reflectance are counted") {
    const auto lifted = [](const PictureValues& picture) {
        Notes notes;
        return liftPicture(picture, {picture, "a.png", {}, notes}, {1, 1, 1}, shipped());
    };
    const std::uint16_t base = 128 * 257;
    const LiftedPicture fine = lifted({4, 1, 1, 65535, {base, base + 1, base + 100, base}});
    CHECK(fine.colours == 3);
    CHECK(fine.missed == 0);
    const auto texel = [&](size_t x) { return fine.texture.texels[x * liftedBands]; };
    CHECK(texel(0) < texel(1));
    CHECK(texel(2) == Approx(linearOfSrgb((base + 100) / 65535.0)).epsilon(1e-6));
    CHECK(texel(3) == texel(0));
    // Rec. 2020's green and red are nearly pure light; its white and a dull green are reflectances.
    PictureValues rec2020{4, 1, 3, 255, {0, 255, 0, 255, 0, 0, 255, 255, 255, 60, 100, 60}};
    rec2020.colour.codes = {{9, 8}};
    const LiftedPicture wide = lifted(rec2020);
    CHECK(wide.colours == 4);
    CHECK(wide.missed == 2);
    CHECK(wide.farthest > 5);
    for (const float reflectance : wide.texture.texels)
        CHECK((reflectance >= 0 && reflectance <= 1));
}
