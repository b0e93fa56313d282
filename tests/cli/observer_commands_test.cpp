// Detectors by every way of naming them, from the command line.
#include "base/files.h"
#include "cli/support.h"
#include "support/read_picture.h"

#include <array>
#include <cmath>

using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;
using nlohmann::json;

namespace {

void writeFlat(const Folder& folder) {
    cli::writeCube(folder / "flat.exr", 4, 4, "380:780:5", [](int, int, double) { return 0.5; });
}

}  // namespace

TEST_CASE("A camera of sixteen filters writes sixteen channels") {
    const Folder folder;
    writeFlat(folder);
    std::string camera = "qe:constant:0.5 * 400:1 700:1 * (";
    for (int i = 0; i < 16; ++i)
        camera += (i ? ", b" : "b") + std::to_string(410 + 18 * i) +
                  " = gaussian:" + std::to_string(410 + 18 * i) + ",8";
    const Outcome outcome =
        run(folder, {"observe", "flat.exr", "-o", "raw.exr", "--observer", camera + ")", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.json().at("channels").size() == 16);
    CHECK(outcome.json().at("channels")[5] == "b500");
}

TEST_CASE("A scene's detector looks by SCENE.xml#NAME, and measures as its parts multiply") {
    const Folder folder;
    writeFlat(folder);
    folder.write(
        "s.xml",
        "<scene version=\"1\"><spectrum name=\"flat\" quantity=\"sensitivity\">400:0.5 700:0.5</spectrum>"
        "<detector name=\"cam\" sensitivity=\"flat\" filter=\"constant:0.5\">"
        "<channel name=\"low\" filter=\"400:1 549.9:1 550:0\"/><channel name=\"all\" filter=\"constant:1\"/>"
        "</detector></scene>");
    const Outcome outcome =
        run(folder, {"measure", "flat.exr", "--at", "1,1", "--observer", "s.xml#cam", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const json reading = outcome.json()[0];
    CHECK(reading.at("channels").at("all").get<double>() == Approx(0.5 * 0.25 * 300).epsilon(1e-5));
    CHECK(reading.at("channels").at("low").get<double>() == Approx(0.5 * 0.25 * 150).epsilon(1e-3));
    CHECK(reading.at("rendered").at("XYZ").size() == 3);
    requireError(run(folder, {"measure", "flat.exr", "--at", "1,1", "--observer", "s.xml#cap"}), 1,
                 "there are: cam");
}

TEST_CASE("A film is exposed by the image and projected: brighter scenes look brighter, exposure in stops") {
    const Folder folder;
    cli::writeCube(folder / "ramp.exr", 8, 8, "380:780:5",
                   [](int x, int, double) { return 0.01 * (1 << x); });
    const auto luminances = [&](const std::string& white) {
        std::vector<double> y;
        std::vector<std::string> arguments{"measure", "ramp.exr", "--observer", "generic-reversal",
                                           "--white", white,      "--json"};
        for (int x = 0; x < 8; ++x)
            arguments.insert(arguments.end(), {"--at", std::to_string(x) + ",3"});
        const Outcome outcome = run(folder, arguments);
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        const json readings = outcome.json();
        for (const json& reading : readings)
            y.push_back(reading.at("rendered").at("XYZ")[1].get<double>());
        return y;
    };
    const std::vector<double> y = luminances("100,100,100");
    for (size_t i = 1; i < y.size(); ++i)
        CHECK(y[i] > y[i - 1]);
    // Half the white is twice the exposure: every patch looks as the one of twice its light did.
    const std::vector<double> more = luminances("50,50,50");
    for (size_t i = 1; i < y.size(); ++i)
        CHECK(more[i - 1] == Approx(y[i]).epsilon(1e-5));
    // And so is a stop of exposure more, for the film as for an eye.
    for (const std::string observer : {"generic-reversal", "cie1931-2"}) {
        const auto picture = [&](const std::string& white, const std::string& exposure) {
            REQUIRE(run(folder, {"observe", "ramp.exr", "-o", "x.png", "-q", "--observer", observer,
                                 "--white", white, "--exposure", exposure})
                        .code == 0);
            return spectrad::readPicture8(folder / "x.png").pixels;
        };
        INFO(observer);
        const auto plain = picture("1e5,1e5,1e5", "0"), brighter = picture("1e5,1e5,1e5", "1");
        CHECK(brighter == picture("5e4,5e4,5e4", "0"));
        CHECK(brighter[3 * 4 + 1] > plain[3 * 4 + 1]);
    }
}

TEST_CASE("What a luminous efficiency sees is in candelas, by day and at night, and its file says so") {
    const Folder folder;
    writeFlat(folder);
    for (const std::string observer : {"cie1924-photopic", "cie1951-scotopic"}) {
        const Outcome outcome =
            run(folder, {"observe", "flat.exr", "-o", "v.exr", "--observer", observer, "--json"});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        CHECK(outcome.json().at("unit") == "cd.m^-2 (V of " + observer + ")");
    }
    const Outcome camera =
        run(folder, {"observe", "flat.exr", "-o", "c.exr", "--observer", "nikon-5100", "--json"});
    CHECK(camera.json().at("unit") == "W.m^-2.sr^-1 x sensitivity");
}

TEST_CASE("A picture says which display it is for") {
    const Folder folder;
    writeFlat(folder);
    folder.write("own.txt",
                 "red 0.64 0.33\ngreen 0.21 0.71\nblue 0.15 0.06\nwhite 0.3127 0.329\ngamma 2.4\n");
    const auto chunks = [&](const std::string& display) {
        const Outcome outcome =
            run(folder, {"observe", "flat.exr", "-o", "d.png", "-q", "--display", display});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        REQUIRE(run(folder,
                    {"expose", "flat.exr", "-o", "r.exr", "--picture", "e.png", "-q", "--display", display})
                    .code == 0);
        std::array<std::string, 2> found;
        for (size_t i = 0; i < 2; ++i) {
            const std::string bytes = spectrad::readFile(folder / (i == 0 ? "d.png" : "e.png"));
            for (const char* name : {"sRGB", "cICP", "gAMA", "cHRM"})
                if (bytes.find(name) < bytes.find("IDAT")) found[i] += std::string(name) + " ";
            const size_t code = bytes.find("cICP");
            if (code != std::string::npos)
                found[i] += std::to_string(bytes[code + 4]) + "/" + std::to_string(bytes[code + 5]);
        }
        CHECK(found[0] == found[1]);
        return found[0];
    };
    CHECK(chunks("srgb") == "sRGB ");
    CHECK(chunks("p3") == "cICP gAMA cHRM 12/13");
    CHECK(chunks("rec2020") == "gAMA cHRM ");
    CHECK(chunks("own.txt") == "gAMA cHRM ");
}

TEST_CASE("A film in another projector is another picture; an eye has no projector") {
    const Folder folder;
    writeFlat(folder);
    const auto reading = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"measure",          "flat.exr", "--at",  "1,1",   "--observer",
                                           "generic-reversal", "--white",  "1,1,1", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(folder, arguments);
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        return outcome.json()[0].at("rendered").at("XYZ");
    };
    const json own = reading({}), table = reading({"--projector", "illuminants/D50"});
    const auto bluer = [](const json& xyz) { return xyz[2].get<double>() / xyz[1].get<double>(); };
    CHECK(bluer(table) > 1.3 * bluer(own));
    CHECK(reading({"--viewer", "cie1931-2"}) == own);
    requireError(run(folder, {"measure", "flat.exr", "--at", "1,1", "--projector", "illuminants/A"}), 2,
                 "is no film");
    requireError(run(folder, {"observe", "flat.exr", "-o", "x.png", "--observer", "generic-reversal",
                              "--viewer", "nikon-5100"}),
                 1, "no X, Y, Z");
}

TEST_CASE("The mean of the image as white makes a flat image grey, and black has none") {
    const Folder folder;
    cli::writeCube(folder / "warm.exr", 4, 4, "380:780:5", [](int, int, double nm) { return nm / 500; });
    const Outcome grey = run(folder, {"observe", "warm.exr", "-o", "g.png", "--white", "image", "--json"});
    INFO(grey.err);
    REQUIRE(grey.code == 0);
    CHECK(grey.json().at("white").at("name") == "image");
    const std::vector<std::uint8_t> rgb = spectrad::readPicture8(folder / "g.png").pixels;
    for (size_t i = 0; i < rgb.size(); i += 3) {
        CHECK(rgb[i] == rgb[i + 1]);
        CHECK(rgb[i + 1] == rgb[i + 2]);
    }
    cli::writeCube(folder / "black.exr", 4, 4, "380:780:5", [](int, int, double) { return 0.0; });
    requireError(run(folder, {"observe", "black.exr", "-o", "b.png", "--white", "image"}), 1, "black");
}

TEST_CASE("The gamut map marks what the display lacks, in blue below and red above, and nothing else") {
    const Folder folder;
    // A grey, a laser's green (red and blue below 0), a grey twice the white.
    cli::writeCube(folder / "three.exr", 3, 1, "380:780:5", [](int x, int, double nm) {
        return x == 1 ? (nm == 520 ? 40.0 : 0.0) : x == 0 ? 0.5 : 2.0;
    });
    const double y = run(folder, {"measure", "three.exr", "--at", "0,0", "--json"}).json()[0].at("XYZ")[1];
    const std::string white = std::to_string(1.5 * y);
    REQUIRE(run(folder, {"observe", "three.exr", "-o", "p.png", "--gamut-map", "m.png", "--white",
                         white + "," + white + "," + white, "-q"})
                .code == 0);
    const std::vector<std::uint8_t> map = spectrad::readPicture8(folder / "m.png").pixels;
    REQUIRE(map.size() == 9);
    CHECK((map[0] == map[1] && map[1] == map[2]));
    CHECK(map[5] > map[4]);
    CHECK(map[6] > map[7]);
    requireError(run(folder, {"observe", "three.exr", "-o", "p.exr", "--gamut-map", "m.png"}), 2,
                 "--gamut-map");
}

TEST_CASE("A display's metamerism is none for who it was made for, some for another, and silent with -q") {
    const Folder folder;
    cli::writeCube(folder / "c.exr", 4, 4, "380:780:5",
                   [](int x, int y, double nm) { return 0.3 + 0.05 * x + 0.1 * y * nm / 780; });
    const auto seenBy = [&](const std::string& eye, const std::string& quiet) {
        std::vector<std::string> arguments{
            "observe",   "c.exr", "-o",     "c.png",        "--display", "displays/lcd-apple-studio",
            "--seen-by", eye,     "--json", "--exposure=-2"};
        if (!quiet.empty()) arguments.push_back(quiet);
        return run(folder, arguments);
    };
    const Outcome self = seenBy("cie1931-2", ""), other = seenBy("cie1964-10", "-q");
    INFO(self.err << other.err);
    REQUIRE(self.code == 0);
    REQUIRE(other.code == 0);
    CHECK(self.json().at("display_metamerism").at("max").get<double>() < 1e-3);
    CHECK(other.json().at("display_metamerism").at("mean").get<double>() > 0.05);
    CHECK(self.err.find("CIEDE2000") != std::string::npos);
    CHECK(other.err.empty());
    // However the picture is made, who it was made for sees what he is to see.
    for (const std::vector<std::string>& way :
         {std::vector<std::string>{"--degree", "0.3", "--white", "illuminants/A"},
          {"--tone", "reinhard"},
          {"--adapt", "none"}}) {
        std::vector<std::string> arguments{
            "observe",   "c.exr",     "-o",     "c.png",         "--display", "displays/lcd-apple-studio",
            "--seen-by", "cie1931-2", "--json", "--exposure=-3", "-q"};
        arguments.insert(arguments.end(), way.begin(), way.end());
        const Outcome made = run(folder, arguments);
        INFO(way[0] << " " << made.err);
        REQUIRE(made.code == 0);
        CHECK(made.json().at("display_metamerism").at("max").get<double>() < 1e-3);
    }
    // A white as bright as itself is white for every eye, whatever its luminance is called.
    cli::writeCube(folder / "w.exr", 4, 4, "380:780:5", [](int, int, double) { return 0.1; },
                   spectrad::CubeKind::radiance, {{"white", "constant:1"}, {"whiteXYZ", "1,1,1"}});
    const Outcome white =
        run(folder, {"observe", "w.exr", "-o", "w.png", "--display", "displays/lcd-apple-studio", "--seen-by",
                     "cie1964-10", "--json", "-q"});
    REQUIRE(white.code == 0);
    CHECK(white.json().at("display_metamerism").at("max").get<double>() < 0.01);
}

TEST_CASE("metamer makes a table that matches where it should, and judges it as a pair") {
    const Folder folder;
    const Outcome made =
        run(folder, {"metamer", "charts/colorchecker/foliage", "--count", "3", "-o", "m.csv", "--json"});
    INFO(made.err);
    REQUIRE(made.code == 0);
    const json metamers = made.json().at("metamers");
    REQUIRE(metamers.size() == 3);
    CHECK(metamers[1].at("match")[0].at("deltae00").get<double>() < 0.01);
    CHECK(metamers[1].at("worst_lamp").at("deltae00").get<double>() >=
          metamers[1].at("differ")[0].at("deltae00").get<double>());
    const Outcome judged =
        run(folder, {"metamer", "charts/colorchecker/foliage", "m.csv#metamer2", "--json"});
    REQUIRE(judged.code == 0);
    const json index = judged.json().at("indices").at(0);
    CHECK(index.at("reference_deltae00").get<double>() < 0.01);
    CHECK(index.at("deltae00").get<double>() ==
          Approx(metamers[1].at("differ")[0].at("deltae00").get<double>()).margin(0.01));
    requireError(run(folder, {"metamer", "charts/colorchecker/white", "--bounds", "0:0.1"}), 1,
                 "no reflectance");
    requireError(run(folder, {"metamer", "charts/colorchecker/white", "--bounds", "0"}), 2, "LOW:HIGH");
}
