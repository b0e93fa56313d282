// Reversal film: exposure to density, density to the projected colour.
#include "camera/film.h"

#include "spectrum/projection.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;
using Catch::Contains;

namespace {

struct Laboratory {
    Library library = Library::open();
    Notes notes;
    SpectrumResolver resolver{library, ".", false, notes};
    Detector eye = standardObserver(library);
    FilmProjection film{filmFor("generic-reversal", resolver, library), eye};

    Triple exposed(const Curve& light, const Curve& patch, double whiteLuminance) {
        const std::array<const Curve*, 2> product{&light, &patch};
        return film.exposures(respond(film.film().layers, product), whiteLuminance, 0);
    }
};

}  // namespace

TEST_CASE("The characteristic curve falls from dmax to dmin and is steepest in between") {
    const CharacteristicCurve curve{0.1, 3.1, 2, -1, 1};
    CHECK(curve.density(0) == 3.1);
    CHECK(curve.density(1e-9) == Approx(3.1));
    CHECK(curve.density(0.1) == Approx(1.6));  // the centre: half-way, with shoulder 1
    CHECK(curve.density(1e9) == Approx(0.1));
    for (double lg = -4; lg < 2; lg += 0.1)
        CHECK(curve.density(std::pow(10, lg)) > curve.density(std::pow(10, lg + 0.1)));
    const double slope =
        (curve.density(0.1 * 1.0001) - curve.density(0.1 / 1.0001)) / (2 * std::log10(1.0001));
    CHECK(slope ==
          Approx(-3.0 * 2 * std::log(10) / 4).epsilon(1e-6));  // derivative of the logistic at its centre
}

TEST_CASE("A grey card under the balancing light exposes every layer to 1, twice as long to 2") {
    Laboratory lab;
    const std::array<const Curve*, 1> d55{&lab.film.film().balance};
    const double luminance = respondXyz(lab.eye, d55)[1];
    const Triple card = lab.exposed(lab.film.film().balance, Curve::constant(0.18), luminance);
    for (const double h : card)
        CHECK(h == Approx(1).epsilon(1e-12));
    const std::vector<double> channels = respond(lab.film.film().layers, d55);
    CHECK(lab.film.exposures(channels, luminance, 1)[0] == Approx(2 / 0.18).epsilon(1e-12));
    CHECK(lab.film.metered(channels[1]) == Approx(luminance).epsilon(1e-12));
}

TEST_CASE("Equal equivalent neutral densities of 1 are a neutral of a tenth, and nearly neutral elsewhere") {
    Laboratory lab;
    const Triple none = lab.film.xyz({0, 0, 0}), one = lab.film.xyz({1, 1, 1}), two = lab.film.xyz({2, 2, 2});
    const Triple lamp = lab.film.lamp();
    CHECK(lamp[1] == Approx(1).epsilon(1e-6));
    for (size_t k = 0; k < 3; ++k) {
        // The base is a filter of its own, so a tenth of what it lets through.
        CHECK(one[k] / none[k] == Approx(0.1).epsilon(0.01));
        CHECK(-std::log10(two[k] / none[k]) == Approx(2).margin(0.12));
    }
    const auto a = *uvPrime(lamp), b = *uvPrime(two);
    CHECK(std::hypot(a[0] - b[0], a[1] - b[1]) < 0.012);
}

TEST_CASE("The transparency's colour is the integral of its own spectrum under the lamp") {
    Laboratory lab;
    const Triple densities{0.4, 1.1, 2.0};
    std::vector<double> nm, value;
    for (double at = 360; at <= 830; at += 0.5) {
        nm.push_back(at);
        value.push_back(lab.film.transmittance(densities, at));
    }
    const Curve film = Curve::table(nm, value);
    const std::array<const Curve*, 2> product{&film, &lab.film.film().projector};
    const std::array<const Curve*, 1> lamp{&lab.film.film().projector};
    const Triple fine = respondXyz(lab.eye, product);
    const double whole = respondXyz(lab.eye, lamp)[1];
    const Triple xyz = lab.film.xyz(densities);
    for (size_t k = 0; k < 3; ++k)
        CHECK(xyz[k] == Approx(fine[k] / whole).epsilon(2e-3));  // linear between nodes of 4 nm
}

TEST_CASE("More light on one layer only takes its own dye away") {
    Laboratory lab;
    const Triple grey = lab.film.xyz(lab.film.densities({1, 1, 1}));
    const Triple red = lab.film.xyz(lab.film.densities({4, 1, 1}));
    const Triple blue = lab.film.xyz(lab.film.densities({1, 1, 4}));
    CHECK(red[0] / grey[0] > 1.5);
    CHECK((*uvPrime(red))[0] > (*uvPrime(grey))[0] + 0.02);
    CHECK(blue[2] / grey[2] > 2);
}

TEST_CASE("A film's file that lacks or mistakes something is refused with its line") {
    Laboratory lab;
    const std::string good =
        "layers films/generic-reversal-layers\ndyes films/generic-reversal-dyes\nbalance illuminants/D55\n"
        "projector illuminants/A\nred 0 3 1 0 1\ngreen 0 3 1 0 1\nblue 0 3 1 0 1\n";
    CHECK(parseFilm(good, "f.film", lab.resolver).curves[2].dmax == 3);
    const auto refused = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        static_cast<void>(parseFilm(text, "f.film", lab.resolver));
    };
    CHECK_THROWS_WITH(refused("blue 0 3 1 0 1\n", ""), Contains("needs a line 'blue'"));
    CHECK_THROWS_WITH(refused("blue", "bleu"), Contains("f.film:7:1") && Contains("did you mean 'blue'"));
    CHECK_THROWS_WITH(refused("green 0 3", "green 4 3"), Contains("f.film:6:9") && Contains("above dmin"));
    CHECK_THROWS_WITH(refused("red 0 3 1", "red 0 3 x"), Contains("f.film:5:9") && Contains("'x'"));
    CHECK_THROWS_WITH(refused("layers films/generic-reversal-layers", "layers cie1931-2"),
                      Contains("R, G, B"));
    CHECK_THROWS_WITH(refused("illuminants/A", "illuminants/Q"), Contains("f.film:4:11"));
    CHECK_THROWS_WITH(refused("red 0", "blue 0 3 1 0 1\nred 0"), Contains("given twice"));
}

TEST_CASE("Another lamp and another eye see the same transmittance: their product, summed nm by nm") {
    Laboratory lab;
    const Spectrum lamp = lab.resolver.resolve("illuminants/D50", Role::light, {});
    const Detector ten = detectorFor("cie1964-10", lab.resolver, {});
    const Triple densities{0.6, 1.1, 1.7}, dyes = lab.film.dyePerDensity();
    lab.film.project(&lamp, &ten, lab.eye);
    CHECK(lab.film.dyePerDensity() == dyes);
    Triple sum{};
    double lampY = 0;
    for (double nm = 360; nm <= 832; nm += 0.25) {
        const double light = lamp.curve().at(nm), t = lab.film.transmittance(densities, nm);
        for (size_t k = 0; k < 3; ++k)
            sum[k] += light * t * ten.response[k].at(nm);
        lampY += light * ten.response[1].at(nm);
    }
    const Triple seen = lab.film.xyz(densities);
    for (size_t k = 0; k < 3;
         ++k)  // the projection takes dyes as linear over hats of 4 nm: 2e-3 at such densities
        CHECK(seen[k] == Approx(sum[k] / lampY).epsilon(2.5e-3));
    CHECK(lab.film.film().projectorName == "illuminants/D50");
    const Detector camera = detectorFor("nikon-5100", lab.resolver, {});
    CHECK_THROWS_WITH(lab.film.project(nullptr, &camera, lab.eye), Contains("no X, Y, Z"));
}
