/* Surfaces that are rougher along one axis than along the other: functions of a direction's height and azimuth. Included by lobes.h. */
#ifdef HAS_ANISOTROPY

/* A vector in the surface's own frame: x along the texture's u, y across it, z along the normal. */
static inline v3 local_of(surface s, v3 d) {
    const v3 r = {dot3(s.tangent, d), dot3(s.bitangent, d), dot3(s.normal, d)};
    return r;
}

/* x of a direction's azimuth, -1 where the surface is roughest and 1 where it is smoothest: linear in 1 / (alpha + 0.15 of the
 * larger alpha), alpha the width that the azimuth sees. Albedos are nearly straight in it (design.md). */
static vfloat azimuth_of(sd_lobe lobe, v3 d) {
    const float low = fmin(lobe.alpha, lobe.alpha_v), high = fmax(lobe.alpha, lobe.alpha_v);
    const float shift = 0.15f * high, most = 1.0f / (low + shift), least = 1.0f / (high + shift);
    const vfloat u2 = d.x * d.x, v2 = d.y * d.y, across = u2 + v2;
    const vfloat square = fma(v2, (vfloat)(lobe.alpha_v * lobe.alpha_v), u2 * (lobe.alpha * lobe.alpha));
    const vfloat width = sqrt(square / select(across, (vfloat)1.0f, across == 0.0f));
    return fmin(fmax((2.0f / (width + shift) - (most + least)) / (most - least), -1.0f), 1.0f);
}

static vfloat look_up_round(global const sd_piece* table, table_cell at, vfloat x) {
    vfloat sum = look_up(table + (SD_AZIMUTHS - 1) * SD_CELLS, at);
    for (int k = SD_AZIMUTHS - 2; k >= 0; --k) sum = fma(sum, x, look_up(table + k * SD_CELLS, at));
    return sum;
}

#endif
