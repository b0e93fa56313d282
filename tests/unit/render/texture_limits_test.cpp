// Textures beyond what the device takes are refused before they are read, by their numbers.
#include "image/cube.h"
#include "image/picture.h"
#include "render/texture.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace spectrad;

namespace {

DeviceInfo small(std::uint64_t bytes) {
    DeviceInfo device;
    device.number = 2;
    device.name = "pocket";
    device.maxAllocationBytes = bytes;
    return device;
}

}  // namespace

TEST_CASE(
    "a texture larger than the device's memory is an error at its place that names file, numbers, device") {
    const TemporaryFolder folder;
    const Library library(std::filesystem::path(SPECTRAD_SOURCE) / "spectra");
    writePng(folder.path() / "wall.png", {8, 4, 1, std::vector<std::uint8_t>(32, 77)}, {}, {});
    Cube cube;
    cube.info.width = 8, cube.info.height = 4;
    cube.info.wavelengths.nm = {400, 500, 600};
    cube.info.wavelengths.projection = Projection::point;
    cube.info.kind = CubeKind::reflectance;
    cube.values.assign(8 * 4 * 3, 0.5f);
    const auto writer = createExr(folder.path() / "wall.exr", cube.info, {});
    const std::vector<float> preview(3 * 8 * 4, 0.0f);
    writer->write(4, cube.values.data(), preview.data());
    writer->finish();
    Notes notes;
    const Scene scene;
    TextureLoader textures(scene, library, notes);
    TextureUse picture, spectral;
    picture.source = (folder.path() / "wall.png").string();
    spectral.source = (folder.path() / "wall.exr").string();
    spectral.where = {"scene.xml", 3, 7};
    // Pictures are lifted to 41 bands.
    const std::uint64_t pictureBytes = 8 * 4 * 41 * sizeof(float), cubeBytes = 8 * 4 * 3 * sizeof(float);
    textures.limitTo(small(cubeBytes));
    CHECK(textures.load(spectral).texels.size() == cube.values.size());
    CHECK_THROWS_WITH(textures.load(picture),
                      Catch::Contains("8 x 4 texels of 41 bands take 5248 bytes, more than the 384"));
    textures.limitTo(small(pictureBytes));
    CHECK(textures.load(picture).nm.size() == 41);
    textures.limitTo(small(cubeBytes - 1));
    CHECK_THROWS_WITH(textures.load(spectral),
                      Catch::StartsWith("scene.xml:3:7: ") &&
                          Catch::Contains("wall.exr: 8 x 4 texels of 3 bands take 384 bytes, more than the "
                                          "383 that device 2 (pocket) gives in one piece"));
    // A pyramid is a third larger than its lowest level.
    spectral.filter = TextureFilter::mip;
    textures.limitTo(small(cubeBytes));
    CHECK_THROWS_AS(textures.load(spectral), InputError);
}
