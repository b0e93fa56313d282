/* Edge functions and depth keys, common to small and large triangles.
 * E(x, y) = a x + b y + c with a = y0 - y1, b = x1 - x0 is >= 0 on the inner side of edge 0 -> 1 of a triangle of positive
 * area; samples exactly on an edge belong to it where it is a left (a > 0) or a top edge (a == 0 and b > 0, y down), so that
 * neighbours never share and never miss a sample. All in exact integers. */
#include "prelude.h"

/* 0 where a sample on the edge counts, -1 where not: added to the edge function before comparing with 0. */
static inline int edge_bias(int a, int b) { return (a > 0 || (a == 0 && b > 0)) ? 0 : -1; }

/* The 64-bit key whose minimum is the nearest sample; equal depths are decided by the triangle's number. */
static inline ulong depth_word(float key, int orthographic) {
    const uint bits = as_uint(key);
    return (ulong)(orthographic ? bits : ~bits) << 32;
}

/* First and last pixel (of a row or column) whose samples may lie in [from, to], both SD_SUBPIXEL-ths from the centre.
 * half_size: half the image's extent in the same unit; offsets of samples within a pixel are 0..255. */
static inline int first_pixel(int from, int half_size) { return (from + half_size) >> 8; }
static inline int last_pixel(int to, int half_size) { return (to + half_size) >> 8; }
