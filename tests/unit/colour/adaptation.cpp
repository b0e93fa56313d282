// Chromatic adaptation, and the 3×3 matrices that it is made of.
#include "colour/colour.h"

#include <catch2/catch.hpp>

#include <string>

using namespace spectrad;

namespace {

const Triple whiteA{1.09850, 1, 0.35585}, whiteD65{0.95047, 1, 1.08883};

void checkEqual(const Matrix3& m, const Matrix3& expected, double margin) {
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) {
            CAPTURE(i, j);
            CHECK(m[i][j] == Approx(expected[i][j]).margin(margin));
        }
}

}  // namespace

TEST_CASE("A matrix times its inverse is the identity") {
    const Matrix3 m{{{2, -1, 0.5}, {0.25, 3, 1}, {-1, 0.5, 4}}};
    checkEqual(m * inverse(m), diagonal({1, 1, 1}), 1e-15);
    CHECK(determinant(m) == Approx(26.5625));
    CHECK(determinant({{{1, 2, 3}, {2, 4, 6}, {0, 0, 1}}}) == 0);
}

// References: colour-science 0.4.7, matrix_chromatic_adaptation_VonKries(A, D65, …).
TEST_CASE("CAT16 from A to D65 is colour-science's matrix") {
    checkEqual(adaptation(Adaptation::cat16, whiteA, whiteD65),
               {{{0.9506894052039, -0.1873763491431, 0.2627906070721},
                 {-0.02566523107483, 1.032306743157, -0.01155960888329},
                 {-0.002740638793658, 0.09096745233067, 2.812626498199}}},
               1e-11);
}

TEST_CASE("Bradford from A to D65 is colour-science's matrix") {
    checkEqual(adaptation(Adaptation::bradford, whiteA, whiteD65),
               {{{0.84469652397, -0.117922540858, 0.394810760931},
                 {-0.136630339504, 1.10412262859, 0.129171840256},
                 {0.079848948384, -0.134899945292, 3.192400942791}}},
               1e-11);
}

TEST_CASE("Von Kries from A to D65 is colour-science's matrix") {
    checkEqual(adaptation(Adaptation::vonKries, whiteA, whiteD65),
               {{{0.939498699519, -0.23391499351, 0.428117667806},
                 {-0.025693902961, 1.026382848197, 0.005176069148},
                 {0, 0, 3.059800477729}}},
               1e-11);
}

TEST_CASE("Bradford from D65 to D50 is the published matrix of the ICC's connection space") {
    // B. Lindbloom, "Chromatic adaptation" (whites of ASTM E308), seven decimals.
    checkEqual(adaptation(Adaptation::bradford, {0.95047, 1, 1.08883}, {0.96422, 1, 0.82521}),
               {{{1.0478112, 0.0228866, -0.0501270},
                 {0.0295424, 0.9904844, -0.0170491},
                 {-0.0092345, 0.0150436, 0.7521316}}},
               1e-6);
}

TEST_CASE("Adaptation takes one white to the other, keeps luminance ratios, and is undone by the way back") {
    const Triple bright{300 * whiteA[0], 300, 300 * whiteA[2]};
    for (const Adaptation method : {Adaptation::cat16, Adaptation::bradford, Adaptation::vonKries}) {
        const Matrix3 there = adaptation(method, bright, whiteD65);
        const Triple seen = there * bright;  // chromatic only: the luminance stays 300
        for (size_t c = 0; c < 3; ++c)
            CHECK(seen[c] == Approx(300 * whiteD65[c]).epsilon(1e-12));
        checkEqual(there * adaptation(method, whiteD65, bright), diagonal({1, 1, 1}), 1e-12);
        checkEqual(adaptation(method, bright, bright), diagonal({1, 1, 1}), 1e-14);
    }
    checkEqual(adaptation(Adaptation::none, bright, whiteD65), diagonal({1, 1, 1}), 0);
}

TEST_CASE("A white that the cones of a method cannot see is refused, not divided by") {
    const Triple neon =
        xyzFromChromaticity({0.7155, 0.2844});  // 632.8 nm: Bradford's second response is negative
    CHECK_THROWS_AS((void)adaptation(Adaptation::bradford, neon, whiteD65), InputError);
    CHECK_NOTHROW((void)adaptation(Adaptation::cat16, neon, whiteD65));
    CHECK_NOTHROW((void)adaptation(Adaptation::none, neon, whiteD65));
    CHECK_THROWS_AS((void)adaptation(Adaptation::cat16, {0, 0, 0}, whiteD65), InputError);
    CHECK_THROWS_AS((void)adaptation(Adaptation::cat16, whiteD65, {0.1, -1, 0.1}), InputError);
}

TEST_CASE("Adaptation methods are named as the format names them") {
    CHECK(parseAdaptation("cat16") == Adaptation::cat16);
    CHECK(parseAdaptation("bradford") == Adaptation::bradford);
    CHECK(parseAdaptation("vonkries") == Adaptation::vonKries);
    CHECK(parseAdaptation("none") == Adaptation::none);
    try {
        (void)parseAdaptation("bradfort");
        FAIL("an unknown method passed");
    } catch (const UsageError& error) {
        CHECK(std::string(error.what()).find("did you mean 'bradford'") != std::string::npos);
        CHECK(std::string(error.what()).find("allowed: cat16, bradford, vonkries, none") !=
              std::string::npos);
    }
}
