/* Lighting: the geometry factors g of every term of the term image, summed over a pixel's samples. No wavelength appears here. */
#include "blocks.h"
#include "surface.h"

#define INV_PI 0.31830988618379067f

/* Adds lanes to their pixels' sums: neighbours pairwise, so that the order of addition is the same everywhere. */
static inline void add_to(global float* sums, vfloat v) {
#if VW == 1
    *sums += v;
#elif SLOTS == 1
    vstore16(vload16(0, sums) + v, 0, sums);
#else
    const float8 v8 = v.even + v.odd;
#if SLOTS == 2
    vstore8(vload8(0, sums) + v8, 0, sums);
#else
    const float4 v4 = v8.even + v8.odd;
#if SLOTS == 4
    vstore4(vload4(0, sums) + v4, 0, sums);
#else
    const float2 v2 = v4.even + v4.odd;
#if SLOTS == 8
    vstore2(vload2(0, sums) + v2, 0, sums);
#else
    *sums += v2.x + v2.y;
#endif
#endif
#endif
#endif
}

#ifdef HAS_COAT
/* Both columns of an albedo table at cosines in 0..1, linear between entries. */
static void look_up(global const sd_albedo* table, vfloat cosine, vfloat* through, vfloat* missing) {
    const vfloat at = clamp(cosine, 0.0f, 1.0f) * (float)SD_TABLE_CELLS;
    const vint cell = min(V_INT(at), SD_TABLE_CELLS - 1);
    const vfloat t = at - V_FLOAT(cell);
    int cells[VW];
    float from_through[VW], to_through[VW], from_missing[VW], to_missing[VW];
    VSTORE(cell, cells);
    for (int i = 0; i < VW; ++i) {
        const sd_albedo from = table[cells[i]], to = table[cells[i] + 1];
        from_through[i] = from.through, to_through[i] = to.through;
        from_missing[i] = from.missing, to_missing[i] = to.missing;
    }
    *through = fma(t, VLOAD(to_through) - VLOAD(from_through), VLOAD(from_through));
    *missing = fma(t, VLOAD(to_missing) - VLOAD(from_missing), VLOAD(from_missing));
}

/* Unpolarized Fresnel reflectance of a dielectric of relative index n at cosine c; 1 beyond the critical angle. */
static vfloat fresnel(vfloat c, float n) {
    const vfloat square = fma(c, c, (vfloat)(n * n - 1.0f));
    const vfloat g = sqrt(fmax(square, 0.0f));
    const vfloat a = (g - c) / (g + c), b = fma(c, g + c, (vfloat)-1.0f) / fma(c, g - c, (vfloat)1.0f);
    return select(0.5f * a * a * fma(b, b, (vfloat)1.0f), (vfloat)1.0f, square < 0.0f);
}

/* BRDF of the coat, 1/sr: GGX (Walter et al. 2007) with height-correlated Smith shadowing (Heitz 2014), and what bounces more
 * than once between facets (Kulla & Conty 2017). 1 - (n.h)^2 is taken as |n x h|^2, which keeps its digits on smooth coats. */
static vfloat coat(sd_lobe lobe, surface s, v3 to_light, vfloat cos_light, vfloat missing_view, vfloat missing_light) {
    const v3 h = unit3(add3(to_light, s.view));
    const vfloat cos_half = dot3(s.normal, h), cos_diff = clamp(dot3(s.view, h), 0.0f, 1.0f);
    const v3 across = cross3(s.normal, h);
    const float a2 = lobe.alpha * lobe.alpha;
    const vfloat width = fma(cos_half * cos_half, (vfloat)a2, dot3(across, across));
    const vfloat shadow_view = cos_light * sqrt(fma(s.cos_view * s.cos_view, (vfloat)(1.0f - a2), (vfloat)a2));
    const vfloat shadow_light = s.cos_view * sqrt(fma(cos_light * cos_light, (vfloat)(1.0f - a2), (vfloat)a2));
    const vfloat facets = (a2 * INV_PI) / (width * width) * 0.5f / (shadow_view + shadow_light);
    return fma(facets, fresnel(cos_diff, lobe.ior), missing_view * missing_light * lobe.multiple);
}
#endif

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
        const v3 axis = {(vfloat)-light.axis_x, (vfloat)-light.axis_y, (vfloat)-light.axis_z};
        const vfloat t = clamp((dot3(axis, *to_light) - light.cos_outer) * light.inv_cos_range, 0.0f, 1.0f);
        strength = strength * (t * t * fma((vfloat)-2.0f, t, (vfloat)3.0f));
    }
#endif
    return select(strength, (vfloat)0.0f, square == 0.0f);
#else
    return 0.0f;
#endif
}

/* All lobes of a material under all lights, for the lanes of `mask`; sums: g of the material's first term at the lanes' first pixel. */
static void shade(sd_material material, global const sd_lobe* lobes, global const sd_albedo* tables, global const sd_light* lights,
                  uint light_count, surface s, vint mask, global float* sums) {
    for (uint l = 0; l < material.lobes; ++l) {
        const sd_lobe lobe = lobes[material.first_lobe + l];
        if (lobe.type == SD_LOBE_EMISSION) {
            add_to(sums + lobe.term * SD_BLOCK, select((vfloat)0.0f, (vfloat)1.0f, mask));
            continue;
        }
#ifdef HAS_COAT
        global const sd_albedo* table = tables + lobe.table;
        vfloat through_view = 1.0f, missing_view = 0.0f;
        if (lobe.type != SD_LOBE_DIFFUSE) look_up(table, s.cos_view, &through_view, &missing_view);
#endif
        for (uint k = 0; k < light_count; ++k) {
            const sd_light light = lights[k];
            vfloat g;
#ifdef HAS_AMBIENT
            if (light.type == SD_LIGHT_AMBIENT) {
                /* The group's spectrum is the irradiance pi L of the uniform radiance L. */
                g = light.scale;
#ifdef HAS_COAT
                if (lobe.type == SD_LOBE_COATED) g = light.scale * through_view * lobe.mean_through;
                if (lobe.type == SD_LOBE_COAT) g = light.scale * INV_PI * (1.0f - through_view);
#endif
                add_to(sums + (lobe.term + light.group) * SD_BLOCK, select((vfloat)0.0f, g, mask));
                continue;
            }
#endif
            v3 to_light;
            const vfloat strength = arriving(light, s.position, &to_light);
            const vfloat cos_light = dot3(s.normal, to_light);
            const vint lit = mask & (cos_light > 0.0f);
            if (!ANY(lit)) continue;
            g = strength * cos_light;
#ifdef HAS_COAT
            if (lobe.type != SD_LOBE_DIFFUSE) {
                vfloat through_light, missing_light;
                look_up(table, cos_light, &through_light, &missing_light);
                if (lobe.type == SD_LOBE_COATED) g = g * (through_view * through_light);
                if (lobe.type == SD_LOBE_COAT) {
                    if (lobe.alpha == 0.0f) continue; /* a mirror shows no point of light that has no size */
                    g = g * coat(lobe, s, to_light, cos_light, missing_view, missing_light);
                }
            }
#endif
            add_to(sums + (lobe.term + light.group) * SD_BLOCK, select((vfloat)0.0f, g, lit));
        }
    }
}

/* g: SD_BLOCK floats a term of each block, from block_first[block] on; the sum over samples divided by their number.
 * pattern_x, pattern_y: PATTERN lanes' offsets; pattern_used: -1 where a lane is a sample, 0 where it only fills the slots. */
BLOCK_GROUP kernel void light_block(global const ulong* keys, global const uint* index, global const float* camera,
                                    global const float* camera_normal, global const uint* triangle_material,
                                    global const sd_material* materials, global const sd_lobe* lobes,
                                    global const sd_albedo* tables, global const sd_light* lights, uint light_count,
                                    sd_frame frame, constant int* pattern_x, constant int* pattern_y, constant int* pattern_used,
                                    uint words, uint blocks, global const uint* sets, global const uint* block_first,
                                    global float* g) {
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
    uint seen_material = 0, seen_offset = 0;
    int known = 0;
    for (int lane = FIRST_LANE; lane < END_LANE; lane += VW) {
        const vuint id = V_UINT(VLOAD(lanes + lane) & 0xffffffffUL);
        uint ids[VW];
        VSTORE(id, ids);
        vint todo = VLOAD(pattern_used + lane % PATTERN);
        const int pixel = lane / SLOTS;
        const int x0 = (col + pixel) * SD_SUBPIXEL - frame.width * (SD_SUBPIXEL / 2);
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
                if (material.terms > 0) add_to(material_sums, select((vfloat)0.0f, (vfloat)1.0f, mask));
                continue;
            }
            const vfloat x = V_FLOAT(x0 + VLOAD(pattern_x + lane % PATTERN)), y = V_FLOAT(y0 + VLOAD(pattern_y + lane % PATTERN));
            const surface s = surface_at(index + 3 * (size_t)triangle, camera, camera_normal, frame, x, y);
            shade(material, lobes, tables, lights, light_count, s, mask, material_sums);
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
