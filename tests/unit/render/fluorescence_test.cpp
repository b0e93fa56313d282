// Reradiation against a direct product with the matrix, in double precision and independently of the
// library's integrals.
#include "render/fluorescence.h"

#include "render/donaldson.h"
#include "spectrum/library.h"
#include "spectrum/projection.h"
#include "support/bispectral_exr.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

using namespace spectrad;

namespace {

using Function = std::function<double(double)>;

const Library& library() {
    static const Library opened = Library::open();
    return opened;
}

double gauss(double nm, double centre, double fwhm) {
    return std::exp(-4 * std::log(2.0) * (nm - centre) * (nm - centre) / (fwhm * fwhm));
}

/// Samples of the library, linear between, zero outside.
struct Samples {
    std::vector<double> nm, value;
    Samples(const std::string& name, size_t column) {
        const Curve curve = library().find(name).value().curves.at(column);
        nm.assign(curve.sampleWavelengths().begin(), curve.sampleWavelengths().end());
        value.assign(curve.sampleValues().begin(), curve.sampleValues().end());
        const double peak = *std::max_element(value.begin(), value.end());
        for (double& v : value)
            v /= peak;
    }
    double operator()(double at) const {
        if (at < nm.front() || at > nm.back()) return 0;
        const auto i = std::min(static_cast<size_t>(std::upper_bound(nm.begin(), nm.end(), at) - nm.begin()),
                                nm.size() - 1);
        return value[i - 1] + (value[i] - value[i - 1]) * (at - nm[i - 1]) / (nm[i] - nm[i - 1]);
    }
};

/// A fluorophore on a base, as formulae of the interface's text.
struct Sample {
    Function excitation, emission;  ///< peak 1; energy per nm
    Function base = [](double) { return 0.5; };
    double yield = 1, strength = 1, inside = 0;
    bool antiStokes = false;
};
struct Lamp {
    Function irradiance;
    std::vector<SpectralLine> lines;
};

/// Points and weights of a 3-point Gauss rule on cells of a quarter of a nanometre, cut at `knots` too.
struct Cells {
    std::vector<double> edge;
    Cells(double from, double to, const std::vector<double>& knots) {
        for (double nm = from; nm <= to; nm += 0.25)
            edge.push_back(nm);
        for (double nm : knots)
            if (nm > from && nm < to) edge.push_back(nm);
        std::sort(edge.begin(), edge.end());
        edge.erase(std::unique(edge.begin(), edge.end()), edge.end());
    }
};
constexpr std::array<double, 3> ruleAt{0.11270166537925831148, 0.5, 0.88729833462074168852},
    ruleWeight{5.0 / 18, 8.0 / 18, 5.0 / 18};

double cell(double from, double to, const Function& f) {
    double sum = 0;
    for (size_t i = 0; i < 3; ++i)
        sum += ruleWeight[i] * f(from + (to - from) * ruleAt[i]);
    return sum * (to - from);
}

/// Hat averages over 400:700:10 of ∫ M(λo, λi) E(λi) dλi, row of the matrix by row.
std::vector<double> directProduct(const Sample& s, const Lamp& lamp, const std::vector<double>& knots) {
    const Cells cells(250, 850, knots);
    double photons = 0;
    for (size_t c = 0; c + 1 < cells.edge.size(); ++c)
        photons += cell(cells.edge[c], cells.edge[c + 1], [&](double nm) { return s.emission(nm) * nm; });
    // What a wavelength adds to any emission above it: a(λi) λi, through the coat.
    const Function taken = [&](double nm) {
        return s.strength * s.excitation(nm) * (1 - s.base(nm)) * nm / (1 - s.base(nm) * s.inside);
    };
    const Function in = [&](double nm) { return taken(nm) * lamp.irradiance(nm); };
    std::vector<double> whole;
    for (size_t c = 0; c + 1 < cells.edge.size(); ++c)
        whole.push_back(cell(cells.edge[c], cells.edge[c + 1], in));
    const auto row = [&](double out, size_t c) {
        double sum = 0;
        for (size_t i = 0; i < (s.antiStokes ? whole.size() : c); ++i)
            sum += whole[i];
        if (!s.antiStokes) sum += cell(cells.edge[c], out, in);
        for (const SpectralLine& line : lamp.lines)
            if (s.antiStokes || line.nm <= out) sum += line.integral * taken(line.nm);
        return s.yield * s.emission(out) / photons * sum * (1 - s.inside) / (1 - s.base(out) * s.inside);
    };
    std::vector<double> bands(31, 0.0);
    for (size_t c = 0; c + 1 < cells.edge.size(); ++c) {
        const double from = cells.edge[c], to = cells.edge[c + 1];
        if (from < 400 || to > 700) continue;
        for (size_t i = 0; i < 3; ++i) {
            const double nm = from + (to - from) * ruleAt[i],
                         value = row(nm, c) * ruleWeight[i] * (to - from);
            const double place = (nm - 400) / 10;
            const auto band = static_cast<size_t>(place);
            bands[band] += value * (1 - (place - static_cast<double>(band)));
            bands[band + 1] += value * (place - static_cast<double>(band));
        }
    }
    for (size_t j = 0; j < bands.size(); ++j)
        bands[j] /= j == 0 || j + 1 == bands.size() ? 5 : 10;
    return bands;
}

Spectrum of(Curve curve) {
    Spectrum spectrum;
    spectrum.curves = {std::move(curve)};
    return spectrum;
}

Fluorescence fluorophore(Curve excitation, Curve emission, double yield) {
    Fluorescence f;
    f.excitation = of(std::move(excitation));
    f.emission = of(std::move(emission));
    f.yield = yield;
    return f;
}

Material materialOf(std::vector<Fluorescence> parts, std::optional<Curve> base) {
    Material m;
    m.name = "sample";
    if (base) m.diffuse.emplace().reflectance = of(std::move(*base));
    m.fluorescence = std::move(parts);
    return m;
}

const Wavelengths grid = parseWavelengths("400:700:10", {});

std::vector<double> projected(const Curve& curve) {
    const std::array<const Curve*, 1> product{&curve};
    return project(grid, product);
}

/// The glow of one fluorophore on the grid.
std::vector<double> glow(const Material& material, const Curve& light, double inside = 0) {
    Notes notes;
    const std::vector<Curve> curves = FluorescentBase(material, inside, notes).reradiation(light);
    REQUIRE(curves.size() == 1);
    return projected(curves.front());
}

/// Largest relative difference; what is below a billionth of the peak counts as that.
double worst(const std::vector<double>& got, const std::vector<double>& want) {
    const double peak = *std::max_element(want.begin(), want.end());
    double error = 0;
    for (size_t j = 0; j < want.size(); ++j)
        error = std::max(error, std::abs(got[j] - want[j]) / std::max(std::abs(want[j]), 1e-9 * peak));
    return peak > 0 ? error : 1;
}

std::vector<double> knotsOf(const Curve& curve) {
    return {curve.sampleWavelengths().begin(), curve.sampleWavelengths().end()};
}

double photonsOf(const Curve& curve) {
    const Curve wavelength = Curve::table({100, 2000}, {100, 2000});
    const std::array<const Curve*, 2> product{&curve, &wavelength};
    return integrate(product, 250, 900);
}

}  // namespace

TEST_CASE("a separable fluorophore is the direct product with its matrix, within 1e-6 in every band") {
    const Curve excitation = Curve::gaussian(380, 60), emission = Curve::gaussian(470, 90);  // they overlap
    Sample s;
    s.excitation = [](double nm) { return gauss(nm, 380, 60); };
    s.emission = [](double nm) { return gauss(nm, 470, 90); };
    s.yield = 0.8;
    Material material = materialOf({fluorophore(excitation, emission, 0.8)}, Curve::constant(0.5));
    const std::vector<double> lampNm{250, 300, 420, 780}, lampValue{0, 1, 3, 0.5};
    Lamp lamp{[&](double nm) {
                  for (size_t i = 0; i + 1 < lampNm.size(); ++i)
                      if (nm >= lampNm[i] && nm <= lampNm[i + 1])
                          return lampValue[i] + (lampValue[i + 1] - lampValue[i]) * (nm - lampNm[i]) /
                                                    (lampNm[i + 1] - lampNm[i]);
                  return 0.0;
              },
              {}};
    const Curve light = Curve::table(lampNm, lampValue);

    CHECK(worst(glow(material, light), directProduct(s, lamp, {})) <= 1e-6);
    SECTION("half of it, by strength") {
        material.fluorescence[0].strength = s.strength = 0.5;
        CHECK(worst(glow(material, light), directProduct(s, lamp, {})) <= 1e-6);
    }
    SECTION("emission above the excitation's energy, where asked for") {
        const std::vector<double> without = glow(material, light);
        material.fluorescence[0].antiStokes = s.antiStokes = true;
        const std::vector<double> with = glow(material, light);
        CHECK(worst(with, directProduct(s, lamp, {})) <= 1e-6);
        CHECK(with[0] > 1.01 * without[0]);
    }
    SECTION("emission counted in photons") {
        material.fluorescence[0].emissionInPhotons = true;
        s.emission = [](double nm) { return gauss(nm, 470, 90) / nm; };
        CHECK(worst(glow(material, light), directProduct(s, lamp, {})) <= 1e-6);
    }
    SECTION("through a coat that sends 60 % back down, on a base that is not grey") {
        material.diffuse->reflectance = of(Curve::table({400, 700}, {0.2, 0.9}, Outside::hold));
        s.base = [](double nm) { return 0.2 + 0.7 * std::clamp((nm - 400) / 300, 0.0, 1.0); };
        s.inside = 0.6;
        CHECK(worst(glow(material, light, 0.6), directProduct(s, lamp, {})) <= 1e-6);
    }
    SECTION("lines in the ultraviolet and within the emission") {
        lamp = {[](double) { return 0.0; }, {{365.4, 1}}};
        CHECK(worst(glow(material, Curve::line(365.4)), directProduct(s, lamp, {})) <= 1e-6);
        lamp.lines[0].nm = 441.3;  // emission below it is none: a jump
        CHECK(worst(glow(material, Curve::line(441.3)), directProduct(s, lamp, {441.3})) <= 1e-6);
    }
}

TEST_CASE("the library's fluorophores under its lamps are the direct product, within 1e-6 in every band") {
    for (const std::string dye : {"fluorophores/quinine", "fluorophores/optical-brightener",
                                  "fluorophores/green", "fluorophores/red"}) {
        const Spectrum found = library().find(dye).value();
        Sample s;
        s.excitation = Samples(dye, 0);
        s.emission = Samples(dye, 1);
        const Material material =
            materialOf({fluorophore(found.curves.at(0), found.curves.at(1), 1)}, Curve::constant(0.5));
        for (const std::string name :
             {"illuminants/D65", "illuminants/A", "illuminants/FL11", "lamps/uv-365"}) {
            const Curve light = library().find(name).value().curve();
            const Samples shape(name, 0);
            const double top = light.bounds().second;
            const Lamp lamp{[&](double nm) { return top * shape(nm); }, {}};
            CAPTURE(dye, name);
            CHECK(worst(glow(material, light), directProduct(s, lamp, knotsOf(light))) <= 1e-6);
        }
    }
}

TEST_CASE("as many photons leave as a yield of 1 takes in, and never more") {
    Notes notes;
    const Curve narrow = Curve::gaussian(350, 20);
    // Excitation and emission apart: what is absorbed leaves.
    const Material apart =
        materialOf({fluorophore(Curve::gaussian(350, 20), Curve::gaussian(520, 40), 1)}, Curve::constant(0));
    const Curve out = FluorescentBase(apart, 0, notes).reradiation(narrow).front();
    const Curve absorbed = Curve::combined({narrow}, [](std::span<const double> v) { return v[0] * v[0]; });
    CHECK(photonsOf(out) == Approx(photonsOf(absorbed)).epsilon(1e-8));
    // Overlapping, on every base, under every lamp, coated or not: reflected and emitted together at most
    // what came in.
    for (const std::string dye : {"fluorophores/orange", "fluorophores/yellow"}) {
        const Spectrum found = library().find(dye).value();
        for (double reflectance : {0.0, 0.3, 0.9, 1.0}) {
            for (double inside : {0.0, 0.6}) {
                const Material m = materialOf({fluorophore(found.curves.at(0), found.curves.at(1), 1)},
                                              Curve::constant(reflectance));
                const FluorescentBase base(m, inside, notes);
                for (const std::string name : {"illuminants/D65", "illuminants/FL11", "lamps/uv-365"}) {
                    const Curve light = library().find(name).value().curve();
                    const Curve back = base.reflectance(), glowing = base.reradiation(light).front();
                    const Curve reflected =
                        Curve::combined({light, back}, [](std::span<const double> v) { return v[0] * v[1]; });
                    CAPTURE(dye, reflectance, inside, name);
                    CHECK(photonsOf(reflected) + photonsOf(glowing) <= photonsOf(light) * (1 + 1e-9));
                    if (reflectance < 1) CHECK(photonsOf(glowing) > 0);
                }
            }
        }
    }
    CHECK(notes.lines().empty());
}

TEST_CASE("fluorophores on one substrate add; where they would absorb more than there is, it is said") {
    const Curve light = library().find("illuminants/D65").value().curve();
    Fluorescence blue = fluorophore(Curve::gaussian(360, 40), Curve::gaussian(450, 50), 0.9);
    Fluorescence red = fluorophore(Curve::gaussian(520, 40), Curve::gaussian(610, 40), 0.7);
    Notes notes;
    const std::vector<Curve> both =
        FluorescentBase(materialOf({blue, red}, Curve::constant(0.4)), 0, notes).reradiation(light);
    REQUIRE(both.size() == 2);
    CHECK(worst(projected(both[0]), glow(materialOf({blue}, Curve::constant(0.4)), light)) <= 1e-14);
    CHECK(worst(projected(both[1]), glow(materialOf({red}, Curve::constant(0.4)), light)) <= 1e-14);
    CHECK(notes.lines().empty());
    const FluorescentBase twice(materialOf({blue, blue}, Curve::constant(0.4)), 0, notes);
    REQUIRE(notes.lines().size() == 1);
    CHECK(notes.lines().front().find("absorb") != std::string::npos);
}

TEST_CASE("a Donaldson matrix is read as written, in any order of its columns") {
    const TemporaryFolder folder;
    const auto path = folder.write(
        "m.csv", "# measured\nemission_nm,ex420,ex400\n400,0.01,0.5\n420,0.6,0.2\n440,0.3,0.1\n");
    Notes notes;
    const DonaldsonMatrix m = readDonaldson(path.string(), notes);
    CHECK(m.emission == std::vector<double>{400, 420, 440});
    CHECK(m.excitation == std::vector<double>{400, 420});
    CHECK(m.value == std::vector<std::vector<double>>{{0.5, 0.01}, {0.2, 0.6}, {0.1, 0.3}});
    const auto refused = [&](const std::string& text, const std::string& word) {
        try {
            (void)readDonaldson(folder.write("bad.csv", text).string(), notes);
            FAIL("not refused: " << text);
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).find(word) != std::string::npos);
        }
    };
    refused("emission_nm,ex400,in420\n400,1,2\n420,1,2\n", "in420");
    refused("emission_nm,ex400,ex400\n400,1,2\n420,1,2\n", "400 nm");
    refused("emission_nm,ex400\n400,1\n420,1\n", "two excitation");
    refused("emission_nm,ex400,ex420\n400,1,2\n", "two emission");
}

TEST_CASE("a two-by-two matrix worked out by hand") {
    const TemporaryFolder folder;
    Fluorescence f;
    f.matrixFile =
        folder.write("m.csv", "emission_nm,ex400,ex420\n400,0.5,0.01\n420,0.2,0.6\n440,0.1,-0.3\n").string();
    Notes notes;
    const FluorescentBase base(materialOf({f}, std::nullopt), 0, notes);
    // The cell at 400 nm for light of 420 nm is zeroed, and said.
    REQUIRE(notes.lines().size() == 1);
    CHECK(notes.lines().front().find("1 cells") != std::string::npos);
    // Diagonal 0.5, 0.6; held outside.
    CHECK(base.reflectance().at(410) == Approx(0.55));
    CHECK(base.reflectance().at(300) == Approx(0.5));
    CHECK(base.reflectance().at(700) == Approx(0.6));
    // Bands 390…410 and 410…430: mean irradiance 2 and 5; a line counts by its integral over 20 nm.
    const Curve light = Curve::table({390, 410, 410, 430}, {2, 2, 5, 5});
    const Curve out = base.reradiation(light).front();
    CHECK(out.at(400) == Approx(0));
    CHECK(out.at(420) == Approx(0.2 * 2));
    CHECK(out.at(440) ==
          Approx(0.1 * 2 - 0.3 * 5));  // signed here; the sum with the reflection is what may not be negative
    CHECK(out.at(430) == Approx(0.5 * (out.at(420) + out.at(440))));
    CHECK(out.at(450) == 0);
    CHECK(base.reradiation(Curve::line(405, 3)).front().at(420) == Approx(0.2 * 3 / 20));
    f.antiStokes = true;
    CHECK(FluorescentBase(materialOf({f}, std::nullopt), 0, notes).reradiation(light).front().at(400) ==
          Approx(0.01 * 5));
}

TEST_CASE("a matrix that contradicts what stands beside it, or gains energy, is refused or said") {
    const TemporaryFolder folder;
    Fluorescence f;
    f.matrixFile =
        folder.write("m.csv", "emission_nm,ex400,ex420\n400,0.5,0\n420,0.2,0.6\n440,0.9,0.8\n460,0.9,0.8\n")
            .string();
    Notes notes;
    CHECK_THROWS_AS(FluorescentBase(materialOf({f}, Curve::constant(0.5)), 0, notes), InputError);
    CHECK_THROWS_AS(FluorescentBase(materialOf({f, f}, std::nullopt), 0, notes), InputError);
    CHECK(notes.lines().size() >= 1);  // columns that send out more than they take in
    CHECK(notes.lines().front().find("more energy") != std::string::npos);
    f.diagonalNone = true;
    CHECK_NOTHROW(FluorescentBase(materialOf({f}, Curve::constant(0.5)), 0, notes));
    f.diagonalNone = false;
    f.matrixFile = folder.write("n.csv", "emission_nm,ex400,ex420\n405,0.5,0\n425,0.2,0.6\n").string();
    CHECK_THROWS_WITH(FluorescentBase(materialOf({f}, std::nullopt), 0, notes),
                      Catch::Contains("no diagonal"));
}

TEST_CASE(
    "matrices measured at RIT under D65, A and an ultraviolet lamp are the direct product, within 1e-6") {
    for (const std::string name : {"ciba12", "herpiora", "ixcrlale", "php8hp1c"}) {
        const std::filesystem::path path =
            std::filesystem::path(SPECTRAD_SHARED) / "data/fluorescence/bispectral_rit" / (name + ".csv");
        if (!std::filesystem::exists(path)) {
            WARN("skipped: no " << path.string());
            continue;
        }
        Notes notes;
        const DonaldsonMatrix m = readDonaldson(path.string(), notes);
        REQUIRE((m.emission.size() == 41 && m.excitation.size() == 49));
        Fluorescence f;
        f.matrixFile = path.string();
        const FluorescentBase base(materialOf({f}, std::nullopt), 0, notes);
        for (const std::string lampName : {"illuminants/D65", "illuminants/A", "lamps/uv-365"}) {
            const Curve light = library().find(lampName).value().curve();
            const Samples shape(lampName, 0);
            const double top = light.bounds().second;
            const Cells cells(295, 785, knotsOf(light));
            std::vector<double> rows(41, 0.0);
            for (size_t i = 0; i < 49; ++i) {
                double mean = 0;
                for (size_t c = 0; c + 1 < cells.edge.size(); ++c)
                    if (cells.edge[c] >= m.excitation[i] - 5 && cells.edge[c + 1] <= m.excitation[i] + 5)
                        mean += cell(cells.edge[c], cells.edge[c + 1],
                                     [&](double nm) { return top * shape(nm); }) /
                                10;
                for (size_t r = 0; r < 41; ++r)
                    if (m.emission[r] > m.excitation[i]) rows[r] += m.value[r][i] * mean;
            }
            // Linear between rows 10 nm apart, so the hat of a band inside weighs them 1, 4, 1.
            std::vector<double> want, got = projected(base.reradiation(light).front());
            for (size_t j = 0; j < grid.size(); ++j) {
                const size_t r = j + 2;
                want.push_back(j == 0                 ? (2 * rows[r] + rows[r + 1]) / 3
                               : j + 1 == grid.size() ? (2 * rows[r] + rows[r - 1]) / 3
                                                      : (rows[r - 1] + 4 * rows[r] + rows[r + 1]) / 6);
            }
            const double peak = *std::max_element(want.begin(), want.end());
            REQUIRE(peak > 0);
            for (size_t j = 0; j < want.size(); ++j) {
                CAPTURE(name, lampName, j);
                CHECK(std::abs(got[j] - want[j]) <= 1e-6 * std::max(std::abs(want[j]), 1e-3 * peak));
            }
        }
    }
}

TEST_CASE("a matrix in the bispectral EXR layout glows as the same matrix in a text") {
    const TemporaryFolder folder;
    const std::string csv = "emission_nm,ex400,ex420\n400,0.5,0\n420,0.25,0.625\n440,0.125,0.375\n";
    Fluorescence text, image;
    text.matrixFile = folder.write("m.csv", csv).string();
    image.matrixFile = (folder.path() / "m.exr").string();
    test::writeBispectral(
        image.matrixFile,
        {{400, 400, 0.5}, {420, 420, 0.625}, {400, 420, 0.25}, {400, 440, 0.125}, {420, 440, 0.375}});
    Notes notes;
    const DonaldsonMatrix read = readDonaldson(image.matrixFile, notes),
                          same = readDonaldson(text.matrixFile, notes);
    CHECK(read.emission == same.emission);
    CHECK(read.excitation == same.excitation);
    CHECK(read.value == same.value);
    CHECK(notes.lines().empty());  // below the diagonal no channel is missed
    test::writeBispectral(image.matrixFile, {{400, 400, 0.5}, {420, 420, 0.6}, {400, 440, 0.1}});
    (void)readDonaldson(image.matrixFile, notes);
    REQUIRE(notes.lines().size() == 1);
    CHECK_THAT(notes.lines().front(), Catch::Contains("2 of 6 pairs"));
}

TEST_CASE(
    "matrices measured at RIT: through an EXR and back the same glow, and never more photons than came") {
    for (const std::string name : {"ciba12", "herpiora", "ixcrlale", "php8hp1c"}) {
        const std::filesystem::path path =
            std::filesystem::path(SPECTRAD_SHARED) / "data/fluorescence/bispectral_rit" / (name + ".csv");
        if (!std::filesystem::exists(path)) {
            WARN("skipped: no " << path.string());
            continue;
        }
        const TemporaryFolder folder;
        Notes notes;
        const DonaldsonMatrix m = readDonaldson(path.string(), notes);
        std::vector<BispectralCell> cells;
        for (size_t r = 0; r < m.emission.size(); ++r)
            for (size_t i = 0; i < m.excitation.size(); ++i)
                cells.push_back({m.excitation[i], m.emission[r], m.value[r][i]});
        Fluorescence text, image;
        text.matrixFile = path.string();
        image.matrixFile = (folder.path() / "m.exr").string();
        test::writeBispectral(image.matrixFile, cells);
        const FluorescentBase a(materialOf({text}, std::nullopt), 0, notes),
            b(materialOf({image}, std::nullopt), 0, notes);
        CAPTURE(name);
        CHECK(b.figures().at(0).matrix->zeroed == a.figures().at(0).matrix->zeroed);
        CHECK(a.figures().at(0).matrix->mostPhotons <= 1);
        CHECK(a.figures().at(0).stokesShift() == b.figures().at(0).stokesShift());
        for (const std::string lampName : {"illuminants/D65", "illuminants/A", "lamps/uv-365"}) {
            const Curve light = library().find(lampName).value().curve();
            const std::vector<double> want = projected(a.reradiation(light).front()),
                                      got = projected(b.reradiation(light).front());
            const double peak = *std::max_element(want.begin(), want.end());
            for (size_t j = 0; j < want.size(); ++j)
                CHECK(std::abs(got[j] - want[j]) <= 1e-6 * peak);  // cells are floats in the file
            const Curve both = Curve::combined({light, a.reflectance()},
                                               [](std::span<const double> v) { return v[0] * v[1]; });
            CHECK(photonsOf(both) + photonsOf(a.reradiation(light).front()) <= photonsOf(light));
        }
    }
}
