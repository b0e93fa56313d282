/* The smaller levels of a texture: each texel of half the size is the mean of the area that it covers, in double, in the order of
 * operations that the host uses for textures of its own (halved() in src/render/texels.cpp). */
#include "prelude.h"

/* Which texels of a row of `from` one of a row of `to` covers, and with which shares: three at most, since a side is halved. */
typedef struct cover {
    uint first, count;
    double share[3];
} cover;

static cover cover_of(uint i, uint from, uint to) {
    const double begin = (double)i * from / to, end = (double)(i + 1) * from / to;
    cover c;
    c.first = (uint)begin;
    c.count = 0;
    for (uint k = c.first; k < end && c.count < 3; ++k)
        c.share[c.count++] = (fmin((double)(k + 1), end) - fmax((double)k, begin)) / (end - begin);
    return c;
}

/* A work-item a texel of the smaller level; from, to: first floats of the levels in `texels`, [(row * width + column) * bands + band]. */
kernel void halve_texels(global float* texels, ulong from, uint width, uint height, ulong to, uint half_width, uint half_height, uint bands) {
    const size_t item = get_global_id(0);
    if (item >= (size_t)half_width * half_height) return;
    const cover columns = cover_of((uint)(item % half_width), width, half_width), rows = cover_of((uint)(item / half_width), height, half_height);
    global const float* corner = texels + from + ((size_t)rows.first * width + columns.first) * bands;
    global float* out = texels + to + item * bands;
    uint band = 0;
    for (; band + VW <= bands; band += VW) {
        vdouble sum = 0.0;
        for (uint r = 0; r < rows.count; ++r)
            for (uint c = 0; c < columns.count; ++c)
                sum = sum + rows.share[r] * columns.share[c] * V_DOUBLE(VLOAD(corner + ((size_t)r * width + c) * bands + band));
        VSTORE(V_FLOAT(sum), out + band);
    }
    for (; band < bands; ++band) {
        double sum = 0.0;
        for (uint r = 0; r < rows.count; ++r)
            for (uint c = 0; c < columns.count; ++c)
                sum = sum + rows.share[r] * columns.share[c] * (double)corner[((size_t)r * width + c) * bands + band];
        out[band] = (float)sum;
    }
}
