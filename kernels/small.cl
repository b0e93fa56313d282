/* Coverage of small triangles, one work-item a triangle, by 64-bit atomic minima on the samples' keys; others are passed on. */
#include "raster.h"

/* Vectors of half the width where they still span what a small triangle does: fewer lines of the cache are touched. */
#if VW == 16 && SLOTS < 16
#define SMALL_LANES 8
typedef int8 sint;
typedef ulong8 sulong;
typedef float8 sfloat;
#define S_LOAD(p) vload8(0, p)
#define S_STORE(v, p) vstore8(v, 0, p)
#define S_FLOAT(v) convert_float8(v)
#define S_ULONG(v) convert_ulong8(v)
#define S_AS_UINT(v) as_uint8(v)
#define S_BITS(mask) bits8(convert_char8(mask))
#else
#define SMALL_LANES VW
typedef vint sint;
typedef vulong sulong;
typedef vfloat sfloat;
#define S_LOAD(p) VLOAD(p)
#define S_STORE(v, p) VSTORE(v, p)
#define S_FLOAT(v) V_FLOAT(v)
#define S_ULONG(v) V_ULONG(v)
#define S_AS_UINT(v) AS_UINT(v)
#define S_BITS(mask) LANE_BITS(mask)
#endif
/* Pixels of a vector, or 1 where a pixel takes several vectors. */
#define SMALL_STEP (SMALL_LANES > SLOTS ? SMALL_LANES / SLOTS : 1)

/* Triangles of a work-item: one on GPUs; on CPUs some, whose keys come from memory all at once while the first are set up. */
#if VW == 16
#define BATCH SD_BATCH
#else
#define BATCH 1
#endif
/* PREFETCH: the device's compiler is Clang as it stands; OpenCL's own prefetch() does nothing there. */
#ifdef PREFETCH
#define FETCH(p) __builtin_prefetch((const void*)(size_t)(p), 1)
#else
#define FETCH(p)
#endif

/* A triangle and the pixels that its samples lie in, within image and strip. */
typedef struct candidate {
    uint id;
    int row0, row1, col0, col1;
} candidate;

/* Fills `c` and returns 1 for a small triangle that may cover samples; large ones and those to be clipped go to their lists. */
static int look_at(uint id, global const uint* index, global const sd_vertex* screen, sd_frame frame, int least, int most,
                   global uint* large, global uint* clip, global uint* counters, candidate* c) {
    const sd_vertex v0 = screen[index[3 * id]], v1 = screen[index[3 * id + 1]], v2 = screen[index[3 * id + 2]];
    if (v0.outside | v1.outside | v2.outside) {
        if (!(v0.outside & v1.outside & v2.outside)) clip[atomic_inc(counters + 1)] = id;
        return 0;
    }
    const int top = min(v0.y, min(v1.y, v2.y)), bottom = max(v0.y, max(v1.y, v2.y));
    const int left = min(v0.x, min(v1.x, v2.x)), right = max(v0.x, max(v1.x, v2.x));
    const int half_w = frame.width * (SD_SUBPIXEL / 2), half_h = frame.height * (SD_SUBPIXEL / 2);
    /* Samples have offsets from `least` to `most`: most triangles of a fine mesh fall between them. */
    c->id = id;
    c->row0 = max(first_pixel(top - most + SD_SUBPIXEL - 1, half_h), frame.first_row);
    c->row1 = min(last_pixel(bottom - least, half_h), frame.first_row + frame.rows - 1);
    c->col0 = max(first_pixel(left - most + SD_SUBPIXEL - 1, half_w), 0);
    c->col1 = min(last_pixel(right - least, half_w), frame.width - 1);
    if ((c->row0 > c->row1) | (c->col0 > c->col1)) return 0;
    if ((right - left < SD_SMALL * SD_SUBPIXEL) & (bottom - top < SD_SMALL * SD_SUBPIXEL)) return 1;
    if ((long)(v1.x - v0.x) * (v2.y - v0.y) != (long)(v2.x - v0.x) * (v1.y - v0.y)) large[atomic_inc(counters)] = id;
    return 0;
}

/* keys: of the strip's first sample. */
static void cover(candidate c, global const uint* index, global const sd_vertex* screen, sd_frame frame, constant int* pattern_x,
                  constant int* pattern_y, global ulong* keys) {
    const sd_vertex v0 = screen[index[3 * c.id]];
    sd_vertex v1 = screen[index[3 * c.id + 1]];
    sd_vertex v2 = screen[index[3 * c.id + 2]];
    /* Differences are below 2^11 and positions of samples inside relative to vertex 0 as well: edge functions there stay below 2^24,
     * exact in float, and below 2^26 at all lanes. */
    const int area = (v1.x - v0.x) * (v2.y - v0.y) - (v2.x - v0.x) * (v1.y - v0.y);
    if (area == 0) return;
    if (area < 0) {
        const sd_vertex swap = v1;
        v1 = v2;
        v2 = swap;
    }
    const int a0 = v1.y - v2.y, b0 = v2.x - v1.x, a1 = v2.y - v0.y, b1 = v0.x - v2.x, a2 = v0.y - v1.y, b2 = v1.x - v0.x;
    const int c0 = -(a0 * (v1.x - v0.x) + b0 * (v1.y - v0.y));
    const int bias0 = edge_bias(a0, b0), bias1 = edge_bias(a1, b1), bias2 = edge_bias(a2, b2);
    const float inv_area = 1.0f / (float)abs(area);
    const float key_min = fmin(v0.depth_key, fmin(v1.depth_key, v2.depth_key));
    const float key_max = fmax(v0.depth_key, fmax(v1.depth_key, v2.depth_key));
    const uint turn = depth_turn(frame.orthographic);
    const size_t pitch = (size_t)frame.pitch * SLOTS;
    const int y = c.row0 * SD_SUBPIXEL - frame.height * (SD_SUBPIXEL / 2) - v0.y;
    for (int step = c.col0; step <= c.col1; step += SMALL_STEP) {
        /* A vector stays within its row: the last one starts earlier, and meets some samples twice. */
        const int col = min(step, frame.pitch - SMALL_STEP);
        const int x = col * SD_SUBPIXEL - frame.width * (SD_SUBPIXEL / 2) - v0.x;
        for (int part = 0; part < SMALL_STEP * SLOTS; part += SMALL_LANES) {
            const sint dx = x + S_LOAD(pattern_x + part), dy = y + S_LOAD(pattern_y + part);
            sint e0 = a0 * dx + b0 * dy + c0, e1 = a1 * dx + b1 * dy, e2 = a2 * dx + b2 * dy;
            global ulong* cells = keys + (c.row0 - frame.first_row) * pitch + col * SLOTS + part;
            for (int row = c.row0; row <= c.row1; ++row, cells += pitch) {
                /* Negative where outside: the sign bits say all. */
                const uint in = S_BITS(((e0 + bias0) | (e1 + bias1) | (e2 + bias2)) >= 0);
                if (in != 0) {
                    const sfloat sum = fma(S_FLOAT(e2), (sfloat)v2.depth_key,
                                           fma(S_FLOAT(e1), (sfloat)v1.depth_key, S_FLOAT(e0) * v0.depth_key));
                    const sfloat key = clamp(sum * inv_area, (sfloat)key_min, (sfloat)key_max);
                    const sulong word = (S_ULONG(S_AS_UINT(key) ^ turn) << 32) | (sulong)c.id;
                    /* Most candidates lose: a plain look first is nine times cheaper than an atomic. */
                    uint wins = in & S_BITS(word < S_LOAD(cells));
                    ulong words[SMALL_LANES];
                    S_STORE(word, words);
                    for (; wins != 0; wins &= wins - 1) {
                        const int lane = lowest_lane(wins);
                        atom_min(cells + lane, words[lane]);
                    }
                }
                e0 += b0 * SD_SUBPIXEL, e1 += b1 * SD_SUBPIXEL, e2 += b2 * SD_SUBPIXEL;
            }
        }
    }
}

/* One work-item BATCH triangles. keys: one a sample of the strip, [row][x][slot]. pattern_x, pattern_y: PATTERN offsets of lanes,
 * SD_SUBPIXEL-ths of a pixel from the vector's first pixel; a pixel's first and last sample have the least and the largest offset,
 * in x as in y. counters: [0] large triangles, [1] triangles to clip; their numbers go to `large` and `clip`. */
kernel void cover_small(global const uint* index, global const sd_vertex* screen, uint triangles, sd_frame frame,
                        constant int* pattern_x, constant int* pattern_y, global ulong* keys, global uint* large,
                        global uint* clip, global uint* counters) {
    const uint first = (uint)get_global_id(0) * BATCH;
    if (first >= triangles) return;
    const uint end = min(first + BATCH, triangles);
    const int least = pattern_x[0], most = pattern_x[frame.samples - 1];
    candidate found[BATCH];
    int count = 0;
    for (uint id = first; id < end; ++id) {
        if (!look_at(id, index, screen, frame, least, most, large, clip, counters, found + count)) continue;
        const candidate c = found[count++];
        for (int row = c.row0; row <= c.row1; ++row)
            FETCH(keys + ((size_t)(row - frame.first_row) * frame.pitch + c.col0) * SLOTS);
    }
    for (int i = 0; i < count; ++i) cover(found[i], index, screen, frame, pattern_x, pattern_y, keys);
}
