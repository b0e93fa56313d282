/* Sizes and offsets of the shared structs as this device's compiler sees them; a test compares them with the host's. */
#include "types.h"

#define OFFSET(type, member) (uint)((global char*)&((global type*)0)->member - (global char*)0)

kernel void layout_probe(global uint* out) {
    out[0] = sizeof(sd_frame);
    out[1] = OFFSET(sd_frame, tiles_y);
    out[2] = sizeof(sd_draw);
    out[3] = OFFSET(sd_draw, normal);
    out[4] = sizeof(sd_vertex);
    out[5] = sizeof(sd_large);
    out[6] = OFFSET(sd_large, key);
    out[7] = sizeof(sd_light);
    out[8] = OFFSET(sd_light, group);
    out[9] = sizeof(sd_lobe);
    out[10] = sizeof(sd_piece);
    out[11] = sizeof(sd_material);
    out[12] = sizeof(sd_texture);
    out[13] = OFFSET(sd_texture, place);
}
