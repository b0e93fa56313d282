/* Triangles that need more than a look: large ones become records for the tiles, those that leave the clip volume are cut. */
#include "raster.h"

/* A corner while it is being cut: pixels times reach, and the reach (depth, or 1 for orthographic cameras) and depth themselves. */
typedef struct corner {
    double x, y, reach, depth;
    uint vertex; /* whose corner it is; NO_VERTEX where an edge was cut */
} corner;
#define NO_VERTEX 0xffffffffu

static void write_large(global sd_large* out, const int* x, const int* y, const float* key, uint id) {
    const long area = (long)(x[1] - x[0]) * (y[2] - y[0]) - (long)(x[2] - x[0]) * (y[1] - y[0]);
    const int second = area < 0 ? 2 : 1, third = area < 0 ? 1 : 2;
    sd_large t;
    t.x[0] = x[0], t.x[1] = x[second], t.x[2] = x[third];
    t.y[0] = y[0], t.y[1] = y[second], t.y[2] = y[third];
    t.id = id;
    t.key_min = fmin(key[0], fmin(key[1], key[2]));
    t.key_max = fmax(key[0], fmax(key[1], key[2]));
    t.pad_ = 0;
    /* The plane through the corners, in double: gradients from exact integer differences. */
    const double inv_area = 1.0 / (double)(area < 0 ? -area : area);
    const double k0 = key[0], d1 = (double)key[second] - k0, d2 = (double)key[third] - k0;
    t.key = k0;
    t.key_x = (d1 * (double)(t.y[2] - t.y[0]) - d2 * (double)(t.y[1] - t.y[0])) * inv_area;
    t.key_y = (d2 * (double)(t.x[1] - t.x[0]) - d1 * (double)(t.x[2] - t.x[0])) * inv_area;
    *out = t;
}

/* One work-item a number in `large`: its record goes to records[i]. */
kernel void setup_large(global const uint* index, global const sd_vertex* screen, global const uint* large, uint count,
                        global sd_large* records) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const uint id = large[i];
    int x[3], y[3];
    float key[3];
    for (int k = 0; k < 3; ++k) {
        const sd_vertex v = screen[index[3 * id + k]];
        x[k] = v.x;
        y[k] = v.y;
        key[k] = v.depth_key;
    }
    write_large(records + i, x, y, key, id);
}

/* Signed distance to plane p of the clip volume (near, left, right, top, bottom), >= 0 inside. */
static double inside_of(int p, corner c) {
    switch (p) {
        case 0: return c.depth - (double)SD_NEAR;
        case 1: return fma((double)SD_GUARD, c.reach, c.x);
        case 2: return fma((double)SD_GUARD, c.reach, -c.x);
        case 3: return fma((double)SD_GUARD, c.reach, c.y);
        default: return fma((double)SD_GUARD, c.reach, -c.y);
    }
}

/* Where the edge from the inner to the outer corner meets the plane: always computed in that direction, so that both triangles
 * of an edge get the same point. */
static corner cut(corner in, double d_in, corner out, double d_out) {
    const double t = d_in / (d_in - d_out);
    corner c;
    c.x = fma(t, out.x - in.x, in.x);
    c.y = fma(t, out.y - in.y, in.y);
    c.reach = fma(t, out.reach - in.reach, in.reach);
    c.depth = fma(t, out.depth - in.depth, in.depth);
    c.vertex = NO_VERTEX;
    return c;
}

/* One work-item a number in `clip`: Sutherland-Hodgman against five planes, at most 8 corners, 6 triangles, appended to
 * records from *used on. camera: vertices in camera space, 3 floats each; screen: where those lie that need no cut. Records that do
 * not fit are only counted. */
kernel void clip_triangles(global const uint* index, global const float* camera, global const sd_vertex* screen, global const uint* clip, uint count,
                           sd_frame frame, uint capacity, global sd_large* records, global uint* used) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const uint id = clip[i];
    corner polygon[9], next[9];
    int corners = 3;
    for (int k = 0; k < 3; ++k) {
        polygon[k].vertex = index[3 * id + k];
        const global float* p = camera + 3 * (size_t)polygon[k].vertex;
        polygon[k].x = p[0] * frame.pixels_per_slope;
        polygon[k].y = -p[1] * frame.pixels_per_slope;
        polygon[k].depth = -(double)p[2];
        polygon[k].reach = frame.orthographic ? 1.0 : polygon[k].depth;
    }
    for (int plane = 0; plane < 5 && corners > 0; ++plane) {
        int kept = 0;
        for (int k = 0; k < corners; ++k) {
            const corner here = polygon[k], there = polygon[k + 1 < corners ? k + 1 : 0];
            const double d_here = inside_of(plane, here), d_there = inside_of(plane, there);
            if (d_here >= 0) next[kept++] = here;
            if (d_here >= 0 && d_there < 0) next[kept++] = cut(here, d_here, there, d_there);
            if (d_here < 0 && d_there >= 0) next[kept++] = cut(there, d_there, here, d_here);
        }
        corners = min(kept, 9);
        for (int k = 0; k < corners; ++k) polygon[k] = next[k];
    }
    if (corners < 3) return;
    int x[9], y[9];
    float key[9];
    const int bound = SD_GUARD * SD_SUBPIXEL;
    for (int k = 0; k < corners; ++k) {
        if (polygon[k].vertex != NO_VERTEX && screen[polygon[k].vertex].outside == 0) {
            /* The very place that neighbours which need no cut have it at: projected from float again, it may snap elsewhere. */
            const sd_vertex v = screen[polygon[k].vertex];
            x[k] = v.x, y[k] = v.y, key[k] = v.depth_key;
            continue;
        }
        const double reach = frame.orthographic ? 1.0 : fmax(polygon[k].depth, (double)SD_NEAR);
        const double depth = fmax(polygon[k].depth, (double)SD_NEAR);
        x[k] = clamp(convert_int_sat_rte(polygon[k].x / reach * SD_SUBPIXEL), -bound, bound);
        y[k] = clamp(convert_int_sat_rte(polygon[k].y / reach * SD_SUBPIXEL), -bound, bound);
        key[k] = frame.orthographic ? (float)depth : (float)(1.0 / depth);
    }
    /* A fan; the diagonals are inner edges, exact like all others. */
    for (int k = 2; k < corners; ++k) {
        const int fx[3] = {x[0], x[k - 1], x[k]}, fy[3] = {y[0], y[k - 1], y[k]};
        const float fk[3] = {key[0], key[k - 1], key[k]};
        if ((long)(fx[1] - fx[0]) * (fy[2] - fy[0]) == (long)(fx[2] - fx[0]) * (fy[1] - fy[0])) continue;
        const uint at = atomic_inc(used);
        if (at < capacity) write_large(records + at, fx, fy, fk, id);
    }
}
