// Every way of writing a spectrum, in the order that counts, and every way of getting it wrong.
#include "spectrum/resolver.h"

#include "base/files.h"
#include "spectrum/projection.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace spectrad;
namespace fs = std::filesystem;

namespace {

const SourceLocation at{"s.xml", 4, 9};
const std::string head = "s.xml:4:9: ";

/// A scene's folder and a resolver in it, with the library that ships.
struct Fixture {
    TemporaryFolder folder;
    Library library{fs::path(SPECTRAD_SOURCE) / "spectra"};
    Notes notes;
    SpectrumResolver resolver{library, folder.path(), false, notes};

    void write(const std::string& file, const std::string& text) const {
        writeFile(folder.path() / file, text);
    }
    [[nodiscard]] Spectrum get(const std::string& text, Role role = Role::any) const {
        return resolver.resolve(text, role, at);
    }
    void define(const std::string& name, const std::string& value) { resolver.define(name, get(value), at); }
};

}  // namespace

TEST_CASE("A scene's own spectrum is found by its name, and unused ones are known") {
    Fixture f;
    f.define("paint", "400:0.1 700:0.3");
    f.define("spare", "constant:1");
    const Spectrum paint = f.get("paint", Role::reflectance);
    CHECK(paint.text == "paint");
    CHECK(paint.curve().at(550) == Approx(0.2));
    CHECK(paint.curve().at(800) == 0.3);
    REQUIRE(f.resolver.unused().size() == 1);
    CHECK(f.resolver.unused()[0].first == "spare");
    CHECK(f.resolver.unused()[0].second.line == 4);
    CHECK_THROWS_WITH(f.resolver.define("paint", f.get("constant:1"), {"s.xml", 8, 1}),
                      "s.xml:8:1: spectrum 'paint' is defined already, at s.xml:4:9");
}

TEST_CASE("Library names mean what ships, and observers need not say their folder") {
    Fixture f;
    const Spectrum d65 = f.get("illuminants/D65", Role::light);
    CHECK(d65.relative);
    CHECK(d65.curve().at(560) == 100);
    CHECK(d65.curve().at(200) == 0);
    CHECK(f.get("charts/colorchecker/dark-skin", Role::reflectance).curves.size() == 1);
    CHECK(f.get("metals/Au", Role::index).curves.size() == 2);
    for (const char* name : {"observers/cie1931-2", "cie1931-2"}) {
        const Spectrum observer = f.get(name, Role::detector);
        CHECK(observer.channels == std::vector<std::string>{"X", "Y", "Z"});
        CHECK(observer.text == name);
    }
    CHECK(f.get("nikon-5100", Role::detector).curves.size() == 3);
}

TEST_CASE("A file beside the scene gives column 2, or the column of that number or name") {
    Fixture f;
    f.write("lamp.csv",
            "# quantity: radiance\n# relative: yes\n# source: me\nnm,a,Patch 7\n400,1,5\n700,2,6\n");
    CHECK(f.get("lamp.csv", Role::light).curve().at(400) == 1);
    CHECK(f.get("lamp.csv#2", Role::light).curve().at(400) == 1);
    CHECK(f.get("lamp.csv#3", Role::light).curve().at(400) == 5);
    const Spectrum named = f.get("lamp.csv#Patch 7", Role::light);
    CHECK(named.curve().at(700) == 6);
    CHECK(named.quantity == Quantity::radiance);
    CHECK(named.relative);
    CHECK(named.source == "me");
    CHECK(named.channels == std::vector<std::string>{"Patch 7"});
    REQUIRE(named.files.size() == 1);
    CHECK(named.files[0] == f.folder.path() / "lamp.csv");
    CHECK(f.resolver.resolveFile("lamp.csv", "a", Role::light, at).curve().at(700) == 2);
    CHECK(f.resolver.resolveFile("lamp.csv", "", Role::any, at).curves.size() == 2);
}

TEST_CASE("A definition of a file with several columns serves as one curve, or as all where all are meant") {
    Fixture f;
    f.write("gold.csv", "nm,n,k\n400,1.5,2\n700,0.2,3\n");
    f.resolver.define("gold", f.resolver.resolveFile("gold.csv", "", Role::any, at), at);
    CHECK(f.get("gold", Role::index).curves.size() == 2);
    CHECK(f.get("gold", Role::light).curves.size() == 1);
    CHECK(f.get("gold", Role::light).curve().at(700) == 0.2);
}

TEST_CASE("A fluorophore gives each role its own column") {
    Fixture f;
    const Spectrum excitation = f.get("fluorophores/green", Role::excitation);
    CHECK(excitation.channels == std::vector<std::string>{"excitation"});
    CHECK(f.get("fluorophores/green", Role::emission).channels == std::vector<std::string>{"emission"});
    CHECK(f.get("fluorophores/green/emission", Role::emission).channels ==
          std::vector<std::string>{"emission"});
}

TEST_CASE("Every formula of the format is read") {
    const Fixture f;
    CHECK(f.get("constant:0.18", Role::reflectance).curve().at(1) == 0.18);
    CHECK(f.get("blackbody:2856", Role::light).curve().at(560) == Curve::blackbody(2856).at(560));
    CHECK(f.get("daylight:6504", Role::light).curve().at(560) == 100);
    CHECK(f.get("gaussian:450,20", Role::light).curve().at(460) == Approx(0.5));
    CHECK(f.get("line:632.8", Role::light).curve().lines()[0].nm == 632.8);
    CHECK(f.get("line:632.8,0.01", Role::light).curve().at(632.8) == Approx(100));
    CHECK(f.get("cauchy:1.5,0.004", Role::index).curve().at(500) == Approx(1.516));
    CHECK(f.get("sellmeier:1.03961212,0.00600069867,0.231792344,0.0200179144,1.01046945,103.560653",
                Role::index)
              .curve()
              .at(587.56) == Approx(1.5168).margin(1e-5));
    CHECK(f.get("1.5", Role::index).curve().at(500) == 1.5);
    CHECK(f.get("300:1 420:1 780:1", Role::light).curve().at(500) == 1);
    CHECK_FALSE(f.get("300:1 420:1", Role::light).relative);
    for (const char* text :
         {"blackbody:2856", "daylight:6504", "gaussian:450,20", "line:632.8", "constant:1"}) {
        CHECK(f.get(text, Role::light).relative);
        CHECK(f.get(text, Role::light).formula);
        CHECK(f.get(text, Role::light).text == text);
    }
}

TEST_CASE("A colour is a reflectance on a surface and that under D65 in a lamp") {
    Fixture f;
    const Spectrum surface = f.get("srgb:#808080", Role::reflectance);
    CHECK(surface.quantity == Quantity::reflectance);
    CHECK(surface.curve().at(550) == Approx(0.2158605).epsilon(1e-6));
    const Spectrum lamp = f.get("rgb:4,4,4", Role::light);
    CHECK(lamp.curve().at(560) == Approx(400));
    CHECK(lamp.curve().at(200) == 0);
    const Curve* factor = &lamp.curve();
    CHECK(integrate({&factor, 1}) > 0);
    f.define("glow", "srgb:#ffffff");
    CHECK(f.get("glow", Role::light).curve().at(560) == Approx(100));
    CHECK(f.get("glow", Role::reflectance).curve().at(560) == 1);
}

TEST_CASE("The first reading counts, and a second one is a warning that names both") {
    Fixture f;
    f.define("paint", "constant:0.5");
    CHECK(f.notes.lines().empty());
    f.write("paint", "400 0.1\n700 0.1\n");
    CHECK(f.get("paint", Role::reflectance).curve().at(500) == 0.5);
    REQUIRE(f.notes.lines().size() == 1);
    CHECK(f.notes.lines()[0] ==
          "s.xml:4:9: warning: 'paint' could mean the scene's spectrum 'paint' or the file " +
              (f.folder.path() / "paint").string() + "; the first is taken");
    f.define("illuminants/D65", "constant:7");
    CHECK(f.get("illuminants/D65", Role::light).curve().at(560) == 7);
    CHECK(f.notes.lines()[1] ==
          "s.xml:4:9: warning: 'illuminants/D65' could mean the scene's spectrum 'illuminants/D65' or the "
          "library's 'illuminants/D65'; the first is taken");
}

TEST_CASE("What lies outside a curve follows from its role") {
    Fixture f;
    f.define("s", "400:0.5 700:0.5");
    for (Role role : {Role::reflectance, Role::transmittance, Role::index})
        CHECK(f.get("s", role).curve().at(900) == 0.5);
    for (Role role : {Role::light, Role::detector, Role::excitation, Role::emission})
        CHECK(f.get("s", role).curve().at(900) == 0);
}

TEST_CASE("An unknown name is refused with the nearest known one") {
    Fixture f;
    f.define("paint", "constant:0.5");
    const std::string end = ": neither the scene nor the library has it, nor is it a file beside the scene";
    CHECK_THROWS_WITH(f.get("pant"), head + "unknown spectrum 'pant' (did you mean 'paint'?)" + end);
    CHECK_THROWS_WITH(f.get("illuminants/D66"),
                      Catch::Contains("unknown spectrum 'illuminants/D66' (did you mean 'illuminants/D"));
    CHECK_THROWS_WITH(f.get("D65"), head + "unknown spectrum 'D65' (did you mean 'illuminants/D65'?)" + end);
    CHECK_THROWS_WITH(f.get("quite-different-from-all"),
                      head + "unknown spectrum 'quite-different-from-all'" + end);
    CHECK_THROWS_WITH(f.get("gausian:450,20"), head +
                                                   "unknown formula 'gausian' (did you mean 'gaussian'?) "
                                                   "(allowed: constant, blackbody, daylight, gaussian, "
                                                   "line, srgb, rgb, sellmeier, cauchy, or pairs nm:value)");
    CHECK_THROWS_WITH(f.get("0.18", Role::reflectance),
                      head + "unknown spectrum '0.18' (for one value at all wavelengths: constant:0.18)");
    CHECK_THROWS_WITH(f.get("cie1931", Role::detector),
                      head + "unknown observer 'cie1931' (did you mean 'cie1931-2'?)" + end);
    CHECK_THROWS_WITH(f.get("nikon5100", Role::detector), Catch::Contains("did you mean 'nikon-5100'?"));
    CHECK_THROWS_WITH(f.get("sensors/cdd", Role::detector),
                      Catch::Contains("unknown spectrum 'sensors/cdd' (did you mean 'sensors/ccd'?)"));
    CHECK_THROWS_WITH(f.get("  "), head + "a spectrum without a name or value");
}

TEST_CASE("A missing file is refused with the path that was tried, a missing column with those there are") {
    Fixture f;
    f.write("lamp.csv", "nm,a,Patch 7\n400,1,5\n");
    const std::string tried = (f.folder.path() / "lmap.csv").string();
    CHECK_THROWS_WITH(
        f.get("lmap.csv#2"),
        head + "cannot find the file 'lmap.csv' (did you mean 'lamp.csv'?) (tried: " + tried + ")");
    CHECK_THROWS_WITH(f.resolver.findFile("/nowhere/x.csv", at),
                      head + "cannot find the file '/nowhere/x.csv' (tried: /nowhere/x.csv)");
    CHECK_THROWS_WITH(
        f.get("lamp.csv#Patch 8"),
        head + "'lamp.csv' has no column 'Patch 8' (did you mean 'Patch 7'?) (there are: a, Patch 7)");
    CHECK_THROWS_WITH(f.get("lamp.csv#1"),
                      head + "'lamp.csv' has no column 1 of values (allowed: 2 … 3; 1 is the wavelength)");
    CHECK_THROWS_WITH(f.get("lamp.csv#4"),
                      head + "'lamp.csv' has no column 4 of values (allowed: 2 … 3; 1 is the wavelength)");
    f.write("bad.csv", "nm,v\n400,nan\n");
    CHECK_THROWS_WITH(f.get("bad.csv"), (f.folder.path() / "bad.csv").string() +
                                            ":2: column 2 ('v') is 'nan', not a finite number");
    CHECK_THROWS_WITH(f.resolver.findFile("", at), head + "a file without a name");
    CHECK_THROWS_WITH(f.resolver.findFile(".", at), Catch::StartsWith(head + "'.' is not a file (at "));
}

TEST_CASE("A bad formula is refused with an example or with what is allowed") {
    const Fixture f;
    CHECK_THROWS_WITH(f.get("constant:x"),
                      head + "constant: 'x' is not a finite number (allowed: as in constant:0.18)");
    CHECK_THROWS_WITH(f.get("constant:1,2"),
                      head + "constant: takes one number (allowed: as in constant:0.18)");
    CHECK_THROWS_WITH(f.get("constant:inf"),
                      head + "constant: 'inf' is not a finite number (allowed: as in constant:0.18)");
    CHECK_THROWS_WITH(f.get("blackbody:0"), head + "blackbody: temperature 0 K (allowed: 1 … 100000000 K)");
    CHECK_THROWS_WITH(f.get("daylight:3000"),
                      head + "daylight: temperature 3000 K (allowed: 4000 … 25000 K)");
    CHECK_THROWS_WITH(f.get("gaussian:450"), head +
                                                 "gaussian: takes its centre and its full width at half "
                                                 "maximum, in nm (allowed: as in gaussian:450,20)");
    CHECK_THROWS_WITH(f.get("gaussian:450,0"), head + "gaussian: width 0 nm (allowed: 1e-06 … 1000000 nm)");
    CHECK_THROWS_WITH(f.get("line:0"), head + "line: wavelength 0 nm (allowed: 1 … 1000000 nm)");
    CHECK_THROWS_WITH(f.get("srgb:#12345"),
                      head + "srgb: takes # and six hexadecimal digits (allowed: as in srgb:#c04020)");
    CHECK_THROWS_WITH(f.get("srgb:#12345g"),
                      head + "srgb: takes # and six hexadecimal digits (allowed: as in srgb:#c04020)");
    CHECK_THROWS_WITH(f.get("rgb:1,0"),
                      head + "rgb: takes three linear sRGB components (allowed: as in rgb:0.8,0.2,0.1)");
    CHECK_THROWS_WITH(f.get("rgb:1.5,0,0", Role::reflectance), head + "rgb: component 1.5 (allowed: 0 … 1)");
    CHECK_THROWS_WITH(f.get("sellmeier:1,2,3", Role::index),
                      Catch::Contains("sellmeier: takes pairs B,C of numbers, one to three, C in µm²"));
    CHECK_THROWS_WITH(f.get("cauchy:0.2", Role::index),
                      head +
                          "cauchy: gives no index between 1 and 6 anywhere from 0.1 to 20 µm (allowed: as in "
                          "cauchy:1.5046,0.0042,0)");
    CHECK_THROWS_WITH(f.get("400:1 x:2"), Catch::Contains("'x:2' is not a pair nm:value"));
}

TEST_CASE("Values that a role does not allow are refused with the value and its wavelength") {
    const Fixture f;
    CHECK_THROWS_WITH(f.get("400:0.5 500:1.25", Role::reflectance),
                      head + "'400:0.5 500:1.25' as a reflectance: value 1.25 at 500 nm (allowed: 0 … 1)");
    CHECK_THROWS_WITH(f.get("400:5 500:45.5", Role::reflectance),
                      head +
                          "'400:5 500:45.5' as a reflectance: value 5 at 400 nm (allowed: 0 … 1); the values "
                          "look like percent: divide "
                          "them by 100");
    CHECK_THROWS_WITH(f.get("400:0.5 500:-0.1", Role::transmittance),
                      head + "'400:0.5 500:-0.1' as a transmittance: value -0.1 at 500 nm (allowed: 0 … 1)");
    CHECK_THROWS_WITH(f.get("constant:1.5", Role::reflectance),
                      head + "'constant:1.5' as a reflectance: value 1.5 (allowed: 0 … 1)");
    CHECK_THROWS_WITH(f.get("400:1 500:-2", Role::light),
                      head + "'400:1 500:-2' as a light: value -2 at 500 nm (allowed: 0 or more)");
    CHECK_THROWS_WITH(f.get("400:0 500:1", Role::index),
                      head + "'400:0 500:1' as an index: value 0 at 400 nm (allowed: n above 0)");
    CHECK_THROWS_WITH(f.get("400:0 500:0", Role::excitation),
                      head + "'400:0 500:0' is zero everywhere, but the shape of an excitation has a peak");
    CHECK(f.get("400:-1 500:2", Role::detector).curve().at(400) == -1);
}

TEST_CASE(
    "A spectrum of another quantity, several where one is meant, or a line where values are needed is "
    "refused") {
    Fixture f;
    CHECK_THROWS_WITH(f.get("illuminants/D65", Role::reflectance),
                      head + "'illuminants/D65' has the quantity power and cannot be a reflectance");
    CHECK_THROWS_WITH(f.get("metals/Au", Role::reflectance),
                      head + "'metals/Au' has the quantity index and cannot be a reflectance");
    CHECK_THROWS_WITH(f.get("cauchy:1.5", Role::light),
                      head + "'cauchy:1.5' has the quantity index and cannot be a light");
    CHECK_THROWS_WITH(f.get("blackbody:2856", Role::reflectance),
                      head + "'blackbody:2856' has the quantity power and cannot be a reflectance");
    CHECK_THROWS_WITH(
        f.get("charts/colorchecker", Role::reflectance),
        Catch::StartsWith(head +
                          "'charts/colorchecker' holds 24 spectra where one is meant; say which, as in "
                          "'charts/colorchecker/dark-skin' (there are: dark-skin, "));
    CHECK_THROWS_WITH(f.get("line:500", Role::reflectance),
                      head +
                          "'line:500' is a line of no width and cannot be a reflectance; give it a width, as "
                          "in line:500,0.01");
    // Not a fluorophore's either way: no band of what it sends out would hold the line's light.
    for (const Role role : {Role::excitation, Role::emission})
        CHECK_THROWS_WITH(f.get("line:500", role),
                          Catch::Contains("'line:500' is a line of no width and cannot be an "));
    f.write("three.csv", "400,1,2,3\n");
    CHECK_THROWS_WITH(
        f.get("three.csv", Role::index),
        head + "'three.csv' has 3 columns, but an index has n, or n and k (column 2, column 3, column 4)");
}

TEST_CASE("Restricted, no file outside the scene's folder is read, links resolved, but the library's") {
    const TemporaryFolder outer;
    fs::create_directories(outer.path() / "scene");
    writeFile(outer.path() / "secret.csv", "400,1\n");
    writeFile(outer.path() / "scene/mine.csv", "400,1\n");
    fs::create_symlink(outer.path() / "secret.csv", outer.path() / "scene/link.csv");
    const Library library(fs::path(SPECTRAD_SOURCE) / "spectra");
    Notes notes;
    const SpectrumResolver strict(library, outer.path() / "scene", true, notes),
        open(library, outer.path() / "scene", false, notes);
    const std::string refusal = "lies outside the scene's folder, which is not allowed here (--restrict)";

    CHECK(open.resolve("../secret.csv", Role::light, at).curves.size() == 1);
    CHECK(open.resolve("link.csv", Role::light, at).curves.size() == 1);
    CHECK(strict.resolve("mine.csv", Role::light, at).curves.size() == 1);
    CHECK(strict.resolve("../scene/mine.csv", Role::light, at).curves.size() == 1);
    CHECK(strict.resolve("illuminants/A", Role::light, at).curves.size() == 1);
    CHECK_THROWS_WITH(strict.resolve("../secret.csv", Role::light, at), head + "'../secret.csv' " + refusal);
    CHECK_THROWS_WITH(strict.resolve("link.csv", Role::light, at), head + "'link.csv' " + refusal);
    CHECK_THROWS_WITH(strict.resolve((outer.path() / "secret.csv").string(), Role::light, at),
                      Catch::EndsWith(refusal));
    // Whether it exists is not told.
    CHECK_THROWS_WITH(strict.resolve("../absent.csv", Role::light, at), head + "'../absent.csv' " + refusal);
    CHECK_THROWS_WITH(strict.findFile("../secret.csv", at), head + "'../secret.csv' " + refusal);
}

TEST_CASE("Quantities keep their names, and unknown ones are refused") {
    for (Quantity q : {Quantity::reflectance, Quantity::transmittance, Quantity::radiance,
                       Quantity::irradiance, Quantity::intensity, Quantity::power, Quantity::sensitivity,
                       Quantity::index, Quantity::reradiation})
        CHECK(parseQuantity(name(q), at) == q);
    CHECK_THROWS_WITH(parseQuantity("reflectence", at),
                      head +
                          "unknown quantity 'reflectence' (did you mean 'reflectance'?) (allowed: "
                          "reflectance, transmittance, radiance, "
                          "irradiance, intensity, power, sensitivity, index, reradiation, density)");
}
