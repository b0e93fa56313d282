// Silhouettes of imported models against an independent rasterizer: OpenGL's, as OSMesa draws it off-screen.
#include "scenes/scene_image.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#ifdef SPECTRAD_HAVE_OSMESA
#include <GL/osmesa.h>
#endif

using namespace spectrad;
using namespace spectrad::test;

namespace fs = std::filesystem;

namespace {

constexpr int width = 400, height = 300;
constexpr double fovDegrees = 35;

/// Corners and fans of an OBJ file, read without the scene's importer.
struct Model {
    std::vector<Vec3> corner;
    std::vector<std::vector<size_t>> face;
    Vec3 centre;
    double radius = 0;
};

Model readObj(const fs::path& path) {
    Model model;
    std::ifstream file(path);
    Vec3 low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            Vec3 v;
            words >> v.x >> v.y >> v.z;
            model.corner.push_back(v);
            low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
            high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
        } else if (word == "f") {
            std::vector<size_t> face;
            while (words >> word) {
                const long i = std::stol(word);
                face.push_back(
                    static_cast<size_t>(i < 0 ? static_cast<long>(model.corner.size()) + i : i - 1));
            }
            model.face.push_back(face);
        }
    }
    model.centre = (low + high) * 0.5;
    model.radius = length(high - low) / 2;
    return model;
}

struct Camera3 {
    Vec3 from, at;
};
std::vector<Camera3> camerasAround(const Model& model) {
    std::vector<Camera3> cameras;
    for (const Vec3 direction : {Vec3{0.1, 0.2, 1}, Vec3{1, 0.4, -0.3}, Vec3{-0.7, -0.5, 0.6}})
        cameras.push_back({model.centre + normalized(direction) * (model.radius * 3.4), model.centre});
    // So near that the model leaves the image on all sides.
    cameras.push_back({model.centre + normalized(Vec3{0.5, 0.3, 1}) * (model.radius * 1.3), model.centre});
    return cameras;
}

using Mask = std::vector<bool>;

Mask ours(const fs::path& path, const Camera3& camera) {
    const auto triple = [](Vec3 v) { return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z); };
    RenderSettings settings;
    settings.samples = 1;
    const Image image = imageOf(
        fmt::format("<scene version=\"1\"><wavelengths>550</wavelengths>"
                    "<material name=\"glow\"><emission spectrum=\"constant:1\" scale=\"1\"/></material>"
                    "<mesh file=\"{}\" material=\"glow\"/>"
                    "<camera type=\"perspective\" fov=\"{}\" look-from=\"{}\" look-at=\"{}\" "
                    "size=\"{}x{}\"/></scene>",
                    path.string(), fovDegrees, triple(camera.from), triple(camera.at), width, height),
        settings);
    Mask mask;
    for (float v : image.values)
        mask.push_back(v == 1.0f);
    return mask;
}

#ifdef SPECTRAD_HAVE_OSMESA
Mask osmesas(const Model& model, const Camera3& camera) {
    const OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
    REQUIRE(context);
    std::vector<unsigned char> pixels(size_t{4} * width * height);
    REQUIRE(OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, width, height));
    OSMesaPixelStore(OSMESA_Y_UP, 0);
    glViewport(0, 0, width, height);
    glDisable(GL_CULL_FACE);
    glClear(GL_COLOR_BUFFER_BIT);
    const double nearest = model.radius * 1e-3, top = nearest * std::tan(fovDegrees * std::numbers::pi / 360),
                 right = top * width / height;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-right, right, -top, top, nearest, model.radius * 10);
    glMatrixMode(GL_MODELVIEW);
    const Vec3 z = normalized(camera.from - camera.at), x = normalized(cross({0, 1, 0}, z)), y = cross(z, x);
    const double view[16] = {x.x, y.x, z.x, 0, x.y, y.y, z.y, 0, x.z, y.z, z.z, 0, 0, 0, 0, 1};  // by columns
    glLoadMatrixd(view);
    glColor3f(1, 1, 1);
    for (const auto& face : model.face) {
        // Triangles of a fan, as importers cut faces; relative to the eye, since GL computes in float.
        for (size_t i = 2; i < face.size(); ++i) {
            glBegin(GL_TRIANGLES);
            for (const size_t corner : {face[0], face[i - 1], face[i]}) {
                const Vec3 p = model.corner[corner] - camera.from;
                glVertex3d(p.x, p.y, p.z);
            }
            glEnd();
        }
    }
    glFinish();
    OSMesaDestroyContext(context);
    Mask mask;
    for (size_t i = 0; i < pixels.size(); i += 4)
        mask.push_back(pixels[i] > 127);
    return mask;
}
#else
Mask osmesas(const Model&, const Camera3&) {
    return {};
}
#endif

struct Comparison {
    size_t covered = 0, edge = 0, different = 0, differentInside = 0;
};
/// A pixel lies at an edge where one of its eight neighbours is of the other kind.
Comparison compare(const Mask& mask, const Mask& reference) {
    Comparison result;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto at = [&](const Mask& m, int i, int j) {
                return m[static_cast<size_t>(j) * width + static_cast<size_t>(i)];
            };
            bool edge = false;
            for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
                for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i)
                    edge = edge || at(reference, i, j) != at(reference, x, y);
            const bool different = at(mask, x, y) != at(reference, x, y);
            result.covered += at(reference, x, y);
            result.edge += edge;
            result.different += different;
            result.differentInside += different && !edge;
        }
    }
    return result;
}

}  // namespace

TEST_CASE("silhouettes of imported models are OpenGL's but for pixels whose centres an edge meets") {
    if (!haveDevice()) return;
#ifndef SPECTRAD_HAVE_OSMESA
    WARN("skipped: built without OSMesa (libosmesa6-dev)");
    return;
#endif
    for (const char* name : {"cow.obj", "spot.obj", "stanford-bunny.obj", "suzanne.obj", "teapot.obj"}) {
        const fs::path path = fs::path(SPECTRAD_SHARED) / "models" / name;
        if (!fs::exists(path)) {
            WARN("skipped: no " << path.string());
            continue;
        }
        const Model model = readObj(path);
        for (const Camera3& camera : camerasAround(model)) {
            const Comparison result = compare(ours(path, camera), osmesas(model, camera));
            INFO(name << ": " << result.covered << " pixels covered, " << result.edge << " at edges, "
                      << result.different << " different");
            CHECK(result.covered > 5000);
            CHECK(result.differentInside == 0);
            CHECK(static_cast<double>(result.different) < 0.01 * static_cast<double>(result.edge));
        }
    }
}
