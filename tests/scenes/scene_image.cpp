#include "scenes/scene_image.h"

#include "render/passes.h"
#include "render/renderer.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

namespace spectrad::test {

bool haveDevice() {
    static const bool have = !listDevices().empty();
    if (!have) WARN("skipped: no OpenCL device");
    return have;
}

const Device& device() {
    static const Device opened = Device::open(std::nullopt);
    return opened;
}

const Library& library() {
    static const Library opened = Library::open();
    return opened;
}

Scene sceneFrom(const std::string& text) {
    const TemporaryFolder folder;
    Notes notes;
    return loadScene(folder.write("scene.xml", text), library(), {}, notes);
}

Plan planOf(const Scene& scene, const RenderSettings& settings) {
    Notes notes;
    return makePlan(scene, settings, library(), notes);
}

Image imageOf(const Plan& plan) {
    Image image{plan.view.width, plan.view.height, plan.wavelengths, {}, {}};
    const auto width = static_cast<size_t>(image.width), height = static_cast<size_t>(image.height);
    // What the renderer leaves out stays NaN.
    image.values.assign(width * height * plan.wavelengths.size(), std::numeric_limits<float>::quiet_NaN());
    image.preview.assign(width * height * 3, std::numeric_limits<float>::quiet_NaN());
    int next = 0;
    Renderer renderer(device(), plan);
    renderer.render([&](int firstRow, int rows, const float* bands, const float* preview) {
        if (firstRow != next || rows < 1 || firstRow + rows > image.height)
            throw std::logic_error(
                fmt::format("strip of rows {} to {} after row {}", firstRow, firstRow + rows - 1, next - 1));
        next += rows;
        const size_t bandsInRow = width * plan.wavelengths.size(), from = static_cast<size_t>(firstRow);
        std::copy_n(bands, static_cast<size_t>(rows) * bandsInRow, image.values.data() + from * bandsInRow);
        std::copy_n(preview, static_cast<size_t>(rows) * width * 3, image.preview.data() + from * width * 3);
    });
    if (next != image.height) throw std::logic_error("the last strips are missing");
    return image;
}

Image imageOf(const Scene& scene, const RenderSettings& settings) {
    Notes notes;
    PassTextures passes(scene, library(), device(), settings, notes);
    return imageOf(makePlan(scene, settings, library(), passes, notes));
}

Image imageOf(const std::string& text, const RenderSettings& settings) {
    return imageOf(sceneFrom(text), settings);
}

void Worst::add(double value, double want, double scale, int column, int row, size_t which) {
    const double now = value == want ? 0 : std::abs(value - want) / scale;
    if (now <= error || std::isnan(error)) return;
    *this = {now, column, row, which, value, want};
}

std::string Worst::str() const {
    return fmt::format("pixel {},{} band {}: {} where {} is expected (error {:.3g})", x, y, band, got,
                       expected, error);
}

}  // namespace spectrad::test
