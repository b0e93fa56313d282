#include "kernels/twin.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace spectrad::twin {

namespace {

struct V {
    float x, y, z;
};
float dot(V a, V b) {
    return std::fma(a.z, b.z, std::fma(a.y, b.y, a.x * b.x));
}
V scaled(V a, float s) {
    return {a.x * s, a.y * s, a.z * s};
}
V crossed(V a, V b) {
    return {std::fma(a.y, b.z, -(a.z * b.y)), std::fma(a.z, b.x, -(a.x * b.z)),
            std::fma(a.x, b.y, -(a.y * b.x))};
}
V unit(V a) {
    const float square = dot(a, a);
    return scaled(a, 1.0f / std::sqrt(square == 0.0f ? 1.0f : square));
}

struct Surface {
    V position, normal, view;
    float cosView;
    float u, v;
};

float mixed(float b0, float v0, float b1, float v1, float b2, float v2) {
    return std::fma(b2, v2, std::fma(b1, v1, b0 * v0));
}

Surface surfaceAt(const World& world, const Vertices& vertices, const sd_frame& frame, std::uint32_t triangle,
                  float x, float y) {
    std::array<const float*, 3> p{}, n{};
    for (size_t k = 0; k < 3; ++k) {
        p[k] = vertices.camera.data() + 3 * size_t{world.index[3 * size_t{triangle} + k]};
        n[k] = vertices.normal.data() + 3 * size_t{world.index[3 * size_t{triangle} + k]};
    }
    const float rx = x * frame.slope_per_subpixel, ry = -(y * frame.slope_per_subpixel);
    std::array<float, 3> u{}, v{};
    for (size_t k = 0; k < 3; ++k) {
        u[k] = frame.orthographic ? p[k][0] - rx : std::fma(rx, p[k][2], p[k][0]);
        v[k] = frame.orthographic ? p[k][1] - ry : std::fma(ry, p[k][2], p[k][1]);
    }
    float b0 = std::fma(u[1], v[2], -(u[2] * v[1])), b1 = std::fma(u[2], v[0], -(u[0] * v[2])),
          b2 = std::fma(u[0], v[1], -(u[1] * v[0]));
    const float turn = std::copysign(1.0f, b0 + b1 + b2);
    b0 = std::fmax(b0 * turn, 0.0f), b1 = std::fmax(b1 * turn, 0.0f), b2 = std::fmax(b2 * turn, 0.0f);
    const float sum = b0 + b1 + b2;
    if (sum > 0) {
        const float inv = 1.0f / sum;
        b0 *= inv, b1 *= inv, b2 *= inv;
    } else {
        b0 = b1 = b2 = 1.0f / 3.0f;
    }
    Surface s{};
    s.position = {mixed(b0, p[0][0], b1, p[1][0], b2, p[2][0]), mixed(b0, p[0][1], b1, p[1][1], b2, p[2][1]),
                  mixed(b0, p[0][2], b1, p[1][2], b2, p[2][2])};
    V normal{mixed(b0, n[0][0], b1, n[1][0], b2, n[2][0]), mixed(b0, n[0][1], b1, n[1][1], b2, n[2][1]),
             mixed(b0, n[0][2], b1, n[1][2], b2, n[2][2])};
    s.view = frame.orthographic ? V{0, 0, 1} : unit({-s.position.x, -s.position.y, -s.position.z});
    const V e1{p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]},
        e2{p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]};
    const V face = crossed(e1, e2);
    const float seen = dot(face, s.view), along = dot(face, normal);
    normal = unit(normal);
    s.normal = scaled(normal, std::copysign(1.0f, seen) * std::copysign(1.0f, along));
    s.cosView = std::fmax(dot(s.normal, s.view), 1e-5f);
    if (!world.uv.empty()) {
        std::array<const float*, 3> t{};
        for (size_t k = 0; k < 3; ++k)
            t[k] = world.uv.data() + 2 * size_t{world.index[3 * size_t{triangle} + k]};
        s.u = mixed(b0, t[0][0], b1, t[1][0], b2, t[2][0]);
        s.v = mixed(b0, t[0][1], b1, t[1][1], b2, t[2][1]);
    }
    return s;
}

constexpr float inversePi = 0.31830988618379067f;

struct Cell {
    int cell;
    float t;
};
Cell cellOf(float cosine) {
    const float at = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * static_cast<float>(SD_CELLS);
    const int cell = std::min(static_cast<int>(at), SD_CELLS - 1);
    return {cell, at - static_cast<float>(cell)};
}
float lookUp(const sd_piece* table, Cell at) {
    const float* c = table[at.cell].c;
    return std::fma(at.t, std::fma(at.t, std::fma(at.t, c[3], c[2]), c[1]), c[0]);
}

float arriving(const sd_light& light, V position, V& toLight) {
    if (light.type == SD_LIGHT_DIRECTIONAL) {
        toLight = {light.x, light.y, light.z};
        return light.scale;
    }
    const V d{light.x - position.x, light.y - position.y, light.z - position.z};
    const float square = dot(d, d);
    const float inv = 1.0f / (square == 0.0f ? 1.0f : square);
    toLight = scaled(d, std::sqrt(inv));
    float strength = light.scale * inv;
    if (light.type == SD_LIGHT_SPOT) {
        const V axis{-light.axis_x, -light.axis_y, -light.axis_z};
        const float t = std::clamp((dot(axis, toLight) - light.cos_outer) * light.inv_cos_range, 0.0f, 1.0f);
        strength = strength * (t * t * std::fma(-2.0f, t, 3.0f));
    }
    return square == 0.0f ? 0.0f : strength;
}

/// One band of a texture at the surface's coordinates.
float texel(const World& world, const sd_texture& t, const Surface& s, int band) {
    const float x = std::clamp(s.u, 0.0f, 1.0f) * static_cast<float>(t.width),
                y = (1.0f - std::clamp(s.v, 0.0f, 1.0f)) * static_cast<float>(t.height);
    const auto at = [&](int column, int row) {
        return world
            .texels[t.first +
                    (static_cast<size_t>(std::clamp(row, 0, t.height - 1)) * static_cast<size_t>(t.width) +
                     static_cast<size_t>(std::clamp(column, 0, t.width - 1))) *
                        static_cast<size_t>(t.bands) +
                    static_cast<size_t>(band)];
    };
    if (t.filter == SD_NEAREST) return at(static_cast<int>(x), static_cast<int>(y));
    const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f), right = (x - 0.5f) - left,
                down = (y - 0.5f) - top;
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const float a = std::fma(right, at(column + 1, row) - at(column, row), at(column, row));
    const float b = std::fma(right, at(column + 1, row + 1) - at(column, row + 1), at(column, row + 1));
    return std::fma(down, b - a, a);
}

/// Calls add(call, term, g) for everything that lobes and lights add to one sample; `call` orders the
/// additions.
void shade(const Plan& plan, const sd_material& material, const Surface& s,
           const std::function<void(size_t, std::uint32_t, float)>& add) {
    const World& world = plan.world;
    const std::uint32_t groups = plan.groups;
    size_t call = 0;
    for (std::uint32_t l = 0; l < material.lobes; ++l) {
        const sd_lobe& lobe = world.lobes[material.first_lobe + l];
        if (lobe.type == SD_LOBE_EMISSION) {
            add(call++, lobe.term, 1.0f);
            continue;
        }
        const sd_piece* table = world.tables.data() + lobe.table;
        const Cell viewCell = cellOf(s.cosView);
        const float first = lobe.type == SD_LOBE_DIFFUSE ? 0.0f : lookUp(table, viewCell);
        constexpr size_t callsALight = 64;
        const auto paint = [&](size_t base, std::uint32_t term, float g) {
            if (lobe.texture == 0) {
                add(base, term, g);
                return;
            }
            const sd_texture& t = world.textures[lobe.texture - 1];
            for (int band = 0; band < t.bands; ++band)
                add(base + static_cast<size_t>(band), term + static_cast<std::uint32_t>(band) * groups,
                    g * texel(world, t, s, band));
        };
        for (const sd_light& light : world.lights) {
            const size_t base = call;
            call += callsALight;
            const std::uint32_t term = lobe.term + light.group;
            if (light.type == SD_LIGHT_AMBIENT || light.type == SD_LIGHT_SURROUNDINGS) {
                if (light.type == SD_LIGHT_SURROUNDINGS && !(lobe.type == SD_LOBE_FACETS && lobe.alpha == 0))
                    continue;
                if (lobe.type == SD_LOBE_DIFFUSE) paint(base, term, light.scale);
                if (lobe.type == SD_LOBE_ROUGH) {
                    add(base, term, light.scale * (1.0f - first));
                    add(base + 1, term + groups, light.scale * first);
                }
                if (lobe.type == SD_LOBE_COATED) paint(base, term, light.scale * first * lobe.mean_through);
                if (lobe.type == SD_LOBE_FACETS) {
                    for (std::uint32_t f = 0; f < lobe.functions; ++f)
                        add(base + f, term + f * groups,
                            light.scale * inversePi * lookUp(table + (1 + f) * SD_CELLS, viewCell));
                    if (lobe.multiple_to == lobe.functions)
                        add(base + lobe.functions, term + lobe.functions * groups,
                            light.scale * inversePi * first);
                }
                continue;
            }
            V toLight{};
            const float strength = arriving(light, s.position, toLight);
            const float cosLight = dot(s.normal, toLight);
            if (!(cosLight > 0)) continue;
            const float irradiance = strength * cosLight;
            if (lobe.type == SD_LOBE_DIFFUSE) paint(base, term, irradiance);
            if (lobe.type == SD_LOBE_COATED)
                paint(base, term, irradiance * (first * lookUp(table, cellOf(cosLight))));
            if (lobe.type == SD_LOBE_ROUGH) {
                const float beyond = std::fma(-cosLight, s.cosView, dot(toLight, s.view));
                const float divisor = beyond > 0 ? std::fmax(cosLight, s.cosView) : 1.0f;
                const float single = lobe.mean_through * std::fma(lobe.alpha, beyond / divisor, 1.0f);
                add(base, term, irradiance * single);
                add(base + 1, term + groups,
                    irradiance * (first * lookUp(table, cellOf(cosLight)) * lobe.multiple));
            }
            if (lobe.type == SD_LOBE_FACETS && lobe.alpha != 0) {
                const V h = unit({toLight.x + s.view.x, toLight.y + s.view.y, toLight.z + s.view.z});
                const float cosHalf = dot(s.normal, h), cosDiff = std::clamp(dot(s.view, h), 0.0f, 1.0f);
                const V across = crossed(s.normal, h);
                const float a2 = lobe.alpha * lobe.alpha;
                const float width = std::fma(cosHalf * cosHalf, a2, dot(across, across));
                const float shadowView = cosLight * std::sqrt(std::fma(s.cosView * s.cosView, 1.0f - a2, a2));
                const float shadowLight = s.cosView * std::sqrt(std::fma(cosLight * cosLight, 1.0f - a2, a2));
                const float shape =
                    (a2 * inversePi) / (width * width) * 0.5f / (shadowView + shadowLight) * irradiance;
                const float multiple = first * lookUp(table, cellOf(cosLight)) * lobe.multiple * irradiance;
                const Cell facing = cellOf(cosDiff);
                for (std::uint32_t f = 0; f < lobe.functions; ++f) {
                    float g = shape * lookUp(table + (1 + lobe.functions + f) * SD_CELLS, facing);
                    if (f == lobe.multiple_to) g += multiple;
                    add(base + f, term + f * groups, g);
                }
                if (lobe.multiple_to == lobe.functions)
                    add(base + lobe.functions, term + lobe.functions * groups, multiple);
            }
        }
    }
}

bool isTextured(const World& world, const sd_material& material, std::uint32_t term) {
    bool textured = false;
    for (std::uint32_t l = 0; l < material.lobes; ++l)
        if (world.lobes[material.first_lobe + l].term <= term)
            textured = world.lobes[material.first_lobe + l].texture != 0;
    return textured;
}

float pairwise(const std::vector<float>& v, size_t from, size_t count) {
    if (count == 1) return v[from];
    return pairwise(v, from, count / 2) + pairwise(v, from + count / 2, count / 2);
}

}  // namespace

Block light(const Plan& plan, const Vertices& vertices, const sd_frame& frame, const LanePattern& lanes,
            const std::vector<std::uint64_t>& keys, int row, int blockColumn, int vectorWidth) {
    const World& world = plan.world;
    const size_t slots = lanes.slotX.size();
    const std::uint64_t* cells = keys.data() + (static_cast<size_t>(row) * static_cast<size_t>(frame.pitch) +
                                                static_cast<size_t>(blockColumn) * SD_BLOCK) *
                                                   slots;
    std::set<std::uint32_t> materials;
    const auto materialOf = [&](std::uint64_t key) {
        const auto id = static_cast<std::uint32_t>(key);
        return id == 0xffffffffu ? 0u : world.triangleMaterial[id];
    };
    for (size_t i = 0; i < SD_BLOCK * slots; ++i)
        materials.insert(materialOf(cells[i]));
    Block block;
    std::vector<size_t> offset(world.materials.size());
    for (std::uint32_t m : materials) {
        offset[m] = block.term.size();
        for (std::uint32_t t = 0; t < world.materials[m].terms; ++t)
            block.term.push_back(world.materials[m].first_term + t);
    }
    block.g.assign(block.term.size() * SD_BLOCK, 0.0f);
    const auto lanesAtOnce = static_cast<size_t>(vectorWidth);
    const size_t group = std::min(slots, lanesAtOnce);  // lanes of one pixel that are added pairwise
    for (size_t lane = 0; lane < SD_BLOCK * slots; lane += group) {
        const size_t x = lane / slots;
        // As the kernel: triangle by triangle of the vector, in the order of their first lanes; g of lanes
        // that do not see it is 0.
        const size_t vectorStart = lane / lanesAtOnce * lanesAtOnce;
        std::vector<std::uint32_t> order;
        for (size_t i = vectorStart; i < vectorStart + lanesAtOnce; ++i) {
            const auto id = static_cast<std::uint32_t>(cells[i]);
            if (lanes.used[i % slots] && std::find(order.begin(), order.end(), id) == order.end())
                order.push_back(id);
        }
        for (std::uint32_t id : order) {
            const std::uint32_t m = id == 0xffffffffu ? 0 : world.triangleMaterial[id];
            const sd_material& material = world.materials[m];
            // Each add of the kernel, in its order; lanes left at zero where the sample sees another triangle
            // or no light.
            std::map<size_t, std::pair<std::uint32_t, std::vector<float>>> adds;
            for (size_t i = 0; i < group; ++i) {
                if (!lanes.used[(lane + i) % slots] || static_cast<std::uint32_t>(cells[lane + i]) != id)
                    continue;
                const auto add = [&](size_t call, std::uint32_t term, float g) {
                    auto& entry = adds.try_emplace(call, term, std::vector<float>(group, 0.0f)).first->second;
                    entry.second[i] = g;
                };
                if (id == 0xffffffffu) {
                    if (material.terms > 0) add(0, 0, 1.0f);
                    continue;
                }
                const size_t slot = (lane + i) % slots;
                const int sx = (blockColumn * SD_BLOCK + static_cast<int>(x)) * 256 - frame.width * 128 +
                               lanes.slotX[slot];
                const int sy = row * 256 - frame.height * 128 + lanes.slotY[slot];
                shade(plan, material,
                      surfaceAt(world, vertices, frame, id, static_cast<float>(sx), static_cast<float>(sy)),
                      add);
            }
            for (const auto& [call, entry] : adds) {
                float& sum = block.g[(offset[m] + entry.first) * SD_BLOCK + x];
                if (!isTextured(world, material, entry.first)) {
                    sum += pairwise(entry.second, 0, group);
                    continue;
                }
                for (float g : entry.second)
                    if (g != 0) sum += g;  // a texture's bands are added lane by lane
            }
        }
    }
    const float inverse = 1.0f / static_cast<float>(frame.samples);
    for (float& g : block.g)
        g *= inverse;
    return block;
}

std::vector<float> expand(const Block& block, const std::vector<float>& spectra, size_t bands) {
    std::vector<float> out(bands * SD_BLOCK, 0.0f);
    for (size_t band = 0; band < bands; ++band)
        for (size_t t = 0; t < block.term.size(); ++t)
            for (size_t x = 0; x < SD_BLOCK; ++x)
                out[band * SD_BLOCK + x] = std::fma(spectra[block.term[t] * bands + band],
                                                    block.g[t * SD_BLOCK + x], out[band * SD_BLOCK + x]);
    return out;
}

}  // namespace spectrad::twin
