/* Edge functions and depth keys, common to small and large triangles.
 * E(x, y) = a x + b y + c with a = y0 - y1, b = x1 - x0 is >= 0 on the inner side of edge 0 -> 1 of a triangle of positive
 * area; samples exactly on an edge belong to it where it is a left (a > 0) or a top edge (a == 0 and b > 0, y down), so that
 * neighbours never share and never miss a sample. All in exact integers. */
#include "prelude.h"

/* 0 where a sample on the edge counts, -1 where not: added to the edge function before comparing with 0. */
static inline int edge_bias(int a, int b) { return (a > 0 || (a == 0 && b > 0)) ? 0 : -1; }

/* What turns the bits of a depth key so that the nearest is the smallest: depths (orthographic) grow with distance, 1/depth does
 * not. Above the triangle's number, which decides between equal depths, they are the sample's 64-bit key. */
static inline uint depth_turn(int orthographic) { return orthographic ? 0u : ~0u; }

/* First and last pixel (of a row or column) whose samples may lie in [from, to], both SD_SUBPIXEL-ths from the centre.
 * half_size: half the image's extent in the same unit; offsets of samples within a pixel are 0..255. */
static inline int first_pixel(int from, int half_size) { return (from + half_size) >> 8; }
static inline int last_pixel(int to, int half_size) { return (to + half_size) >> 8; }

/* The lanes of a comparison that hold, as bits: a byte of ones or zeros a lane, of which one bit each stays; a product brings
 * eight together. */
#if VW == 16
static inline uint bits8(char8 mask) { return (uint)(((as_ulong(mask) & 0x8040201008040201UL) * 0x0101010101010101UL) >> 56); }
static inline uint bits16(char16 mask) { return bits8(mask.lo) | bits8(mask.hi) << 8; }
#define LANE_BITS(mask) bits16(convert_char16(mask))
#else
#define LANE_BITS(mask) ((mask) != 0 ? 1u : 0u)
#endif
/* Number of the lowest bit of a set that is not empty. */
static inline int lowest_lane(uint lanes) { return 31 - (int)clz(lanes & -lanes); }
