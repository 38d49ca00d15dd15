/* SPDX-License-Identifier: BSD-3-Clause
 * Which blocks of a volume the transfer function shows, summed up so that "any in this box?" costs eight loads.
 * Crow, "Summed-area tables for texture mapping", SIGGRAPH 1984 (here in three dimensions). */
#ifndef METAMER_RENDER_OCCUPANCY_H
#define METAMER_RENDER_OCCUPANCY_H

#include "metamer/transfer.h"
#include "volume/blocks.h"

typedef struct mtm_occupancy {
    int cells_log2;
    int size[3];               /* blocks */
    unsigned char *is_visible; /* x fastest */
    uint32_t *sums;            /* (size + 1)³: visible blocks below (x, y, z) */
} mtm_occupancy;

/* Memory for the blocks; nothing is visible. Release with mtm_occupancy_free. MTM_MEMORY. */
MTM_CHECK mtm_status mtm_occupancy_create(const mtm_blocks *blocks, mtm_occupancy *occupancy,
                                          mtm_error *error);
void mtm_occupancy_free(mtm_occupancy *occupancy);

void mtm_occupancy_update(mtm_occupancy *occupancy, const mtm_blocks *blocks, const mtm_transfer *transfer);

/* Whether one of the blocks first … last is visible; both lie in the volume. */
static inline bool mtm_occupancy_any_of(const mtm_occupancy *occupancy, const int32_t first[3],
                                        const int32_t last[3]) {
    const size_t row = (size_t)occupancy->size[0] + 1;
    const size_t layer = row * ((size_t)occupancy->size[1] + 1);
    const uint32_t *near = occupancy->sums + (size_t)first[2] * layer;
    const uint32_t *far = occupancy->sums + ((size_t)last[2] + 1) * layer;
    const size_t x0 = (size_t)first[0];
    const size_t x1 = (size_t)last[0] + 1;
    const size_t y0 = (size_t)first[1] * row;
    const size_t y1 = ((size_t)last[1] + 1) * row;
    const uint32_t far_sum = far[y1 + x1] - far[y1 + x0] - far[y0 + x1] + far[y0 + x0];
    const uint32_t near_sum = near[y1 + x1] - near[y1 + x0] - near[y0 + x1] + near[y0 + x0];
    return far_sum != near_sum;
}

/* Whether a block that touches the box low … high (voxel coordinates, may reach outside) is visible. */
static inline bool mtm_occupancy_any(const mtm_occupancy *occupancy, const double low[3],
                                     const double high[3]) {
    int32_t first[3];
    int32_t last[3];
    for (int axis = 0; axis < 3; axis++) {
        const int32_t limit = occupancy->size[axis] - 1;
        const double end = (double)occupancy->size[axis] * (1 << occupancy->cells_log2);
        if (!(high[axis] >= 0) || !(low[axis] <= end)) return false;
        first[axis] = low[axis] > 0 ? (int32_t)low[axis] >> occupancy->cells_log2 : 0;
        last[axis] = high[axis] < end ? (int32_t)high[axis] >> occupancy->cells_log2 : limit;
        if (first[axis] > limit) first[axis] = limit;
        if (last[axis] > limit) last[axis] = limit;
    }
    return mtm_occupancy_any_of(occupancy, first, last);
}

#endif
