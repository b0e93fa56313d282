// Detectors as products of curves, eyes that lack a cone, and the night's luminous efficiency.
#include "colour/observe.h"
#include "spectrum/detector_product.h"
#include "spectrum/projection.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>

using namespace spectrad;
using Catch::Contains;

namespace {

const Library& library() {
    static const Library shared = Library::open();
    return shared;
}

struct Reader {
    Notes notes;
    SpectrumResolver resolver{library(), ".", false, notes};
    Detector detector(const std::string& text) { return detectorFor(text, resolver, {}); }
};

std::vector<double> seen(const Detector& detector, const Curve& light) {
    const std::array<const Curve*, 1> product{&light};
    return respond(detector, product);
}

double largest(const std::vector<double>& values) {
    return *std::max_element(values.begin(), values.end());
}

}  // namespace

TEST_CASE("A product of constants is a box whose integral is their product times its width") {
    Reader reader;
    const Detector detector =
        reader.detector("400:0.5 600:0.5 * constant:0.8 * (a = constant:0.25, b = 450:1 500:1 550:0)");
    REQUIRE(detector.channels == std::vector<std::string>{"A", "B"});
    const std::vector<double> signal = seen(detector, Curve::constant(3));
    CHECK(signal[0] == Approx(3 * 0.5 * 0.8 * 0.25 * 200).epsilon(1e-12));
    CHECK(signal[1] == Approx(3 * 0.5 * 0.8 * 50 * 1.5).epsilon(1e-12));
}

TEST_CASE("A quantum efficiency counts photons: electrons per joule are QE λ / hc") {
    Reader reader;
    const Detector detector = reader.detector("qe:500:0.4 600:0.4");
    const double hc = 6.62607015e-34 * 299'792'458;
    CHECK(seen(detector, Curve::constant(1))[0] ==
          Approx(0.4 * (600.0 * 600 - 500.0 * 500) / 2 * 1e-9 / hc).epsilon(1e-12));
}

TEST_CASE("Sixteen filters before one sensor are sixteen channels") {
    Reader reader;
    std::string text = "qe:sensors/ccd * filters/ir-cut * (";
    for (int i = 0; i < 16; ++i)
        text += (i ? ", " : "") + ("b" + std::to_string(400 + 20 * i)) +
                " = gaussian:" + std::to_string(400 + 20 * i) + ",10";
    const Detector detector = reader.detector(text + ")");
    REQUIRE(detector.size() == 16);
    CHECK(detector.channels[3] == "b460");
    CHECK_FALSE(detector.tristimulus);
    for (const double signal : seen(detector, Curve::constant(1)))
        CHECK(signal > 0);
}

TEST_CASE("The camera behind separation filters is the product of its published parts") {
    Reader reader;
    const Detector shipped = reader.detector("dcs200-like");
    const Detector product = reader.detector(
        "qe:sensors/ccd * filters/ir-cut * (R = filters/red, G = filters/green, B = filters/blue)");
    REQUIRE(shipped.channels == product.channels);
    const Curve light = Curve::blackbody(4000);
    const std::vector<double> a = seen(shipped, light), b = seen(product, light);
    for (size_t c = 0; c < 3; ++c)
        CHECK(a[c] / largest(a) ==
              Approx(b[c] / largest(b)).epsilon(1e-3));  // its file ends at 360 and 800 nm
}

TEST_CASE("Products that mean nothing are refused with the form that does") {
    Reader reader;
    CHECK_THROWS_WITH(reader.detector("filters/red * filters/ir-cut"), Contains("all filters and no sensor"));
    CHECK_THROWS_WITH(reader.detector("qe:filters/red"), Contains("no quantum efficiency"));
    CHECK_THROWS_WITH(reader.detector("qe:400:40 700:60"),
                      Contains("value 60 (allowed: at most 1)") && Contains("percent"));
    CHECK_THROWS_WITH(reader.detector("qe:observers/cie1931-2"), Contains("at most 1"));
    CHECK_THROWS_WITH(reader.detector("qe:constant:0.5"), Contains("goes on for ever"));
    CHECK(reader.detector("qe:nikon-5100").electrons);
    CHECK(reader.detector("qe:sensors/ccd * filters/red").electrons);
    CHECK(reader.detector("filters/ir-cut * (R = qe:500:0.4 600:0.4, G = qe:400:0.4 500:0.4)").electrons);
    CHECK_FALSE(reader.detector("nikon-5100").electrons);
    CHECK_FALSE(reader.detector("sensors/ccd * filters/red").electrons);
    CHECK_THROWS_WITH(reader.detector("cie1931-2 * "), Contains("empty factor"));
    CHECK_THROWS_WITH(reader.detector("sensors/ccd * (R = filters/red"), Contains("parentheses"));
    CHECK_THROWS_WITH(reader.detector("sensors/ccd * (filters/red)"), Contains("no channel"));
    CHECK_THROWS_WITH(reader.detector("sensors/ccd * (R = filters/red, R = filters/red)"),
                      Contains("'R' twice"));
    CHECK_THROWS_WITH(reader.detector("cameras/nikon-5100 * observers/cie1931-2"),
                      Contains("another factor"));
    CHECK_THROWS_WITH(reader.detector("sensors/ccd * illuminants/A"), Contains("power"));
}

TEST_CASE("An eye without a cone does not see the difference that only this cone sees") {
    Reader reader;
    const Detector cones = reader.detector("stockman-sharpe-2");
    const std::array<const char*, 3> eyes{"protanope", "deuteranope", "tritanope"};
    for (size_t missing = 0; missing < 3; ++missing) {
        // Three lights; the mixture that the other two cones do not see at all.
        const std::array<double, 3> nm{450, 540, 610};
        std::array<std::array<double, 3>, 3> signal{};
        for (size_t l = 0; l < 3; ++l)
            for (size_t c = 0; c < 3; ++c)
                signal[l][c] = cones.response[c].at(nm[l]);
        const size_t p = missing == 0 ? 1 : 0, q = missing == 2 ? 1 : 2;
        const Triple mixture{signal[1][p] * signal[2][q] - signal[1][q] * signal[2][p],
                             signal[2][p] * signal[0][q] - signal[2][q] * signal[0][p],
                             signal[0][p] * signal[1][q] - signal[0][q] * signal[1][p]};
        const Detector eye = reader.detector(eyes[missing]);
        REQUIRE(eye.tristimulus);
        double scale = 0;
        for (const double m : mixture)
            scale = std::max(scale, std::abs(m));
        for (size_t k = 0; k < 3; ++k) {
            double sum = 0;
            for (size_t l = 0; l < 3; ++l)
                sum += mixture[l] * eye.response[k].at(nm[l]);
            CHECK(std::abs(sum) < 1e-9 * scale);
        }
        // Neutral stays neutral, and so does the anchor of the spectrum.
        const Detector normal = reader.detector("cie2015-2");
        const auto xy = [](const std::vector<double>& v) { return *chromaticity({v[0], v[1], v[2]}); };
        const Curve equal = Curve::table({390, 830}, {1, 1});
        CHECK(xy(seen(eye, equal))[0] == Approx(xy(seen(normal, equal))[0]).margin(2e-4));
        const double anchor = missing == 2 ? 485 : 475;
        CHECK(eye.response[1].at(anchor) == Approx(normal.response[1].at(anchor)).epsilon(1e-3));
    }
}

TEST_CASE("A pigment shifted by 10 nm lies half-way between normal and missing") {
    Reader reader;
    const Detector cones = reader.detector("stockman-sharpe-2"), eye = reader.detector("protanomalous-10");
    double areaL = 0, areaM = 0;
    for (double nm = 390; nm <= 830; ++nm) {
        areaL += cones.response[0].at(nm);
        areaM += cones.response[1].at(nm);
    }
    for (const double nm : {450.0, 520.0, 600.0, 650.0}) {
        const double l =
            0.5 * cones.response[0].at(nm) + 0.5 * 0.96 * areaL / areaM * cones.response[1].at(nm);
        CHECK(eye.response[1].at(nm) ==
              Approx(0.68990272 * l + 0.34832189 * cones.response[1].at(nm)).epsilon(1e-6));
    }
}

TEST_CASE("At night 1700 lumens are a watt, and the picture is grey") {
    Reader reader;
    const Detector night = reader.detector("cie1951-scotopic"), day = reader.detector("cie1924-photopic");
    CHECK(night.scale == Approx(1700.1).margin(1.5));
    CHECK(day.scale == Approx(683.0).margin(0.1));
    const Triple grey = toXyz(towardsXyz(night, standardObserver(library())), {2.5});
    CHECK(grey == Triple{2.5, 2.5, 2.5});
}

// Run by tests/interop/detector_integrals.py, which knows the same integrals from colour-science.
TEST_CASE("Detector integrals for other programs", "[.][interop-export]") {
    const char* target = std::getenv("SPECTRAD_INTEGRALS");
    REQUIRE(target);
    std::ofstream out(target);
    out.precision(17);
    Reader reader;
    const std::vector<std::string> patches = library().find("charts/colorchecker").value().channels;
    const Spectrum chart = library().find("charts/colorchecker").value();
    for (const LibraryEntry& entry : library().list()) {
        if (entry.quantity != Quantity::sensitivity) continue;
        const bool whole = entry.name.find('/') == entry.name.rfind('/');
        if (!whole || !(entry.name.starts_with("observers/") || entry.name.starts_with("cameras/"))) continue;
        const Detector detector = reader.detector(entry.name);
        for (const char* light : {"A", "D65", "FL11"}) {
            const Curve lamp = library().find(std::string("illuminants/") + light).value().curve();
            for (size_t p = 0; p < chart.curves.size(); ++p) {
                const Curve patch = chart.curves[p].withOutside(Outside::hold);
                const std::array<const Curve*, 2> product{&lamp, &patch};
                const std::vector<double> channels = respond(detector, product);
                for (size_t c = 0; c < channels.size(); ++c)
                    out << entry.name << ',' << light << ',' << patches[p] << ',' << detector.channels[c]
                        << ',' << channels[c] / detector.scale << '\n';
            }
        }
    }
    REQUIRE(out.good());
}
