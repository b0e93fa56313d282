/* Adding to the sums of pixels: plain lanes, or lanes times the texels of a spectral texture. */
#include "surface.h"

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
/* The four texels around a point and their weights; outside 0..1 the border goes on. */
typedef struct texel_taps {
    vint column0, column1, row0, row1;
    vfloat right, down; /* weight of column1, row1 */
} texel_taps;

static texel_taps taps_at(sd_texture t, vfloat u, vfloat v) {
    const vfloat x = clamp(u, 0.0f, 1.0f) * (float)t.width, y = (1.0f - clamp(v, 0.0f, 1.0f)) * (float)t.height;
    texel_taps taps;
    if (t.filter == SD_NEAREST) {
        taps.column0 = taps.column1 = min(V_INT(x), (vint)(t.width - 1));
        taps.row0 = taps.row1 = min(V_INT(y), (vint)(t.height - 1));
        taps.right = taps.down = 0.0f;
        return taps;
    }
    const vfloat left = floor(x - 0.5f), top = floor(y - 0.5f);
    taps.right = (x - 0.5f) - left;
    taps.down = (y - 0.5f) - top;
    const vint last_column = t.width - 1, last_row = t.height - 1;
    taps.column0 = clamp(V_INT(left), (vint)0, last_column);
    taps.column1 = clamp(V_INT(left) + 1, (vint)0, last_column);
    taps.row0 = clamp(V_INT(top), (vint)0, last_row);
    taps.row1 = clamp(V_INT(top) + 1, (vint)0, last_row);
    return taps;
}

/* g times each band of the texture, lane by lane: bands lie together in memory, lanes do not. sums: the lobe's first term. */
static void add_textured(global const sd_texture* texture, global const float* texels, surface s, vfloat g, vint mask, uint groups,
                         global float* sums) {
    const sd_texture t = *texture;
    const texel_taps taps = taps_at(t, s.u, s.v);
    int used[VW], column0[VW], column1[VW], row0[VW], row1[VW];
    float lane_g[VW], right[VW], down[VW];
    VSTORE(mask, used);
    VSTORE(taps.column0, column0);
    VSTORE(taps.column1, column1);
    VSTORE(taps.row0, row0);
    VSTORE(taps.row1, row1);
    VSTORE(g, lane_g);
    VSTORE(taps.right, right);
    VSTORE(taps.down, down);
    for (int i = 0; i < VW; ++i) {
        if (used[i] == 0) continue;
        global const float* above = texels + t.first + (size_t)row0[i] * t.width * t.bands;
        global const float* below = texels + t.first + (size_t)row1[i] * t.width * t.bands;
        const size_t from = (size_t)column0[i] * t.bands, to = (size_t)column1[i] * t.bands;
        global float* pixel = sums + i / SLOTS;
        for (int band = 0; band < t.bands; ++band) {
            const float a = fma(right[i], above[to + band] - above[from + band], above[from + band]);
            const float b = fma(right[i], below[to + band] - below[from + band], below[from + band]);
            pixel[(size_t)band * groups * SD_BLOCK] += lane_g[i] * fma(down[i], b - a, a);
        }
    }
}
#endif

