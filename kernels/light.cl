/* Lighting: the geometry factors g of every term of the term image, summed over a pixel's samples. No wavelength appears here. */
#include "blocks.h"
#include "mapping.h"
#include "relief.h"
#include "shadow.h"

/* Irradiance at normal incidence per unit of the group's spectrum, and where it comes from. */
static vfloat arriving(sd_light light, v3 position, v3* to_light) {
#ifdef HAS_DIRECTIONAL
    if (light.type == SD_LIGHT_DIRECTIONAL) {
        to_light->x = light.x, to_light->y = light.y, to_light->z = light.z;
        return light.scale;
    }
#endif
#if defined(HAS_POINT) || defined(HAS_SPOT)
    v3 d;
    d.x = light.x - position.x, d.y = light.y - position.y, d.z = light.z - position.z;
    const vfloat square = dot3(d, d);
    const vfloat inv = 1.0f / select(square, (vfloat)1.0f, square == 0.0f);
    *to_light = scale3(d, sqrt(inv));
    vfloat strength = light.scale * inv;
#ifdef HAS_SPOT
    if (light.type == SD_LIGHT_SPOT) {
        /* From the axis to the light's way, which is -to_light. */
        const v3 apart = {light.axis_x + to_light->x, light.axis_y + to_light->y, light.axis_z + to_light->z};
        const vfloat t = clamp((light.chord_outer - dot3(apart, apart)) * light.inv_chord_range, 0.0f, 1.0f);
        strength = strength * (t * t * fma((vfloat)-2.0f, t, (vfloat)3.0f));
    }
#endif
    return select(strength, (vfloat)0.0f, square == 0.0f);
#else
    return 0.0f;
#endif
}

/* The g of one lobe under one light: added to the terms [function][group] of the lobe at `sums`. */
static void shade_light(sd_lobe lobe, global const sd_piece* tables, sd_light light, uint groups, surface s, vint mask,
                        lobe_view at_view, paint p, global float* sums) {
    global float* term = sums + (lobe.term + light.group) * SD_BLOCK;
#ifdef HAS_UNIFORM
    if (light.type == SD_LIGHT_AMBIENT || light.type == SD_LIGHT_SURROUNDINGS) {
        /* The group's spectrum is the irradiance pi L of the uniform radiance L. */
        if (light.type == SD_LIGHT_SURROUNDINGS && !(lobe.type == SD_LOBE_FACETS && lobe.alpha == 0.0f)) return;
        uniform_light(lobe, tables, light.scale, groups, at_view, s, mask, p, term);
        return;
    }
#endif
    v3 to_light;
    const vfloat strength = arriving(light, s.position, &to_light);
    const vfloat cos_light = dot3(s.normal, to_light);
#ifdef HAS_RELIEF
    const vint lit = mask & (cos_light > 0.0f) & (dot3(s.horizon, to_light) > 0.0f);
#else
    const vint lit = mask & (cos_light > 0.0f);
#endif
    if (!ANY(lit)) return;
    const vfloat irradiance = strength * cos_light;
    switch (lobe.type) {
        case SD_LOBE_DIFFUSE: add_painted(lobe, p, s, irradiance, lit, groups, term); break;
#ifdef HAS_ROUGH
        case SD_LOBE_ROUGH: rough(lobe, tables, s, to_light, cos_light, irradiance, groups, at_view, lit, p, term); break;
#endif
#ifdef HAS_ROUGH_COATED
        case SD_LOBE_ROUGH_COATED:
            rough_coated(lobe, tables, s, to_light, cos_light, irradiance, groups, at_view, lit, p, term);
            break;
#endif
#ifdef HAS_COATED
        case SD_LOBE_COATED: {
            const vfloat through = at_view.first * first_at(lobe, tables + lobe.table_light, s, to_light, cos_light);
            add_painted(lobe, p, s, irradiance * through, lit, groups, term);
            break;
        }
#endif
#ifdef HAS_FACETS
        case SD_LOBE_FACETS: facets(lobe, tables, s, to_light, cos_light, irradiance, groups, at_view, lit, term); break;
#endif
        default: break;
    }
}

#ifdef HAS_SHADOWS
#define REACHED_ARGUMENT , const vuint* reached
#define REACHED , reached
/* Lanes of `mask` that light k reaches: a bit a light. */
#define LIT(mask, k) ((mask) & ((reached[(k) >> 5] >> ((k)&31) & 1u) != 0))

/* Places that look for their lights: of each lane what it sees of its own triangle. */
typedef struct seekers {
    v3 position, normal, lifted;
    vint found;
} seekers;

static inline v3 choose3(v3 a, v3 b, vint second) {
    const v3 r = {select(a.x, b.x, second), select(a.y, b.y, second), select(a.z, b.z, second)};
    return r;
}

/* Which lights reach the lanes: turned towards them, and nothing between. Lanes of many triangles ask together. */
static void seek(seekers at, global const sd_light* lights, uint light_count, caster_tree tree, vuint* reached) {
    for (uint w = 0; w < SHADOW_WORDS; ++w) reached[w] = 0;
    for (uint k = 0; k < light_count; ++k) {
        const sd_light light = lights[k];
        vint open = at.found;
        if (light.shadows) {
            v3 to_light;
            const vfloat strength = arriving(light, at.position, &to_light);
            open &= (strength > 0.0f) & (dot3(at.normal, to_light) > 0.0f);
            if (ANY(open)) open = unhidden(tree, light, at.lifted, open);
        }
        reached[k >> 5] |= select((vuint)0, (vuint)(1u << (k & 31)), open);
    }
}
#else
#define REACHED_ARGUMENT
#define REACHED
#define LIT(mask, k) (mask)
#endif

/* All lobes of a material under all lights, for the lanes of `mask`; sums: g of the material's first term at the lanes' first pixel. */
static void shade(sd_material material, global const sd_lobe* lobes, global const sd_piece* tables, global const sd_light* lights,
                  uint light_count, uint groups, surface s, sd_frame frame, vfloat x, vfloat y, vint mask, paint p,
                  global float* sums REACHED_ARGUMENT) {
    for (uint l = 0; l < material.lobes; ++l) {
        const sd_lobe lobe = lobes[material.first_lobe + l];
        if (lobe.type == SD_LOBE_EMISSION) {
            /* A texture's radiances come one a band, as if of one group. */
            add_painted(lobe, p, s, 1.0f, mask, 1, sums + lobe.term * SD_BLOCK);
            continue;
        }
#ifdef HAS_MAPPING
        if (lobe.type == SD_LOBE_REFLECTION) {
            reflection(lobe, tables, frame, s, mask, p, x, y, sums + lobe.term * SD_BLOCK);
            continue;
        }
#endif
        const lobe_view at_view = view_of(lobe, tables, s);
        for (uint k = 0; k < light_count; ++k) shade_light(lobe, tables, lights[k], groups, s, LIT(mask, k), at_view, p, sums);
    }
}

/* g: SD_BLOCK floats a term of each block, from block_first[block] on; the sum over samples divided by their number.
 * pattern_x, pattern_y: PATTERN lanes' offsets; pattern_used: -1 where a lane is a sample, 0 where it only fills the slots. */
BLOCK_GROUP kernel void light_block(global const ulong* keys, global const uint* index, global const float* camera,
                                    global const float* camera_normal, global const float* coordinates, global const float* tangents,
                                    global const uint* triangle_material,
                                    global const sd_material* materials, global const sd_lobe* lobes,
                                    global const sd_piece* tables, global const sd_light* lights, uint light_count,
                                    uint groups, global const sd_texture* textures, global const float* texels, sd_frame frame,
                                    constant int* pattern_x, constant int* pattern_y, constant int* pattern_used,
                                    uint words, uint blocks, global const uint* sets, global const uint* block_first,
                                    global float* g
#ifdef HAS_SHADOWS
                                    , global const uint* casters, uint caster_count, uint leaves, global const float* bounds
#endif
) {
    const uint block = BLOCK_ID;
    if (block >= blocks) return;
    const uint first = block_first[block], end = block_first[block + 1];
    global float* sums = g + (size_t)first * SD_BLOCK;
    for (uint t = 0; t < end - first; ++t)
        for (int x = FIRST_PIXEL; x < (VW == 1 ? FIRST_PIXEL + 1 : SD_BLOCK); x += VW) VSTORE((vfloat)0.0f, sums + t * SD_BLOCK + x);

    const int blocks_x = frame.pitch / SD_BLOCK;
    const int row = (int)(block / (uint)blocks_x), col = (int)(block % (uint)blocks_x) * SD_BLOCK;
    const int y0 = (row + frame.first_row) * SD_SUBPIXEL - frame.height * (SD_SUBPIXEL / 2);
    global const ulong* lanes = keys + (size_t)block * SD_BLOCK * SLOTS;
    const paint p = {textures, texels, (float)frame.samples};
#ifdef HAS_SHADOWS
    const caster_tree tree = {index, camera, casters, bounds, caster_count, leaves};
#endif
    uint seen_material = 0, seen_offset = 0;
    int known = 0;
    for (int lane = FIRST_LANE; lane < END_LANE; lane += VW) {
        const vuint id = V_UINT(VLOAD(lanes + lane) & 0xffffffffUL);
        uint ids[VW];
        VSTORE(id, ids);
        vint todo = VLOAD(pattern_used + lane % PATTERN);
        const int pixel = lane / SLOTS;
        const int x0 = (col + pixel) * SD_SUBPIXEL - frame.width * (SD_SUBPIXEL / 2);
        const vfloat x = V_FLOAT(x0 + VLOAD(pattern_x + lane % PATTERN)), y = V_FLOAT(y0 + VLOAD(pattern_y + lane % PATTERN));
#ifdef HAS_SHADOWS
        seekers at;
        at.position = at.normal = at.lifted = (v3){(vfloat)0.0f, (vfloat)0.0f, (vfloat)0.0f};
        at.found = 0;
        vint waiting = todo & (id != NO_TRIANGLE);
        for (int i = 0; i < VW && ANY(waiting); ++i) {
            const uint triangle = ids[i];
            const vint mask = waiting & (id == triangle ? (vint)-1 : (vint)0);
            if (!ANY(mask)) continue;
            waiting &= ~mask;
            surface s = surface_at(index + 3 * (size_t)triangle, camera, camera_normal, coordinates, tangents, frame, x, y);
#ifdef HAS_RELIEF
            const uint relief = materials[material_of(triangle, triangle_material)].relief;
            if (relief != 0) bend(&s, index + 3 * (size_t)triangle, camera, coordinates, p, relief, mask);
#endif
            at.position = choose3(at.position, s.position, mask);
            at.normal = choose3(at.normal, s.normal, mask);
            at.lifted = choose3(at.lifted, s.lifted, mask);
            at.found |= mask;
        }
        vuint reached[SHADOW_WORDS];
        seek(at, lights, light_count, tree, reached);
#endif
        for (int i = 0; i < VW && ANY(todo); ++i) {
            const uint triangle = ids[i];
            const vint mask = todo & (id == triangle ? (vint)-1 : (vint)0);
            if (!ANY(mask)) continue; /* its samples are done, or it only fills a slot */
            todo &= ~mask;
            const uint m = material_of(triangle, triangle_material);
            const sd_material material = materials[m];
            if (!known || m != seen_material) {
                /* Where the material's terms start: after those of the block's materials with lower numbers. */
                seen_offset = 0;
                for (uint w = 0; w <= m >> 5; ++w) {
                    uint bits = sets[(size_t)block * words + w];
                    if (w == m >> 5) bits &= (1u << (m & 31)) - 1;
                    for (; bits != 0; bits &= bits - 1) seen_offset += materials[w * 32 + 31 - clz(bits & -bits)].terms;
                }
                seen_material = m;
                known = 1;
            }
            global float* material_sums = sums + seen_offset * SD_BLOCK + pixel;
            if (triangle == NO_TRIANGLE) {
#ifdef HAS_MAPPING
                if (material.terms > 0 && lobes[material.first_lobe].texture != 0) {
                    backdrop(lobes[material.first_lobe], frame, mask, p, x, y, material_sums);
                    continue;
                }
#endif
                if (material.terms > 0) add_to(material_sums, select((vfloat)0.0f, (vfloat)1.0f, mask));
                continue;
            }
            surface s = surface_at(index + 3 * (size_t)triangle, camera, camera_normal, coordinates, tangents, frame, x, y);
#ifdef HAS_RELIEF
            if (material.relief != 0) bend(&s, index + 3 * (size_t)triangle, camera, coordinates, p, material.relief, mask);
#endif
            shade(material, lobes, tables, lights, light_count, groups, s, frame, x, y, mask, p, material_sums REACHED);
        }
    }
    const float inv_samples = 1.0f / (float)frame.samples;
    for (uint t = 0; t < end - first; ++t) {
        for (int x = FIRST_PIXEL; x < (VW == 1 ? FIRST_PIXEL + 1 : SD_BLOCK); x += VW) {
            global float* cell = sums + t * SD_BLOCK + x;
            VSTORE(VLOAD(cell) * inv_samples, cell);
        }
    }
}
