/* Which materials a block of pixels sees, and so how many terms it needs: the shape of the term image. */
#include "blocks.h"

/* One work-item a block, on every device (it is a small part of the work). sets: `words` of 32 bits a block, a bit a material;
 * block_terms: how many terms the block has. */
kernel void find_materials(global const ulong* keys, global const uint* triangle_material, global const sd_material* materials,
                           sd_frame frame, uint words, uint blocks, global uint* sets, global uint* block_terms) {
    const uint block = (uint)get_global_id(0);
    if (block >= blocks) return;
    global uint* set = sets + (size_t)block * words;
    for (uint w = 0; w < words; ++w) set[w] = 0;
    global const ulong* lanes = keys + (size_t)block * SD_BLOCK * SLOTS;
    uint last = 0;
    int known = 0; /* whether `last` has been seen yet */
    for (int lane = 0; lane < SD_BLOCK * SLOTS; lane += VW) {
        const vuint id = V_UINT(VLOAD(lanes + lane) & 0xffffffffUL);
        if (known && ALL(id == last)) continue;
        uint ids[VW];
        VSTORE(id, ids);
        for (int i = 0; i < VW; ++i) {
            if (known && ids[i] == last) continue;
            last = ids[i];
            known = 1;
            const uint m = material_of(last, triangle_material);
            set[m >> 5] |= 1u << (m & 31);
        }
    }
    uint terms = 0;
    for (uint w = 0; w < words; ++w)
        for (uint bits = set[w]; bits != 0; bits &= bits - 1) terms += materials[w * 32 + 31 - clz(bits & -bits)].terms;
    block_terms[block] = terms;
}

/* Exclusive prefix sum of `count` numbers; sums[count] is the total. */
kernel void scan_terms(global const uint* numbers, uint count, global uint* sums) {
    uint sum = 0;
    for (uint i = 0; i < count; ++i) {
        sums[i] = sum;
        sum += numbers[i];
    }
    sums[count] = sum;
}

/* The terms of each block, materials ascending, from block_first[block] on. */
kernel void list_terms(global const sd_material* materials, global const uint* sets, uint words, uint blocks,
                       global const uint* block_first, global uint* block_term) {
    const uint block = (uint)get_global_id(0);
    if (block >= blocks) return;
    uint at = block_first[block];
    for (uint w = 0; w < words; ++w) {
        for (uint bits = sets[(size_t)block * words + w]; bits != 0; bits &= bits - 1) {
            const sd_material m = materials[w * 32 + 31 - clz(bits & -bits)];
            for (uint t = 0; t < m.terms; ++t) block_term[at++] = m.first_term + t;
        }
    }
}
