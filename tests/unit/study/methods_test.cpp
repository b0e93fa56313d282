// The ways of other renderers, each where its result can be known.
#include "colour/detector.h"
#include "spectrum/library.h"
#include "spectrum/projection.h"
#include "study/adaptive.h"
#include "study/eigen.h"
#include "study/linear_model.h"
#include "study/quadrature.h"
#include "study/three_channels.h"
#include "study/trial.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace spectrad;

namespace {

const Library& library() {
    static const Library opened = Library::open();
    return opened;
}

const Detector& observer() {
    static const Detector standard = standardObserver(library());
    return standard;
}

Scene chart(const Curve& light, const Curve& reflectance) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].diffuse.emplace();
    scene.materials[0].diffuse->reflectance.emplace();
    scene.materials[0].diffuse->reflectance->curves = {reflectance};
    scene.lights.resize(1);
    scene.lights[0].emitter.spectrum.curves = {light};
    scene.lights[0].emitter.scale = 1;
    return scene;
}

/// XYZ of light × surface in three numbers.
Triple seen(const ThreeChannelScene& told) {
    const Curve &light = told.scene.lights[0].emitter.spectrum.curve(),
                &surface = told.scene.materials[0].diffuse->reflectance->curve();
    Triple xyz{};
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < 3; ++k)
            xyz[c] +=
                told.weights.weights[c][k] * light.at(told.channels.nm[k]) * surface.at(told.channels.nm[k]);
    return xyz;
}

Triple exact(const Curve& light, const Curve& reflectance) {
    const std::array<const Curve*, 2> product{&light, &reflectance};
    return respondXyz(observer(), product);
}

}  // namespace

TEST_CASE("eigenvectors of a symmetric matrix: orthonormal, largest value first, and they rebuild it") {
    const std::vector<double> m{4, 1, 0.5, 1, 3, -2, 0.5, -2, 1};
    const Eigen eigen = eigenOf(m, 3);
    CHECK(eigen.value[0] > eigen.value[1]);
    CHECK(eigen.value[1] > eigen.value[2]);
    for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < 3; ++j) {
            double rebuilt = 0, inner = 0;
            for (size_t k = 0; k < 3; ++k) {
                rebuilt += eigen.value[k] * eigen.vector[k][i] * eigen.vector[k][j];
                inner += eigen.vector[i][k] * eigen.vector[j][k];
            }
            CHECK(rebuilt == Approx(m[3 * i + j]).margin(1e-13));
            CHECK(inner == Approx(i == j ? 1 : 0).margin(1e-13));
        }
    }
}

TEST_CASE("Gaussian quadrature sees polynomials of degree below its number of wavelengths exactly") {
    for (int count : {4, 6, 10}) {
        const QuadratureRule rule = gaussRule(observer(), count);
        REQUIRE(rule.nm.size() == static_cast<size_t>(count));
        CHECK(std::is_sorted(rule.nm.begin(), rule.nm.end()));
        CHECK(rule.nm.front() > 360);
        CHECK(rule.nm.back() < 830);
        for (int degree = 0; degree < count; ++degree) {
            // Summed every nanometre, as the rule is made.
            for (size_t c = 0; c < 3; ++c) {
                double right = 0, sum = 0, size = 0;
                for (int nm = 360; nm <= 830; ++nm) {
                    const double value = std::pow((nm - 560) / 200.0, degree);
                    right += observer().scale * observer().response[c].at(nm) * value;
                    size += observer().scale * observer().response[c].at(nm) * std::abs(value);
                }
                for (size_t k = 0; k < rule.nm.size(); ++k)
                    sum += rule.weights.weights[c][k] * std::pow((rule.nm[k] - 560) / 200.0, degree);
                CAPTURE(count, degree, c);
                CHECK(std::abs(sum - right) < 1e-9 * size);
            }
        }
    }
}

TEST_CASE("greys under any lamp, and anything under D65 within the gamut, are exact in RGB") {
    const Curve d65 = library().find("illuminants/D65")->curve(),
                lampA = library().find("illuminants/A")->curve(),
                skin = library().find("charts/colorchecker/light-skin")->curve().withOutside(Outside::hold),
                grey = Curve::constant(0.18);
    const auto check = [&](const Curve& light, const Curve& surface, double margin) {
        const auto told = inThreeChannels(chart(light, surface), ThreeChannels::rgb, observer(), library());
        REQUIRE(told);
        const Triple right = exact(light, surface), ours = seen(*told);
        for (size_t c = 0; c < 3; ++c)
            CHECK(ours[c] == Approx(right[c]).epsilon(margin));
    };
    check(d65, grey, 1e-12);
    check(lampA, grey, 1e-12);
    check(d65, skin, 1e-3);  // sRGB's white is D65 to four digits
    const auto told = inThreeChannels(chart(lampA, skin), ThreeChannels::rgb, observer(), library());
    CHECK(std::abs(seen(*told)[2] / exact(lampA, skin)[2] - 1) > 0.005);  // under A it is not
}

TEST_CASE("tristimulus products are exact under equal-energy light") {
    const Curve equal = Curve::constant(1),
                foliage = library().find("charts/colorchecker/foliage")->curve().withOutside(Outside::hold);
    const auto told = inThreeChannels(chart(equal, foliage), ThreeChannels::xyz, observer(), library());
    REQUIRE(told);
    const Triple right = exact(equal, foliage), ours = seen(*told);
    for (size_t c = 0; c < 3; ++c)
        CHECK(ours[c] == Approx(right[c]).epsilon(1e-12));
}

TEST_CASE("a scene with a spectral texture is not told in three numbers") {
    Scene scene = chart(Curve::constant(1), Curve::constant(1));
    scene.materials[0].diffuse->reflectance.reset();
    scene.materials[0].diffuse->texture.emplace();
    CHECK_FALSE(inThreeChannels(scene, ThreeChannels::rgb, observer(), library()));
}

TEST_CASE("a linear model with as many components as spectra is exact; with one less it is not") {
    Plan plan;
    plan.terms.bands = 5;
    std::vector<std::vector<float>> spectra{{1, 2, 3, 4, 5}, {5, 1, 0, 1, 5}, {0, 100, 0, 300, 0}};
    if (GENERATE(false, true))  // more terms than bands: mixtures of the same three, as texels are
        for (int k = 1; k <= 5; ++k) {
            spectra.emplace_back();
            for (size_t b = 0; b < 5; ++b)
                spectra.back().push_back(static_cast<float>(k) * spectra[0][b] + 2 * spectra[1][b] +
                                         spectra[2][b] / 4);
        }
    for (const auto& s : spectra)
        plan.terms.spectra.insert(plan.terms.spectra.end(), s.begin(), s.end());
    plan.terms.preview.resize(3 * spectra.size());
    plan.wavelengths.nm = {400, 450, 500, 550, 600};
    DetectorWeights weights;
    weights.weights = {{1, 2, 3, 2, 1}};
    const auto worst = [&](int count) {
        const LinearModel model = inPrincipalComponents(plan, weights, count);
        REQUIRE(model.plan.terms.bands == static_cast<size_t>(count));
        double error = 0;
        for (size_t t = 0; t < spectra.size(); ++t) {
            double right = 0, ours = 0;
            for (size_t b = 0; b < 5; ++b)
                right += weights.weights[0][b] * double{spectra[t][b]};
            for (size_t k = 0; k < model.plan.terms.bands; ++k)
                ours += model.weights.weights[0][k] *
                        double{model.plan.terms.spectra[t * model.plan.terms.bands + k]};
            error = std::max(error, std::abs(ours / right - 1));
        }
        return error;
    };
    CHECK(worst(3) < 1e-6);
    CHECK(worst(2) > 1e-3);
    CHECK(inPrincipalComponents(plan, weights, 8).plan.terms.bands == 3);
}

TEST_CASE("a float cut to n bits is its neighbour of n bits, ties to even") {
    CHECK(keepBits(1.0f, 8) == 1.0f);
    CHECK(keepBits(1.0f + 0x1p-8f, 8) == 1.0f);                       // a tie, down to even
    CHECK(keepBits(1.0f + 0x1p-8f + 0x1p-20f, 8) == 1.0f + 0x1p-7f);  // just above it
    CHECK(keepBits(1.0f + 3 * 0x1p-8f, 8) == 1.0f + 0x1p-6f);         // a tie, up to even
    CHECK(keepBits(-0.1f, 24) == -0.1f);
    CHECK(std::abs(keepBits(-0.1f, 12) + 0.1f) <= 0x1p-12f * 0.1f);
}

TEST_CASE("adaptive wavelengths crowd where the lamp's lines are, and leave no gap where it is smooth") {
    const Curve fl11 = library().find("illuminants/FL11")->curve();
    const std::vector<double> nm = adaptiveWavelengths(chart(fl11, Curve::constant(1)), observer(), 40);
    REQUIRE(nm.size() == 40);
    CHECK(std::is_sorted(nm.begin(), nm.end()));
    CHECK(nm.front() == 380);
    CHECK(nm.back() == 780);
    const auto within = [&](double from, double to) {
        return std::count_if(nm.begin(), nm.end(), [&](double v) { return v >= from && v < to; });
    };
    CHECK(within(530, 560) >= 6);  // the green line at 545 nm
    CHECK(within(680, 780) <= 6);
    const std::vector<double> even =
        adaptiveWavelengths(chart(Curve::constant(1), Curve::constant(1)), observer(), 40);
    double widest = 0;
    for (size_t i = 1; i < even.size(); ++i)
        if (even[i] > 420 && even[i] < 660) widest = std::max(widest, even[i] - even[i - 1]);
    CHECK(widest <= 25);
}
