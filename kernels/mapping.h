/* Images that are looked up by the pixel or by a direction, not by the surface's coordinates: what is behind everything, and what
 * mirrors show. */
#include "lobes.h"

#ifdef HAS_MAPPING
/* Coordinates of the sample in the picture itself. */
static surface by_pixel(surface s, sd_frame frame, vfloat x, vfloat y) {
    s.u = x / (float)(frame.width * SD_SUBPIXEL) + 0.5f;
    s.v = 0.5f - y / (float)(frame.height * SD_SUBPIXEL);
    return s;
}

/* Coordinates of a direction (camera space, any length) in six faces, one below the other: +x -x +y -y +z -z of the world as
 * someone inside sees them (makeCubeView). Half a texel inside a face's border no filter reaches the next face. */
static surface by_direction(surface s, v3 d, sd_frame frame, int side) {
    const vfloat x = fma(d.z, (vfloat)frame.to_world[2], fma(d.y, (vfloat)frame.to_world[1], d.x * frame.to_world[0]));
    const vfloat y = fma(d.z, (vfloat)frame.to_world[5], fma(d.y, (vfloat)frame.to_world[4], d.x * frame.to_world[3]));
    const vfloat z = fma(d.z, (vfloat)frame.to_world[8], fma(d.y, (vfloat)frame.to_world[7], d.x * frame.to_world[6]));
    const vfloat ax = fabs(x), ay = fabs(y), az = fabs(z);
    const vint on_x = (ax >= ay) & (ax >= az), on_y = !on_x & (ay >= az);
    const vfloat along = select(select(z, y, on_y), x, on_x), size = fabs(along);
    const vint below = along < 0.0f;
    const vfloat right = select(select(select(-x, x, below), x, on_y), select(z, -z, below), on_x);
    const vfloat up = select(y, select(z, -z, below), on_y);
    const vfloat half_by_size = 0.5f / select(size, (vfloat)1.0f, size == 0.0f);
    const float border = 0.5f / (float)side;
    const vfloat face = select(select((vfloat)4.0f, (vfloat)2.0f, on_y), (vfloat)0.0f, on_x) + select((vfloat)0.0f, (vfloat)1.0f, below);
    const vfloat down = clamp(0.5f - up * half_by_size, border, 1.0f - border);
    s.u = clamp(fma(right, half_by_size, (vfloat)0.5f), border, 1.0f - border);
    s.v = 1.0f - (face + down) * (1.0f / 6.0f);
    return s;
}

/* What a mirror shows: functions of the angle times the image's bands, terms [function][band]. */
static void reflection(sd_lobe lobe, global const sd_piece* tables, sd_frame frame, surface s, vint mask, paint p, vfloat x, vfloat y,
                       global float* term) {
    const sd_texture t = p.textures[lobe.texture - 1];
    if (lobe.mapping == SD_MAP_CUBE) {
        const vfloat twice = 2.0f * dot3(s.normal, s.view);
        const v3 d = {fma(twice, s.normal.x, -s.view.x), fma(twice, s.normal.y, -s.view.y), fma(twice, s.normal.z, -s.view.z)};
        s = by_direction(s, d, frame, t.width);
    } else {
        s = by_pixel(s, frame, x, y);
    }
    const table_cell cell = cell_of(s.cos_view);
    for (uint f = 0; f < lobe.functions; ++f)
        add_painted(lobe, p, s, look_up(tables + lobe.table + f * SD_CELLS, cell), mask, 1, term + (size_t)f * t.bands * SD_BLOCK);
}

/* The image behind everything. */
static void backdrop(sd_lobe lobe, sd_frame frame, vint mask, paint p, vfloat x, vfloat y, global float* term) {
    surface s;
    s.u = s.v = 0.0f;
#ifdef HAS_MIP
    s.u_x = s.v_x = s.u_y = s.v_y = 0.0f; /* the finest level */
#endif
    if (lobe.mapping == SD_MAP_CUBE) {
        v3 ray = {(vfloat)0.0f, (vfloat)0.0f, (vfloat)-1.0f};
        if (!frame.orthographic) ray.x = x * frame.slope_per_subpixel, ray.y = -(y * frame.slope_per_subpixel);
        s = by_direction(s, ray, frame, p.textures[lobe.texture - 1].width);
    } else {
        s = by_pixel(s, frame, x, y);
    }
    add_painted(lobe, p, s, 1.0f, mask, 1, term);
}
#endif
