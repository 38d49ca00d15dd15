/* SPDX-License-Identifier: BSD-3-Clause
 * Summing up the visible blocks. */
#include "render/occupancy.h"

#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"

mtm_status mtm_occupancy_create(const mtm_blocks *blocks, mtm_occupancy *occupancy, mtm_error *error) {
    *occupancy = (mtm_occupancy){.cells_log2 = blocks->cells_log2};
    memcpy(occupancy->size, blocks->size, sizeof occupancy->size);
    const size_t sum_count =
        ((size_t)blocks->size[0] + 1) * ((size_t)blocks->size[1] + 1) * ((size_t)blocks->size[2] + 1);
    occupancy->is_visible = mtm_allocate(mtm_blocks_count(blocks), sizeof *occupancy->is_visible);
    occupancy->sums = mtm_allocate(sum_count, sizeof *occupancy->sums);
    if (occupancy->is_visible != NULL && occupancy->sums != NULL) return MTM_OK;
    mtm_occupancy_free(occupancy);
    return mtm_fail_memory(error, "empty-space skipping", sum_count * sizeof *occupancy->sums);
}

void mtm_occupancy_free(mtm_occupancy *occupancy) {
    free(occupancy->is_visible);
    free(occupancy->sums);
    *occupancy = (mtm_occupancy){0};
}

/* The sums of one layer: those of the layer before and of this layer's blocks. */
static void add_layer(mtm_occupancy *occupancy, size_t layer) {
    const size_t across = (size_t)occupancy->size[0];
    const size_t down = (size_t)occupancy->size[1];
    const unsigned char *is_visible = occupancy->is_visible + layer * across * down;
    const uint32_t *before = occupancy->sums + layer * (across + 1) * (down + 1);
    uint32_t *sums = occupancy->sums + (layer + 1) * (across + 1) * (down + 1);
    for (size_t y = 0; y < down; y++) {
        uint32_t in_row = 0;
        for (size_t x = 0; x < across; x++) {
            const size_t at = (y + 1) * (across + 1) + x + 1;
            const size_t above = at - (across + 1);
            in_row += is_visible[y * across + x];
            sums[at] = in_row + before[at] + sums[above] - before[above];
        }
    }
}

void mtm_occupancy_update(mtm_occupancy *occupancy, const mtm_blocks *blocks, const mtm_transfer *transfer) {
    const size_t count = mtm_blocks_count(blocks);
    for (size_t i = 0; i < count; i++)
        occupancy->is_visible[i] =
            mtm_transfer_is_visible(transfer, (double)blocks->lowest[i], (double)blocks->highest[i]);
    for (size_t layer = 0; layer < (size_t)blocks->size[2]; layer++) add_layer(occupancy, layer);
}
