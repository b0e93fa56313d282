/* Reading textures: where lanes' points fall between texels, and the filtered values there. */
#include "surface.h"

#ifdef HAS_TEXTURE
/* The lanes of a mask, packed: textures are read lane by lane, and most lanes may see something else. */
typedef struct lane_list {
    int lane[VW];
    int count;
} lane_list;

static lane_list lanes_of(vint mask) {
    int used[VW];
    VSTORE(mask, used);
    lane_list list;
    list.count = 0;
    for (int i = 0; i < VW; ++i)
        if (used[i] != 0) list.lane[list.count++] = i;
    return list;
}

/* The four texels around each lane's point and the weights of the right and the lower ones. */
typedef struct texel_taps {
    ulong at[4][VW]; /* first float of the texels: upper left, upper right, lower left, lower right */
    vfloat right, down;
    float rights[VW], downs[VW]; /* the same, lane by lane */
    int single; /* nearest: the first alone */
} texel_taps;

#ifdef HAS_MIP
/* The level of the pyramid whose texels are as large as a sample's share of its pixel, and how far it is to the next. Between
 * powers of two the fraction is linear in the size, so no logarithm is needed. */
typedef struct mip_place {
    vint level;
    vfloat fraction;
} mip_place;

static mip_place mip_of(sd_texture t, surface s, float samples) {
    const float w = (float)t.width, h = (float)t.height;
    const vfloat ax = fma((vfloat)t.place[0], s.u_x, t.place[1] * s.v_x) * w, ay = fma((vfloat)t.place[3], s.u_x, t.place[4] * s.v_x) * h;
    const vfloat bx = fma((vfloat)t.place[0], s.u_y, t.place[1] * s.v_y) * w, by = fma((vfloat)t.place[3], s.u_y, t.place[4] * s.v_y) * h;
    const vfloat square = fmax(fma(ax, ax, ay * ay), fma(bx, bx, by * by)) / samples;
    const vint bits = AS_INT(fmin(fmax(sqrt(square), 1.0f), 1048576.0f));
    mip_place p;
    p.level = (bits >> 23) - 127;
    p.fraction = AS_FLOAT((bits & 0x7fffff) | 0x3f800000) - 1.0f;
    const vint last = p.level >= t.levels - 1;
    p.level = min(p.level, (vint)(t.levels - 1));
    p.fraction = select(p.fraction, (vfloat)0.0f, last);
    return p;
}
#endif

/* Taps in one level of the texture, a level for each lane; `level` 0 unless there is a pyramid. */
static void taps_at(sd_texture t, vint level, surface s, const lane_list* lanes, texel_taps* taps) {
    vfloat u = s.u, v = s.v;
#ifdef HAS_TEXTURE_PLACE
    u = fma((vfloat)t.place[0], s.u, fma((vfloat)t.place[1], s.v, (vfloat)t.place[2]));
    v = fma((vfloat)t.place[3], s.u, fma((vfloat)t.place[4], s.v, (vfloat)t.place[5]));
    if (t.wrap == SD_REPEAT) {
        u = u - floor(u);
        v = v - floor(v);
    }
#endif
    vint width = t.width, height = t.height;
    ulong first[VW];
    for (int i = 0; i < VW; ++i) first[i] = t.first;
#ifdef HAS_MIP
    if (t.levels > 1) {
        int levels[VW], widths[VW], heights[VW];
        VSTORE(level, levels);
        for (int i = 0; i < VW; ++i) widths[i] = t.width, heights[i] = t.height;
        for (int k = 0; k < lanes->count; ++k) {
            const int i = lanes->lane[k];
            for (int l = 0; l < levels[i]; ++l) {
                first[i] += (ulong)widths[i] * heights[i] * t.bands;
                widths[i] = max(widths[i] / 2, 1);
                heights[i] = max(heights[i] / 2, 1);
            }
        }
        width = VLOAD(widths);
        height = VLOAD(heights);
    }
#endif
    const vfloat x = clamp(u, 0.0f, 1.0f) * V_FLOAT(width), y = (1.0f - clamp(v, 0.0f, 1.0f)) * V_FLOAT(height);
    const vint last_column = width - 1, last_row = height - 1;
    vint column0, column1, row0, row1;
    taps->single = t.filter == SD_NEAREST;
    if (t.filter == SD_NEAREST) {
        column0 = column1 = clamp(V_INT(x), (vint)0, last_column);
        row0 = row1 = clamp(V_INT(y), (vint)0, last_row);
        taps->right = taps->down = 0.0f;
    } else {
        const vfloat left = floor(x - 0.5f), top = floor(y - 0.5f);
        taps->right = (x - 0.5f) - left;
        taps->down = (y - 0.5f) - top;
        column0 = V_INT(left), column1 = column0 + 1;
        row0 = V_INT(top), row1 = row0 + 1;
#ifdef HAS_TEXTURE_PLACE
        if (t.wrap == SD_REPEAT) {
            column0 = select(column0, last_column, column0 < 0);
            column1 = select(column1, (vint)0, column1 > last_column);
            row0 = select(row0, last_row, row0 < 0);
            row1 = select(row1, (vint)0, row1 > last_row);
        }
#endif
        column0 = clamp(column0, (vint)0, last_column);
        column1 = clamp(column1, (vint)0, last_column);
        row0 = clamp(row0, (vint)0, last_row);
        row1 = clamp(row1, (vint)0, last_row);
    }
    VSTORE(taps->right, taps->rights);
    VSTORE(taps->down, taps->downs);
    int w[VW], c0[VW], c1[VW], r0[VW], r1[VW];
    VSTORE(width, w);
    VSTORE(column0, c0);
    VSTORE(column1, c1);
    VSTORE(row0, r0);
    VSTORE(row1, r1);
    for (int k = 0; k < lanes->count; ++k) {
        const int i = lanes->lane[k];
        const ulong above = (ulong)r0[i] * w[i], below = (ulong)r1[i] * w[i];
        taps->at[0][i] = first[i] + (above + c0[i]) * t.bands;
        taps->at[1][i] = first[i] + (above + c1[i]) * t.bands;
        taps->at[2][i] = first[i] + (below + c0[i]) * t.bands;
        taps->at[3][i] = first[i] + (below + c1[i]) * t.bands;
    }
}

/* One band at the taps; lanes that are not listed are 0. */
static vfloat tapped(global const float* texels, const texel_taps* taps, const lane_list* lanes, int band) {
    float a[VW], b[VW], c[VW], d[VW];
    for (int i = 0; i < VW; ++i) a[i] = b[i] = c[i] = d[i] = 0.0f;
    for (int k = 0; k < lanes->count; ++k) {
        const int i = lanes->lane[k];
        a[i] = texels[taps->at[0][i] + band];
        if (taps->single) continue;
        b[i] = texels[taps->at[1][i] + band];
        c[i] = texels[taps->at[2][i] + band];
        d[i] = texels[taps->at[3][i] + band];
    }
    if (taps->single) return VLOAD(a);
    const vfloat above = fma(taps->right, VLOAD(b) - VLOAD(a), VLOAD(a)), below = fma(taps->right, VLOAD(d) - VLOAD(c), VLOAD(c));
    return fma(taps->down, below - above, above);
}

/* Bands from `band` on at the taps of one lane: VW neighbours in memory, which a texel of more bands has. */
static inline vfloat bands_at(global const float* texels, const texel_taps* taps, int lane, int band) {
    const vfloat a = VLOAD(texels + taps->at[0][lane] + band);
    if (taps->single) return a;
    const vfloat b = VLOAD(texels + taps->at[1][lane] + band), c = VLOAD(texels + taps->at[2][lane] + band),
                 d = VLOAD(texels + taps->at[3][lane] + band);
    const vfloat right = taps->rights[lane], above = fma(right, b - a, a), below = fma(right, d - c, c);
    return fma((vfloat)taps->downs[lane], below - above, above);
}

/* A texture where the lanes of a mask see it. */
typedef struct texture_view {
    lane_list lanes;
    texel_taps taps;
#ifdef HAS_MIP
    texel_taps coarser;
    vfloat fraction; /* of the way to the coarser level */
    float fractions[VW];
#endif
} texture_view;

static void look_at_texture(sd_texture t, surface s, vint mask, float samples, texture_view* view) {
    view->lanes = lanes_of(mask);
#ifdef HAS_MIP
    view->fraction = 0.0f;
    if (t.levels > 1) {
        const mip_place place = mip_of(t, s, samples);
        taps_at(t, place.level, s, &view->lanes, &view->taps);
        taps_at(t, min(place.level + 1, (vint)(t.levels - 1)), s, &view->lanes, &view->coarser);
        view->fraction = place.fraction;
        VSTORE(place.fraction, view->fractions);
        return;
    }
    view->coarser.single = -1;
#endif
    taps_at(t, 0, s, &view->lanes, &view->taps);
}

static inline vfloat texture_band(global const float* texels, const texture_view* view, int band) {
    const vfloat value = tapped(texels, &view->taps, &view->lanes, band);
#ifdef HAS_MIP
    if (view->coarser.single < 0) return value;
    return fma(view->fraction, tapped(texels, &view->coarser, &view->lanes, band) - value, value);
#else
    return value;
#endif
}

/* Bands from `band` on where one lane sees the texture. */
static inline vfloat texture_bands(global const float* texels, const texture_view* view, int lane, int band) {
    const vfloat value = bands_at(texels, &view->taps, lane, band);
#ifdef HAS_MIP
    if (view->coarser.single < 0) return value;
    return fma((vfloat)view->fractions[lane], bands_at(texels, &view->coarser, lane, band) - value, value);
#else
    return value;
#endif
}
#endif
