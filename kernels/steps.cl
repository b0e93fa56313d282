/* How finely a texture's intervals must be cut for what a lobe makes of a texel's reflectance (src/render/texture_nodes.cpp has the
 * mathematics): only products and comparisons in double, so that the host comes to the same number. */
#include "prelude.h"

/* Whether a polynomial through degree + 1 even nodes on low...high is near enough to rho^power / (z - rho), z > 1. */
static int near_enough(double low, double high, double z, uint power, uint degree, double tolerance) {
    const double spacing = (high - low) / degree;
    double error = power == 2 ? z * z : power == 1 ? z : 1.0, bound = tolerance * (power == 2 ? high * high : power == 1 ? high : 1.0);
    /* k = 0 stands before the loop: as a choice within it Intel's compiler (2026.22) took 0.25 for every k. */
    error = error * (spacing * 0.25), bound = bound * (z - low);
    for (uint k = 1; k <= degree; ++k) {
        error = error * (spacing * (double)k);
        bound = bound * (z - low - spacing * k);
    }
    return error <= bound;
}

/* `found`: 1 at first, then the largest number of steps that any two neighbouring bands of any texel need, `most` at most; from 4 on
 * in fours, pieces of degree 4. A work-item takes every items-th texel. */
kernel void steps_needed(global const float* texels, ulong count, uint bands, double z, uint power, double tolerance, uint most, uint items, global uint* found) {
    const uint item = (uint)get_global_id(0);
    if (item >= items) return;
    uint steps = 1;
    for (ulong i = item; i < count; i += items) {
        for (uint b = 0; b + 1 < bands; ++b) {
            const float here = texels[i * bands + b], next = texels[i * bands + b + 1];
            const double high = fmin(fmax(here, next), 1.0f), low = fmin((double)fmin(here, next), high);
            while (steps < most && !near_enough(high - (high - low) * min(steps, 4u) / steps, high, z, power, min(steps, 4u), tolerance))
                steps += steps < 4 ? 1 : 4;
        }
    }
    if (steps > 1) atomic_max(found, steps);
}

/* The largest of `count` values that are not below zero, whose bits are in the order of the values; `found` was 0. */
kernel void largest_value(global const float* texels, ulong count, uint items, global uint* found) {
    const uint item = (uint)get_global_id(0);
    if (item >= items) return;
    float largest = 0.0f;
    for (ulong i = item; i < count; i += items) largest = fmax(largest, texels[i]);
    atomic_max(found, as_uint(largest));
}
