// Texels that a pass leaves on the device are, bit for bit, those that its cube would become on the host.
#include "kernels/read_back.h"
#include "render/resident.h"
#include "render/texture.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <random>

using namespace spectrad;

namespace {

/// Radiances over fifteen decades, zeros and lines among them.
Cube randomCube(const Wavelengths& grid, int width, int height) {
    std::mt19937 random(static_cast<unsigned>(width * 1000 + static_cast<int>(grid.size())));
    std::uniform_real_distribution<float> decade(-12, 3), share(0, 1);
    Cube cube;
    cube.info.width = width;
    cube.info.height = height;
    cube.info.wavelengths = grid;
    cube.info.projectionStated = true;
    cube.info.kind = CubeKind::radiance;
    cube.values.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * grid.size());
    for (float& value : cube.values)
        value = share(random) < 0.1f ? 0.0f : std::pow(10.0f, decade(random));
    return cube;
}

/// The texture from strips of `rows` rows, each row padded as the renderer pads them.
std::vector<float> onDevice(const Device& device, const Cube& cube, int rows) {
    const auto width = static_cast<size_t>(cube.info.width);
    const size_t pitch = (width + 63) / 64 * 64, bands = cube.info.wavelengths.size();
    TexelStage stage(device, cube.info.wavelengths, cube.info.width, cube.info.height);
    for (int first = 0; first < cube.info.height; first += rows) {
        const int count = std::min(rows, cube.info.height - first);
        std::vector<float> strip(static_cast<size_t>(count) * bands * pitch, 1e30f);
        for (int row = 0; row < count; ++row)
            for (size_t band = 0; band < bands; ++band)
                std::copy_n(cube.row(first + row, band), width,
                            strip.data() + (static_cast<size_t>(row) * bands + band) * pitch);
        DeviceArray<float> buffer;
        buffer.upload(device, strip.data(), strip.size(), "a strip");
        stage.add(buffer.buffer(), static_cast<int>(pitch), first, count);
    }
    return stage.finish()->read();
}

}  // namespace

TEST_CASE("A rendered strip becomes the texels that the host makes of the same cube, bit for bit",
          "[oclgrind]") {
    const std::vector<DeviceInfo> devices = listDevices();
    if (devices.empty()) {
        WARN("skipped: no OpenCL device");
        return;
    }
    const Device device = Device::open(0);
    Wavelengths uneven;
    uneven.nm = {380, 381, 400, 450.5, 450.6, 500, 700};
    Wavelengths points = regularWavelengths(400, 700, 100, {});
    points.projection = Projection::point;
    Wavelengths one;
    one.nm = {550};
    for (const Wavelengths& grid : {regularWavelengths(380, 780, 20, {}), uneven, points, one})
        for (const int width : {1, 15, 16, 33, 70}) {
            const Cube cube = randomCube(grid, width, 5);
            Notes notes;
            TextureUse use;
            use.role = TextureRole::radiance;
            const std::vector<float> host = textureFrom(cube, use, notes).texels;
            const std::vector<float> there = onDevice(device, cube, 2);
            INFO(grid.size() << " bands, " << width << " pixels a row");
            REQUIRE(there.size() == host.size());
            CHECK(std::memcmp(there.data(), host.data(), host.size() * sizeof(float)) == 0);
        }
}
