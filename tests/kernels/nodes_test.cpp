// What becomes of a pass on the device – divided by a white diffuser, shown on a display, turned into texels
// with their smaller levels – is, bit for bit, what would become of its cube on the host.
#include "kernels/read_back.h"
#include "render/divided.h"
#include "render/resident.h"
#include "render/shown.h"
#include "render/texels.h"
#include "render/texture.h"
#include "render/texture_nodes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <limits>
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

/// Rows of a cube as the renderer hands them out, each padded to whole blocks; the padding is no number.
struct Strips {
    Strips(const Device& d, const Cube& c, int r) : device(d), cube(c), rows(r) {
        const auto width = static_cast<size_t>(cube.info.width);
        pitch = (width + 63) / 64 * 64;
    }
    template <typename Use>
    void each(const Use& use) const {
        const size_t bands = cube.info.wavelengths.size();
        for (int first = 0; first < cube.info.height; first += rows) {
            const int count = std::min(rows, cube.info.height - first);
            std::vector<float> strip(static_cast<size_t>(count) * bands * pitch, std::nanf(""));
            for (int row = 0; row < count; ++row)
                for (size_t band = 0; band < bands; ++band)
                    std::copy_n(cube.row(first + row, band), cube.info.width,
                                strip.data() + (static_cast<size_t>(row) * bands + band) * pitch);
            DeviceArray<float> buffer;
            buffer.upload(device, strip.data(), strip.size(), "a strip");
            use(buffer.buffer(), static_cast<int>(pitch), first, count);
        }
    }
    const Device& device;
    const Cube& cube;
    int rows;
    size_t pitch = 0;
};

/// The texture from strips of `rows` rows.
std::shared_ptr<const ResidentTexels> onDevice(const Device& device, const Cube& cube, int rows) {
    TexelStage stage(device, cube.info.wavelengths, cube.info.width, cube.info.height,
                     cube.info.kind == CubeKind::reflectance);
    Strips(device, cube, rows).each([&](const cl::Buffer& strip, int pitch, int first, int count) {
        stage.add(strip, pitch, first, count);
    });
    return stage.finish();
}

void requireSame(const std::vector<float>& there, const std::vector<float>& host) {
    REQUIRE(there.size() == host.size());
    CHECK(std::memcmp(there.data(), host.data(), host.size() * sizeof(float)) == 0);
}

/// Both forms of the kernels on the first device; none where there is no device.
std::vector<Device> bothForms() {
    std::vector<Device> forms;
    if (listDevices().empty()) {
        WARN("skipped: no OpenCL device");
        return forms;
    }
    for (const char* type : {"cpu", "gpu"}) {
        forms.push_back(Device::open(0));
        forms.back().body().info.type = type;
    }
    return forms;
}

TextureUse useAs(TextureRole role, TextureFilter filter = TextureFilter::bilinear) {
    TextureUse use;
    use.role = role;
    use.source = "pass:p";
    use.filter = filter;
    return use;
}

}  // namespace

TEST_CASE("A rendered strip becomes the texels that the host makes of the same cube, bit for bit",
          "[oclgrind]") {
    Wavelengths uneven;
    uneven.nm = {380, 381, 400, 450.5, 450.6, 500, 700};
    Wavelengths points = regularWavelengths(400, 700, 100, {});
    points.projection = Projection::point;
    Wavelengths one;
    one.nm = {550};
    for (const Device& device : bothForms())
        for (const Wavelengths& grid : {regularWavelengths(380, 780, 20, {}), uneven, points, one})
            for (const int width : {1, 15, 33, 70}) {
                Cube cube = randomCube(grid, width, 5);
                Notes notes, notesThere;
                INFO(grid.size() << " bands, " << width << " pixels a row");
                requireSame(onDevice(device, cube, 2)->read(1),
                            textureFrom(cube, useAs(TextureRole::radiance), notes).texels);
                CHECK(notes.lines().empty());
                cube.info.kind = CubeKind::reflectance;  // held above zero, and counted
                const TextureUse use = useAs(TextureRole::reflectance);
                const auto resident = onDevice(device, cube, 2);
                requireSame(resident->read(1), textureFrom(cube, use, notes).texels);
                CHECK((resident->lost > 0) == (grid.size() > 4));
                static_cast<void>(textureFrom(resident, use, notesThere));
                CHECK(notesThere.lines() == notes.lines());
            }
}

TEST_CASE("A texture's smaller levels are the host's, bit for bit, whatever its sides", "[oclgrind]") {
    for (const Device& device : bothForms())
        for (const int bands : {1, 3, 21})
            for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {16, 8}, {7, 5}, {21, 3}}) {
                const Wavelengths grid = regularWavelengths(400, 400 + 10 * (bands - 1), 10, {});
                const Cube cube = randomCube(grid, width, height);
                Notes notes;
                const TextureUse use = useAs(TextureRole::radiance, TextureFilter::mip);
                World host, there;
                static_cast<void>(
                    addTexels(host, {width, height, bands, textureFrom(cube, use, notes).texels}, use));
                const auto resident = withLevels(*onDevice(device, cube, 2));
                REQUIRE(resident);
                static_cast<void>(addResident(there, resident, use));
                CHECK(there.textures[0].levels == host.textures[0].levels);
                CHECK(there.texels.empty());
                fetchTexels(there);
                INFO(bands << " bands, " << width << " x " << height);
                requireSame(there.texels, host.texels);
                // A use that wants the finest alone finds it in front.
                World finest;
                static_cast<void>(addResident(finest, resident, useAs(TextureRole::radiance)));
                CHECK(finest.textures[0].levels == 1);
                CHECK(finestLevel(finest, 1).size() == resident->count(1));
                fetchTexels(finest);
                CHECK(std::memcmp(finest.texels.data(), host.texels.data(),
                                  resident->count(1) * sizeof(float)) == 0);
            }
}

TEST_CASE("A reflectance is divided on the device as on the host, and refused at the same pixel",
          "[oclgrind]") {
    const Wavelengths grid = regularWavelengths(400, 700, 50, {});
    Wavelengths one;
    one.nm = {550};
    for (const Device& device : bothForms())
        for (const bool dark : {false, true}) {
            const int width = 70, height = 5;
            Cube cube = randomCube(grid, width, height), white = randomCube(one, width, height),
                 coverage = randomCube(one, width, height);
            for (size_t i = 0; i < white.values.size(); ++i) {
                const bool lit = white.values[i] > 0;
                if (!lit) coverage.values[i] = 0;
            }
            if (dark)
                for (const size_t i : {size_t{3 * 70 + 9}, size_t{2 * 70 + 66}, size_t{4 * 70}})
                    white.values[i] = 0, coverage.values[i] = 0.25f;
            DivisionStage stage(device, 128, width, height);
            Strips(device, white, 2).each([&](const cl::Buffer& strip, int, int first, int count) {
                stage.addWhite(strip, first, count);
            });
            Strips(device, coverage, 3).each([&](const cl::Buffer& strip, int, int first, int count) {
                stage.addCoverage(strip, first, count);
            });
            std::vector<float> divided;
            Strips(device, cube, 2).each([&](const cl::Buffer& strip, int pitch, int first, int count) {
                stage.divide(strip, grid.size(), first, count);
                const std::vector<float> rows =
                    read<float>(device, strip, static_cast<size_t>(count * pitch) * grid.size());
                for (size_t line = 0; line < static_cast<size_t>(count) * grid.size(); ++line)
                    divided.insert(divided.end(), rows.begin() + std::ptrdiff_t(line) * pitch,
                                   rows.begin() + std::ptrdiff_t(line) * pitch + width);
            });
            const auto there = stage.dark(), here = divideByWhite(cube, white, coverage);
            CHECK(there == here);
            if (dark)
                CHECK(here == PixelPlace{66, 2});
            else
                requireSame(divided, cube.values);
        }
}

TEST_CASE("A display shows on the device what it shows on the host, and clips as many pixels", "[oclgrind]") {
    const Library library = Library::open();
    const Wavelengths grid = regularWavelengths(400, 700, 20, {});
    Screen screen;
    screen.detector = *library.find("observers/cie1931-2");
    for (const double peak : {610.0, 545.0, 450.0})
        screen.primaries.curves.push_back(Curve::table({peak - 40, peak, peak + 40}, {0, 1, 0}));
    screen.primaries.text = "triangles";
    screen.luminance = 1e4;
    for (const Device& device : bothForms())
        for (const bool finite : {true, false}) {
            Cube cube = randomCube(grid, 70, 5);
            if (!finite) cube.values[grid.size() * 70 * 3 + 12] = std::numeric_limits<float>::infinity();
            ScreenStage stage(device, screen, grid, library, 70);
            std::vector<float> shown;
            Strips(device, cube, 2).each([&](const cl::Buffer& strip, int pitch, int first, int count) {
                stage.show(strip, pitch, first, count);
                const std::vector<float> rows =
                    read<float>(device, strip, static_cast<size_t>(count * pitch) * grid.size());
                for (size_t line = 0; line < static_cast<size_t>(count) * grid.size(); ++line)
                    shown.insert(shown.end(), rows.begin() + std::ptrdiff_t(line) * pitch,
                                 rows.begin() + std::ptrdiff_t(line) * pitch + 70);
            });
            Notes here, there;
            if (!finite) {
                CHECK_THROWS_WITH(stage.finish(350, there),
                                  "pixel (12, 3) holds a value that is no finite number");
                continue;
            }
            stage.finish(350, there);
            requireSame(shown, shownOn(screen, cube, library, here).values);
            CHECK(there.lines() == here.lines());
            CHECK(here.lines().size() == 1);
        }
}

TEST_CASE("How finely a painted coat's intervals are cut is found on the device as on the host",
          "[oclgrind]") {
    const Wavelengths grid = regularWavelengths(400, 700, 50, {});
    for (const Device& device : bothForms())
        for (const float most : {0.0f, 0.05f, 0.4f, 0.9f, 1.0f}) {
            Cube cube = randomCube(grid, 33, 3);
            cube.info.kind = CubeKind::reflectance;
            cube.info.wavelengths.projection = Projection::point;
            float largest = 0;
            for (const float value : cube.values)
                largest = std::max(largest, value);
            for (float& value : cube.values)
                value *= most / largest;
            Notes notes;
            const TextureUse use = useAs(TextureRole::reflectance);
            World host, there;
            static_cast<void>(addTexels(
                host, {33, 3, static_cast<int>(grid.size()), textureFrom(cube, use, notes).texels}, use));
            static_cast<void>(addResident(there, onDevice(device, cube, 2), use));
            CHECK(largestTexel(there, 1) == largestTexel(host, 1));
            for (const int power : {0, 1, 2})
                for (const double inside : {0.0, 0.1, 0.6, 0.92}) {
                    INFO("reflectances up to " << most << ", power " << power << ", inside " << inside);
                    const int steps = stepsFor(host, 1, inside, power);
                    CHECK(stepsFor(there, 1, inside, power) == steps);
                    if (most == 0 || inside == 0) CHECK(steps == 1);
                    if (most == 1 && inside > 0.5) CHECK(steps >= 4);
                }
        }
}
