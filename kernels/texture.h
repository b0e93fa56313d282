/* Adding to the sums of pixels: plain lanes, or lanes times the texels of a spectral texture. */
#include "texels.h"

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

#ifdef HAS_TEXTURE
/* What a lobe makes of a texel's reflectance rho: rho itself (inside 0), what a coat leaves of it, rho (1 - inside) / (1 - rho
 * inside), or that times the same with `second` (rho again where that is 0; nothing where it is negative). Between two of the
 * texture's wavelengths it is not linear, so it is taken at `steps` places of each interval, each with a term of its own. */
#ifdef HAS_TEXTURE_CURVE
static inline vfloat left_by(float inside, vfloat rho) { return rho * (1.0f - inside) / fma(-rho, (vfloat)inside, (vfloat)1.0f); }
#endif
static inline vfloat of_texel(float inside, float second, vfloat rho) {
#ifdef HAS_TEXTURE_CURVE
    if (inside != 0.0f) {
        const vfloat left = left_by(inside, rho);
        return second >= 0.0f ? left * left_by(second, rho) : left;
    }
#endif
    return rho;
}

/* The same for a texture of more than VW bands, whose texels are read as vectors of bands, lane after lane: a tenth of the loads. A
 * pixel's lanes add up one after another. */
static void add_wide(const texture_view* view, int bands, global const float* texels, vfloat g, uint groups, int steps, float inside,
                     float second, global float* sums) {
    const size_t next_term = (size_t)groups * SD_BLOCK;
    float weight[VW];
    VSTORE(g, weight);
    for (int from = 0, to; from < view->lanes.count; from = to) {
        const int pixel = view->lanes.lane[from] / SLOTS;
        for (to = from + 1; to < view->lanes.count && view->lanes.lane[to] / SLOTS == pixel; ++to) {}
        for (int k = 0; k < steps; ++k) {
            /* The last band ends the last interval. The last vector begins where it still fits. */
            const int count = k == 0 ? bands : bands - 1;
            for (int band = 0; band < count; band += VW) {
                const int start = min(band, count - VW);
                vfloat sum = 0.0f;
                for (int l = from; l < to; ++l) {
                    const int lane = view->lanes.lane[l];
                    vfloat rho = texture_bands(texels, view, lane, start);
                    if (k > 0) rho = fma((vfloat)((float)k / (float)steps), texture_bands(texels, view, lane, start + 1) - rho, rho);
                    sum = sum + weight[lane] * of_texel(inside, second, rho);
                }
                float one[VW];
                VSTORE(sum, one);
                for (int i = band - start; i < VW; ++i) sums[((size_t)(start + i) * steps + k) * next_term + pixel] += one[i];
            }
        }
    }
}

/* g times what the lobe makes of each band of its texture, to terms [band][step][light group] from `sums` on. */
static void add_textured(sd_texture t, global const float* texels, surface s, vfloat g, vint mask, float samples, uint groups,
                         int steps, float inside, float second, global float* sums) {
    texture_view view;
    look_at_texture(t, s, mask, samples, &view);
    if (t.bands > VW) {
        add_wide(&view, t.bands, texels, g, groups, steps, inside, second, sums);
        return;
    }
    const size_t next_term = (size_t)groups * SD_BLOCK;
    vfloat here = texture_band(texels, &view, 0);
    for (int band = 0; band < t.bands; ++band) {
        const vfloat next = band + 1 < t.bands ? texture_band(texels, &view, band + 1) : here;
        const int count = band + 1 < t.bands ? steps : 1;
        for (int k = 0; k < count; ++k, sums += next_term) {
            const vfloat rho = k == 0 ? here : fma((vfloat)((float)k / (float)steps), next - here, here);
            add_to(sums, select((vfloat)0.0f, g * of_texel(inside, second, rho), mask));
        }
        here = next;
    }
}
#endif
