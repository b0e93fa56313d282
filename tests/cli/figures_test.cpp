// The paper's figures 2, 3 and 4 by numbers: rendered small, measured in the cubes as a user would.
#include "cli/support.h"
#include "colour/colour.h"

#include <array>
#include <cmath>
#include <map>

using cli::Folder;
using cli::Outcome;
using cli::run;
using nlohmann::json;
using spectrad::Triple;

namespace {

const std::string scenes = SPECTRAD_SOURCE "/scenes/paper/";

/// Pixels on both sides of the animals' seams at 600 x 150, half the scenes' own size; and the grey floor.
const std::vector<std::pair<std::string, std::array<std::string, 2>>> seams{{"elephant", {"96,65", "106,65"}},
                                                                            {"rabbit", {"247,92", "257,92"}},
                                                                            {"cow", {"390,65", "380,65"}},
                                                                            {"duck", {"515,95", "505,95"}}};
constexpr const char* floorPlace = "300,142";
constexpr double floorReflectance = 0.45;

void render(const Folder& folder, const std::string& scene, const std::string& cube,
            std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", scenes + scene, "-o", cube, "--samples", "4", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
}

std::vector<std::string> lit(const std::string& lamp, const char* second) {
    return {"--set", "key.spectrum=" + lamp, "--set", std::string(second) + ".spectrum=" + lamp};
}

json measured(const Folder& folder, const std::string& cube, const std::vector<std::string>& places,
              const std::string& observer) {
    std::vector<std::string> arguments{"measure", cube, "--json", "-q", "--observer", observer};
    for (const std::string& place : places)
        arguments.insert(arguments.end(), {"--at", place + ",1"});
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return outcome.json();
}

Triple seen(const json& reading) {
    return (reading.contains("rendered") ? reading.at("rendered") : reading).at("XYZ").get<Triple>();
}

/// CIEDE2000 of each animal's halves against a perfect diffuser in the floor's place. Shading is one factor
/// for all wavelengths, so the right half counts at the left's luminance; but for film, which is not linear.
std::map<std::string, double> differences(const Folder& folder, const std::string& cube,
                                          const std::string& observer) {
    std::vector<std::string> places{floorPlace};
    for (const auto& [animal, pair] : seams)
        places.insert(places.end(), pair.begin(), pair.end());
    const json readings = measured(folder, cube, places, observer);
    const bool film = observer == "generic-reversal";
    Triple white = seen(readings[0]);
    for (double& w : white)
        w /= film ? 1 : floorReflectance;
    std::map<std::string, double> result;
    for (size_t i = 0; i < seams.size(); ++i) {
        if (film) {
            result[seams[i].first] =
                spectrad::deltaE00(readings[1 + 2 * i].at("rendered").at("Lab").get<Triple>(),
                                   readings[2 + 2 * i].at("rendered").at("Lab").get<Triple>());
            continue;
        }
        const Triple left = seen(readings[1 + 2 * i]);
        Triple right = seen(readings[2 + 2 * i]);
        const double scale = left[1] / right[1];
        for (double& v : right)
            v *= scale;
        result[seams[i].first] = spectrad::deltaE00(spectrad::lab(left, white), spectrad::lab(right, white));
    }
    return result;
}

}  // namespace

TEST_CASE("Figure 2: halves match under D65 and part under A and a fluorescent lamp") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    for (const char* lamp : {"illuminants/D65", "illuminants/A", "lamps/f32t8-tl841-triphosphor"}) {
        std::vector<std::string> options = lit(lamp, "fill");
        options.insert(options.end(), {"--size", "600x150"});
        render(folder, "figure2.xml", "f.exr", options);
        for (const auto& [animal, e] : differences(folder, "f.exr", "cie1931-2")) {
            INFO(lamp << ", " << animal << ": " << e);
            if (std::string(lamp) == "illuminants/D65")
                CHECK(e < 0.1);
            else
                CHECK(e > 3);
        }
    }
}

TEST_CASE("Figure 3: halves match for CIE 1931, and neither for the camera nor on film") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    render(folder, "figure3.xml", "f.exr", {"--size", "600x150"});
    for (const auto& [animal, e] : differences(folder, "f.exr", "cie1931-2")) {
        INFO(animal << ": " << e);
        CHECK(e < 0.1);
    }
    for (const std::string& observer : {scenes + "figure3.xml#camera", std::string("generic-reversal")})
        for (const auto& [animal, e] : differences(folder, "f.exr", observer)) {
            INFO(observer << ", " << animal << ": " << e);
            CHECK(e > 3);
        }
}

TEST_CASE("Figure 4: the ink glows under D65 and the black light; under A below 5 % of the black light's") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    std::map<std::string, double> emitted;  // W.m^-2.sr^-1, for equal irradiance of 300 to 780 nm
    for (const std::string lamp : {"illuminants/A", "illuminants/D65", "lamps/uv-365"}) {
        double sum = 0;
        for (const double sign : {1.0, -1.0}) {
            std::vector<std::string> options = lit(lamp, "rim");
            options.insert(options.end(), {"--size", "360x180"});
            if (sign < 0) options.insert(options.end(), {"--set", "inked.fluorescence.yield=0"});
            render(folder, "figure4.xml", "f.exr", options);
            const json readings = measured(folder, "f.exr", {"246,102", "114,102"}, "cie1931-2");
            for (const json& value : readings[0].at("radiance"))
                sum += sign * 5 * value.get<double>();
            if (sign < 0) {
                // Without its glow the ink's paint is the plain one; the two rabbits stand differently, so
                // shapes are compared.
                const Triple inked = seen(readings[0]), plain = seen(readings[1]);
                for (size_t k = 0; k < 3; ++k)
                    CHECK(inked[k] / inked[1] == Approx(plain[k] / plain[1]).epsilon(1e-5));
            }
        }
        emitted[lamp] = sum;
    }
    CHECK(emitted["lamps/uv-365"] > 0.1);
    CHECK(emitted["illuminants/D65"] > 0.05 * emitted["lamps/uv-365"]);
    CHECK(emitted["illuminants/A"] > 0);
    CHECK(emitted["illuminants/A"] < 0.05 * emitted["lamps/uv-365"]);
    WARN("emission under A / black light " << emitted["illuminants/A"] / emitted["lamps/uv-365"]
                                           << ", D65 / black light "
                                           << emitted["illuminants/D65"] / emitted["lamps/uv-365"]);
}
