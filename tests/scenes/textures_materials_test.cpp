// Images on materials: an image that holds one reflectance everywhere is that reflectance, whatever lies over
// it or glows in it; pictures that choose and mask do it exactly.
#include "image/cube.h"
#include "image/picture.h"
#include "image/png16.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace spectrad;
using namespace spectrad::test;

namespace {

const std::vector<double> paintNm{350, 420, 480, 500, 520, 600, 640, 760};
const std::vector<float> paint{0.05f, 0.2f, 0.95f, 0.1f, 0.6f, 0.9f, 0.3f, 0.99f};
const std::string paintPairs = "350:0.05 420:0.2 480:0.95 500:0.1 520:0.6 600:0.9 640:0.3 760:0.99";

class Workshop {
  public:
    Workshop() {
        cube("paint.exr", paintNm, paint);
        cube("flat.exr", {400, 450, 500, 600, 700}, {0.6f, 0.6f, 0.6f, 0.6f, 0.6f});
        grey("grey.png", {128, 128, 128, 128});
        grey("halves.png", {0, 0, 255, 255});
        grey("steps.png", {0, 51, 204, 255});
    }
    /// A reflectance everywhere, as a cube of point values.
    void cube(const std::string& name, const std::vector<double>& nm, const std::vector<float>& curve) const {
        CubeInfo info;
        info.width = 4;
        info.height = 2;
        info.kind = CubeKind::reflectance;
        info.wavelengths.nm = nm;
        info.wavelengths.projection = Projection::point;
        info.projectionStated = true;
        std::vector<float> values;
        for (int row = 0; row < 2; ++row)
            for (float value : curve)
                values.insert(values.end(), 4, value);
        const auto writer = createExr(folder_.path() / name, info, {});
        writer->write(2, values.data(), std::vector<float>(24, 0.0f).data());
        (void)writer->finish();
    }
    void grey(const std::string& name, const std::vector<std::uint8_t>& row) const {
        writePng(folder_.path() / name, {static_cast<int>(row.size()), 1, 1, row}, {}, {});
    }
    /// Marked as linear.
    void grey16(const std::string& name, const std::vector<std::uint16_t>& row) const {
        writePng16(folder_.path() / name, {static_cast<int>(row.size()), 1, 1, row});
    }
    void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
    [[nodiscard]] Scene scene(const std::string& lobes, const std::string& light,
                              const std::string& bands) const {
        const std::string text =
            "<scene version=\"1\"><wavelengths projection=\"" + bands +
            "\" from=\"400\" to=\"700\" step=\"20\"/><material name=\"m\">" + lobes +
            "</material><node rotate=\"1 1 0 25\"><plane size=\"4 2\" material=\"m\"/></node>" + light +
            R"(<camera fov="20" look-from="0.3 0.2 5" look-at="0 0 0" size="70x20"/></scene>)";
        Notes notes;
        return loadScene(folder_.write("scene.xml", text), library(), {}, notes);
    }
    [[nodiscard]] Image render(const std::string& lobes, const std::string& light = window,
                               Only only = Only::everything, const std::string& bands = "slit") const {
        RenderSettings settings;
        settings.only = only;
        settings.samples = 4;
        return imageOf(scene(lobes, light, bands), settings);
    }
    [[nodiscard]] std::string refusal(const std::string& lobes) const {
        try {
            (void)render(lobes);
        } catch (const InputError& error) {
            return error.what();
        }
        return "not refused";
    }

    static inline const std::string window =
        R"(<light type="directional" direction="0.3 -0.2 -1" spectrum="illuminants/FL11" illuminance="500 lx"/>)";
    static inline const std::string sky =
        R"(<light type="ambient" spectrum="illuminants/D65" luminance="80 cd/m2"/>)";

  private:
    TemporaryFolder folder_;
};

/// The largest difference ÷ the second image's value there, or a millionth of its largest where that is more.
double difference(const Image& a, const Image& b) {
    REQUIRE(a.values.size() == b.values.size());
    const float most = *std::max_element(b.values.begin(), b.values.end());
    REQUIRE(most > 0);
    double worst = 0;
    for (size_t i = 0; i < a.values.size(); ++i) {
        const double scale = std::max<double>(std::abs(b.values[i]), 1e-4 * most);
        worst = std::max(worst, std::abs(a.values[i] - b.values[i]) / scale);
    }
    return worst;
}

const std::string plain = "<diffuse reflectance=\"" + paintPairs + "\"/>";
const std::string textured = "<diffuse texture=\"paint.exr\"/>";
const std::string dye =
    R"(<fluorescence excitation="gaussian:430,60" emission="gaussian:540,50" yield="0.8" strength="0.7")";

std::vector<std::string> coats() {
    return {"", R"(<gloss ior="1.5" roughness="0.3"/>)", R"(<gloss ior="1.9" roughness="0"/>)",
            R"(<gloss ior="cauchy:1.45,0.02" roughness="0.5"/>)",
            R"(<specular reflectance="400:0.05 700:0.6" roughness="0.4"/>)"};
}

}  // namespace

TEST_CASE(
    "an image of one reflectance everywhere is that reflectance: bare, under every coat, in every light") {
    if (!haveDevice()) return;
    const Workshop shop;
    for (const std::string& coat : coats())
        for (const std::string& light : {Workshop::window, Workshop::sky})
            for (const std::string bands : {"slit", "point"}) {
                CAPTURE(coat, light, bands);
                CHECK(difference(shop.render(textured + coat, light, Only::everything, bands),
                                 shop.render(plain + coat, light, Only::everything, bands)) < 4e-6);
            }
}

TEST_CASE("and so it is on a rough diffuse surface, bare and under every coat") {
    if (!haveDevice()) return;
    const Workshop shop;
    for (const std::string& coat : coats())
        for (const std::string& light : {Workshop::window, Workshop::sky}) {
            CAPTURE(coat, light);
            const Image want =
                shop.render("<diffuse reflectance=\"" + paintPairs + "\" roughness=\"35\"/>" + coat, light);
            CHECK(difference(shop.render(R"(<diffuse texture="paint.exr" roughness="35"/>)" + coat, light),
                             want) < 1e-5);
            CHECK(difference(shop.render(R"(<diffuse select="grey.png" roughness="35"><choose value="128" )"
                                         "reflectance=\"" +
                                             paintPairs + "\"/></diffuse>" + coat,
                                         light),
                             want) < 1e-5);
        }
}

TEST_CASE("a fluorophore takes from an image what it would take from that reflectance") {
    if (!haveDevice()) return;
    const Workshop shop;
    for (const std::string& coat : {coats()[0], coats()[4]})
        for (const Only part : {Only::everything, Only::reflection, Only::fluorescence}) {
            CAPTURE(coat, static_cast<int>(part));
            CHECK(difference(shop.render(textured + dye + "/>" + coat, Workshop::window, part),
                             shop.render(plain + dye + "/>" + coat, Workshop::window, part)) < 1e-5);
        }
}

TEST_CASE(
    "under glass a fluorophore takes from an image of steep curves what it takes from those, within 1e-4") {
    if (!haveDevice()) return;
    const Workshop shop;
    std::vector<double> nm;
    std::vector<float> curve;
    std::string pairs;
    for (int w = 380; w <= 720; w += 10) {
        nm.push_back(w);
        curve.push_back(0.5f + 0.4f * std::sin(static_cast<float>(w) / 30));
        pairs += fmt::format("{}:{} ", w, curve.back());
    }
    shop.cube("waves.exr", nm, curve);
    shop.write("matrix.csv",
               "emission_nm,ex380,ex420,ex460\n420,0.02,0,0\n460,0.1,0.05,0\n500,0.2,0.3,0.1\n"
               "540,0.1,0.25,0.15\n600,0.01,0.05,0.001\n");
    const std::string waves = "<diffuse texture=\"waves.exr\"/>",
                      wave = "<diffuse reflectance=\"" + pairs + "\"/>",
                      matrix = R"(<fluorescence matrix="matrix.csv" diagonal="none")";
    const auto within = [&](const std::string& image, const std::string& same, const std::string& rest) {
        CAPTURE(image, rest);
        CHECK(difference(shop.render(image + rest, Workshop::window, Only::fluorescence),
                         shop.render(same + rest, Workshop::window, Only::fluorescence)) < 1e-4);
    };
    for (const std::string& coat : {coats()[1], coats()[2]})
        for (const std::string& glowing : {dye, matrix})
            within(waves, wave, glowing + "/>" + coat);
    within(textured, plain, dye + "/>" + coats()[1]);  // 0.2 to 0.95 to 0.1 within 80 nm
    within(waves, wave, dye + R"( anti-stokes="true"/>)" + coats()[1]);
}

TEST_CASE("reflectances above 1 in an image are said; under a coat those without end are refused") {
    if (!haveDevice()) return;
    const Workshop shop;
    shop.cube("bright.exr", {400, 500, 600, 700}, {0.5f, 1.2f, 0.5f, 0.5f});
    shop.cube("percent.exr", {400, 500, 600, 700}, {50, 50, 60, 70});
    const auto notesOf = [&](const std::string& lobes) {
        Notes notes;
        (void)makePlan(shop.scene(lobes, Workshop::window, "slit"), {}, library(), notes);
        std::string all;
        for (const std::string& line : notes.lines())
            all += line + "\n";
        return all;
    };
    CHECK(notesOf(textured).find("above 1") == std::string::npos);
    CHECK(notesOf("<diffuse texture=\"bright.exr\"/>" + coats()[1])
              .find("8 of 32 reflectances lie above 1, up to 1.2: they count as they are") !=
          std::string::npos);
    CHECK(notesOf("<diffuse texture=\"percent.exr\"/>").find("percent? divide them by 100") !=
          std::string::npos);
    const std::string refused = shop.refusal("<diffuse texture=\"percent.exr\"/>" + coats()[1]);
    CHECK(refused.find("percent.exr has a reflectance of 70: under a coat") != std::string::npos);
    CHECK(refused.find("scene.xml:1:") != std::string::npos);
}

TEST_CASE("fluorophores of every kind, rough surfaces, images, coats and two lamps go together") {
    if (!haveDevice()) return;
    const Workshop shop;
    shop.write("matrix.csv",
               "emission_nm,ex380,ex420,ex460\n420,0.02,0,0\n460,0.1,0.05,0\n500,0.2,0.3,0.1\n"
               "540,0.1,0.25,0.15\n600,0.01,0.05,-0.001\n");
    const std::string rough = R"( roughness="50")",
                      lamps = Workshop::window +
                              R"(<light type="ambient" spectrum="lamps/uv-365" radiance="2 W/m2/sr"/>)";
    const std::vector<std::string> dyes{
        dye + "/>", dye + R"( anti-stokes="true"/>)",
        R"(<fluorescence matrix="matrix.csv" diagonal="none"/>)",
        dye + "/>" +
            R"(<fluorescence excitation="gaussian:380,40" emission="gaussian:450,40" strength="0.3" mask="grey.png"/>)"};
    for (const std::string& coat : {coats()[1], coats()[4]})
        for (const std::string& dyed : dyes)
            for (const std::string& turn : {std::string(), rough}) {
                CAPTURE(coat, dyed, turn);
                const std::string more = dyed + coat;
                const Image want =
                    shop.render("<diffuse reflectance=\"constant:0.6\"" + turn + "/>" + more, lamps);
                CHECK(difference(shop.render("<diffuse texture=\"flat.exr\"" + turn + "/>" + more, lamps),
                                 want) < 1e-5);
            }
}

TEST_CASE("a mask's grey is a strength: on paint, on an image, on chosen spectra, under coats") {
    if (!haveDevice()) return;
    const Workshop shop;
    const std::string weaker = fmt::format(
        R"(<fluorescence excitation="gaussian:430,60" emission="gaussian:540,50" yield="0.8" strength="{}"/>)",
        0.7 * 128 / 255);
    const std::string chosen =
        R"(<diffuse select="grey.png"><choose value="128" reflectance=")" + paintPairs + R"("/></diffuse>)";
    for (const std::string& coat : {coats()[0], coats()[1], coats()[3], coats()[4]})
        for (const std::string& base : {plain, textured, chosen}) {
            if (base == textured && coat.starts_with("<gloss")) continue;  // above, on a flat image
            CAPTURE(coat, base);
            CHECK(difference(shop.render(base + dye + " mask=\"grey.png\"/>" + coat),
                             shop.render(plain + weaker + coat)) < 1e-5);
        }
    // Where it is black there is none, where it is white there is all; the base is there everywhere.
    const std::string halves = plain + dye + " mask=\"halves.png\" filter=\"nearest\"/>";
    const Image got = shop.render(halves), none = shop.render(plain), all = shop.render(plain + dye + "/>");
    for (size_t band = 0; band < got.wavelengths.size(); ++band) {
        CAPTURE(band);
        CHECK(got.at(20, 10, band) == Approx(none.at(20, 10, band)).epsilon(1e-5));
        CHECK(got.at(50, 10, band) == Approx(all.at(50, 10, band)).epsilon(1e-5));
    }
    CHECK(all.at(50, 10, 7) > 1.02 * none.at(50, 10, 7));
}

TEST_CASE("a map picks measured spectra texel by texel, or mixes them by its values") {
    if (!haveDevice()) return;
    const Workshop shop;
    const std::string other = "400:0.8 550:0.1 700:0.5";
    const auto select = [&](const std::string& picture, const std::string& attributes) {
        return "<diffuse select=\"" + picture + "\" " + attributes + "><choose value=\"0\" reflectance=\"" +
               paintPairs + "\"/><choose value=\"255\" reflectance=\"" + other + "\"/></diffuse>";
    };
    for (const std::string& rest : {coats()[0], coats()[1], coats()[3], dye + "/>" + coats()[1]}) {
        CAPTURE(rest);
        const Image a = shop.render(plain + rest),
                    b = shop.render("<diffuse reflectance=\"" + other + "\"/>" + rest);
        const Image picked = shop.render(select("halves.png", "filter=\"nearest\"") + rest);
        const Image mixed = shop.render(select("steps.png", "filter=\"nearest\" values=\"mix\"") + rest);
        for (size_t band = 0; band < a.wavelengths.size(); band += 3) {
            CAPTURE(band);
            CHECK(picked.at(20, 10, band) == Approx(a.at(20, 10, band)).epsilon(2e-6));
            CHECK(picked.at(50, 10, band) == Approx(b.at(50, 10, band)).epsilon(2e-6));
            CHECK(mixed.at(27, 10, band) ==
                  Approx(0.8 * a.at(27, 10, band) + 0.2 * b.at(27, 10, band)).epsilon(4e-6));
            CHECK(mixed.at(42, 10, band) ==
                  Approx(0.2 * a.at(42, 10, band) + 0.8 * b.at(42, 10, band)).epsilon(4e-6));
        }
    }
    CHECK_THAT(shop.refusal(select("steps.png", "")),
               Catch::Contains("pixel 1,0 is 51") && Catch::Contains("<choose>"));
}

TEST_CASE("maps of 16 bits count as they stand: masks of their 65535, choices by their numbers") {
    if (!haveDevice()) return;
    const Workshop shop;
    shop.grey16("grey16.png", {128 * 257, 128 * 257, 128 * 257, 128 * 257});
    const Image eight = shop.render(plain + dye + " mask=\"grey.png\"/>"),
                sixteen = shop.render(plain + dye + " mask=\"grey16.png\"/>");
    CHECK(sixteen.values == eight.values);
    shop.grey16("classes16.png", {300, 300, 40000, 40000});
    const auto select = [](const std::string& attributes, int last) {
        return fmt::format(
            "<diffuse select=\"classes16.png\" filter=\"nearest\"{}><choose value=\"300\" "
            "reflectance=\"constant:0.2\"/><choose value=\"{}\" reflectance=\"constant:0.6\"/></diffuse>",
            attributes, last);
    };
    const Image want = shop.render("<diffuse reflectance=\"constant:0.6\"/>"),
                got = shop.render(select("", 40000));
    CHECK(got.at(20, 10, 5) == Approx(want.at(20, 10, 5) / 3).epsilon(1e-6));
    CHECK(got.at(50, 10, 5) == Approx(want.at(50, 10, 5)).epsilon(1e-6));
    CHECK_THAT(shop.refusal(select("", 40001)), Catch::Contains("pixel 2,0 is 40000"));
    const Image mixed = shop.render(select(" values=\"mix\"", 65535));
    const double share = (40000.0 - 300) / (65535 - 300);
    CHECK(mixed.at(50, 10, 5) == Approx(want.at(50, 10, 5) * (0.2 + 0.4 * share) / 0.6).epsilon(1e-5));
}

TEST_CASE("a map of colours picks by colour; coloured masks and missing colours are refused by pixel") {
    if (!haveDevice()) return;
    const Workshop shop;
    const TemporaryFolder folder;
    writePng(folder.path() / "classes.png", {2, 1, 3, {255, 0, 0, 0, 0, 255}}, {}, {});
    const std::string file = (folder.path() / "classes.png").string();
    const std::string map = "<diffuse select=\"" + file +
                            "\" filter=\"nearest\"><choose value=\"#0000ff\" reflectance=\"constant:0.2\"/>"
                            "<choose value=\"#ff0000\" reflectance=\"constant:0.6\"/></diffuse>";
    const Image got = shop.render(map), want = shop.render("<diffuse reflectance=\"constant:0.6\"/>");
    CHECK(got.at(20, 10, 5) == Approx(want.at(20, 10, 5)).epsilon(1e-6));
    CHECK(got.at(50, 10, 5) == Approx(want.at(50, 10, 5) / 3).epsilon(1e-6));
    std::string missing = map;
    missing.replace(missing.find("#ff0000"), 7, "#ff0001");
    CHECK_THAT(shop.refusal(missing), Catch::Contains("pixel 0,0 is #ff0000"));
    CHECK_THAT(shop.refusal(plain + dye + " mask=\"" + file + "\"/>"),
               Catch::Contains("pixel 0,0 is coloured"));
}

TEST_CASE("what a scene's images do not need is not compiled") {
    const Workshop shop;
    const auto switches = [&](const std::string& lobes) {
        std::string text;
        for (const std::string& define : planOf(shop.scene(lobes, Workshop::window, "slit")).defines)
            if (define.starts_with("HAS_TEXTURE") || define == "HAS_MIP") text += define + " ";
        return text;
    };
    CHECK(switches(plain + coats()[1]).empty());
    CHECK(switches(textured) == "HAS_TEXTURE ");
    CHECK(switches(textured + coats()[4]) == "HAS_TEXTURE ");
    CHECK(switches(textured + coats()[1]) == "HAS_TEXTURE HAS_TEXTURE_CURVE ");
    CHECK(switches("<diffuse texture=\"paint.exr\" filter=\"mip\"/>") == "HAS_MIP HAS_TEXTURE ");
    CHECK(switches("<diffuse texture=\"paint.exr\" wrap=\"repeat\"/>") == "HAS_TEXTURE HAS_TEXTURE_PLACE ");
    CHECK(switches("<diffuse texture=\"paint.exr\" rotate=\"10\"/>") == "HAS_TEXTURE HAS_TEXTURE_PLACE ");
}
