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

/* Triangles drawn into a tile between two looks at how far it shows. */
#define TILE_LOOK 16
/* Pixels that one repetition of the pattern spans: what a step to the right moves by. */
#define TILE_STEP (PATTERN / SLOTS)

/* An edge function a x + b y + c at the lanes of a vector, divided by SD_SUBPIXEL and rounded down. Pixels are SD_SUBPIXEL apart,
 * so that steps of a and b a pixel stay exact and no sign changes. |a|, |b| <= 2^24 (the guard band) change it by less than 2^30
 * across a tile of 32 pixels; held within +-2^30 where the vectors start, it keeps its signs all over the tile in 32 bits.
 * c: of the pixel where the vectors start. */
static vint edge_at(int a, int b, long c, vint x, vint y) {
    const vlong e = ((long)a * V_LONG(x) + (long)b * V_LONG(y) + c) >> 8;
    return V_INT(clamp(e, (vlong)-(1L << 30), (vlong)(1L << 30)));
}

/* The largest key of `rows` rows of `lanes` samples. */
static ulong furthest(global const ulong* cells, int rows, int lanes, size_t pitch) {
    vulong most = 0;
    for (int row = 0; row < rows; ++row, cells += pitch)
        for (int lane = 0; lane < lanes; lane += VW) most = max(most, VLOAD(cells + lane));
    ulong all[VW];
    VSTORE(most, all);
    for (int i = 1; i < VW; ++i) all[0] = max(all[0], all[i]);
    return all[0];
}

/* One work-item a tile. pattern_x, pattern_y: PATTERN offsets of lanes, SD_SUBPIXEL-ths of a pixel from the vector's first pixel. */
kernel void cover_tiles(global const sd_large* records, global const uint* tile_first, global const uint* tile_list,
                        sd_frame frame, constant int* pattern_x, constant int* pattern_y, global ulong* keys) {
    const int tile = (int)get_global_id(0);
    if (tile >= frame.tiles_x * frame.tiles_y) return;
    const int size = 1 << frame.tile_shift;
    const int tile_col = (tile % frame.tiles_x) * size, tile_row = (tile / frame.tiles_x) * size;
    const int end_col = min(tile_col + size, frame.pitch), end_row = min(tile_row + size, frame.rows);
    const int half_w = frame.width * (SD_SUBPIXEL / 2), half_h = frame.height * (SD_SUBPIXEL / 2);
    const size_t pitch = (size_t)frame.pitch * SLOTS;
    keys += tile_row * pitch + tile_col * SLOTS;
    /* Triangles behind all that the tile shows are passed over; how far that is, is looked up now and then. */
    ulong limit = EMPTY_KEY;
    const uint turn = depth_turn(frame.orthographic);
    int drawn = 0;
    for (uint n = tile_first[tile]; n < tile_first[tile + 1]; ++n) {
        const global sd_large* t = records + tile_list[n];
        const uint nearest = as_uint(frame.orthographic ? t->key_min : t->key_max) ^ turn;
        if (((ulong)nearest << 32 | t->id) > limit) continue;
        const int x_0 = t->x[0], y_0 = t->y[0];
        const int left = min(x_0, min(t->x[1], t->x[2])), right = max(x_0, max(t->x[1], t->x[2]));
        const int top = min(y_0, min(t->y[1], t->y[2])), bottom = max(y_0, max(t->y[1], t->y[2]));
        const int row0 = max(first_pixel(top, half_h) - frame.first_row, tile_row);
        const int rows = min(last_pixel(bottom, half_h) - frame.first_row, end_row - 1) - row0 + 1;
        const int col0 = max(first_pixel(left, half_w), tile_col) & -TILE_STEP;
        const int cols = min(last_pixel(right, half_w), end_col - 1) - col0 + 1;
        /* Edge k runs from corner k to the next; relative to corner 0 the products stay below 2^50. */
        const int x = col0 * SD_SUBPIXEL - half_w - x_0, y = (row0 + frame.first_row) * SD_SUBPIXEL - half_h - y_0;
        const int a0 = t->y[0] - t->y[1], b0 = t->x[1] - t->x[0], a1 = t->y[1] - t->y[2], b1 = t->x[2] - t->x[1];
        const int a2 = t->y[2] - t->y[0], b2 = t->x[0] - t->x[2];
        const long c0 = (long)a0 * x + (long)b0 * y + edge_bias(a0, b0), c2 = (long)a2 * x + (long)b2 * y + edge_bias(a2, b2);
        const long c1 = (long)a1 * (x + x_0 - t->x[1]) + (long)b1 * (y + y_0 - t->y[1]) + edge_bias(a1, b1);
        const vdouble key_x = t->key_x;
        const vfloat key_min = t->key_min, key_max = t->key_max;
        for (int part = 0; part < PATTERN; part += VW) {
            const vint offset_x = VLOAD(pattern_x + part), offset_y = VLOAD(pattern_y + part);
            const vint start0 = edge_at(a0, b0, c0, offset_x, offset_y), start1 = edge_at(a1, b1, c1, offset_x, offset_y);
            const vint start2 = edge_at(a2, b2, c2, offset_x, offset_y);
            global ulong* cells = keys + (row0 - tile_row) * pitch + (col0 - tile_col) * SLOTS + part;
            for (int row = 0; row < rows; ++row, cells += pitch) {
                const vdouble down = fma((vdouble)t->key_y, V_DOUBLE(y + row * SD_SUBPIXEL + offset_y), (vdouble)t->key);
                vint e0 = start0 + b0 * row, e1 = start1 + b1 * row, e2 = start2 + b2 * row;
                for (int col = 0; col < cols; col += TILE_STEP, e0 += a0 * TILE_STEP, e1 += a1 * TILE_STEP, e2 += a2 * TILE_STEP) {
                    const vint in = (e0 | e1 | e2) >= 0;
                    if (LANE_BITS(in) == 0) continue;
                    const vfloat key = V_FLOAT(fma(key_x, V_DOUBLE(x + col * SD_SUBPIXEL + offset_x), down));
                    const vuint near = AS_UINT(clamp(key, key_min, key_max)) ^ turn;
                    const vulong word = (V_ULONG(near) << 32) | (vulong)t->id;
                    global ulong* cell = cells + col * SLOTS;
                    const vulong old = VLOAD(cell);
                    VSTORE(select(old, min(old, word), V_LONG(in)), cell);
                }
            }
        }
        if (++drawn % TILE_LOOK == 0) limit = furthest(keys, end_row - tile_row, (end_col - tile_col) * SLOTS, pitch);
    }
}
