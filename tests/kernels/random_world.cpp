#include "kernels/random_world.h"

#include "render/casters.h"
#include "render/facets.h"
#include "render/fresnel.h"
#include "render/samples.h"
#include "render/texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace spectrad {

namespace {

using Random = std::mt19937;
double uniform(Random& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}

/// A lobe with tables of its own; `functions` angle functions for microfacets.
void addLobe(Plan& plan, int type, std::uint32_t& term, double alpha, std::uint32_t functions = 0,
             bool multipleApart = false, double alphaAcross = 0) {
    World& world = plan.world;
    sd_lobe lobe{};
    lobe.type = type;
    lobe.term = term;
    lobe.table = static_cast<sd_uint>(world.tables.size());
    lobe.table_light = lobe.table;
    lobe.functions = functions;
    lobe.multiple_to = multipleApart ? functions : 0;
    lobe.multiple = 0.3f;
    lobe.alpha = static_cast<float>(alpha);
    lobe.alpha_v = static_cast<float>(alphaAcross);
    lobe.mean_through = 0.9f;
    lobe.ratio = 0.37f, lobe.inv_n2 = 0.44f, lobe.escape = 0.6f, lobe.rest = 1.7f;
    lobe.inside_rest = 0.7f, lobe.second_rest = 0.2f;
    const size_t each = alphaAcross == 0 ? 1 : SD_AZIMUTHS;
    if (type == SD_LOBE_COATED) lobe.table_light += static_cast<sd_uint>(each * SD_CELLS);
    const size_t tables = type == SD_LOBE_REFLECTION     ? functions
                          : type == SD_LOBE_FACETS       ? (1 + functions) * each + functions
                          : type == SD_LOBE_ROUGH_COATED ? each + 2
                          : type == SD_LOBE_COATED       ? 2 * each
                          : type == SD_LOBE_EMISSION || type == SD_LOBE_DIFFUSE ? 0
                                                                                : each;
    for (size_t t = 0; t < tables; ++t) {
        // At the normal there is no azimuth: coefficients beyond the constant vanish.
        const bool constant = alphaAcross == 0 || t % SD_AZIMUTHS == 0 ||
                              (type != SD_LOBE_COATED && t >= (1 + functions) * each);
        const auto table = tabulate([&](double c) {
            const double f = fresnelDielectric(c, 1.3 + 0.2 * static_cast<double>(t));
            return constant ? f : 0.1 * (1 - c) * f;
        });
        world.tables.insert(world.tables.end(), table.begin(), table.end());
    }
    world.lobes.push_back(lobe);
    const std::uint32_t blocks = type == SD_LOBE_FACETS         ? functions + (multipleApart ? 1 : 0)
                                 : type == SD_LOBE_ROUGH_COATED ? 3
                                 : type == SD_LOBE_ROUGH        ? 2
                                                                : 1;
    constexpr std::uint32_t imageBands = 4;
    term += type == SD_LOBE_REFLECTION ? functions * imageBands
            : type == SD_LOBE_EMISSION ? 1
                                       : blocks * plan.groups;
}

void addMaterials(Plan& plan, bool backdrop) {
    World& world = plan.world;
    std::uint32_t terms = 0;
    const auto begin = [&] {
        sd_material m{};
        m.first_lobe = static_cast<sd_uint>(world.lobes.size());
        m.first_term = terms;
        world.materials.push_back(m);
    };
    const auto end = [&](std::uint32_t used) {
        sd_material& m = world.materials.back();
        m.lobes = static_cast<sd_uint>(world.lobes.size()) - m.first_lobe;
        m.terms = used;
        terms += used;
    };
    // Background; Lambert; coated; coated mirror; glowing Lambert; rough; metal of three functions.
    std::uint32_t term = 0;
    begin(), addLobe(plan, SD_LOBE_EMISSION, term, 0), end(term);
    term = 0;
    begin(), addLobe(plan, SD_LOBE_DIFFUSE, term, 0), end(term);
    for (double alpha : {0.25, 0.0}) {
        term = 0;
        begin(), addLobe(plan, SD_LOBE_COATED, term, 0), addLobe(plan, SD_LOBE_FACETS, term, alpha, 1),
            end(term);
    }
    term = 0;
    begin(), addLobe(plan, SD_LOBE_EMISSION, term, 0), addLobe(plan, SD_LOBE_DIFFUSE, term, 0), end(term);
    term = 0;
    begin(), addLobe(plan, SD_LOBE_ROUGH, term, 0.4), end(term);
    term = 0;
    begin(), addLobe(plan, SD_LOBE_FACETS, term, 0.09, 3, true), end(term);
    // Rougher along one axis than along the other: a coat over its base, a metal.
    term = 0;
    begin(), addLobe(plan, SD_LOBE_COATED, term, 0.2, 0, false, 0.5),
        addLobe(plan, SD_LOBE_FACETS, term, 0.2, 1, false, 0.5), end(term);
    term = 0;
    begin(), addLobe(plan, SD_LOBE_FACETS, term, 0.4, 2, true, 0.15), end(term);
    // Rough diffuse under coats, one of them brushed.
    for (const double across : {0.0, 0.5}) {
        term = 0;
        begin(), addLobe(plan, SD_LOBE_ROUGH_COATED, term, 0.2, 0, false, across),
            addLobe(plan, SD_LOBE_FACETS, term, 0.2, 1, false, across), end(term);
    }
    // Lambert, coat and rough diffuse, bare and coated, over textures: every filter, both ways beyond the
    // border, turned, masked; and glowing. Textures of few bands, and of more than vectors have lanes.
    struct Painted {
        int type;
        TextureFilter filter;
        int bands;
    };
    for (const auto& [type, filter, bands] : {Painted{SD_LOBE_DIFFUSE, TextureFilter::bilinear, 19},
                                              {SD_LOBE_COATED, TextureFilter::nearest, 4},
                                              {SD_LOBE_COATED, TextureFilter::bilinear, 17},
                                              {SD_LOBE_ROUGH, TextureFilter::mip, 4},
                                              {SD_LOBE_ROUGH, TextureFilter::mip, 18},
                                              {SD_LOBE_ROUGH_COATED, TextureFilter::bilinear, 4}}) {
        TextureUse use;
        use.filter = filter;
        use.repeat = filter != TextureFilter::nearest;
        if (use.repeat) use.scale = {1.36, 1.0}, use.rotateDegrees = 20, use.offset = {0.2, -0.6};
        Texels image{5, 3, bands, {}};
        for (int i = 0; i < 5 * 3 * bands; ++i)
            image.texels.push_back(static_cast<float>((i * 37 % 101) / 100.0));
        const sd_uint number = addTexels(world, image, use);
        // A strength beside it: the same texels read as one band.
        sd_texture t = world.textures.back();
        t.bands = 1, t.width = 7, t.levels = 1;
        world.textures.push_back(t);
        const int steps = type == SD_LOBE_COATED ? 3 : type == SD_LOBE_DIFFUSE ? 1 : 2;
        const auto width = static_cast<std::uint32_t>(bands);
        const std::uint32_t blocks = (width - 1) * static_cast<std::uint32_t>(steps) + 1;
        term = 0;
        begin();
        addLobe(plan, type, term, 0.4);
        sd_lobe& lobe = world.lobes.back();
        lobe.texture = number;
        lobe.strength = type == SD_LOBE_DIFFUSE ? number + 1 : 0;
        lobe.inside = type == SD_LOBE_DIFFUSE ? 0.0f : 0.55f;
        lobe.steps = steps;
        term = plan.groups * (type == SD_LOBE_ROUGH          ? width + blocks
                              : type == SD_LOBE_ROUGH_COATED ? width + 2 * blocks
                                                             : blocks);
        addLobe(plan, SD_LOBE_EMISSION, term, 0);
        world.lobes.back().texture = number;
        world.lobes.back().steps = 1;
        end(term + width - 1);
    }
    // Mirrors that show six faces, or the picture's own place; and six faces behind everything.
    Texels faces{3, 18, 4, {}};
    for (int i = 0; i < 3 * 18 * 4; ++i)
        faces.texels.push_back(static_cast<float>((i * 53 % 97) / 90.0));
    const sd_uint facesNumber = addTexels(world, faces, {});
    for (const sd_uint mapping : {SD_MAP_CUBE, SD_MAP_PICTURE}) {
        term = 0;
        begin(), addLobe(plan, SD_LOBE_REFLECTION, term, 0, 2);
        world.lobes.back().texture = facesNumber;
        world.lobes.back().mapping = mapping;
        world.lobes.back().steps = 1;
        end(term);
    }
    if (backdrop) {
        world.lobes[0].texture = facesNumber;
        world.lobes[0].mapping = SD_MAP_CUBE;
        world.lobes[0].steps = 1;
        world.materials[0].first_term = terms;
        world.materials[0].terms = 4;
        terms += 4;
    }
    // Both metals bent by a map of directions, the coat over a mirror and the brushed coat by slopes.
    for (const int bands : {3, 2}) {
        Texels image{4, 4, bands, {}};
        for (int i = 0; i < 16 * bands; ++i)
            image.texels.push_back(i % 3 == 2 && bands == 3 ? 0.8f
                                                            : static_cast<float>(i * 29 % 83) / 83 - 0.5f);
        TextureUse use;
        use.repeat = true;
        use.rotateDegrees = -35;
        use.scale = {2, 1.2};
        const sd_uint number = addTexels(world, image, use);
        for (const size_t bent : bands == 3 ? std::array<size_t, 2>{6, 8} : std::array<size_t, 2>{3, 7})
            world.materials[bent].relief = number;
    }
    plan.terms.bands = 7;
    Random random(99);
    for (std::uint32_t t = 0; t < terms; ++t) {
        for (size_t b = 0; b < plan.terms.bands; ++b)
            plan.terms.spectra.push_back(static_cast<float>(uniform(random, 0, 2)));
        for (size_t c = 0; c < 3; ++c)
            plan.terms.preview.push_back(static_cast<float>(uniform(random, -0.1, 2)));
    }
}

void addLights(World& world) {
    const auto add = [&](int type, float x, float y, float z, std::uint32_t group, float scale) {
        sd_light l{};
        l.type = type;
        l.x = x, l.y = y, l.z = z;
        l.axis_x = 0.6f, l.axis_y = -0.48f, l.axis_z = -0.64f;
        l.chord_outer = 0.6f;
        l.inv_chord_range = 1 / 0.4f;
        l.group = group;
        l.scale = scale;
        world.lights.push_back(l);
    };
    add(SD_LIGHT_POINT, 1, 2, 0.5f, 0, 3);
    add(SD_LIGHT_SPOT, -2, 2, 1, 1, 20);
    add(SD_LIGHT_DIRECTIONAL, 0.48f, 0.6f, 0.64f, 0, 0.7f);
    add(SD_LIGHT_AMBIENT, 0, 0, 0, 1, 0.4f);
    add(SD_LIGHT_SURROUNDINGS, 0, 0, 0, 0, 0.2f);
}

/// All but every fifth triangle hide the spot and the lamp far away.
void addShadows(Plan& plan) {
    World& world = plan.world;
    world.lights[1].shadows = world.lights[2].shadows = 1;
    for (std::uint32_t t = 0; t < world.triangleMaterial.size(); ++t)
        if (t % 5 != 0) world.casters.push_back(t);
    orderCasters(world);
    plan.defines.insert(plan.defines.end(), {"HAS_SHADOWS", "SHADOW_WORDS=1"});
}

Plan emptyPlan(int samples, bool orthographic, int width, int height) {
    Plan plan;
    plan.samples = samples;
    plan.view.orthographic = orthographic;
    plan.view.width = width;
    plan.view.height = height;
    plan.view.worldToCamera = Affine::rotation({1, 2, 3}, 40);
    plan.view.pixelsPerSlope = orthographic ? height / 4.0 : height * 0.9;
    plan.wavelengths.nm = {400, 450, 500, 550, 600, 650, 700};
    plan.defines = {"HAS_COATED",        "HAS_FACETS",
                    "HAS_ROUGH",         "HAS_ROUGH_COATED",
                    "HAS_ANISOTROPY",    "HAS_TEXTURE",
                    "HAS_UNIFORM",       "HAS_POINT",
                    "HAS_MIP",           "HAS_RELIEF",
                    "HAS_TEXTURE_CURVE", "HAS_TEXTURE_PLACE",
                    "HAS_MAPPING",       "HAS_SPOT",
                    "HAS_DIRECTIONAL",   "SLOTS=" + std::to_string(lanePattern(samples, 1).slots)};
    sd_draw draw{};
    draw.to_camera[0] = draw.to_camera[5] = draw.to_camera[10] = 1;
    draw.normal[0] = draw.normal[4] = draw.normal[8] = 1;
    plan.world.draws.push_back(draw);
    plan.groups = 2;
    addMaterials(plan, !orthographic);
    addLights(plan.world);
    return plan;
}

void addVertex(World& world, double x, double y, double z, Random& random) {
    for (double v : {x, y, z})
        world.position.push_back(static_cast<float>(v));
    for (int i = 0; i < 3; ++i)
        world.normal.push_back(static_cast<float>(uniform(random, -1, 1)));
    for (const double along : {0.8, -0.5, 0.3})  // neighbours' agree as neighbours' do
        world.tangent.push_back(static_cast<float>(along + uniform(random, -0.1, 0.1)));
    world.vertexDraw.push_back(0);
    for (int i = 0; i < 2; ++i)
        world.uv.push_back(static_cast<float>(uniform(random, -0.3, 1.4)));
}

void addTriangle(World& world, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (std::uint32_t i : {a, b, c})
        world.index.push_back(i);
    world.triangleMaterial.push_back(static_cast<std::uint32_t>(1 + world.triangleMaterial.size() % 9));
}

}  // namespace

Plan randomPlan(unsigned seed, int samples, bool orthographic, int triangles, int height) {
    Plan plan = emptyPlan(samples, orthographic, height * 3 / 2 + 5, height);
    Random random(seed);
    // A turned, moved and stretched placement as well.
    sd_draw draw{};
    const double c = std::cos(0.4), s = std::sin(0.4);
    const double m[12] = {c, -s, 0, 0.1, s, c, 0, -0.2, 0, 0, 1.5, -0.3};
    for (size_t i = 0; i < 12; ++i)
        draw.to_camera[i] = m[i];
    const float n[9] = {static_cast<float>(c),
                        static_cast<float>(-s),
                        0,
                        static_cast<float>(s),
                        static_cast<float>(c),
                        0,
                        0,
                        0,
                        0.7f};
    for (size_t i = 0; i < 9; ++i)
        draw.normal[i] = n[i];
    plan.world.draws.push_back(draw);
    for (int t = 0; t < triangles; ++t) {
        const double size = std::pow(10, uniform(random, -2.5, 0.5));
        const double x = uniform(random, -3, 3), y = uniform(random, -2, 2), z = uniform(random, -8, -0.5);
        const auto first = static_cast<std::uint32_t>(plan.world.vertexDraw.size());
        for (int k = 0; k < 3; ++k) {
            addVertex(plan.world, x + uniform(random, -size, size), y + uniform(random, -size, size),
                      z + uniform(random, -size, size), random);
            plan.world.vertexDraw.back() = static_cast<std::uint32_t>(t % 2);
        }
        addTriangle(plan.world, first, first + 1, first + 2);
    }
    addShadows(plan);
    return plan;
}

Plan unbent(Plan plan) {
    for (sd_material& material : plan.world.materials)
        material.relief = 0;
    return plan;
}

Plan adversarialPlan(unsigned seed, bool orthographic) {
    Plan plan = emptyPlan(seed % 3 == 0 ? 1 : 16, orthographic, 70, 33);
    World& world = plan.world;
    Random random(seed);
    const auto corner = [&](double x, double y, double z) {
        addVertex(world, x, y, z, random);
        return static_cast<std::uint32_t>(world.vertexDraw.size() - 1);
    };
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        addTriangle(world, a, b, c);
    };
    // Corners exactly on samples and pixel borders, collinear and coincident corners.
    const double pixel = 1 / plan.view.pixelsPerSlope;
    const auto onGrid = [&](double col, double row, double z) {
        const double reach = orthographic ? 1 : -z;
        return corner((col - 35) * pixel * reach, (16.5 - row) * pixel * reach, z);
    };
    triangle(onGrid(10, 5, -2), onGrid(20, 5, -2), onGrid(10, 15, -2));
    triangle(onGrid(20, 5, -2), onGrid(20, 15, -2), onGrid(10, 15, -2));
    triangle(onGrid(30.5, 5.5, -3), onGrid(40.5, 5.5, -3), onGrid(30.5, 15.5, -3));
    triangle(onGrid(1, 1, -2), onGrid(3, 3, -2), onGrid(5, 5, -2));
    const std::uint32_t point = onGrid(50, 10, -2);
    triangle(point, point, onGrid(52, 11, -2));
    // Through and behind the eye, huge, far away, slivers.
    triangle(corner(-1, -0.5, 1), corner(1, -0.5, 1), corner(0, -0.5, -1e6));
    triangle(corner(-1e6, -1, -1), corner(1e6, -1, -1), corner(0, 1e6, -2));
    triangle(corner(0.3, 0.2, 5), corner(-0.3, 0.2, 5), corner(0, 0.4, 3));
    triangle(corner(0.3, 0.2, -1e-9), corner(-3e-9, 0.2, -2e-9), corner(0, 4, -1e9));
    triangle(corner(-1e8, -1e7, -1e9), corner(1e8, -1e7, -1e9), corner(0, 1e8, -1e9));
    triangle(corner(-2, 0, -3), corner(2, 1e-8, -3), corner(2, 0, -3));
    triangle(corner(-2, 0.4, -3), corner(2, 0.4 + 1e-3, -3), corner(0, 0.4 + 2e-3, -3));
    // The same one twice: the lower number wins everywhere.
    const std::uint32_t a = corner(-0.8, 0.3, -4), b = corner(0.7, 0.1, -4), c = corner(0.1, 1.2, -4);
    triangle(a, b, c);
    triangle(a, b, c);
    triangle(c, b, a);
    // A fan around one corner that also reaches behind the eye.
    const std::uint32_t centre = corner(0.05, -0.1, -1.5);
    std::uint32_t last = corner(2, -0.1, 0.2);
    for (int k = 1; k <= 12; ++k) {
        const double angle = 2 * 3.141592653589793 * k / 12;
        const std::uint32_t next = corner(2 * std::cos(angle), -0.1 + 1.4 * std::sin(angle),
                                          -1.5 + 1.7 * std::cos(angle * 2 + seed));
        triangle(centre, last, next);
        last = next;
    }
    for (int t = 0; t < 40; ++t) {
        const double scale = std::pow(10, uniform(random, -9, 9));
        const std::uint32_t p = corner(uniform(random, -1, 1) * scale, uniform(random, -1, 1) * scale,
                                       uniform(random, -1, 0.3) * scale);
        const std::uint32_t q = corner(uniform(random, -1, 1) * scale, uniform(random, -1, 1) * scale,
                                       uniform(random, -1, 0.3) * scale);
        const std::uint32_t r = corner(uniform(random, -1, 1) * scale, uniform(random, -1, 1) * scale,
                                       uniform(random, -1, 0.3) * scale);
        triangle(p, q, r);
    }
    addShadows(plan);
    return plan;
}

Plan wallPlan(int samples) {
    Plan plan = emptyPlan(samples, true, 400, 40);
    Random random(5);
    for (const auto& [x, y] : {std::pair{-9.0, -1.0}, {9.0, -1.0}, {9.0, 1.5}, {-9.0, 1.5}})
        addVertex(plan.world, x, y, -3, random);
    addTriangle(plan.world, 0, 1, 2);
    addTriangle(plan.world, 0, 2, 3);
    return plan;
}

}  // namespace spectrad
