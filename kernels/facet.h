/* The plane of a triangle, as true as its corners' coordinates: from its two shorter edges and the corner between them, which keeps
 * the digits of needles and slivers. */
#ifndef FACET_H
#define FACET_H

static inline float least(float a, float b) { return a < b ? a : b; }
static inline float greatest(float a, float b) { return a > b ? a : b; }
static inline float size_of(const global float* p) { return greatest(greatest(fabs(p[0]), fabs(p[1])), fabs(p[2])); }

typedef struct facet {
    float x, y, z; /* normal, m^2 */
    float edges;   /* product of both edges' largest coordinates, m^2: rounding of the normal is in proportion */
    int corner;    /* 0, 1 or 2: between them */
} facet;

static inline float square_of(const float* e) { return fma(e[2], e[2], fma(e[1], e[1], e[0] * e[0])); }
static inline float reach_of(const float* e) { return greatest(greatest(fabs(e[0]), fabs(e[1])), fabs(e[2])); }

static inline facet facet_of(const global float* p0, const global float* p1, const global float* p2) {
    const float e0[3] = {p1[0] - p0[0], p1[1] - p0[1], p1[2] - p0[2]};
    const float e1[3] = {p2[0] - p1[0], p2[1] - p1[1], p2[2] - p1[2]};
    const float e2[3] = {p0[0] - p2[0], p0[1] - p2[1], p0[2] - p2[2]};
    const float s0 = square_of(e0), s1 = square_of(e1), s2 = square_of(e2);
    const float* a = e0;
    const float* b = e1;
    facet f;
    f.corner = 1;
    if (s0 > s2 && s0 > s1)
        a = e1, b = e2, f.corner = 2;
    else if (s1 > s2)
        a = e2, b = e0, f.corner = 0;
    f.x = fma(a[1], b[2], -(a[2] * b[1]));
    f.y = fma(a[2], b[0], -(a[0] * b[2]));
    f.z = fma(a[0], b[1], -(a[1] * b[0]));
    f.edges = reach_of(a) * reach_of(b);
    return f;
}

/* The largest coordinate of the normal; 1 for none. */
static inline float steepness(facet f) {
    const float largest = greatest(greatest(fabs(f.x), fabs(f.y)), fabs(f.z));
    return largest > 0.0f ? largest : 1.0f;
}
#endif
