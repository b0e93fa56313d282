/* Coverage of small triangles, one work-item a triangle, by 64-bit atomic minima on the samples' keys; others are passed on. */
#include "raster.h"

#if SLOTS >= 16
#define LANES 16
typedef int16 sint;
typedef float16 sfloat;
#define S_LOAD(p) vload16(0, p)
#define S_STORE(v, p) vstore16(v, 0, p)
#define S_FLOAT(v) convert_float16(v)
#elif SLOTS == 8
#define LANES 8
typedef int8 sint;
typedef float8 sfloat;
#define S_LOAD(p) vload8(0, p)
#define S_STORE(v, p) vstore8(v, 0, p)
#define S_FLOAT(v) convert_float8(v)
#elif SLOTS == 4
#define LANES 4
typedef int4 sint;
typedef float4 sfloat;
#define S_LOAD(p) vload4(0, p)
#define S_STORE(v, p) vstore4(v, 0, p)
#define S_FLOAT(v) convert_float4(v)
#elif SLOTS == 2
#define LANES 2
typedef int2 sint;
typedef float2 sfloat;
#define S_LOAD(p) vload2(0, p)
#define S_STORE(v, p) vstore2(v, 0, p)
#define S_FLOAT(v) convert_float2(v)
#else
#define LANES 1
typedef int sint;
typedef float sfloat;
#define S_LOAD(p) (*(p))
#define S_STORE(v, p) (*(p) = (v))
#define S_FLOAT(v) convert_float(v)
#endif

/* keys: one a sample of the strip, [row][x][slot]. sample_x, sample_y: SLOTS offsets in a pixel, 0..255.
 * counters: [0] large triangles, [1] triangles to clip; their numbers go to `large` and `clip`. */
kernel void cover_small(global const uint* index, global const sd_vertex* screen, uint triangles, sd_frame frame,
                        constant int* sample_x, constant int* sample_y, global ulong* keys, global uint* large,
                        global uint* clip, global uint* counters) {
    const uint id = (uint)get_global_id(0);
    if (id >= triangles) return;
    const sd_vertex v0 = screen[index[3 * id]];
    sd_vertex v1 = screen[index[3 * id + 1]];
    sd_vertex v2 = screen[index[3 * id + 2]];
    if (v0.outside & v1.outside & v2.outside) return;
    if (v0.outside | v1.outside | v2.outside) {
        clip[atomic_inc(counters + 1)] = id;
        return;
    }
    const int top = min(v0.y, min(v1.y, v2.y)), bottom = max(v0.y, max(v1.y, v2.y));
    const int half_w = frame.width * (SD_SUBPIXEL / 2), half_h = frame.height * (SD_SUBPIXEL / 2);
    const int row0 = max(first_pixel(top, half_h), frame.first_row);
    const int row1 = min(last_pixel(bottom, half_h), frame.first_row + frame.rows - 1);
    if (row0 > row1) return;
    const int left = min(v0.x, min(v1.x, v2.x)), right = max(v0.x, max(v1.x, v2.x));
    const int col0 = max(first_pixel(left, half_w), 0), col1 = min(last_pixel(right, half_w), frame.width - 1);
    if (col0 > col1) return;
    const long area = (long)(v1.x - v0.x) * (v2.y - v0.y) - (long)(v2.x - v0.x) * (v1.y - v0.y);
    if (area == 0) return;
    if (right - left >= SD_SMALL * SD_SUBPIXEL || bottom - top >= SD_SMALL * SD_SUBPIXEL) {
        large[atomic_inc(counters)] = id;
        return;
    }
    if (area < 0) {
        const sd_vertex swap = v1;
        v1 = v2;
        v2 = swap;
    }
    /* Differences are below 2^11 and positions relative to vertex 0 below 2^12: edge functions stay below 2^24, exact in float. */
    const int a0 = v1.y - v2.y, b0 = v2.x - v1.x, a1 = v2.y - v0.y, b1 = v0.x - v2.x, a2 = v0.y - v1.y, b2 = v1.x - v0.x;
    const int bias0 = edge_bias(a0, b0), bias1 = edge_bias(a1, b1), bias2 = edge_bias(a2, b2);
    const int c0 = -(a0 * (v1.x - v0.x) + b0 * (v1.y - v0.y));
    const float inv_area = 1.0f / (float)abs((int)area);
    const float key_min = fmin(v0.depth_key, fmin(v1.depth_key, v2.depth_key));
    const float key_max = fmax(v0.depth_key, fmax(v1.depth_key, v2.depth_key));
    for (int row = row0; row <= row1; ++row) {
        for (int col = col0; col <= col1; ++col) {
            const int x = col * SD_SUBPIXEL - half_w - v0.x, y = row * SD_SUBPIXEL - half_h - v0.y;
            for (int slot = 0; slot < SLOTS; slot += LANES) {
                const sint dx = x + S_LOAD(sample_x + slot), dy = y + S_LOAD(sample_y + slot);
                const sint e0 = a0 * dx + b0 * dy + c0, e1 = a1 * dx + b1 * dy, e2 = a2 * dx + b2 * dy;
                /* Negative where outside: the sign bits say all. */
                const sint outside = (e0 + bias0) | (e1 + bias1) | (e2 + bias2);
#if LANES > 1
                if (!any(outside >= 0)) continue;
#else
                if (outside < 0) continue;
#endif
                const sfloat sum = fma(S_FLOAT(e2), (sfloat)v2.depth_key, fma(S_FLOAT(e1), (sfloat)v1.depth_key, S_FLOAT(e0) * v0.depth_key));
                const sfloat key = clamp(sum * inv_area, key_min, key_max);
                int missed[LANES];
                float lane_key[LANES];
                S_STORE(outside, missed);
                S_STORE(key, lane_key);
                global ulong* cell = keys + ((size_t)(row - frame.first_row) * frame.pitch + col) * SLOTS + slot;
                for (int lane = 0; lane < LANES; ++lane) {
                    if (missed[lane] < 0) continue;
                    const ulong word = depth_word(lane_key[lane], frame.orthographic) | id;
                    /* Most candidates lose: a plain look first is nine times cheaper than an atomic. */
                    if (word < cell[lane]) atom_min(cell + lane, word);
                }
            }
        }
    }
}
