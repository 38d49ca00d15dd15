/* SPDX-License-Identifier: BSD-3-Clause
 * Smallest and largest value of every block of cells, for empty-space skipping. */
#ifndef METAMER_VOLUME_BLOCKS_H
#define METAMER_VOLUME_BLOCKS_H

#include "metamer/volume.h"

/* Blocks of 2^cells_log2 cells along an edge; a block's values include the voxels on its far faces, because
 * interpolation inside it reads them. */
typedef struct mtm_blocks {
    int cells_log2;
    int size[3];   /* blocks along each axis, ≥ 1 */
    float *lowest; /* physical values, x fastest; rounded outward */
    float *highest;
} mtm_blocks;

/* Release with mtm_blocks_free. Precondition: cells_log2 0 … 6. MTM_MEMORY, MTM_CANCELLED. */
MTM_CHECK mtm_status mtm_blocks_create(const mtm_volume *volume, int cells_log2, int thread_count,
                                       const mtm_progress *progress, mtm_blocks *blocks, mtm_error *error);
void mtm_blocks_free(mtm_blocks *blocks);

size_t mtm_blocks_count(const mtm_blocks *blocks);

#endif
