/* Large triangles by tiles: counted, scanned, dealt out; then one owner a tile, rows of samples as vectors, no atomics. */
#include "raster.h"

typedef struct tile_box {
    int x0, x1, y0, y1; /* tiles, inclusive; empty if x0 > x1 or y0 > y1 */
} tile_box;

static tile_box tiles_of(const global sd_large* t, sd_frame frame) {
    const int half_w = frame.width * (SD_SUBPIXEL / 2), half_h = frame.height * (SD_SUBPIXEL / 2);
    const int left = min(t->x[0], min(t->x[1], t->x[2])), right = max(t->x[0], max(t->x[1], t->x[2]));
    const int top = min(t->y[0], min(t->y[1], t->y[2])), bottom = max(t->y[0], max(t->y[1], t->y[2]));
    tile_box box;
    box.x0 = max(first_pixel(left, half_w), 0) >> frame.tile_shift;
    box.x1 = min(last_pixel(right, half_w), frame.width - 1) >> frame.tile_shift;
    box.y0 = max(first_pixel(top, half_h) - frame.first_row, 0) >> frame.tile_shift;
    box.y1 = min(last_pixel(bottom, half_h) - frame.first_row, frame.rows - 1) >> frame.tile_shift;
    if (first_pixel(left, half_w) >= frame.width || last_pixel(right, half_w) < 0 ||
        first_pixel(top, half_h) >= frame.first_row + frame.rows || last_pixel(bottom, half_h) < frame.first_row)
        box.x1 = box.x0 - 1;
    return box;
}

/* False if the whole tile lies on the outer side of an edge: the corner furthest along the edge's normal decides. */
static int may_touch(const global sd_large* t, int tile_x, int tile_y, sd_frame frame) {
    const int side = SD_SUBPIXEL << frame.tile_shift;
    const int x0 = tile_x * side - frame.width * (SD_SUBPIXEL / 2);
    const int y0 = frame.first_row * SD_SUBPIXEL + tile_y * side - frame.height * (SD_SUBPIXEL / 2);
    for (int k = 0; k < 3; ++k) {
        const int n = k < 2 ? k + 1 : 0;
        const long a = t->y[k] - t->y[n], b = t->x[n] - t->x[k];
        const long x = x0 + (a > 0 ? side - 1 : 0) - t->x[k], y = y0 + (b > 0 ? side - 1 : 0) - t->y[k];
        if (a * x + b * y < 0) return 0;
    }
    return 1;
}

kernel void count_tiles(global const sd_large* records, uint count, sd_frame frame, global uint* tile_counts) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const tile_box box = tiles_of(records + i, frame);
    for (int y = box.y0; y <= box.y1; ++y)
        for (int x = box.x0; x <= box.x1; ++x)
            if (may_touch(records + i, x, y, frame)) atomic_inc(tile_counts + y * frame.tiles_x + x);
}

/* Exclusive prefix sum of `count` numbers; sums[count] is the total. One work-item: lists are short next to the work they save. */
kernel void scan(global const uint* numbers, uint count, global uint* sums) {
    uint sum = 0;
    for (uint i = 0; i < count; ++i) {
        sums[i] = sum;
        sum += numbers[i];
    }
    sums[count] = sum;
}

/* tile_counts is counted down to zero while the records' numbers take their places from tile_first on. */
kernel void deal_tiles(global const sd_large* records, uint count, sd_frame frame, global const uint* tile_first,
                       global uint* tile_counts, global uint* tile_list) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const tile_box box = tiles_of(records + i, frame);
    for (int y = box.y0; y <= box.y1; ++y) {
        for (int x = box.x0; x <= box.x1; ++x) {
            const int tile = y * frame.tiles_x + x;
            if (may_touch(records + i, x, y, frame)) tile_list[tile_first[tile] + atomic_dec(tile_counts + tile) - 1] = i;
        }
    }
}

/* One work-item a tile. pattern_x, pattern_y: PATTERN offsets of lanes, SD_SUBPIXEL-ths of a pixel from the vector's first pixel. */
kernel void cover_tiles(global const sd_large* records, global const uint* tile_first, global const uint* tile_list,
                        sd_frame frame, constant int* pattern_x, constant int* pattern_y, global ulong* keys) {
    const int tile = (int)get_global_id(0);
    if (tile >= frame.tiles_x * frame.tiles_y) return;
    const int size = 1 << frame.tile_shift;
    const int tile_col = (tile % frame.tiles_x) * size, tile_row = (tile / frame.tiles_x) * size;
    const int half_w = frame.width * (SD_SUBPIXEL / 2), half_h = frame.height * (SD_SUBPIXEL / 2);
    for (uint n = tile_first[tile]; n < tile_first[tile + 1]; ++n) {
        const global sd_large* t = records + tile_list[n];
        const int x_0 = t->x[0], y_0 = t->y[0];
        const int left = min(x_0, min(t->x[1], t->x[2])), right = max(x_0, max(t->x[1], t->x[2]));
        const int top = min(y_0, min(t->y[1], t->y[2])), bottom = max(y_0, max(t->y[1], t->y[2]));
        const int row0 = max(first_pixel(top, half_h) - frame.first_row, tile_row);
        const int row1 = min(last_pixel(bottom, half_h) - frame.first_row, min(tile_row + size, frame.rows) - 1);
        const int col0 = max(first_pixel(left, half_w), tile_col);
        const int col1 = min(last_pixel(right, half_w), min(tile_col + size, frame.pitch) - 1);
        if (col0 > col1) continue;
        /* Edge k runs from corner k to the next; relative to corner 0 the products stay below 2^50. */
        const int a0 = t->y[0] - t->y[1], b0 = t->x[1] - t->x[0], a1 = t->y[1] - t->y[2], b1 = t->x[2] - t->x[1];
        const int a2 = t->y[2] - t->y[0], b2 = t->x[0] - t->x[2];
        const long c0 = edge_bias(a0, b0), c2 = edge_bias(a2, b2);
        const long c1 = edge_bias(a1, b1) - ((long)a1 * (t->x[1] - x_0) + (long)b1 * (t->y[1] - y_0));
        /* Vectors start at multiples of VW lanes. */
        const int first_lane = col0 * SLOTS / VW * VW, end_lane = (col1 + 1) * SLOTS;
        for (int row = row0; row <= row1; ++row) {
            const int y = (row + frame.first_row) * SD_SUBPIXEL - half_h - y_0;
            global ulong* cells = keys + (size_t)row * frame.pitch * SLOTS;
            for (int lane = first_lane; lane < end_lane; lane += VW) {
                const int x = (lane / SLOTS) * SD_SUBPIXEL - half_w - x_0;
                const vlong dx = V_LONG(x + VLOAD(pattern_x + lane % PATTERN)), dy = V_LONG(y + VLOAD(pattern_y + lane % PATTERN));
                const vlong e0 = (long)a0 * dx + (long)b0 * dy + c0, e1 = (long)a1 * dx + (long)b1 * dy + c1;
                const vlong e2 = (long)a2 * dx + (long)b2 * dy + c2;
                const vlong outside = e0 | e1 | e2;
                const vlong in = outside >= 0;
                if (!ANY(in)) continue;
                const vdouble depth = fma((vdouble)t->key_x, V_DOUBLE(dx), fma((vdouble)t->key_y, V_DOUBLE(dy), (vdouble)t->key));
                const vfloat key = clamp(V_FLOAT(depth), (vfloat)t->key_min, (vfloat)t->key_max);
                const vuint bits = frame.orthographic ? AS_UINT(key) : ~AS_UINT(key);
                const vulong word = (V_ULONG(bits) << 32) | (vulong)t->id;
                const vulong old = VLOAD(cells + lane);
                VSTORE(select(old, min(old, word), in), cells + lane);
            }
        }
    }
}
