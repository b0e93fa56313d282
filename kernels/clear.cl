/* Every sample of a strip empty again. */
#include "prelude.h"

kernel void clear_keys(global ulong* keys, ulong count) {
    const size_t at = get_global_id(0) * 16;
    if (at + 16 <= count) {
        vstore16((ulong16)EMPTY_KEY, 0, keys + at);
    } else {
        for (size_t i = at; i < count; ++i) keys[i] = EMPTY_KEY;
    }
}
