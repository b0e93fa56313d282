// Detectors by every way of naming them, from the command line.
#include "cli/support.h"

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
