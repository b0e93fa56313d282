/* A reflectance: the image under equal-energy light divided by what a perfect white diffuser sends back at the same place. All images
 * are rows [row][band][pitch]; white and coverage have one band and all rows of the picture. */
#include "prelude.h"

/* The first pixel, row by row, where something is seen that no light reaches: `found` was all ones. A work-item a row. */
kernel void find_dark(global const float* white, global const float* coverage, uint pitch, uint width, uint rows, global ulong* found) {
    const uint row = (uint)get_global_id(0);
    if (row >= rows) return;
    for (uint x = 0; x < width; ++x) {
        const size_t at = (size_t)row * pitch + x;
        if (!(white[at] > 0.0f) && coverage[at] > 0.0f) {
            atom_min(found, (ulong)row * width + x);
            return;
        }
    }
}

/* Divides the rows of a strip, which begins at row `first` of the picture, where light arrives. A work-item VW pixels of a row. */
kernel void divide_by_white(global float* cube, global const float* white, uint pitch, uint rows, uint bands, uint first) {
    const uint across = pitch / VW, row = (uint)get_global_id(0) / across, x = (uint)get_global_id(0) % across * VW;
    if (row >= rows) return;
    const vfloat diffuser = VLOAD(white + (size_t)(first + row) * pitch + x);
    const vint lit = diffuser > 0.0f;
    const vdouble divisor = V_DOUBLE(select((vfloat)1.0f, diffuser, lit));
    global float* at = cube + (size_t)row * bands * pitch + x;
    for (uint band = 0; band < bands; ++band, at += pitch) {
        const vfloat value = VLOAD(at);
        VSTORE(select(value, V_FLOAT(V_DOUBLE(value) / divisor), lit), at);
    }
}
