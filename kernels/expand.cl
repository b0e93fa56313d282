/* Expansion: L(x, wavelength) = sum over terms of g(x) c(wavelength), from the term image into rows laid out [row][band][x].
 * The whole image passes through here, so it runs at the speed of memory: a block's g stay in registers (or the first-level
 * cache), bands go out one after another, past the cache where the device can. */
#include "blocks.h"

#if VW == 16
#if defined(__has_builtin)
#if __has_builtin(__builtin_nontemporal_store)
#define STREAM(v, p) __builtin_nontemporal_store(v, (global float16*)(p))
#endif
#endif
#ifndef STREAM
#define STREAM(v, p) vstore16(v, 0, p)
#endif

/* With a constant number of terms the compiler unrolls and keeps all g in registers. */
static inline void expand_terms(const uint terms, global const float* g, global const uint* term, global const float* spectra,
                                uint bands, size_t pitch, global float* out) {
    for (uint band = 0; band < bands; ++band) {
        float16 a = 0.0f, b = 0.0f, c = 0.0f, d = 0.0f;
        for (uint t = 0; t < terms; ++t) {
            const float s = spectra[(size_t)term[t] * bands + band];
            a = fma((float16)s, vload16(0, g + t * SD_BLOCK), a);
            b = fma((float16)s, vload16(1, g + t * SD_BLOCK), b);
            c = fma((float16)s, vload16(2, g + t * SD_BLOCK), c);
            d = fma((float16)s, vload16(3, g + t * SD_BLOCK), d);
        }
        global float* p = out + band * pitch;
        STREAM(a, p);
        STREAM(b, p + 16);
        STREAM(c, p + 32);
        STREAM(d, p + 48);
    }
}

/* Many terms, of which a band needs few: those whose span leaves the band out are passed over. */
static void expand_many(const uint terms, global const float* g, global const uint* term, global const float* spectra,
                        global const uint* spans, uint bands, size_t pitch, global float* out) {
    for (uint band = 0; band < bands; ++band) {
        float16 a = 0.0f, b = 0.0f, c = 0.0f, d = 0.0f;
        for (uint t = 0; t < terms; ++t) {
            if (band < spans[2 * term[t]] || band >= spans[2 * term[t] + 1]) continue;
            const float s = spectra[(size_t)term[t] * bands + band];
            a = fma((float16)s, vload16(0, g + t * SD_BLOCK), a);
            b = fma((float16)s, vload16(1, g + t * SD_BLOCK), b);
            c = fma((float16)s, vload16(2, g + t * SD_BLOCK), c);
            d = fma((float16)s, vload16(3, g + t * SD_BLOCK), d);
        }
        global float* p = out + band * pitch;
        STREAM(a, p);
        STREAM(b, p + 16);
        STREAM(c, p + 32);
        STREAM(d, p + 48);
    }
}
#endif

/* spectra: `bands` floats a term; spans: first band and end of the bands in which a term is not zero (texture terms have three or
 * so); out: rows from the block first_block on. */
BLOCK_GROUP kernel void expand(global const float* g, global const uint* block_first, global const uint* block_term,
                               global const float* spectra, global const uint* spans, uint bands, sd_frame frame,
                               uint first_block, uint blocks, global float* out) {
    if (BLOCK_ID >= blocks) return;
    const uint block = first_block + BLOCK_ID;
    const uint first = block_first[block], terms = block_first[block + 1] - first;
    const uint blocks_x = (uint)frame.pitch / SD_BLOCK;
    const size_t pitch = (size_t)frame.pitch;
    out += (BLOCK_ID / blocks_x) * bands * pitch + (BLOCK_ID % blocks_x) * SD_BLOCK + FIRST_PIXEL;
    global const uint* term = block_term + first;
    g += (size_t)first * SD_BLOCK + FIRST_PIXEL;
#if VW == 16
    switch (terms) {
        case 1: expand_terms(1, g, term, spectra, bands, pitch, out); break;
        case 2: expand_terms(2, g, term, spectra, bands, pitch, out); break;
        case 3: expand_terms(3, g, term, spectra, bands, pitch, out); break;
        case 4: expand_terms(4, g, term, spectra, bands, pitch, out); break;
        default: expand_many(terms, g, term, spectra, spans, bands, pitch, out);
    }
#else
    for (uint band = 0; band < bands; ++band) {
        float sum = 0.0f;
        for (uint t = 0; t < terms; ++t)
            if (band >= spans[2 * term[t]] && band < spans[2 * term[t] + 1])
                sum = fma(spectra[(size_t)term[t] * bands + band], g[t * SD_BLOCK], sum);
        out[band * pitch] = sum;
    }
#endif
}
