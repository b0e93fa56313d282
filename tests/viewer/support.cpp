#include "viewer/support.h"

#include "colour/difference.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace spectrad::view::test {

bool canView() {
    static const bool can = [] {
        if (listDevices().empty()) {
            WARN("skipped: no OpenCL device");
            return false;
        }
        try {
            (void)openOffscreen(8, 8);
        } catch (const MachineError& error) {
            WARN("skipped: " << error.what());
            return false;
        }
        return true;
    }();
    return can;
}

const std::string& smallScene() {
    static const std::string text = R"(<scene version="1">
  <wavelengths from="380" to="780" step="5"/>
  <material name="red"><diffuse reflectance="charts/colorchecker/red"/></material>
  <material name="lacquer"><diffuse reflectance="charts/colorchecker/cyan"/><gloss ior="1.5" roughness="0.3"/></material>
  <material name="gold"><conductor ior="metals/Au" roughness="0.4"/></material>
  <material name="marker">
    <diffuse reflectance="constant:0.2"/>
    <fluorescence excitation="gaussian:400,40" emission="gaussian:520,40" yield="0.8"/>
  </material>
  <node name="floor" translate="0 -1 0" rotate="1 0 0 -90"><plane size="9 9" material="red"/></node>
  <node name="ball" translate="-1.3 0 0"><sphere radius="1" material="lacquer"/></node>
  <node name="nugget" translate="1.3 0 0"><sphere radius="0.8" material="gold"/></node>
  <node name="note" translate="0 1 -1"><plane size="1 1" material="marker"/></node>
  <light name="lamp" type="point" position="2 4 4" spectrum="illuminants/D65" intensity="300 cd"/>
  <light name="fill" type="ambient" spectrum="illuminants/A" luminance="5 cd/m2"/>
  <camera name="eye" fov="40" look-from="0 1 7" look-at="0 0 0" size="96x64"/>
</scene>
)";
    return text;
}

Desk::Desk(const std::string& sceneText, RenderSettings settings)
    : library(Library::open()), device(Device::open(std::nullopt)) {
    open(folder.write("scene.xml", sceneText), settings);
}

Desk::Desk(const std::filesystem::path& file, RenderSettings settings)
    : library(Library::open()), device(Device::open(std::nullopt)) {
    open(file, settings);
}

void Desk::open(const std::filesystem::path& file, const RenderSettings& settings) {
    const Opener opener = [this, file, settings](Notes& said) -> std::unique_ptr<Subject> {
        if (looksLikeCube(file)) return std::make_unique<CubeSubject>(file, library, said);
        return std::make_unique<SceneSubject>(file, LoadOptions{}, settings, device, library, said);
    };
    session = std::make_unique<Session>(opener, library, notes);
    face = openOffscreen(session->about().width(), session->about().height());
    viewer = std::make_unique<Viewer>(*face, *session);
}

void Desk::play(const std::string& script) {
    run(*viewer, parseScript(script, "script"), 0);
}

bool Desk::refresh(Codes& left, Codes& right) const {
    if (!session->begin()) return false;
    left = session->painting().left;
    right = session->painting().right;
    return true;
}

Pin Desk::measured(int x, int y) const {
    return session->subject().still(session->look(0))->measured(x, y);
}

Cube rendered(const std::string& text, const Desk& desk, RenderSettings settings) {
    Notes notes;
    const Scene scene = loadScene(desk.folder.write("rendered.xml", text), desk.library, {}, notes);
    PassTextures passes(scene, desk.library, desk.device, settings, notes);
    return passes.render();
}

double worstDifference(Desk& desk, const std::string& text, RenderSettings settings) {
    Look& look = desk.session->look(0);
    desk.session->stand.samples = 16;
    settings.samples = 16;
    const Cube cube = rendered(text, desk, settings);
    const ChannelImage viewed = desk.session->subject().xyz(look);
    ChannelImage expected(cube.info.width, cube.info.height, 3);
    const DetectorWeights weights = weightsOn(cube.info.wavelengths, look.eye->detector);
    for (int y = 0; y < cube.info.height; ++y)
        observeRow(weights, cube.row(y, 0), y, expected);
    const White white = withLuminance(desk.session->whiteOf(look),
                                      *std::max_element(expected.plane[1].begin(), expected.plane[1].end()));
    return colourDifference(viewed, expected, white.xyz).max;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

}  // namespace spectrad::view::test
