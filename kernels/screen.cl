/* What a display shows of a picture that a detector takes: sums over the bands for each channel, a matrix to X Y Z, one to the drives of
 * three primaries, and their spectra; in double, in the order of operations that the host uses (shownOn() in src/render/shown.cpp). */
#include "prelude.h"

/* In place, rows [row][band][pitch] that begin at row `first` of the picture; a work-item VW pixels of a row. weights:
 * [channel][band]; matrix: to X Y Z, [3][channel]; drives: X Y Z to drives, 3 rows of 3; primaries: [3][band];
 * bad: the first pixel, row by row, whose channels are no finite numbers (it was all ones); clipped: the number of pixels that
 * the display cannot show. */
kernel void show_on_screen(global float* cube, uint pitch, uint width, uint rows, uint bands, uint first, uint channels,
                           global const double* weights, global const double* matrix, constant double* drives,
                           global const double* primaries, global ulong* bad, global ulong* clipped) {
    const uint across = pitch / VW, row = (uint)get_global_id(0) / across, x = (uint)get_global_id(0) % across * VW;
    if (row >= rows || x >= width) return;
    global float* pixels = cube + (size_t)row * bands * pitch + x;
    vdouble xyz[3] = {0.0, 0.0, 0.0};
    vint finite = -1;
    for (uint c = 0; c < channels; ++c) {
        vdouble sum = 0.0;
        for (uint j = 0; j < bands; ++j) sum = sum + weights[c * bands + j] * V_DOUBLE(VLOAD(pixels + (size_t)j * pitch));
        finite &= V_INT(isfinite(sum)) != 0;
        for (uint k = 0; k < 3; ++k) xyz[k] = xyz[k] + matrix[k * channels + c] * sum;
    }
    vdouble drive[3];
    vint outside = 0;
    for (uint k = 0; k < 3; ++k) {
        drive[k] = drives[3 * k] * xyz[0] + drives[3 * k + 1] * xyz[1] + drives[3 * k + 2] * xyz[2];
        /* Rounding alone is no clipping. */
        outside |= V_INT(drive[k] < -1e-6 | drive[k] > 1 + 1e-6) != 0;
        drive[k] = drive[k] < 0.0 ? (vdouble)0.0 : drive[k];
        drive[k] = drive[k] > 1.0 ? (vdouble)1.0 : drive[k];
    }
    for (uint j = 0; j < bands; ++j)
        VSTORE(V_FLOAT(drive[0] * primaries[j] + drive[1] * primaries[bands + j] + drive[2] * primaries[2 * bands + j]), pixels + (size_t)j * pitch);
    int ends[VW], beyond[VW];
    VSTORE(finite, ends);
    VSTORE(outside, beyond);
    for (uint lane = 0; lane < VW && x + lane < width; ++lane) {
        if (ends[lane] == 0) atom_min(bad, (ulong)(first + row) * width + x + lane);
        if (beyond[lane] != 0) atom_inc(clipped);
    }
}
