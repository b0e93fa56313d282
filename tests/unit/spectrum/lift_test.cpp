// Colours lifted to reflectances come back as the colours they were.
#include "spectrum/lift.h"

#include "base/error.h"
#include "spectrum/library.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;
using Triple = std::array<double, 3>;

namespace {

Library shipped() {
    return Library(std::filesystem::path(SPECTRAD_SOURCE) / "spectra");
}

Triple lab(const Triple& xyz, const Triple& white) {
    Triple f{};
    for (size_t i = 0; i < 3; ++i) {
        const double r = xyz[i] / white[i];
        f[i] = r > 216.0 / 24389 ? std::cbrt(r) : (24389.0 / 27 * r + 16) / 116;
    }
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

/// Integrates a lifted colour over the whole of D65 and the observer, and compares with the colour that was
/// asked for.
class RoundTrip {
  public:
    RoundTrip()
        : lamp_(shipped().find("illuminants/D65").value()),
          observer_(shipped().find("observers/cie1931-2").value()) {
        white_ = seen(Curve::constant(1));
    }
    /// ΔE*ab, never below ΔE00 by more than a little: a stricter measure.
    [[nodiscard]] double difference(const Curve& reflectance, const Triple& rgb) const {
        const Triple a = lab(seen(reflectance), white_),
                     b = lab(xyzOfLinearSrgb(rgb), xyzOfLinearSrgb({1, 1, 1}));
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }

  private:
    [[nodiscard]] Triple seen(const Curve& reflectance) const {
        Triple xyz{};
        for (size_t i = 0; i < 3; ++i) {
            const Curve* product[] = {&lamp_.curve(), &observer_.curves[i], &reflectance};
            xyz[i] = integrate(product);
        }
        return xyz;
    }
    Spectrum lamp_, observer_;
    Triple white_{};
};

}  // namespace

TEST_CASE("The whole sRGB cube lifts to reflectances within 0 and 1 that have its colours") {
    const Library library = shipped();
    const ColourLift lift(library);
    const RoundTrip trip;
    const int n = 8;
    for (int r = 0; r <= n; ++r)
        for (int g = 0; g <= n; ++g)
            for (int b = 0; b <= n; ++b) {
                const Triple rgb{std::pow(r / double(n), 2.2), std::pow(g / double(n), 2.2),
                                 std::pow(b / double(n), 2.2)};
                const Curve curve = lift.fit(rgb).curve();
                CAPTURE(rgb[0], rgb[1], rgb[2]);
                REQUIRE(trip.difference(curve, rgb) < 0.02);
                REQUIRE(curve.bounds().first >= 0);
                REQUIRE(curve.bounds().second <= 1);
            }
}

TEST_CASE("Colours close to black, to white and to the cube's faces lift too") {
    const Library library = shipped();
    const ColourLift lift(library);
    const RoundTrip trip;
    for (double s : {1e-300, 1e-12, 1e-6, 1e-3})
        for (const Triple& rgb :
             {Triple{s, 0, 0}, Triple{0, s, 0}, Triple{0, 0, s}, Triple{1, 1, s}, Triple{s, 1, 1},
              Triple{1, s, 1}, Triple{1, 1, 1 - s}, Triple{1 - s, 1, 1}}) {
            CAPTURE(rgb[0], rgb[1], rgb[2]);
            CHECK(trip.difference(lift.fit(rgb).curve(), rgb) < 0.02);
        }
}

TEST_CASE("Greys are exact constants, black exactly 0 and white exactly 1") {
    const ColourLift lift(shipped());
    for (double grey : {0.0, 1e-6, 0.18, 0.5, 0.9, 1.0}) {
        const LiftedColour lifted = lift.fit({grey, grey, grey});
        CHECK(lifted.c[0] == 0);
        CHECK(lifted.c[1] == 0);
        CHECK(lifted.at(500) == Approx(grey).epsilon(1e-9));
        CHECK(lifted.curve().isConstant());
    }
    CHECK(lift.fit({0, 0, 0}).at(500) == 0);
    CHECK(lift.fit({1, 1, 1}).at(500) == 1);
}

TEST_CASE("A lifted colour's curve is its formula, held beyond 360 and 830 nm") {
    const LiftedColour lifted = ColourLift(shipped()).fit({0.8, 0.2, 0.1});
    const Curve curve = lifted.curve();
    for (double nm : {300.0, 360.0, 433.3, 700.0, 830.0, 2000.0})
        CHECK(curve.at(nm) == lifted.at(nm));
    CHECK(curve.at(100) == curve.at(360));
    CHECK(curve.at(3000) == curve.at(830));
    // The integral is exact: a fine sum agrees.
    double sum = 0;
    for (int i = 0; i < 470'000; ++i)
        sum += curve.at(360 + (i + 0.5) * 0.001) * 0.001;
    const Curve* factor = &curve;
    CHECK(integrate({&factor, 1}, 360, 830) == Approx(sum).epsilon(1e-9));
}

TEST_CASE("Components that no surface has are refused") {
    const ColourLift lift(shipped());
    CHECK_THROWS_WITH(lift.fit({1.5, 0, 0}), "linear RGB component 1.5 (allowed: 0 … 1)");
    CHECK_THROWS_WITH(lift.fit({0, -0.1, 0}), "linear RGB component -0.1 (allowed: 0 … 1)");
    CHECK_THROWS_AS(lift.fit({0, 0, NAN}), InputError);
}
