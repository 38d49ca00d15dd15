/* SPDX-License-Identifier: BSD-3-Clause
 * Smallest and largest value of every block of cells.
 * Levoy, "Efficient ray tracing of volume data", ACM TOG 9(3), 1990 (a pyramid there, one level here). */
#include "volume/blocks.h"

#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "volume/voxel_type.h"

enum { ROW_VOXELS = MTM_BLOCK_CELLS + 1 };

typedef struct block_job {
    const mtm_volume *volume;
    const mtm_grid *grid;
    mtm_blocks *blocks;
    double slope, intercept, smallest;
} block_job;

static int min_of(int a, int b) {
    return a < b ? a : b;
}

/* Widens *low … *high by `count` voxels in a row that begins at `first`. */
static void include_row(const block_job *job, size_t first, size_t count, double *low, double *high) {
    double values[ROW_VOXELS];
    mtm_voxels_to_double(mtm_volume_type(job->volume), mtm_volume_voxels(job->volume), first, count, values);
    for (size_t n = 0; n < count; n++) {
        const double value = job->slope * values[n] + job->intercept;
        const double usable = isfinite(value) ? value : job->smallest;
        *low = usable < *low ? usable : *low;
        *high = usable > *high ? usable : *high;
    }
}

static void measure_block(const block_job *job, const int block[3], double *low, double *high) {
    int first[3];
    int last[3];
    for (int axis = 0; axis < 3; axis++) {
        first[axis] = block[axis] * MTM_BLOCK_CELLS;
        last[axis] = min_of(first[axis] + MTM_BLOCK_CELLS, job->grid->size[axis] - 1);
    }
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (int k = first[2]; k <= last[2]; k++) {
        for (int j = first[1]; j <= last[1]; j++) {
            const size_t row =
                ((size_t)k * (size_t)job->grid->size[1] + (size_t)j) * (size_t)job->grid->size[0];
            include_row(job, row + (size_t)first[0], (size_t)(last[0] - first[0] + 1), low, high);
        }
    }
}

/* One task is a layer of blocks. */
static void measure_layer(void *context, int layer) {
    const block_job *job = context;
    mtm_blocks *blocks = job->blocks;
    for (int j = 0; j < blocks->size[1]; j++) {
        for (int i = 0; i < blocks->size[0]; i++) {
            const size_t index =
                ((size_t)layer * (size_t)blocks->size[1] + (size_t)j) * (size_t)blocks->size[0] + (size_t)i;
            measure_block(job, (const int[3]){i, j, layer}, &blocks->lowest[index], &blocks->highest[index]);
        }
    }
}

mtm_status mtm_blocks_create(const mtm_volume *volume, int thread_count, mtm_blocks *blocks,
                             mtm_error *error) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    size_t count = 1;
    *blocks = (mtm_blocks){0};
    for (int axis = 0; axis < 3; axis++) {
        const int cells = grid->size[axis] > 1 ? grid->size[axis] - 1 : 1;
        blocks->size[axis] = (cells + MTM_BLOCK_CELLS - 1) / MTM_BLOCK_CELLS;
        count *= (size_t)blocks->size[axis];
    }
    blocks->lowest = mtm_allocate(count, sizeof *blocks->lowest);
    blocks->highest = mtm_allocate(count, sizeof *blocks->highest);
    if (blocks->lowest == NULL || blocks->highest == NULL) {
        mtm_blocks_free(blocks);
        return mtm_fail_memory(error, "empty-space skipping", 2 * count * sizeof *blocks->lowest);
    }
    double largest = 0;
    block_job job = {.volume = volume,
                     .grid = grid,
                     .blocks = blocks,
                     .slope = mtm_volume_slope(volume),
                     .intercept = mtm_volume_intercept(volume)};
    mtm_volume_range(volume, &job.smallest, &largest);
    return mtm_parallel_for(thread_count, blocks->size[2], measure_layer, &job, NULL);
}

void mtm_blocks_free(mtm_blocks *blocks) {
    free(blocks->lowest);
    free(blocks->highest);
    *blocks = (mtm_blocks){0};
}
