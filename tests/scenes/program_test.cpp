// Through the program, as users run it.
#include "base/files.h"
#include "scenes/scene_image.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace spectrad;
using namespace spectrad::test;

TEST_CASE("two runs of the program write the same bytes") {
    if (!haveDevice()) return;
    const TemporaryFolder folder;
    folder.write("scene.xml", R"(<scene version="1">
  <material name="plastic"><diffuse reflectance="charts/colorchecker/blue"/><gloss ior="1.5" roughness="0.3"/></material>
  <sphere radius="1" material="plastic"/>
  <light type="point" position="1 3 4" spectrum="illuminants/FL11" intensity="100 cd"/>
  <background spectrum="illuminants/D65" luminance="5 cd/m2"/>
  <camera type="perspective" fov="35" look-from="0 0.8 5" look-at="0 0 0" size="90x70"/>
</scene>)");
    for (const std::string name : {"a", "b"}) {
        const std::string command = "cd '" + folder.path().string() +
                                    "' && '" SPECTRAD_PROGRAM "' render scene.xml -o " + name +
                                    ".exr --preview " + name + ".png --quiet";
        REQUIRE(std::system(command.c_str()) == 0);
    }
    for (const std::string ending : {".exr", ".png"})
        CHECK(readFile(folder.path() / ("a" + ending)) == readFile(folder.path() / ("b" + ending)));
}
