/* Vertices: object space to camera space (double, so that places far from the origin keep their detail) and to the screen. */
#include "prelude.h"

/* One work-item a vertex. position, normal: 3 floats a vertex; draw: which placement. */
kernel void transform(global const float* position, global const float* normal, global const uint* draw,
                      global const sd_draw* draws, global const float* coordinates, sd_frame frame, uint count,
                      global float* camera, global float* camera_normal, global sd_vertex* screen) {
    const uint v = (uint)get_global_id(0);
    if (v >= count) return;
    const global sd_draw* d = draws + draw[v];
    const double px = position[3 * v], py = position[3 * v + 1], pz = position[3 * v + 2];
    const double x = fma(d->to_camera[0], px, fma(d->to_camera[1], py, fma(d->to_camera[2], pz, d->to_camera[3])));
    const double y = fma(d->to_camera[4], px, fma(d->to_camera[5], py, fma(d->to_camera[6], pz, d->to_camera[7])));
    const double z = fma(d->to_camera[8], px, fma(d->to_camera[9], py, fma(d->to_camera[10], pz, d->to_camera[11])));
    camera[3 * v] = (float)x;
    camera[3 * v + 1] = (float)y;
    camera[3 * v + 2] = (float)z;

    /* Clipping decides on the same float depth and the same slopes that clip.cl cuts with. */
#ifdef BAKE
    /* On the screen lie texture coordinates, (0,0) bottom left; nothing is nearer than anything else. */
    const double depth = 1.0, reach = 1.0;
    const double sx = ((double)coordinates[2 * v] - 0.5) * frame.width, sy = (0.5 - (double)coordinates[2 * v + 1]) * frame.height;
#else
    const double depth = -z;
    const double reach = frame.orthographic ? 1.0 : depth;
    const double sx = x * frame.pixels_per_slope, sy = -y * frame.pixels_per_slope;
#endif
    const double guard = (double)SD_GUARD * reach;
    sd_vertex s;
    s.outside = (depth < (double)SD_NEAR ? SD_OUT_NEAR : 0) | (sx < -guard ? SD_OUT_LEFT : 0) | (sx > guard ? SD_OUT_RIGHT : 0) |
                (sy < -guard ? SD_OUT_TOP : 0) | (sy > guard ? SD_OUT_BOTTOM : 0);
    s.x = s.outside ? 0 : convert_int_rte(sx / reach * SD_SUBPIXEL);
    s.y = s.outside ? 0 : convert_int_rte(sy / reach * SD_SUBPIXEL);
    s.depth_key = s.outside ? 0.0f : frame.orthographic ? (float)depth : (float)(1.0 / depth);
    screen[v] = s;

    const float nx = normal[3 * v], ny = normal[3 * v + 1], nz = normal[3 * v + 2];
    camera_normal[3 * v] = fma(d->normal[0], nx, fma(d->normal[1], ny, d->normal[2] * nz));
    camera_normal[3 * v + 1] = fma(d->normal[3], nx, fma(d->normal[4], ny, d->normal[5] * nz));
    camera_normal[3 * v + 2] = fma(d->normal[6], nx, fma(d->normal[7], ny, d->normal[8] * nz));
}

/* The same for directions in the surface, where materials want them. */
kernel void transform_tangents(global const float* tangent, global const uint* draw, global const sd_draw* draws, uint count,
                               global float* camera_tangent) {
    const uint v = (uint)get_global_id(0);
    if (v >= count) return;
    const global sd_draw* d = draws + draw[v];
    const double tx = tangent[3 * v], ty = tangent[3 * v + 1], tz = tangent[3 * v + 2];
    for (int row = 0; row < 3; ++row)
        camera_tangent[3 * v + row] =
            (float)fma(d->to_camera[4 * row], tx, fma(d->to_camera[4 * row + 1], ty, d->to_camera[4 * row + 2] * tz));
}
