/* SPDX-License-Identifier: BSD-3-Clause
 * Smallest and largest value of every block of cells, for empty-space skipping. */
#ifndef METAMER_VOLUME_BLOCKS_H
#define METAMER_VOLUME_BLOCKS_H

#include "metamer/volume.h"

/* Blocks of MTM_BLOCK_CELLS³ cells; a block's values include the voxels on its far faces, because interpolation
 * inside it reads them. */
enum { MTM_BLOCK_CELLS = 8 };

typedef struct mtm_blocks {
    int size[3];    /* blocks along each axis, ≥ 1 */
    double *lowest; /* physical values, x fastest */
    double *highest;
} mtm_blocks;

MTM_CHECK mtm_status mtm_blocks_create(const mtm_volume *volume, int thread_count, mtm_blocks *blocks,
                                       mtm_error *error);
void mtm_blocks_free(mtm_blocks *blocks);

#endif
