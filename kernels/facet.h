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

static inline facet facet_of(const global float* p0, const global float* p1, const global float* p2) {
    const float x0 = p1[0] - p0[0], y0 = p1[1] - p0[1], z0 = p1[2] - p0[2];
    const float x1 = p2[0] - p1[0], y1 = p2[1] - p1[1], z1 = p2[2] - p1[2];
    const float x2 = p0[0] - p2[0], y2 = p0[1] - p2[1], z2 = p0[2] - p2[2];
    const float s0 = fma(z0, z0, fma(y0, y0, x0 * x0)), s1 = fma(z1, z1, fma(y1, y1, x1 * x1)), s2 = fma(z2, z2, fma(y2, y2, x2 * x2));
    /* The longest is left out; choices of values, not of places, which every compiler gets right. */
    const int not0 = s0 > s2 && s0 > s1, not1 = !not0 && s1 > s2;
    const float ax = not0 ? x1 : not1 ? x2 : x0, ay = not0 ? y1 : not1 ? y2 : y0, az = not0 ? z1 : not1 ? z2 : z0;
    const float bx = not0 ? x2 : not1 ? x0 : x1, by = not0 ? y2 : not1 ? y0 : y1, bz = not0 ? z2 : not1 ? z0 : z1;
    facet f;
    f.corner = not0 ? 2 : not1 ? 0 : 1;
    f.x = fma(ay, bz, -(az * by));
    f.y = fma(az, bx, -(ax * bz));
    f.z = fma(ax, by, -(ay * bx));
    f.edges = greatest(greatest(fabs(ax), fabs(ay)), fabs(az)) * greatest(greatest(fabs(bx), fabs(by)), fabs(bz));
    return f;
}

/* The largest coordinate of the normal; 1 for none. */
static inline float steepness(facet f) {
    const float largest = greatest(greatest(fabs(f.x), fabs(f.y)), fabs(f.z));
    return largest > 0.0f ? largest : 1.0f;
}
#endif
