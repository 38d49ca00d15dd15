/* SPDX-License-Identifier: BSD-3-Clause
 * Scalar volumes in their own voxel type: making them, their values, range and histogram. */
#include "volume/volume.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "volume/grid.h"
#include "volume/voxel_type.h"

enum {
    ALIGNMENT = 64,
    CHUNK_VOXELS = 1024, /* converted to double at once; stays in the first-level cache */
    SLAB_COUNT = 64,     /* tasks of the range: many enough for any machine, few enough for the stack */
};

static const size_t BYTES_LIMIT = (size_t)1 << 40;

struct mtm_volume {
    mtm_grid grid;
    mtm_voxel_type type;
    const void *voxels; /* in `memory` or in `mapping`, whichever there is */
    void *memory;
    mtm_mapping mapping;
    size_t voxel_count;
    double slope, intercept;
    double smallest, largest;
};

mtm_status mtm_volume_bytes(const int size[3], mtm_voxel_type type, const char *what, size_t *bytes,
                            mtm_error *error) {
    size_t product = mtm_voxel_type_bytes(type);
    bool is_small = true;
    for (int axis = 0; axis < 3 && is_small; axis++)
        is_small = mtm_size_multiply(product, (size_t)size[axis], &product) && product <= BYTES_LIMIT;
    if (!is_small)
        return mtm_fail(error, MTM_LIMIT, "%s: %d x %d x %d voxels of type %s are more than 2^40 bytes", what,
                        size[0], size[1], size[2], mtm_voxel_type_name(type));
    *bytes = product;
    return MTM_OK;
}

/* A volume that has no voxels yet. */
static mtm_status create_empty(const mtm_grid *grid, mtm_voxel_type type, const char *what,
                               mtm_volume **volume, mtm_error *error) {
    const char *fault = mtm_grid_fault(grid);
    if (fault != NULL) return mtm_fail(error, MTM_ARGUMENT, "%s: the grid %s", what, fault);
    size_t bytes = 0;
    const mtm_status status = mtm_volume_bytes(grid->size, type, what, &bytes, error);
    if (status != MTM_OK) return status;
    mtm_volume *result = mtm_allocate(1, sizeof *result);
    if (result == NULL) return mtm_fail_memory(error, what, sizeof *result);
    *result = (mtm_volume){.grid = *grid, .type = type, .slope = 1.0};
    result->voxel_count = bytes / mtm_voxel_type_bytes(type);
    *volume = result;
    return MTM_OK;
}

/* Not zeroed: the pages of a big volume are touched first by the data that fills them. Only the rest, at least
 * ALIGNMENT bytes, is: a vector load may begin at the last voxel. */
static void *allocate_voxels(size_t bytes) {
    const size_t rounded = (bytes / ALIGNMENT + 2) * ALIGNMENT;
    unsigned char *voxels = aligned_alloc(ALIGNMENT, rounded);
    if (voxels != NULL) memset(voxels + bytes, 0, rounded - bytes);
    return voxels;
}

mtm_status mtm_volume_allocate(const mtm_grid *grid, mtm_voxel_type type, const char *what,
                               mtm_volume **volume, mtm_error *error) {
    mtm_volume *result = NULL;
    const mtm_status status = create_empty(grid, type, what, &result, error);
    if (status != MTM_OK) return status;
    const size_t bytes = result->voxel_count * mtm_voxel_type_bytes(type);
    result->voxels = result->memory = allocate_voxels(bytes);
    if (result->memory == NULL) {
        free(result);
        return mtm_fail_memory(error, what, bytes);
    }
    *volume = result;
    return MTM_OK;
}

mtm_status mtm_volume_adopt(const mtm_grid *grid, mtm_voxel_type type, mtm_mapping *mapping, const char *what,
                            mtm_volume **volume, mtm_error *error) {
    assert((uintptr_t)mapping->bytes % mtm_voxel_type_bytes(type) == 0);
    const mtm_status status = create_empty(grid, type, what, volume, error);
    if (status != MTM_OK) {
        mtm_mapping_close(mapping);
        return status;
    }
    (*volume)->mapping = *mapping;
    (*volume)->voxels = mapping->bytes;
    return MTM_OK;
}

bool mtm_volume_is_mapped(const mtm_volume *volume) {
    return volume->mapping.bytes != NULL;
}

void *mtm_volume_storage(mtm_volume *volume) {
    assert(!mtm_volume_is_mapped(volume));
    return volume->memory;
}

mtm_status mtm_volume_create(const mtm_grid *grid, mtm_voxel_type type, const void *voxels, double slope,
                             double intercept, mtm_volume **volume, mtm_error *error) {
    assert(type >= 0 && type < MTM_VOXEL_TYPE_COUNT && volume != NULL);
    if (slope == 0.0 || !isfinite(slope) || !isfinite(intercept))
        return mtm_fail(error, MTM_ARGUMENT, "volume: slope %g and intercept %g are not finite, slope not 0",
                        slope, intercept);
    mtm_volume *result = NULL;
    const mtm_status status = mtm_volume_allocate(grid, type, "volume", &result, error);
    if (status != MTM_OK) return status;
    const size_t bytes = result->voxel_count * mtm_voxel_type_bytes(type);
    if (voxels != NULL)
        memcpy(result->memory, voxels, bytes);
    else
        memset(result->memory, 0, bytes);
    mtm_volume_finish(result, slope, intercept);
    *volume = result;
    return MTM_OK;
}

void mtm_volume_destroy(mtm_volume *volume) {
    if (volume == NULL) return;
    free(volume->memory);
    mtm_mapping_close(&volume->mapping);
    free(volume);
}

const mtm_grid *mtm_volume_grid(const mtm_volume *volume) {
    return &volume->grid;
}

mtm_voxel_type mtm_volume_type(const mtm_volume *volume) {
    return volume->type;
}

size_t mtm_volume_voxel_count(const mtm_volume *volume) {
    return volume->voxel_count;
}

const void *mtm_volume_voxels(const mtm_volume *volume) {
    return volume->voxels;
}

double mtm_volume_slope(const mtm_volume *volume) {
    return volume->slope;
}

double mtm_volume_intercept(const mtm_volume *volume) {
    return volume->intercept;
}

double mtm_volume_value(const mtm_volume *volume, int i, int j, int k) {
    const int *size = volume->grid.size;
    assert(i >= 0 && i < size[0] && j >= 0 && j < size[1] && k >= 0 && k < size[2]);
    const size_t index = ((size_t)k * (size_t)size[1] + (size_t)j) * (size_t)size[0] + (size_t)i;
    double stored = 0.0;
    mtm_voxels_to_double(volume->type, volume->voxels, index, 1, &stored);
    return volume->slope * stored + volume->intercept;
}

/* The range of stored values; empty while smallest > largest. */
typedef struct value_range {
    double smallest, largest;
} value_range;

typedef struct range_job {
    const mtm_volume *volume;
    value_range slabs[SLAB_COUNT];
} range_job;

static value_range range_of_chunk(value_range range, const double *values, size_t count) {
    for (size_t n = 0; n < count; n++) {
        const double value = values[n];
        if (!(fabs(value) <= DBL_MAX)) continue; /* not a number, or infinite */
        range.smallest = value < range.smallest ? value : range.smallest;
        range.largest = value > range.largest ? value : range.largest;
    }
    return range;
}

static void find_slab_range(void *context, int task) {
    range_job *job = context;
    const mtm_volume *volume = job->volume;
    const size_t slab_voxels = (volume->voxel_count + SLAB_COUNT - 1) / SLAB_COUNT;
    const size_t begin = (size_t)task * slab_voxels;
    const size_t end = begin + slab_voxels < volume->voxel_count ? begin + slab_voxels : volume->voxel_count;
    value_range range = {DBL_MAX, -DBL_MAX};
    for (size_t first = begin; first < end; first += CHUNK_VOXELS) {
        double values[CHUNK_VOXELS];
        const size_t count = end - first < CHUNK_VOXELS ? end - first : CHUNK_VOXELS;
        mtm_voxels_to_double(volume->type, volume->voxels, first, count, values);
        range = range_of_chunk(range, values, count);
    }
    job->slabs[task] = range;
}

static double finite_value(const mtm_volume *volume, double stored) {
    const double value = volume->slope * stored + volume->intercept;
    return fmin(fmax(value, -DBL_MAX), DBL_MAX);
}

void mtm_volume_finish(mtm_volume *volume, double slope, double intercept) {
    range_job job = {.volume = volume};
    const mtm_status status = mtm_parallel_for(0, SLAB_COUNT, find_slab_range, &job, NULL);
    assert(status == MTM_OK); /* nobody can cancel it */
    (void)status;
    value_range range = {DBL_MAX, -DBL_MAX};
    for (int task = 0; task < SLAB_COUNT; task++) {
        range.smallest = fmin(range.smallest, job.slabs[task].smallest);
        range.largest = fmax(range.largest, job.slabs[task].largest);
    }
    volume->slope = slope;
    volume->intercept = intercept;
    if (range.smallest > range.largest) return; /* no finite voxel: 0 and 0 */
    volume->smallest = finite_value(volume, slope > 0.0 ? range.smallest : range.largest);
    volume->largest = finite_value(volume, slope > 0.0 ? range.largest : range.smallest);
}

void mtm_volume_range(const mtm_volume *volume, double *smallest, double *largest) {
    *smallest = volume->smallest;
    *largest = volume->largest;
}

/* value → bin as (value/2 − offset)·scale; halves, because the width of a range of doubles can be beyond the
 * largest double. */
typedef struct bin_scale {
    double offset, scale;
    int bin_count;
} bin_scale;

static bin_scale bin_scale_of(const mtm_volume *volume, int bin_count) {
    bin_scale bins = {0.5 * volume->smallest, 0.0, bin_count};
    const double half_width = 0.5 * volume->largest - bins.offset;
    if (half_width > 0.0) bins.scale = bin_count / half_width;
    return bins;
}

/* Comparisons also catch a range that is empty or so narrow that the scale is infinite. */
static int bin_of(const bin_scale *bins, double value) {
    if (bins->scale == 0.0) return bins->bin_count - 1;
    const double position = (0.5 * value - bins->offset) * bins->scale;
    if (!(position > 0.0)) return 0;
    return position < bins->bin_count ? (int)position : bins->bin_count - 1;
}

void mtm_volume_histogram(const mtm_volume *volume, int bin_count, uint64_t *counts) {
    assert(bin_count >= 1);
    const bin_scale bins = bin_scale_of(volume, bin_count);
    memset(counts, 0, (size_t)bin_count * sizeof *counts);
    for (size_t first = 0; first < volume->voxel_count; first += CHUNK_VOXELS) {
        double values[CHUNK_VOXELS];
        const size_t left = volume->voxel_count - first;
        const size_t count = left < CHUNK_VOXELS ? left : CHUNK_VOXELS;
        mtm_voxels_to_double(volume->type, volume->voxels, first, count, values);
        for (size_t n = 0; n < count; n++) {
            if (!(fabs(values[n]) <= DBL_MAX)) continue;
            counts[bin_of(&bins, volume->slope * values[n] + volume->intercept)]++;
        }
    }
}
