// Scenes of several passes in the viewer: what is seen is what render and observe make, after changes and
// from elsewhere too.
#include "viewer/save.h"
#include "viewer/support.h"

#include <catch2/catch.hpp>

using namespace spectrad;
using view::test::canView;
using view::test::Desk;
using view::test::replaced;
using view::test::worstDifference;

namespace {

constexpr double bound = 0.05;  // ΔE00; bands of 5 nm against exact spectra

/// A print of a chart (reflectance), a picture of it that glows (radiance), a floor that mirrors, and a
/// picture behind everything.
constexpr const char* hall = R"(<scene version="1">
  <material name="red"><diffuse reflectance="charts/colorchecker/red"/></material>
  <material name="blue"><diffuse reflectance="charts/colorchecker/blue"/></material>
  <material name="print"><diffuse texture="pass:print"/></material>
  <material name="screen"><emission texture="pass:shown"/></material>
  <material name="mirror"><specular reflectance="constant:0.8" reflects="pass:image"/></material>
  <node name="chart" translate="0 30 0">
    <node translate="-0.5 0 0"><plane size="1 2" material="red"/></node>
    <node translate="0.5 0 0"><plane size="1 2" material="blue"/></node>
  </node>
  <node name="room">
    <node name="floor" translate="0 -1 0" rotate="1 0 0 -90"><plane size="6 6" material="mirror"/></node>
    <node translate="-1.2 0.2 0" rotate="0 1 0 20"><plane size="1.6 1.6" material="print"/></node>
    <node translate="1.3 0.2 -0.5"><plane size="1.2 1.2" material="screen"/></node>
    <node translate="0 -0.3 0.8"><sphere radius="0.4" material="red"/></node>
  </node>
  <background texture="pass:sky"/>
  <light name="lamp" type="point" position="1 4 5" spectrum="illuminants/D65" intensity="300 cd"/>
  <light name="chartlight" type="ambient" spectrum="illuminants/A" luminance="8 cd/m2"/>
  <camera name="eye" fov="45" look-from="0 0.5 4.5" look-at="0 0 0" size="72x54"/>
  <camera name="flat" type="orthographic" height="2" look-from="0 30 3" look-at="0 30 0" size="32x32"/>
  <pass name="print" camera="flat" of="chart" as="reflectance" lights="chartlight"/>
  <pass name="shown" camera="flat" of="chart" lights="chartlight"/>
  <pass name="sky" camera="flat" of="chart" lights="chartlight"/>
  <pass name="image" camera="eye" of="room" mirror="floor" lights="lamp chartlight"/>
  <pass name="main" camera="eye" of="room" lights="lamp chartlight"/>
</scene>
)";

std::string textNow(const Desk& desk) {
    return view::sceneText(*desk.session->aboutScene(), desk.session->look(0), desk.session->stand.pose);
}

}  // namespace

TEST_CASE("prints, screens, a planar mirror and a backdrop are seen as render makes them") {
    if (!canView()) return;
    Desk desk{std::string(hall)};
    CHECK(worstDifference(desk, hall) < bound);
    // A lamp and a paint within the passes.
    desk.session->set("chartlight.spectrum=illuminants/FL2");
    CHECK(worstDifference(desk, replaced(hall, "illuminants/A", "illuminants/FL2")) < bound);
    desk.session->set("blue.reflectance=charts/colorchecker/yellow");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    desk.session->set("chartlight.times=2");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
}

TEST_CASE("a lamp that shines in another pass alone changes the picture") {
    if (!canView()) return;
    std::string apart = hall;
    for (const char* pass : {"<pass name=\"main\"", "<pass name=\"image\""}) {
        const size_t at = apart.find(" chartlight", apart.find(pass));
        apart.erase(at, std::string(" chartlight").size());
    }
    Desk desk{apart};
    CHECK(worstDifference(desk, apart) < bound);
    desk.session->set("chartlight.spectrum=illuminants/FL2");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    desk.session->set("chartlight.times=0.5");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
}

TEST_CASE("a light of a pass's colour is that of render, whatever lamp lights the pass") {
    if (!canView()) return;
    const std::string glowing = replaced(hall, "illuminants/D65", "pass:shown");
    Desk desk{glowing};
    CHECK(worstDifference(desk, glowing) < bound);
    desk.session->set("chartlight.spectrum=illuminants/FL2");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    desk.session->set("blue.reflectance=charts/colorchecker/yellow");
    desk.session->set("lamp.times=0.5");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    desk.session->set("observer=cie1964-10");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    (void)desk.viewer->picture();  // its panel
    desk.session->set("lamp.spectrum=illuminants/A");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
}

TEST_CASE("from elsewhere, and in another size, mirror and backdrop are made for the camera") {
    if (!canView()) return;
    Desk desk{std::string(hall)};
    desk.play("camera orbit 12 6\ncamera dolly 1");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    desk.session->set("lamp.spectrum=illuminants/LED-B3");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    desk.play("resize 60 80");
    (void)desk.viewer->picture();
    CHECK(worstDifference(desk, replaced(textNow(desk), "72x54", "60x80")) < bound);
    desk.play("resize 72 54\nkey home");
    (void)desk.viewer->picture();
    CHECK(worstDifference(desk, replaced(hall, "illuminants/D65", "illuminants/LED-B3")) < bound);
}

TEST_CASE("a baked light shows as render shows it") {
    if (!canView()) return;
    Desk desk{std::string(hall)};
    // What bake writes: the light on a surface, in its texture's square.
    RenderSettings settings;
    settings.pass = "main";
    settings.size = {16, 16};
    const std::string room = R"(<scene version="1">
  <node name="wall"><plane size="2 2"/></node>
  <light name="lamp" type="point" position="1 1 1" spectrum="illuminants/A" intensity="30 cd"/>
  <camera look-from="0 0 3" look-at="0 0 0" size="16x16"/><pass name="main"/></scene>)";
    const TemporaryFolder folder;
    Notes notes;
    settings.bake = Bake{"wall", PassKind::radiance, 4};
    const Scene scene = loadScene(folder.write("room.xml", room), desk.library, {}, notes);
    PassTextures passes(scene, desk.library, desk.device, settings, notes);
    Cube cube = passes.render();
    cube.info.projectionStated = true;
    const auto writer = createExr(folder.path() / "wall.exr", cube.info, {});
    writer->write(
        cube.info.height, cube.values.data(),
        std::vector<float>(size_t{3} * static_cast<size_t>(cube.info.width * cube.info.height)).data());
    (void)writer->finish();
    const std::string wearing = R"(<scene version="1">
  <material name="baked"><emission texture=")" +
                                (folder.path() / "wall.exr").string() + R"("/></material>
  <node rotate="0 1 0 25"><plane size="2 2" material="baked"/></node>
  <light name="lamp" type="point" position="0 0 3" spectrum="illuminants/D65" intensity="1 cd"/>
  <camera look-from="0 0 3" look-at="0 0 0" size="48x48"/></scene>)";
    Desk wall{wearing};
    CHECK(worstDifference(wall, wearing) < bound);
}

TEST_CASE("with many lights later changes of one plan nothing anew, and show what render makes") {
    if (!canView()) return;
    std::string text =
        "<scene version=\"1\"><material name=\"m\"><diffuse "
        "reflectance=\"charts/colorchecker/orange\"/></material>\n<node><plane size=\"4 4\" "
        "material=\"m\"/></node>\n";
    for (int i = 0; i < 40; ++i)
        text += "<light name=\"l" + std::to_string(i) + "\" type=\"point\" position=\"" +
                std::to_string(i % 8 - 4) + " " + std::to_string(i / 8 - 2) + " 2\" spectrum=\"illuminants/" +
                (i % 2 ? "A" : "D65") + "\" intensity=\"" + std::to_string(10 + i) + " cd\"/>\n";
    text += "<camera look-from=\"0 0 5\" look-at=\"0 0 0\" size=\"48x32\"/></scene>\n";
    Desk desk(text);
    CHECK(worstDifference(desk, text) < bound);
    desk.session->set("l7.on=false");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    desk.session->set("l7.on=true");  // planned while it was off, it hides its share: once more
    CHECK(worstDifference(desk, text) < bound);
    const int planned = desk.session->scene()->timesPlanned();
    desk.session->set("l7.spectrum=illuminants/FL11");
    desk.session->set("l7.times=6");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    CHECK(desk.session->scene()->timesPlanned() == planned);
    desk.session->set("l0.spectrum=illuminants/FL2");
    CHECK(desk.session->whiteOf(desk.session->look(0)).name == "illuminants/FL2");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
    for (int i = 0; i < 40; ++i)  // beyond what can be apart: still right
        desk.session->set("l" + std::to_string(i) + ".times=0.5");
    CHECK(worstDifference(desk, textNow(desk)) < bound);
}
