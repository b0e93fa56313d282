// A scene's text, read and rendered for the tests of the reference.
#pragma once

#include "render/renderer.h"
#include "scene/load.h"
#include "support/temporary_folder.h"
#include "verify/certificate.h"

#include <catch2/catch.hpp>

#include <functional>

namespace spectrad::test {

struct JudgedScene {
    /// `before` writes what the scene reads.
    explicit JudgedScene(
        const std::string& text,
        const std::function<void(const TemporaryFolder&)>& before = [](const auto&) {})
        : scene((before(folder), loadScene(folder.write("scene.xml", text), library, {}, notes))),
          observer(standardObserver(library)) {}

    [[nodiscard]] Plan plan(const RenderSettings& settings = {}) {
        return makePlan(scene, settings, library, notes);
    }
    [[nodiscard]] Cube image(const RenderSettings& settings = {}) {
        const Plan made = plan(settings);
        Cube cube;
        cube.info.width = made.view.width;
        cube.info.height = made.view.height;
        cube.info.wavelengths = made.wavelengths;
        Renderer renderer(device, made);
        renderer.render([&](int, int rows, const float* bands, const float*) {
            cube.values.insert(
                cube.values.end(), bands,
                bands + static_cast<size_t>(rows) * made.terms.bands * static_cast<size_t>(made.view.width));
        });
        return cube;
    }
    [[nodiscard]] Certificate certificate(const Cube& cube, double share, std::uint64_t seed = 1) {
        const Reference reference(scene, {}, cube.info.wavelengths, observer, library, device);
        PixelSample sample(cube.info, share, seed, observer, false);
        sample.add(0, cube.info.height, cube.values.data());
        const White white = defaultWhite(scene, {}, observer, library, device, sample.brightest());
        return certify(sample, reference, observer, white);
    }

    TemporaryFolder folder;
    Notes notes;
    Library library = Library::open();
    Scene scene;
    Detector observer;
    Device device = Device::open(std::nullopt);
};

}  // namespace spectrad::test
