/* A strip of a rendered image as texels of a texture: rows [row][band][pitch] become [pixel][band]. Averages under slits become
 * the values at the nodes of the piecewise-linear curve that has them: a tridiagonal system a pixel (src/spectrum/mass_matrix.h),
 * in double, in the order of operations that the host uses for files, so that a chain of passes is bit for bit the same. */
#include "prelude.h"

/* Each work-item takes vectors of VW pixels in turn, its own rows of `scratch` (bands * VW doubles) for the sums on the way.
 * area: of each band's hat, nm (1 where values are points); forward: off[j - 1] / pivot[j - 1] for j > 0; off: ∫ h_j h_j+1, nm;
 * inverse: 1 / pivot; points != 0: values are taken as they are; first: texels before this strip's, in pixels; above_zero != 0: what
 * comes out below zero is set to it, and counted in the item's own element of `clipped`. */
kernel void nodal_texels(global const float* cube, uint pitch, uint width, uint rows, uint bands, uint points, global const double* area,
                         global const double* forward, global const double* off, global const double* inverse,
                         global double* scratch, uint items, ulong first, uint above_zero, global ulong* clipped, global float* texels) {
    const uint item = (uint)get_global_id(0);
    if (item >= items) return;
    const uint across = (width + VW - 1) / VW;
    ulong lost = 0;
    global double* own = scratch + (size_t)item * bands * VW;
    for (uint vector = item; vector < rows * across; vector += items) {
        const uint row = vector / across, x = vector % across * VW;
        global const float* from = cube + (size_t)row * bands * pitch + x;
        global float* to = texels + (first + (size_t)row * width + x) * bands;
        const uint lanes = min((uint)VW, width - x);
        vdouble before = 0.0;
        for (uint j = 0; j < bands && points == 0; ++j) {
            vdouble here = V_DOUBLE(VLOAD(from + (size_t)j * pitch)) * area[j];
            if (j > 0) here = here - forward[j] * before;
            VSTORE(here, own + (size_t)j * VW);
            before = here;
        }
        vdouble after = 0.0;
        for (uint j = bands; j-- > 0;) {
            vdouble here;
            if (points) {
                here = V_DOUBLE(VLOAD(from + (size_t)j * pitch));
            } else {
                here = VLOAD(own + (size_t)j * VW);
                if (j + 1 < bands) here = here - off[j] * after;
                here = here * inverse[j];
            }
            after = here;
            float value[VW];
            if (above_zero) {
                int below[VW];
                VSTORE(V_INT(here < 0.0), below);
                for (uint lane = 0; lane < lanes; ++lane) lost += below[lane] != 0;
                here = here < 0.0 ? (vdouble)0.0 : here;
            }
            VSTORE(V_FLOAT(here), value);
            for (uint lane = 0; lane < lanes; ++lane)
                to[(size_t)lane * bands + j] = value[lane];
        }
    }
    if (lost > 0) clipped[item] += lost;
}
