// Detectors: integrals, weights on bands, names.
#include "colour/detector.h"

#include "colour/colour.h"
#include "spectrum/projection.h"

#include <catch2/catch.hpp>

using namespace spectrad;

namespace {

const Library& library() {
    static const Library shared = Library::open();
    return shared;
}

Curve reflectance(const char* name) {
    return library().find(name).value().curve().withOutside(Outside::hold);
}
Curve lamp(const char* name) {
    return library().find(name).value().curve();
}

Triple seen(const Detector& observer, const Curve& light, const Curve& surface) {
    const std::array<const Curve*, 2> product{&light, &surface};
    return respondXyz(observer, product);
}

struct Patch {
    const char *light, *observer, *patch;
    Triple xyz;  ///< Y of the perfect white is 1
};

// The integrals of the shipped tables, linear between their samples, by numpy: a 4-point Gauss rule on all
// merged knots.
constexpr Patch patches[] = {
    {"D65", "cie1931-2", "dark-skin", {0.11146830233636489, 0.10077525050177545, 0.06805507869805821}},
    {"D65", "cie1931-2", "blue", {0.07965884592804798, 0.06140069167755157, 0.2821387035741693}},
    {"D65", "cie1931-2", "red", {0.1962374019244687, 0.11754653756333108, 0.050281480746809465}},
    {"D65", "cie1931-2", "white", {0.8621486534754459, 0.9123487574012857, 0.9530552230152592}},
    {"D65", "cie1964-10", "dark-skin", {0.10883702529123745, 0.09820293280093147, 0.06687027912329649}},
    {"A", "cie1931-2", "dark-skin", {0.1472146783339495, 0.11222496592970058, 0.022445210694133577}},
    {"A", "cie1964-10", "red", {0.29667112351467656, 0.1615338522459644, 0.016209512399714243}},
    {"FL11", "cie1931-2", "blue", {0.06589648113350323, 0.05001008482318484, 0.1677158604046706}},
    {"FL11", "cie1964-10", "white", {0.9448858700472943, 0.9123837326422478, 0.5728816121602673}},
};

}  // namespace

TEST_CASE("Chart patches under CIE lamps have the exact integrals of their tables") {
    for (const Patch& patch : patches) {
        CAPTURE(patch.light, patch.observer, patch.patch);
        const Detector observer =
            detectorFrom(library().find(std::string("observers/") + patch.observer).value());
        const Curve light = lamp((std::string("illuminants/") + patch.light).c_str());
        const double white = seen(observer, light, Curve::constant(1))[1];
        const Triple xyz =
            seen(observer, light, reflectance((std::string("charts/colorchecker/") + patch.patch).c_str()));
        for (size_t c = 0; c < 3; ++c)
            CHECK(xyz[c] / white == Approx(patch.xyz[c]).epsilon(1e-10));
    }
}

TEST_CASE("White points of CIE illuminants are the published ones, to what sums at 5 nm leave open") {
    // CIE 015:2018, tables of illuminants.
    struct Published {
        const char* light;
        double x, y;
    };
    for (const Published& published :
         {Published{"A", 0.44758, 0.40745}, Published{"C", 0.31006, 0.31616},
          Published{"D50", 0.34567, 0.35851}, Published{"D65", 0.31272, 0.32903}}) {
        CAPTURE(published.light);
        const Curve light = lamp((std::string("illuminants/") + published.light).c_str());
        const auto xy = chromaticity(seen(standardObserver(library()), light, Curve::constant(1)));
        REQUIRE(xy);
        CHECK((*xy)[0] == Approx(published.x).margin(1e-4));
        CHECK((*xy)[1] == Approx(published.y).margin(1e-4));
    }
}

TEST_CASE("One W/m2/sr at 555 nm is 683 cd/m2, whether a line or a band") {
    const Detector observer = standardObserver(library());
    const Curve line = Curve::line(555), narrow = Curve::rectangle(555, 1e-3);
    for (const Curve* light : {&line, &narrow}) {
        const std::array<const Curve*, 1> product{light};
        CHECK(respondXyz(observer, product)[1] == Approx(683.002).epsilon(1e-6));
    }
}

TEST_CASE("A watt at 540 THz is 683 lm to every observer of the CIE, each by its own maximum") {
    for (const auto& [name, efficacy] : {std::pair{"cie1931-2", 683.002},
                                         {"cie1924-photopic", 683.002},
                                         {"cie1964-10", 683.599},
                                         {"cie2015-2", 683.358},
                                         {"cie2015-10", 683.144},
                                         {"cie2008-photopic-2", 683.358},
                                         {"cie2008-photopic-10", 683.144}}) {
        INFO(name);
        const Detector observer = detectorFrom(library().find(std::string("observers/") + name).value());
        CHECK(observer.scale == efficacy);
        const Curve line = Curve::line(555.016);
        const std::array<const Curve*, 1> product{&line};
        CHECK(respond(observer, product)[observer.size() / 2] == Approx(683).epsilon(1e-5));
    }
    // To a deficient eye white is as bright as to the normal one whose colours it is given in.
    const Curve white = Curve::constant(1).withOutside(Outside::zero);
    for (const auto& [eye, normal] :
         {std::pair{"protanope", "cie2015-2"}, {"deuteranope", "cie2015-2"}, {"tritanope", "cie2015-2"}}) {
        const std::array<const Curve*, 1> product{&white};
        CHECK(respond(detectorFrom(library().find(std::string("observers/") + eye).value()), product)[1] ==
              Approx(respond(detectorFrom(library().find(std::string("observers/") + normal).value()),
                             product)[1])
                  .epsilon(2e-5));
    }
}

TEST_CASE("A filter before an observer dims what he sees, and changes nothing of his lumens") {
    Notes notes;
    const SpectrumResolver resolver(library(), ".", false, notes);
    for (const std::string name : {"observers/cie1964-10", "observers/cie2015-2"}) {
        const Detector bare = detectorFor(name, resolver, {}),
                       behind = detectorFor(name + " * 300:0.5 900:0.5", resolver, {});
        CHECK(behind.scale == bare.scale);
        CHECK(behind.tristimulus);
    }
}

TEST_CASE("What lies outside a detector's range, and no light at all, give exactly nothing") {
    const Detector observer = standardObserver(library());
    const Curve none, infrared = Curve::line(1064);
    for (const Curve* light : {&none, &infrared}) {
        const std::array<const Curve*, 1> product{light};
        CHECK(respondXyz(observer, product) == std::array<double, 3>{0, 0, 0});
    }
}

TEST_CASE("Three channels X, Y, Z are tristimulus and photometric, however the file writes them") {
    Spectrum spectrum;
    spectrum.text = "mine.csv";
    spectrum.curves = {Curve::gaussian(600, 60), Curve::gaussian(550, 60), Curve::gaussian(450, 60)};
    for (const std::vector<std::string>& names : {std::vector<std::string>{"X", "Y", "Z"},
                                                  {"x", "y", "z"},
                                                  {"x_bar", "y_bar", "z_bar"},
                                                  {"xbar", "ybar", "zbar"}}) {
        spectrum.channels = names;
        const Detector detector = detectorFrom(spectrum);
        CHECK(detector.tristimulus);
        CHECK(detector.scale == luminousEfficacy);
        CHECK(detector.channels == std::vector<std::string>{"X", "Y", "Z"});
    }
}

TEST_CASE("Other detectors keep their channels, any number of them, in plain units") {
    Spectrum spectrum;
    spectrum.text = "mine.csv";
    spectrum.curves = {Curve::gaussian(600, 60), Curve::gaussian(550, 60), Curve::gaussian(450, 60),
                       Curve::gaussian(850, 60)};
    spectrum.channels = {"r", "green", "green", ""};
    const Detector detector = detectorFrom(spectrum);
    CHECK_FALSE(detector.tristimulus);
    CHECK(detector.scale == 1);
    CHECK(detector.channels == std::vector<std::string>{"R", "green", "channel3", "channel4"});
    const std::array<const Curve*, 1> product{&spectrum.curves[0]};
    CHECK(respond(detector, product).size() == 4);
    CHECK_THROWS_AS(respondXyz(detector, product), InputError);
}

TEST_CASE("Weights on bands give the detector's exact response to what is linear between the bands") {
    const Detector observer = standardObserver(library());
    const Wavelengths grid = regularWavelengths(360, 830, 10, {});
    const Curve light = Curve::table({360, 830}, {0.2, 1.4});
    const std::array<const Curve*, 1> product{&light};
    const std::vector<double> bands = project(grid, product);
    const std::vector<double> exact = respond(observer, product);
    const DetectorWeights weights = weightsOn(grid, observer);
    REQUIRE(weights.weights.size() == 3);
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (size_t j = 0; j < bands.size(); ++j)
            sum += weights.weights[c][j] * bands[j];
        CHECK(sum == Approx(exact[c]).epsilon(1e-10));
    }
}

TEST_CASE("Observers and cameras are found with and without their folders") {
    Notes notes;
    const SpectrumResolver resolver(library(), SPECTRAD_SOURCE, false, notes);
    CHECK(detectorFor("observers/cie1964-10", resolver, {}).tristimulus);
    CHECK(detectorFor("cie1964-10", resolver, {}).tristimulus);
    CHECK(detectorFor("cie1964-10", resolver, {}).name == "cie1964-10");
    CHECK(detectorFor("stockman-sharpe-2", resolver, {}).channels == std::vector<std::string>{"L", "M", "S"});
    CHECK(detectorFor("nikon-5100", resolver, {}).channels == std::vector<std::string>{"R", "G", "B"});
    CHECK_THROWS_AS(detectorFor("cie1913-2", resolver, {}), InputError);
    CHECK_THROWS_AS(detectorFor("no/such/file.csv", resolver, {}), InputError);
}

TEST_CASE("A user's file is a detector with the channels of its header") {
    const std::string folder = std::string(SPECTRAD_SHARED) + "/data";
    if (!std::filesystem::exists(folder + "/cmf/cie1931_2deg_xyz.csv")) {
        WARN("skipped: no measured files at " << folder);
        return;
    }
    Notes notes;
    const SpectrumResolver resolver(library(), folder, false, notes);
    const Detector observer = detectorFor("cmf/cie1931_2deg_xyz.csv", resolver, {});
    CHECK(observer.tristimulus);
    const Curve light = lamp("illuminants/D65");
    const Triple mine = seen(observer, light, Curve::constant(1));
    const Triple shipped = seen(standardObserver(library()), light, Curve::constant(1));
    for (size_t c = 0; c < 3; ++c)
        CHECK(mine[c] == Approx(shipped[c]).epsilon(1e-9));
    CHECK_FALSE(detectorFor("camera/iset_NikonD1.csv", resolver, {}).tristimulus);
}
