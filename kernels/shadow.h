/* Shadows: whether a triangle stands between a surface and a light. Vectors of rays to one light against one box or triangle at a
 * time; a ray asks a triangle only if it meets the triangle's own box, and boxes of nodes hold those of their triangles in these very
 * numbers, so that the tree answers exactly as if every triangle were asked. */
#include "caster.h"
#include "surface.h"

#ifdef HAS_SHADOWS

typedef struct caster_tree {
    global const uint* index;
    global const float* camera;
    global const uint* casters;
    global const float* bounds;
    uint count, leaves; /* 0 leaves: nothing throws shadows */
} caster_tree;

typedef struct ray {
    v3 from;    /* m */
    v3 along;   /* to the light itself, or, if that is infinitely far, towards it */
    v3 inverse; /* of its coordinates, none of which is 0 */
    vfloat size; /* of the start's coordinates the largest */
    float end;   /* 1: the light; beyond everything if it is infinitely far */
    float light_size; /* of the light's coordinates the largest; 0 if it is infinitely far */
} ray;

static inline vfloat not_zero(vfloat a) { return select(a, copysign((vfloat)1e-30f, a), fabs(a) < 1e-30f); }

static inline ray ray_to(sd_light light, v3 from) {
    ray r;
    r.from = from;
    r.size = max(max(fabs(from.x), fabs(from.y)), fabs(from.z));
    r.end = light.type == SD_LIGHT_DIRECTIONAL ? 1e30f : 1.0f;
    r.light_size = light.type == SD_LIGHT_DIRECTIONAL ? 0.0f : greatest(greatest(fabs(light.x), fabs(light.y)), fabs(light.z));
    r.along.x = light.x, r.along.y = light.y, r.along.z = light.z;
    if (light.type != SD_LIGHT_DIRECTIONAL) r.along.x -= from.x, r.along.y -= from.y, r.along.z -= from.z;
    r.inverse.x = 1.0f / not_zero(r.along.x);
    r.inverse.y = 1.0f / not_zero(r.along.y);
    r.inverse.z = 1.0f / not_zero(r.along.z);
    return r;
}

/* Where along the ray it is between two planes; widened by what rounding may have moved them. */
static inline void between(vfloat low, vfloat high, vfloat inverse, vfloat wider, vfloat* enter, vfloat* leave) {
    const vfloat a = (low - wider) * inverse, b = (high + wider) * inverse;
    *enter = max(*enter, min(a, b));
    *leave = min(*leave, max(a, b));
}

static vint meets_box(ray r, box b) {
    const vfloat wider = (r.size + size_of_box(b)) * 0x1p-20f;
    vfloat enter = 0.0f, leave = r.end;
    between(b.low[0] - r.from.x, b.high[0] - r.from.x, r.inverse.x, wider, &enter, &leave);
    between(b.low[1] - r.from.y, b.high[1] - r.from.y, r.inverse.y, wider, &enter, &leave);
    between(b.low[2] - r.from.z, b.high[2] - r.from.z, r.inverse.z, wider, &enter, &leave);
    return enter <= leave;
}

/* Twice the ray's moment about the edge from a to b, corners relative to the ray's start: of two triangles that share the edge one
 * gets exactly the other's with the other sign, so that no ray slips through between them. */
static inline vfloat moment(v3 a, v3 b, v3 along) {
    const v3 edge = {b.x - a.x, b.y - a.y, b.z - a.z};
    return dot3(cross3(edge, add3(a, b)), along);
}

static inline v3 corner_from(const global float* p, v3 from) {
    const v3 r = {p[0] - from.x, p[1] - from.y, p[2] - from.z};
    return r;
}

/* Between the ray's ends, but not so near to either that rounding would decide: a lamp that lies in a surface is not hidden by it. */
static vint meets_triangle(ray r, global const uint* corner, const global float* camera) {
    const global float* p0 = camera + 3 * (size_t)corner[0];
    const global float* p1 = camera + 3 * (size_t)corner[1];
    const global float* p2 = camera + 3 * (size_t)corner[2];
    const v3 a = corner_from(p0, r.from), b = corner_from(p1, r.from), c = corner_from(p2, r.from);
    const vfloat u = moment(a, b, r.along), v = moment(b, c, r.along), w = moment(c, a, r.along);
    const vint inside = ((u >= 0.0f) & (v >= 0.0f) & (w >= 0.0f)) | ((u <= 0.0f) & (v <= 0.0f) & (w <= 0.0f));
    if (!ANY(inside)) return inside;
    const facet plane = facet_of(p0, p1, p2);
    const v3 normal = {(vfloat)plane.x, (vfloat)plane.y, (vfloat)plane.z};
    v3 to = a;
    if (plane.corner == 1) to = b;
    if (plane.corner == 2) to = c;
    const vfloat speed = dot3(normal, r.along);
    const vfloat ahead = dot3(normal, to) * copysign((vfloat)1.0f, speed);
    const vfloat here = (fabs(to.x) + fabs(to.y) + fabs(to.z)) * (plane.edges * 0x1p-21f);
    const float there = steepness(plane) * (greatest(greatest(greatest(size_of(p0), size_of(p1)), size_of(p2)), r.light_size) * 0x1p-19f);
    return inside & (ahead > here) & (ahead < fma(fabs(speed), (vfloat)r.end, (vfloat)-there));
}

/* Lanes of `asked` from which the light is seen: no triangle stands between. */
static vint unhidden(caster_tree tree, sd_light light, v3 from, vint asked) {
    const ray r = ray_to(light, from);
    vint open = asked;
    uint node = tree.leaves == 0 ? 0 : 1;
    while (node != 0) {
        const global float* at = tree.bounds + 6 * (size_t)node;
        const box b = {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
        if (ANY(open & meets_box(r, b))) {
            if (node < tree.leaves) {
                node *= 2;
                continue;
            }
            const uint end = first_caster(node - tree.leaves + 1, tree.count, tree.leaves);
            for (uint i = first_caster(node - tree.leaves, tree.count, tree.leaves); i < end; ++i) {
                global const uint* corner = tree.index + 3 * (size_t)tree.casters[i];
                const vint met = open & meets_triangle(r, corner, tree.camera);
                if (ANY(met)) open &= (met & meets_box(r, box_of(corner, tree.camera))) == 0;
            }
            if (!ANY(open)) break;
        }
        /* On to what is right of it: up from right children, then to the sibling. */
        node >>= popcount(node & ~(node + 1));
        node += node == 0 ? 0 : 1;
    }
    return open;
}

#endif
