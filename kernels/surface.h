/* What a sample sees of a triangle: position, normal, view direction, in camera space. Vectors of lanes, one triangle at a time. */
#include "prelude.h"

#include "facet.h"

typedef struct v3 {
    vfloat x, y, z;
} v3;

static inline vfloat dot3(v3 a, v3 b) { return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x)); }
static inline v3 scale3(v3 a, vfloat s) {
    const v3 r = {a.x * s, a.y * s, a.z * s};
    return r;
}
static inline v3 add3(v3 a, v3 b) {
    const v3 r = {a.x + b.x, a.y + b.y, a.z + b.z};
    return r;
}
static inline v3 cross3(v3 a, v3 b) {
    const v3 r = {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
    return r;
}
/* Unit vector; a zero vector stays zero. */
static inline v3 unit3(v3 a) {
    const vfloat square = dot3(a, a);
    return scale3(a, 1.0f / sqrt(select(square, (vfloat)1.0f, square == 0.0f)));
}

typedef struct surface {
    v3 position; /* m */
    v3 normal;   /* unit, on the seen side */
    v3 view;     /* unit, towards the viewer */
    vfloat cos_view;
#ifdef HAS_ANISOTROPY
    v3 tangent, bitangent; /* unit, in the surface: along the texture coordinates' u, and across it; their signs mean nothing */
#endif
#ifdef HAS_SHADOWS
    v3 lifted; /* where rays to lights start, m: just off the triangle, and where its normals make it the flat part of something round, on that */
#endif
#ifdef HAS_RELIEF
    vfloat side; /* 1 where the outside is seen, -1 from behind */
    v3 horizon;  /* light from behind this plane does not arrive: the normal before a texture bent it */
#endif
#ifdef HAS_TEXTURE
    vfloat u, v; /* texture coordinates, (0,0) bottom left */
#endif
#ifdef HAS_MIP
    vfloat u_x, v_x, u_y, v_y; /* their change from pixel to pixel, along rows and columns, up to a common sign */
#endif
} surface;

#ifdef HAS_SHADOWS
/* By how much a place lies below the plane through a corner across its normal: along that normal. A normal that leans from the
 * triangle's own (`up`) by more than 30 degrees means less and less that something is round; at 53 degrees, nothing. */
static inline v3 up_to(v3 place, const global float* corner, const global float* corner_normal, v3 up, vfloat side, vfloat share) {
    const v3 raw = {(vfloat)corner_normal[0], (vfloat)corner_normal[1], (vfloat)corner_normal[2]};
    const v3 normal = scale3(unit3(raw), side);
    const v3 off = {place.x - corner[0], place.y - corner[1], place.z - corner[2]};
    const vfloat round = clamp(fma(dot3(normal, up), (vfloat)4.0f, (vfloat)-2.4f), 0.0f, 1.0f);
    return scale3(normal, share * round * max(-dot3(off, normal), (vfloat)0.0f));
}
#endif

#ifdef HAS_ANISOTROPY
/* Tangents in the surface that has the normal, as near as may be to a vector. */
static inline void orient(surface* s, v3 along) {
    s->tangent = unit3(add3(along, scale3(s->normal, -dot3(s->normal, along))));
    s->bitangent = cross3(s->normal, s->tangent);
}
#endif

/* Grazing views are held a little off the horizon, where microfacet terms divide by the cosine. */
#define MIN_COS_VIEW 1e-6f

/* x, y: the samples, SD_SUBPIXEL-ths of a pixel from the image's centre. Barycentrics come from the unclipped corners relative to
 * each sample's ray (the 2-D homogeneous form), so that no clipping or snapping enters; samples that snapping has put a little
 * outside are moved back to the edge. */
static surface surface_at(global const uint* corner, global const float* camera, global const float* normals,
                          global const float* coordinates, global const float* tangents, sd_frame frame,
                          vfloat x, vfloat y) {
    const global float* p0 = camera + 3 * (size_t)corner[0];
    const global float* p1 = camera + 3 * (size_t)corner[1];
    const global float* p2 = camera + 3 * (size_t)corner[2];
    vfloat u0, v0, u1, v1, u2, v2;
#ifdef BAKE
    /* Corners in the texture's square, SD_SUBPIXEL-ths of a texel from its centre. */
    const float wide = (float)(frame.width * SD_SUBPIXEL), high = (float)(frame.height * SD_SUBPIXEL);
    const global float* c0 = coordinates + 2 * (size_t)corner[0];
    const global float* c1 = coordinates + 2 * (size_t)corner[1];
    const global float* c2 = coordinates + 2 * (size_t)corner[2];
    u0 = (c0[0] - 0.5f) * wide - x, v0 = (0.5f - c0[1]) * high - y;
    u1 = (c1[0] - 0.5f) * wide - x, v1 = (0.5f - c1[1]) * high - y;
    u2 = (c2[0] - 0.5f) * wide - x, v2 = (0.5f - c2[1]) * high - y;
#else
    const vfloat rx = x * frame.slope_per_subpixel, ry = -(y * frame.slope_per_subpixel);
    if (frame.orthographic) {
        u0 = p0[0] - rx, v0 = p0[1] - ry, u1 = p1[0] - rx, v1 = p1[1] - ry, u2 = p2[0] - rx, v2 = p2[1] - ry;
    } else {
        u0 = fma(rx, (vfloat)p0[2], (vfloat)p0[0]), v0 = fma(ry, (vfloat)p0[2], (vfloat)p0[1]);
        u1 = fma(rx, (vfloat)p1[2], (vfloat)p1[0]), v1 = fma(ry, (vfloat)p1[2], (vfloat)p1[1]);
        u2 = fma(rx, (vfloat)p2[2], (vfloat)p2[0]), v2 = fma(ry, (vfloat)p2[2], (vfloat)p2[1]);
    }
#endif
    vfloat b0 = fma(u1, v2, -(u2 * v1)), b1 = fma(u2, v0, -(u0 * v2)), b2 = fma(u0, v1, -(u1 * v0));
    const vfloat turn = copysign((vfloat)1.0f, b0 + b1 + b2);
    b0 = fmax(b0 * turn, 0.0f), b1 = fmax(b1 * turn, 0.0f), b2 = fmax(b2 * turn, 0.0f);
    const vfloat sum = b0 + b1 + b2;
    /* Seen exactly edge-on, nothing is left: the middle stands for the triangle. */
    const vint flat_on = !(sum > 0.0f);
    const vfloat inv = 1.0f / select(sum, (vfloat)1.0f, flat_on);
    const vfloat third = 1.0f / 3.0f;
    b0 = select(b0 * inv, third, flat_on), b1 = select(b1 * inv, third, flat_on), b2 = select(b2 * inv, third, flat_on);

    surface s;
    s.position.x = fma(b2, (vfloat)p2[0], fma(b1, (vfloat)p1[0], b0 * p0[0]));
    s.position.y = fma(b2, (vfloat)p2[1], fma(b1, (vfloat)p1[1], b0 * p0[1]));
    s.position.z = fma(b2, (vfloat)p2[2], fma(b1, (vfloat)p1[2], b0 * p0[2]));
    const global float* n0 = normals + 3 * (size_t)corner[0];
    const global float* n1 = normals + 3 * (size_t)corner[1];
    const global float* n2 = normals + 3 * (size_t)corner[2];
    v3 n;
    /* From corner 0: where all three are alike, so is the normal between them, to the bit. */
    n.x = fma(b2, (vfloat)(n2[0] - n0[0]), fma(b1, (vfloat)(n1[0] - n0[0]), (vfloat)n0[0]));
    n.y = fma(b2, (vfloat)(n2[1] - n0[1]), fma(b1, (vfloat)(n1[1] - n0[1]), (vfloat)n0[1]));
    n.z = fma(b2, (vfloat)(n2[2] - n0[2]), fma(b1, (vfloat)(n1[2] - n0[2]), (vfloat)n0[2]));
#ifdef HAS_TEXTURE
    const global float* t0 = coordinates + 2 * (size_t)corner[0];
    const global float* t1 = coordinates + 2 * (size_t)corner[1];
    const global float* t2 = coordinates + 2 * (size_t)corner[2];
    s.u = fma(b2, (vfloat)t2[0], fma(b1, (vfloat)t1[0], b0 * t0[0]));
    s.v = fma(b2, (vfloat)t2[1], fma(b1, (vfloat)t1[1], b0 * t0[1]));
#endif
#if defined(HAS_MIP) && defined(BAKE)
    s.u_x = 1.0f / (float)frame.width, s.v_y = 1.0f / (float)frame.height;
    s.v_x = s.u_y = 0.0f;
#elif defined(HAS_MIP)
    /* b1 and b2 before they were divided by the sum of all are linear in the ray's slopes, and so is the sum: the slopes of these
     * belong to the triangle. Differences of corners keep the digits of small triangles. */
    const float pixel = (float)SD_SUBPIXEL * frame.slope_per_subpixel;
    const float e1x = p1[0] - p0[0], e1y = p1[1] - p0[1], e1z = p1[2] - p0[2];
    const float e2x = p2[0] - p0[0], e2y = p2[1] - p0[1], e2z = p2[2] - p0[2];
    float x1 = e2y, x2 = -e1y, y1 = -e2x, y2 = e1x, sum_x = 0.0f, sum_y = 0.0f;
    if (!frame.orthographic) {
        x1 = fma(e2z, p0[1], -(p0[2] * e2y)), y1 = fma(p0[2], e2x, -(e2z * p0[0]));
        x2 = fma(p0[2], e1y, -(e1z * p0[1])), y2 = fma(e1z, p0[0], -(p0[2] * e1x));
        sum_x = fma(e1z, e2y, -(e2z * e1y)), sum_y = fma(e1x, e2z, -(e2x * e1z));
    }
    const vfloat to_pixel = inv * pixel;
    const float du1 = t1[0] - t0[0], du2 = t2[0] - t0[0], dv1 = t1[1] - t0[1], dv2 = t2[1] - t0[1];
    const vfloat u_off = s.u - t0[0], v_off = s.v - t0[1];
    s.u_x = fma(-u_off, (vfloat)sum_x, (vfloat)fma(x2, du2, x1 * du1)) * to_pixel;
    s.v_x = fma(-v_off, (vfloat)sum_x, (vfloat)fma(x2, dv2, x1 * dv1)) * to_pixel;
    s.u_y = fma(-u_off, (vfloat)sum_y, (vfloat)fma(y2, du2, y1 * du1)) * to_pixel;
    s.v_y = fma(-v_off, (vfloat)sum_y, (vfloat)fma(y2, dv2, y1 * dv1)) * to_pixel;
#endif
    if (frame.orthographic) {
        s.view.x = 0.0f, s.view.y = 0.0f, s.view.z = 1.0f;
    } else {
        s.view.x = -s.position.x, s.view.y = -s.position.y, s.view.z = -s.position.z;
        s.view = unit3(s.view);
    }
#ifndef BAKE
    const v3 e1 = {(vfloat)(p1[0] - p0[0]), (vfloat)(p1[1] - p0[1]), (vfloat)(p1[2] - p0[2])};
    const v3 e2 = {(vfloat)(p2[0] - p0[0]), (vfloat)(p2[1] - p0[1]), (vfloat)(p2[2] - p0[2])};
    const v3 face = cross3(e1, e2);
    const vfloat seen = dot3(face, s.view), along = dot3(face, n);
#endif
    n = unit3(n);
#ifdef BAKE
    /* A texture belongs to the outside. */
    const vfloat side = 1.0f;
#else
    /* The seen side: the face's plane decides, so that a smooth normal that leans over the silhouette stays on its side. */
    const vfloat side = copysign((vfloat)1.0f, seen) * copysign((vfloat)1.0f, along);
#endif
    s.normal = scale3(n, side);
#ifdef HAS_SHADOWS
    /* Onto the planes through the corners across their normals, where these are above (Hanika, Hacking the Shadow Terminator, 2021);
     * and off the triangle by more than rounding may have put the place, or the corners of neighbours, below it. */
    const facet own = facet_of(p0, p1, p2);
    const float largest = steepness(own);
    v3 up = {(vfloat)(own.x / largest), (vfloat)(own.y / largest), (vfloat)(own.z / largest)};
    up = unit3(up);
#ifdef BAKE
    up = scale3(up, copysign((vfloat)1.0f, dot3(up, n)));
#else
    up = scale3(up, copysign((vfloat)1.0f, dot3(up, s.view)));
#endif
    const v3 lift = add3(add3(up_to(s.position, p0, n0, up, side, b0), up_to(s.position, p1, n1, up, side, b1)),
                         up_to(s.position, p2, n2, up, side, b2));
    const float off = greatest(greatest(size_of(p0), size_of(p1)), size_of(p2)) * 0x1p-19f;
    s.lifted = add3(s.position, add3(lift, scale3(up, (vfloat)off)));
#endif
#ifdef HAS_RELIEF
    s.side = side;
    s.horizon = s.normal;
#endif
    s.cos_view = fmax(dot3(s.normal, s.view), MIN_COS_VIEW);
#ifdef HAS_ANISOTROPY
    const global float* g0 = tangents + 3 * (size_t)corner[0];
    const global float* g1 = tangents + 3 * (size_t)corner[1];
    const global float* g2 = tangents + 3 * (size_t)corner[2];
    v3 t;
    t.x = fma(b2, (vfloat)g2[0], fma(b1, (vfloat)g1[0], b0 * g0[0]));
    t.y = fma(b2, (vfloat)g2[1], fma(b1, (vfloat)g1[1], b0 * g0[1]));
    t.z = fma(b2, (vfloat)g2[2], fma(b1, (vfloat)g1[2], b0 * g0[2]));
    orient(&s, t);
#endif
    return s;
}
