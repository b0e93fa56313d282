/* Normal and bump maps: normals bent by a texture, in the frame that the texture's coordinates span on the triangle. */
#include "texture.h"

#ifdef HAS_RELIEF
static v3 edge_between(global const float* from, global const float* to) {
    const v3 e = {(vfloat)(to[0] - from[0]), (vfloat)(to[1] - from[1]), (vfloat)(to[2] - from[2])};
    return e;
}
/* a * x + b * y */
static v3 mix3(v3 a, vfloat x, v3 b, vfloat y) {
    const v3 r = {fma(b.x, y, a.x * x), fma(b.y, y, a.y * x), fma(b.z, y, a.z * x)};
    return r;
}

/* Bends the normal where the lanes of `mask` see the triangle; the horizon stays. */
static void bend(surface* s, global const uint* corner, global const float* camera, global const float* coordinates, paint p,
                 uint relief, vint mask) {
    const sd_texture t = p.textures[relief - 1];
    global const float* p0 = camera + 3 * (size_t)corner[0];
    const v3 e1 = edge_between(p0, camera + 3 * (size_t)corner[1]), e2 = edge_between(p0, camera + 3 * (size_t)corner[2]);
    global const float* t0 = coordinates + 2 * (size_t)corner[0];
    global const float* t1 = coordinates + 2 * (size_t)corner[1];
    global const float* t2 = coordinates + 2 * (size_t)corner[2];
    /* Along the edges the texture's own coordinates change by this. */
    const float a1 = t1[0] - t0[0], b1 = t1[1] - t0[1], a2 = t2[0] - t0[0], b2 = t2[1] - t0[1];
    const float u1 = fma(t.place[0], a1, t.place[1] * b1), v1 = fma(t.place[3], a1, t.place[4] * b1);
    const float u2 = fma(t.place[0], a2, t.place[1] * b2), v2 = fma(t.place[3], a2, t.place[4] * b2);
    const float area = fma(u1, v2, -(u2 * v1)), turn = copysign(1.0f, area), size = fabs(area);
    /* The directions of u and v, each times `size`. */
    const v3 along_u = mix3(e1, (vfloat)(v2 * turn), e2, (vfloat)(-v1 * turn));
    const v3 along_v = mix3(e2, (vfloat)(u1 * turn), e1, (vfloat)(-u2 * turn));

    texture_view view;
    look_at_texture(t, *s, mask, p.samples, &view);
    const vfloat x = texture_band(p.texels, &view, 0), y = texture_band(p.texels, &view, 1);
    const v3 outward = scale3(s->normal, s->side);
    v3 bent;
    if (t.bands == 3) {
        const v3 right = unit3(mix3(along_u, (vfloat)1.0f, outward, -dot3(outward, along_u)));
        v3 up = cross3(outward, right);
        up = scale3(up, copysign((vfloat)1.0f, dot3(up, along_v)));
        bent = mix3(mix3(right, x, up, y), (vfloat)1.0f, outward, texture_band(p.texels, &view, 2));
    } else {
        /* The slope as a vector: x along u and y along v are its products with their directions (Mikkelsen 2010). */
        const v3 slope = mix3(cross3(along_v, outward), x, cross3(outward, along_u), y);
        const vfloat volume = dot3(outward, cross3(along_u, along_v));
        const vfloat per = size / select(volume, (vfloat)1.0f, volume == 0.0f);
        bent = mix3(outward, (vfloat)1.0f, slope, -select(per, (vfloat)0.0f, volume == 0.0f));
    }
    const vint lost = dot3(bent, bent) == 0.0f;
    bent.x = select(bent.x, outward.x, lost), bent.y = select(bent.y, outward.y, lost), bent.z = select(bent.z, outward.z, lost);
    bent = scale3(unit3(bent), s->side);
#ifndef BAKE
    /* A normal that leans away from the viewer is brought back to the edge of what is seen. */
    bent = unit3(mix3(bent, (vfloat)1.0f, s->view, -fmin(dot3(bent, s->view), 0.0f)));
#endif
    s->normal = bent;
    s->cos_view = fmax(dot3(bent, s->view), MIN_COS_VIEW);
#ifdef HAS_ANISOTROPY
    orient(s, s->tangent);
#endif
}
#endif
