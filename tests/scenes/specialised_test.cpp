// What a scene does not use is not compiled.
#include "opencl/kernel_sources.h"
#include "opencl/program.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

using namespace spectrad;
using namespace spectrad::test;

namespace {

std::string scene(const std::string& material, const std::string& lights) {
    return fmt::format(
        "<scene version=\"1\"><material name=\"m\">{}</material><sphere radius=\"1\" material=\"m\"/>{}"
        "<camera type=\"perspective\" fov=\"40\" look-from=\"0 0 5\" look-at=\"0 0 0\" "
        "size=\"8x8\"/></scene>",
        material, lights);
}
const std::string matt = R"(<diffuse reflectance="constant:0.5"/>)",
                  shiny = matt + R"(<gloss ior="1.5" roughness="0.3"/>)";
const std::string lamp =
    R"(<light type="point" position="0 3 3" spectrum="illuminants/D65" intensity="9 cd"/>)";
const std::string spot =
    R"(<light type="spot" position="0 3 3" target="0 0 0" angle="30" blend="0.5" spectrum="illuminants/D65" intensity="9 cd"/>)";
const std::string sun =
    R"(<light type="directional" direction="0 -1 -1" spectrum="illuminants/D65" illuminance="9 lx"/>)";
const std::string sky = R"(<light type="ambient" spectrum="illuminants/D65" luminance="9 cd/m2"/>)";

bool defines(const Plan& plan, const std::string& name) {
    return std::any_of(plan.defines.begin(), plan.defines.end(),
                       [&](const std::string& d) { return d == name || d.starts_with(name + "="); });
}

/// The lighting kernel's text as its compiler sees it, through the machine's C preprocessor; nothing, and
/// said, where there is none.
std::optional<std::string> preprocessed(const Plan& plan) {
    const TemporaryFolder folder;
    const auto file = folder.write("light.c", Program::source({"light.cl"}, plan.defines));
    const std::string command = "cc -E -P -D__OPENCL_VERSION__=120 '" + file.string() + "' 2>/dev/null";
    std::string text;
    FILE* pipe = ::popen(command.c_str(), "r");
    REQUIRE(pipe);
    char buffer[4096];
    for (size_t got; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
        text.append(buffer, got);
    if (::pclose(pipe) == 0) return text;
    WARN("skipped: no C preprocessor 'cc -E'");
    return std::nullopt;
}

}  // namespace

TEST_CASE("switches of the kernels name what the scene has, and nothing else") {
    const auto check = [](const std::string& text, const std::vector<std::string>& on) {
        const Plan plan = planOf(sceneFrom(text));
        for (const char* name : {"HAS_POINT", "HAS_SPOT", "HAS_DIRECTIONAL", "HAS_UNIFORM", "HAS_ROUGH",
                                 "HAS_COATED", "HAS_FACETS", "HAS_TEXTURE"}) {
            CAPTURE(text, name);
            CHECK(defines(plan, name) == (std::find(on.begin(), on.end(), name) != on.end()));
        }
    };
    check(scene(matt, lamp), {"HAS_POINT"});
    check(scene(matt, spot), {"HAS_SPOT"});
    check(scene(matt, sun), {"HAS_DIRECTIONAL"});
    check(scene(matt, sky), {"HAS_UNIFORM"});
    check(scene(shiny, lamp + sky), {"HAS_COATED", "HAS_FACETS", "HAS_POINT", "HAS_UNIFORM"});
    check(scene(R"(<diffuse reflectance="constant:0.5" roughness="20"/>)", sun),
          {"HAS_ROUGH", "HAS_DIRECTIONAL"});
    check(scene(R"(<conductor ior="metals/Au" roughness="0.3"/>)", lamp), {"HAS_FACETS", "HAS_POINT"});
    check(scene(matt, ""), {});
}

TEST_CASE("a material that nothing wears costs no switch, no lobe and no term") {
    const std::string unused =
        R"(<material name="unused"><diffuse reflectance="srgb:#804020"/><gloss ior="1.5" roughness="0.1"/></material>)";
    std::string text = scene(matt, lamp);
    const Plan without = planOf(sceneFrom(text));
    text.insert(text.find("<sphere"), unused);
    const Plan with = planOf(sceneFrom(text));
    CHECK(with.defines == without.defines);
    CHECK(with.terms.count() == without.terms.count());
    CHECK(with.world.lobes.size() == without.world.lobes.size());
    CHECK(with.world.tables.empty());
}

TEST_CASE("code of features that a scene lacks is not given to the compiler") {
    const auto plain = preprocessed(planOf(sceneFrom(scene(matt, lamp)))),
               full = preprocessed(planOf(sceneFrom(scene(shiny, lamp + spot + sun + sky))));
    if (!plain || !full) return;
    // Functions of tables, microfacets and uniform light, and the spot's fade.
    for (const std::string word : {"look_up(", "facets(", "uniform_light(", "light.chord_outer -"}) {
        CAPTURE(word);
        CHECK(full->find(word) != std::string::npos);
        CHECK(plain->find(word) == std::string::npos);
    }
    CHECK(plain->size() < full->size());
}
