// Plans made by hand, for stages on their own: one placement, materials and terms counted out.
#pragma once

#include "render/plan.h"
#include "render/samples.h"

#include <cmath>
#include <random>

namespace spectrad::bench {

/// A camera of 40° that looks down −z from the origin, at a world without triangles and with a background
/// that is black.
inline Plan emptyPlan(int width, int height, int samples, size_t bands) {
    Plan plan;
    plan.samples = samples;
    plan.view.width = width;
    plan.view.height = height;
    plan.view.pixelsPerSlope = height / (2 * std::tan(20 * 3.14159265358979323846 / 180));
    plan.terms.bands = bands;
    for (size_t b = 0; b < bands; ++b)
        plan.wavelengths.nm.push_back(380 + 5.0 * static_cast<double>(b));
    plan.groups = 1;
    plan.defines = {"SLOTS=" + std::to_string(lanePattern(samples, 1).slots)};
    sd_draw draw{};
    draw.to_camera[0] = draw.to_camera[5] = draw.to_camera[10] = 1;
    draw.normal[0] = draw.normal[4] = draw.normal[8] = 1;
    plan.world.draws.push_back(draw);
    plan.world.materials.push_back({});
    return plan;
}

inline sd_lobe emission() {
    sd_lobe lobe{};
    lobe.type = SD_LOBE_EMISSION;
    return lobe;
}

/// A material of lobes with `termsEach` terms each, spectra of some smooth shape.
inline std::uint32_t addMaterial(Plan& plan, std::vector<sd_lobe> lobes, std::uint32_t termsEach) {
    sd_material material{};
    material.first_lobe = static_cast<sd_uint>(plan.world.lobes.size());
    material.lobes = static_cast<sd_uint>(lobes.size());
    material.first_term = static_cast<sd_uint>(plan.terms.count());
    material.terms = material.lobes * termsEach;
    for (size_t l = 0; l < lobes.size(); ++l) {
        lobes[l].term = static_cast<sd_uint>(l) * termsEach;
        plan.world.lobes.push_back(lobes[l]);
    }
    for (std::uint32_t t = 0; t < material.terms; ++t) {
        for (size_t b = 0; b < plan.terms.bands; ++b)
            plan.terms.spectra.push_back(static_cast<float>(1 + std::sin(0.1 * static_cast<double>(b) + t)));
        plan.terms.preview.insert(plan.terms.preview.end(), {0.5f, 0.4f, 0.3f});
    }
    plan.world.materials.push_back(material);
    return static_cast<std::uint32_t>(plan.world.materials.size() - 1);
}

inline std::uint32_t addVertex(World& world, double x, double y, double z) {
    for (double v : {x, y, z})
        world.position.push_back(static_cast<float>(v));
    world.normal.insert(world.normal.end(), {0, 0, 1});
    world.vertexDraw.push_back(0);
    return static_cast<std::uint32_t>(world.vertexDraw.size() - 1);
}

/// Two triangles across the whole image, 2 m away.
inline void addWall(Plan& plan, std::uint32_t material) {
    World& world = plan.world;
    const double x = plan.view.width / plan.view.pixelsPerSlope * 1.01,
                 y = plan.view.height / plan.view.pixelsPerSlope * 1.01;
    const std::uint32_t a = addVertex(world, -x, -y, -2), b = addVertex(world, x, -y, -2),
                        c = addVertex(world, x, y, -2), d = addVertex(world, -x, y, -2);
    world.index.insert(world.index.end(), {a, b, c, a, c, d});
    world.triangleMaterial.insert(world.triangleMaterial.end(), 2, material);
}

/// `count` right triangles with legs of `leg` pixels, turned at random, centres all over the image, 1 to 5 m
/// away.
inline void addRightTriangles(Plan& plan, size_t count, double leg, std::uint32_t material) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    const View& view = plan.view;
    for (size_t t = 0; t < count; ++t) {
        const double cx = (unit(random) - 0.5) * view.width, cy = (unit(random) - 0.5) * view.height;
        const double turn = 2 * 3.14159265358979323846 * unit(random), depth = 1 + 4 * unit(random);
        for (const auto& [u, v] : {std::pair{-1.0 / 3, -1.0 / 3}, {2.0 / 3, -1.0 / 3}, {-1.0 / 3, 2.0 / 3}}) {
            const double x = cx + leg * (u * std::cos(turn) - v * std::sin(turn)),
                         y = cy + leg * (u * std::sin(turn) + v * std::cos(turn));
            const double z = depth * (1 + 0.02 * u);
            plan.world.index.push_back(
                addVertex(plan.world, x / view.pixelsPerSlope * z, y / view.pixelsPerSlope * z, -z));
        }
        plan.world.triangleMaterial.push_back(material);
    }
}

/// An indexed mesh, scaled and moved so that its bounding box stands in the middle of the image and fills
/// `share` of its height.
inline void addMesh(Plan& plan, const Mesh& mesh, double share, std::uint32_t material) {
    std::array<float, 3> low = mesh.position.at(0), high = low;
    for (const auto& p : mesh.position) {
        for (size_t i = 0; i < 3; ++i)
            low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    }
    const double tall = static_cast<double>(high[1]) - low[1], deep = static_cast<double>(high[2]) - low[2];
    const double distance = 4, scale = share * plan.view.height / plan.view.pixelsPerSlope * distance / tall;
    const auto first = static_cast<std::uint32_t>(plan.world.vertexDraw.size());
    for (const auto& p : mesh.position) {
        const auto centred = [&](size_t i) {
            return (p[i] - (static_cast<double>(low[i]) + high[i]) / 2) * scale;
        };
        addVertex(plan.world, centred(0), centred(1), centred(2) - distance - deep * scale / 2);
    }
    for (std::uint32_t i : mesh.index)
        plan.world.index.push_back(first + i);
    plan.world.triangleMaterial.insert(plan.world.triangleMaterial.end(), mesh.triangles(), material);
}

}  // namespace spectrad::bench
