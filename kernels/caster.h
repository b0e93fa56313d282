/* Triangles that throw shadows and the boxes around them. */
#include "prelude.h"

#include "facet.h"

typedef struct box {
    float low[3], high[3];
} box;

static inline uint first_caster(uint leaf, uint casters, uint leaves) { return (uint)((ulong)leaf * casters / leaves); }

static inline box box_of(global const uint* corner, global const float* camera) {
    box b;
    const global float* p0 = camera + 3 * (size_t)corner[0];
    const global float* p1 = camera + 3 * (size_t)corner[1];
    const global float* p2 = camera + 3 * (size_t)corner[2];
    for (int axis = 0; axis < 3; ++axis) {
        b.low[axis] = least(p2[axis], least(p1[axis], p0[axis]));
        b.high[axis] = greatest(p2[axis], greatest(p1[axis], p0[axis]));
    }
    return b;
}

static inline float size_of_box(box b) {
    float size = 0.0f;
    for (int axis = 0; axis < 3; ++axis) size = greatest(greatest(fabs(b.low[axis]), fabs(b.high[axis])), size);
    return size;
}

static inline void store_box(box b, global float* at) {
    for (int axis = 0; axis < 3; ++axis) at[axis] = b.low[axis], at[3 + axis] = b.high[axis];
}
