/* SPDX-License-Identifier: BSD-3-Clause
 * Smallest and largest value of every block of cells.
 * Levoy, "Efficient ray tracing of volume data", ACM TOG 9(3), 1990 (a pyramid there, one level here). */
#include "volume/blocks.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "volume/voxel_type.h"

enum { CHUNK_VOXELS = 512 }; /* of a row, converted at once; a multiple of every block */

typedef struct block_job {
    const mtm_volume *volume;
    const mtm_grid *grid;
    mtm_blocks *blocks;
    double slope, intercept, smallest;
} block_job;

static int min_of(int a, int b) {
    return a < b ? a : b;
}

/* Physical values of `count` voxels in a row that begins at `first`. */
static void read_row(const block_job *job, size_t first, int count, double *values) {
    mtm_voxels_to_double(mtm_volume_type(job->volume), mtm_volume_voxels(job->volume), first, (size_t)count,
                         values);
    for (int n = 0; n < count; n++) values[n] = job->slope * values[n] + job->intercept;
    if (mtm_volume_type(job->volume) < MTM_VOXEL_FLOAT32) return;
    for (int n = 0; n < count; n++) values[n] = isfinite(values[n]) ? values[n] : job->smallest;
}

static void widen(float *lowest, float *highest, double low, double high) {
    if (low < (double)*lowest) {
        const float near = (float)low;
        *lowest = (double)near <= low ? near : nextafterf(near, -HUGE_VALF);
    }
    if (high > (double)*highest) {
        const float near = (float)high;
        *highest = (double)near >= high ? near : nextafterf(near, HUGE_VALF);
    }
}

/* Widens a row of blocks by a row of voxels at (0, y, z). */
static void include_row(const block_job *job, int y, int z, float *lowest, float *highest) {
    const int *size = job->grid->size;
    const int edge = 1 << job->blocks->cells_log2;
    const size_t row = ((size_t)z * (size_t)size[1] + (size_t)y) * (size_t)size[0];
    double values[CHUNK_VOXELS + 1];
    for (int x = 0; x < size[0] - 1 || x == 0; x += CHUNK_VOXELS) {
        const int count = min_of(CHUNK_VOXELS + 1, size[0] - x);
        read_row(job, row + (size_t)x, count, values);
        for (int begin = 0; begin < count - 1 || begin == 0; begin += edge) {
            const int end = min_of(begin + edge, count - 1);
            double low = values[begin];
            double high = values[begin];
            for (int n = begin + 1; n <= end; n++) {
                low = values[n] < low ? values[n] : low;
                high = values[n] > high ? values[n] : high;
            }
            const int block = (x + begin) >> job->blocks->cells_log2;
            widen(&lowest[block], &highest[block], low, high);
        }
    }
}

/* One task is a layer of blocks. A row of voxels on the face between two rows of blocks belongs to both. */
static void measure_layer(void *context, int layer) {
    const block_job *job = context;
    const mtm_blocks *blocks = job->blocks;
    const int edge = 1 << blocks->cells_log2;
    const int last_z = min_of((layer + 1) * edge, job->grid->size[2] - 1);
    for (int j = 0; j < blocks->size[1]; j++) {
        const size_t first = ((size_t)layer * (size_t)blocks->size[1] + (size_t)j) * (size_t)blocks->size[0];
        float *lowest = blocks->lowest + first;
        float *highest = blocks->highest + first;
        for (int i = 0; i < blocks->size[0]; i++) {
            lowest[i] = HUGE_VALF;
            highest[i] = -HUGE_VALF;
        }
        const int last_y = min_of((j + 1) * edge, job->grid->size[1] - 1);
        for (int z = layer * edge; z <= last_z; z++)
            for (int y = j * edge; y <= last_y; y++) include_row(job, y, z, lowest, highest);
    }
}

size_t mtm_blocks_count(const mtm_blocks *blocks) {
    return (size_t)blocks->size[0] * (size_t)blocks->size[1] * (size_t)blocks->size[2];
}

mtm_status mtm_blocks_create(const mtm_volume *volume, int cells_log2, int thread_count,
                             const mtm_progress *progress, mtm_blocks *blocks, mtm_error *error) {
    assert(cells_log2 >= 0 && cells_log2 <= 6);
    const mtm_grid *grid = mtm_volume_grid(volume);
    *blocks = (mtm_blocks){.cells_log2 = cells_log2};
    for (int axis = 0; axis < 3; axis++) {
        const int cells = grid->size[axis] > 1 ? grid->size[axis] - 1 : 1;
        blocks->size[axis] = (cells + (1 << cells_log2) - 1) >> cells_log2;
    }
    const size_t count = mtm_blocks_count(blocks);
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
    const mtm_status status = mtm_parallel_for(thread_count, blocks->size[2], measure_layer, &job, progress);
    if (status != MTM_OK) {
        mtm_blocks_free(blocks);
        return mtm_fail(error, status, "preparing the volume was cancelled");
    }
    return MTM_OK;
}

void mtm_blocks_free(mtm_blocks *blocks) {
    free(blocks->lowest);
    free(blocks->highest);
    *blocks = (mtm_blocks){0};
}
