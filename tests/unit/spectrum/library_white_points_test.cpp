// The CIE illuminants under the CIE observers, against the chromaticities that the CIE publishes.
#include "spectrum/library.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace spectrad;

namespace {

struct Published {
    const char* illuminant;
    double x, y;      ///< CIE 1931
    double x10, y10;  ///< CIE 1964; 0 where CIE 15 gives none
};

// CIE 15:2004, tables T.3 and T.8, and CIE 015:2018, to the digits given there; both from sums over 5 nm. For
// D60, ID50 and ID65, which have none of five digits, what colour-science 0.4.7 computes after ASTM E308-15.
constexpr Published publishedChromaticities[] = {
    {"A", 0.44758, 0.40745, 0.45117, 0.40594},
    {"B", 0.34842, 0.35161, 0.34980, 0.35270},
    {"C", 0.31006, 0.31616, 0.31039, 0.31905},
    {"D50", 0.34570, 0.35850, 0.34773, 0.35952},
    {"D55", 0.33243, 0.34744, 0.33412, 0.34877},
    {"D60", 0.32162, 0.33762, 0.32299, 0.33928},
    {"D65", 0.31270, 0.32900, 0.31382, 0.33100},
    {"D75", 0.29903, 0.31488, 0.29968, 0.31740},
    {"E", 1.0 / 3, 1.0 / 3, 1.0 / 3, 1.0 / 3},
    {"ID50", 0.34321, 0.36021, 0.34562, 0.36123},
    {"ID65", 0.31066, 0.33066, 0.31207, 0.33266},
    {"FL1", 0.3131, 0.3371, 0.31811, 0.33559},
    {"FL2", 0.3721, 0.3751, 0.37925, 0.36733},
    {"FL3", 0.4091, 0.3941, 0.41761, 0.38324},
    {"FL4", 0.4402, 0.4031, 0.44920, 0.39074},
    {"FL5", 0.3138, 0.3452, 0.31975, 0.34246},
    {"FL6", 0.3779, 0.3882, 0.38660, 0.37847},
    {"FL7", 0.3129, 0.3292, 0.31569, 0.32960},
    {"FL8", 0.3458, 0.3586, 0.34902, 0.35939},
    {"FL9", 0.3741, 0.3727, 0.37829, 0.37045},
    {"FL10", 0.3458, 0.3588, 0.35090, 0.35444},
    {"FL11", 0.3805, 0.3769, 0.38541, 0.37123},
    {"FL12", 0.4370, 0.4042, 0.44256, 0.39717},
    {"FL3.1", 0.4407, 0.4033, 0, 0},
    {"FL3.2", 0.3808, 0.3734, 0, 0},
    {"FL3.3", 0.3153, 0.3439, 0, 0},
    {"FL3.4", 0.4429, 0.4043, 0, 0},
    {"FL3.5", 0.3749, 0.3672, 0, 0},
    {"FL3.6", 0.3488, 0.3600, 0, 0},
    {"FL3.7", 0.4384, 0.4045, 0, 0},
    {"FL3.8", 0.3820, 0.3832, 0, 0},
    {"FL3.9", 0.3499, 0.3591, 0, 0},
    {"FL3.10", 0.3455, 0.3560, 0, 0},
    {"FL3.11", 0.3245, 0.3434, 0, 0},
    {"FL3.12", 0.4377, 0.4037, 0, 0},
    {"FL3.13", 0.3830, 0.3724, 0, 0},
    {"FL3.14", 0.3447, 0.3609, 0, 0},
    {"FL3.15", 0.3127, 0.3288, 0, 0},
    {"HP1", 0.5330, 0.4150, 0, 0},
    {"HP2", 0.4778, 0.4158, 0, 0},
    {"HP3", 0.4302, 0.4075, 0, 0},
    {"HP4", 0.3812, 0.3797, 0, 0},
    {"HP5", 0.3776, 0.3713, 0, 0},
    {"LED-B1", 0.4560, 0.4078, 0, 0},
    {"LED-B2", 0.4357, 0.4012, 0, 0},
    {"LED-B3", 0.3756, 0.3723, 0, 0},
    {"LED-B4", 0.3422, 0.3502, 0, 0},
    {"LED-B5", 0.3118, 0.3236, 0, 0},
    {"LED-BH1", 0.4474, 0.4066, 0, 0},
    {"LED-RGB1", 0.4557, 0.4211, 0, 0},
    {"LED-V1", 0.4548, 0.4044, 0, 0},
    {"LED-V2", 0.3781, 0.3775, 0, 0},
};

using Chromaticity = std::array<double, 2>;

template <class Response>
Chromaticity chromaticity(const Spectrum& observer, Response response) {
    std::array<double, 3> sum{};
    for (size_t c = 0; c < 3; ++c)
        sum[c] = response(observer.curves[c]);
    const double total = sum[0] + sum[1] + sum[2];
    return {sum[0] / total, sum[1] / total};
}

Chromaticity integrated(const Curve& light, const Spectrum& observer) {
    return chromaticity(observer, [&](const Curve& function) {
        const Curve* product[] = {&light, &function};
        return integrate(product);
    });
}

Chromaticity summed(const Curve& light, const Spectrum& observer) {
    return chromaticity(observer, [&](const Curve& function) {
        double sum = 0;
        for (size_t i = 0; i < light.sampleValues().size(); ++i)
            sum += light.sampleValues()[i] * function.at(light.sampleWavelengths()[i]);
        return sum;
    });
}

double distance(const Chromaticity& a, double x, double y) {
    return std::max(std::abs(a[0] - x), std::abs(a[1] - y));
}

}  // namespace

TEST_CASE("CIE illuminants have the published white points") {
    const Library library(std::filesystem::path(SPECTRAD_SOURCE) / "spectra");
    const auto observer2 = library.find("observers/cie1931-2"),
               observer10 = library.find("observers/cie1964-10");
    REQUIRE((observer2 && observer10));
    for (const Published& published : publishedChromaticities) {
        INFO(published.illuminant);
        const auto light = library.find(std::string("illuminants/") + published.illuminant);
        REQUIRE(light);
        // Summed as the CIE does it, only its rounding to four digits is left.
        CHECK(distance(summed(light->curve(), *observer2), published.x, published.y) < 1e-4);
        // Integrated exactly, lamps with lines move by what 5 nm steps miss of the observer's curvature.
        CHECK(distance(integrated(light->curve(), *observer2), published.x, published.y) < 4e-4);
        if (published.x10 > 0)
            CHECK(distance(integrated(light->curve(), *observer10), published.x10, published.y10) < 4e-4);
    }
}
