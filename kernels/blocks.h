/* How work-items share blocks. A block is SD_BLOCK pixels of one row; its lanes are SD_BLOCK * SLOTS samples, [x][slot].
 * CPUs: one work-item a block, VW lanes at a time. GPUs: a work-group of SD_BLOCK items a block, an item a pixel. */
#include "prelude.h"

#if VW == 1
#define BLOCK_GROUP __attribute__((reqd_work_group_size(SD_BLOCK, 1, 1)))
#define BLOCK_ID ((uint)get_group_id(0))
#define FIRST_LANE ((int)get_local_id(0) * SLOTS)
#define END_LANE (FIRST_LANE + SLOTS)
#define FIRST_PIXEL ((int)get_local_id(0))
#else
#define BLOCK_GROUP __attribute__((reqd_work_group_size(1, 1, 1)))
#define BLOCK_ID ((uint)get_global_id(0))
#define FIRST_LANE 0
#define END_LANE (SD_BLOCK * SLOTS)
#define FIRST_PIXEL 0
#endif

/* The material of what a sample sees; material 0 is the background. */
static inline uint material_of(uint triangle, global const uint* triangle_material) {
    return triangle == NO_TRIANGLE ? 0 : triangle_material[triangle];
}
