/* Boxes of the tree of what throws shadows (types.h, SD_LEAF_CASTERS), in camera space, made anew whenever the camera moves.
 * A box is six floats: its least corner, its greatest. */
#include "caster.h"

kernel void bound_leaves(global const uint* index, global const float* camera, global const uint* casters, uint caster_count,
                         uint leaves, global float* bounds) {
    const uint leaf = (uint)get_global_id(0);
    if (leaf >= leaves) return;
    box whole = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    const uint end = first_caster(leaf + 1, caster_count, leaves);
    for (uint i = first_caster(leaf, caster_count, leaves); i < end; ++i) {
        const box own = box_of(index + 3 * (size_t)casters[i], camera);
        for (int axis = 0; axis < 3; ++axis) {
            whole.low[axis] = least(own.low[axis], whole.low[axis]);
            whole.high[axis] = greatest(own.high[axis], whole.high[axis]);
        }
    }
    store_box(whole, bounds + 6 * (size_t)(leaves + leaf));
}

/* The nodes first … first + count - 1, from their children. */
kernel void bound_nodes(uint first, uint count, global float* bounds) {
    const uint node = first + (uint)get_global_id(0);
    if (node >= first + count) return;
    const global float* a = bounds + 12 * (size_t)node;
    const global float* b = a + 6;
    box whole;
    for (int axis = 0; axis < 3; ++axis) {
        whole.low[axis] = least(b[axis], a[axis]);
        whole.high[axis] = greatest(b[3 + axis], a[3 + axis]);
    }
    store_box(whole, bounds + 6 * (size_t)node);
}
