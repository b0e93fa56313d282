/* What a screen shows: the terms' colours summed as in expand(), taken to the display's linear signals by a matrix, and encoded in
 * 8 bits by thresholds, so that the code is exactly that of the signal. Three floats a term, whatever the number of bands. */
#include "blocks.h"

/* Signals this far outside 0..1 are out of the display's gamut: a thirtieth of a code at mid-grey. */
#define GAMUT_TOLERANCE 1e-4f

static inline uint encoded(float signal, global const float* threshold, global const uchar* code_start) {
    if (!(signal > 0.0f)) return 0;
    if (signal >= 1.0f) return 255;
    uint code = code_start[(uint)(signal * SD_SHOW_CELLS)];
    while (code < 255 && signal >= threshold[code])
        ++code;
    return code;
}

static inline vfloat signal_of(const float a, const float b, const float c, vfloat x, vfloat y, vfloat z) {
    return fma((vfloat)c, z, fma((vfloat)b, y, (vfloat)a * x));
}

/* 0xAABBGGRR; A is 255, and 254 where the colour lies outside the display's gamut. */
static inline uint pixel_of(float r, float g, float b, global const float* threshold, global const uchar* code_start) {
    const float low = fmin(r, fmin(g, b)), high = fmax(r, fmax(g, b));
    const uint alpha = low < -GAMUT_TOLERANCE || high > 1.0f + GAMUT_TOLERANCE ? 254u : 255u;
    return alpha << 24 | encoded(b, threshold, code_start) << 16 | encoded(g, threshold, code_start) << 8 |
           encoded(r, threshold, code_start);
}

/* colours: three floats a term, [term][3]; out: [row][pitch]. */
BLOCK_GROUP kernel void show(global const float* g, global const uint* block_first, global const uint* block_term,
                             global const float* colours, sd_show matrix, global const float* threshold,
                             global const uchar* code_start, uint blocks, global uint* out) {
    if (BLOCK_ID >= blocks) return;
    const uint first = block_first[BLOCK_ID], terms = block_first[BLOCK_ID + 1] - first;
    global const uint* term = block_term + first;
    g += (size_t)first * SD_BLOCK;
    out += (size_t)BLOCK_ID * SD_BLOCK;
    const float* m = matrix.to_signal;
#if VW == 1
    const int end = FIRST_PIXEL + 1;
#else
    const int end = SD_BLOCK;
#endif
    for (int pixel = FIRST_PIXEL; pixel < end; pixel += VW) {
        vfloat x = 0.0f, y = 0.0f, z = 0.0f;
        for (uint t = 0; t < terms; ++t) {
            global const float* colour = colours + (size_t)term[t] * 3;
            const vfloat factor = VLOAD(g + t * SD_BLOCK + pixel);
            x = fma((vfloat)colour[0], factor, x);
            y = fma((vfloat)colour[1], factor, y);
            z = fma((vfloat)colour[2], factor, z);
        }
        const vfloat red = signal_of(m[0], m[1], m[2], x, y, z);
        const vfloat green = signal_of(m[3], m[4], m[5], x, y, z);
        const vfloat blue = signal_of(m[6], m[7], m[8], x, y, z);
#if VW == 1
        out[pixel] = pixel_of(red, green, blue, threshold, code_start);
#else
        float r[VW], s[VW], b[VW];
        VSTORE(red, r);
        VSTORE(green, s);
        VSTORE(blue, b);
        for (int lane = 0; lane < VW; ++lane)
            out[pixel + lane] = pixel_of(r[lane], s[lane], b[lane], threshold, code_start);
#endif
    }
}
