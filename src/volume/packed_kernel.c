/* SPDX-License-Identifier: BSD-3-Clause
 * Packing a volume with its gradients, a slice at a time. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "volume/packed.h"

enum { CHUNK_VOXELS = 256 };

typedef struct pack_job {
    const mtm_volume *volume;
    const mtm_grid *grid;
    mtm_packed *packed;
    float matrix[3][3]; /* from differences along the axes to scaled world components */
    float *steepest;    /* largest component of each slice while it is measured, else NULL */
} pack_job;

bool mtm_packed_is_possible(const mtm_volume *volume) {
    return mtm_volume_type(volume) <= MTM_VOXEL_UINT16 && mtm_volume_voxel_count(volume) <= INT32_MAX;
}

size_t mtm_packed_bytes(const mtm_volume *volume) {
    return mtm_volume_voxel_count(volume) * mtm_voxel_type_bytes(mtm_volume_type(volume)) * 4;
}

static void load(const mtm_volume *volume, size_t first, int count, float *values) {
    const void *voxels = mtm_volume_voxels(volume);
    const int8_t *int8 = (const int8_t *)voxels + first;
    const uint8_t *uint8 = (const uint8_t *)voxels + first;
    const int16_t *int16 = (const int16_t *)voxels + first;
    const uint16_t *uint16 = (const uint16_t *)voxels + first;
    switch (mtm_volume_type(volume)) {
    case MTM_VOXEL_INT8:
        for (int n = 0; n < count; n++) values[n] = int8[n];
        break;
    case MTM_VOXEL_UINT8:
        for (int n = 0; n < count; n++) values[n] = uint8[n];
        break;
    case MTM_VOXEL_INT16:
        for (int n = 0; n < count; n++) values[n] = int16[n];
        break;
    default:
        for (int n = 0; n < count; n++) values[n] = uint16[n];
        break;
    }
}

/* differences[n] = (after[n] - before[n]) / distance; 0 for the only voxel along an axis. */
static void subtract(const float *after, const float *before, int distance, int count, float *differences) {
    const float factor = distance > 0 ? 1.0f / (float)distance : 0.0f;
    for (int n = 0; n < count; n++) differences[n] = (after[n] - before[n]) * factor;
}

/* Differences along y or z, between the rows before and after the one at `first`. */
static void differ_across(const pack_job *job, int axis, int position, size_t first, int count,
                          float *differences) {
    const int *size = job->grid->size;
    const size_t stride = axis == 1 ? (size_t)size[0] : (size_t)size[0] * (size_t)size[1];
    const bool has_before = position > 0;
    const bool has_after = position + 1 < size[axis];
    float before[CHUNK_VOXELS];
    float after[CHUNK_VOXELS];
    load(job->volume, has_before ? first - stride : first, count, before);
    load(job->volume, has_after ? first + stride : first, count, after);
    subtract(after, before, (int)has_before + (int)has_after, count, differences);
}

/* `row` holds the voxels from x - 1 to x + count, repeated where the volume ends. */
static void differ_along(int size, int x, int count, const float *row, float *differences) {
    subtract(row + 2, row, size > 1 ? 2 : 0, count, differences);
    if (x == 0) differences[0] *= 2;
    if (x + count == size && size > 1) differences[count - 1] *= 2;
}

static float keep(float x, float low, float high) {
    return x > low ? (x < high ? x : high) : low;
}

static void store_bytes(const pack_job *job, int count, const float *values,
                        float components[3][CHUNK_VOXELS], uint8_t *to) {
    const float base = (float)job->packed->value_base;
    for (int n = 0; n < count; n++) {
        to[4 * n] = (uint8_t)(values[n] - base);
        for (int i = 0; i < 3; i++) to[4 * n + 1 + i] = (uint8_t)keep(components[i][n] + 128.5f, 0, 255);
    }
}

/* Rounded while they are positive: conversion cuts toward 0. */
static void store_words(const pack_job *job, int count, const float *values,
                        float components[3][CHUNK_VOXELS], int16_t *to) {
    const float base = (float)job->packed->value_base;
    for (int n = 0; n < count; n++) {
        to[4 * n] = (int16_t)(values[n] - base);
        for (int i = 0; i < 3; i++)
            to[4 * n + 1 + i] = (int16_t)((int32_t)keep(components[i][n] + 32768.5f, 0, 65535) - 32768);
    }
}

static float find_steepest(int count, float components[3][CHUNK_VOXELS], float steepest) {
    for (int i = 0; i < 3; i++) {
        for (int n = 0; n < count; n++) {
            const float size = components[i][n] < 0 ? -components[i][n] : components[i][n];
            steepest = size > steepest ? size : steepest;
        }
    }
    return steepest;
}

static void pack_chunk(const pack_job *job, int x, int y, int z) {
    const int *size = job->grid->size;
    const int count = size[0] - x < CHUNK_VOXELS ? size[0] - x : CHUNK_VOXELS;
    const size_t first = ((size_t)z * (size_t)size[1] + (size_t)y) * (size_t)size[0] + (size_t)x;
    float row[CHUNK_VOXELS + 2];
    float differences[3][CHUNK_VOXELS];
    float components[3][CHUNK_VOXELS];
    const int before = x > 0 ? 1 : 0;
    const int after = x + count < size[0] ? 1 : 0;
    load(job->volume, first - (size_t)before, before + count + after, row + 1 - before);
    if (before == 0) row[0] = row[1];
    if (after == 0) row[count + 1] = row[count];
    differ_along(size[0], x, count, row, differences[0]);
    differ_across(job, 1, y, first, count, differences[1]);
    differ_across(job, 2, z, first, count, differences[2]);
    for (int i = 0; i < 3; i++)
        for (int n = 0; n < count; n++)
            components[i][n] = differences[0][n] * job->matrix[i][0] + differences[1][n] * job->matrix[i][1] +
                               differences[2][n] * job->matrix[i][2];
    if (job->steepest != NULL) {
        job->steepest[z] = find_steepest(count, components, job->steepest[z]);
        return;
    }
    if (job->packed->voxel_bytes == 4)
        store_bytes(job, count, row + 1, components, (uint8_t *)job->packed->voxels + 4 * first);
    else
        store_words(job, count, row + 1, components, (int16_t *)job->packed->voxels + 4 * first);
}

/* One task is a slice. */
static void pack_slice(void *context, int z) {
    const pack_job *job = context;
    for (int y = 0; y < job->grid->size[1]; y++)
        for (int x = 0; x < job->grid->size[0]; x += CHUNK_VOXELS) pack_chunk(job, x, y, z);
}

static void set_scale(pack_job *job, double scale) {
    double inverse[3][3];
    mtm_grid_inverse_axes(job->grid, inverse);
    for (int i = 0; i < 3; i++)
        for (int axis = 0; axis < 3; axis++) job->matrix[i][axis] = (float)(inverse[axis][i] * scale);
    job->packed->gradient_scale = scale;
}

/* The scale at which the steepest gradient just fits: 8 bits are few for a volume without sharp edges. */
static mtm_status choose_scale(pack_job *job, int thread_count, const mtm_progress *progress,
                               mtm_error *error) {
    const int slices = job->grid->size[2];
    const float limit = job->packed->voxel_bytes == 4 ? 127 : 32767;
    job->steepest = mtm_allocate((size_t)slices, sizeof *job->steepest);
    if (job->steepest == NULL)
        return mtm_fail_memory(error, "voxels with gradients", (size_t)slices * sizeof *job->steepest);
    set_scale(job, 1);
    const mtm_status status = mtm_parallel_for(thread_count, slices, pack_slice, job, progress);
    float steepest = 0;
    for (int z = 0; z < slices; z++) steepest = job->steepest[z] > steepest ? job->steepest[z] : steepest;
    free(job->steepest);
    job->steepest = NULL;
    set_scale(job, steepest > 0 ? (double)limit / (double)steepest : 1);
    return status;
}

mtm_status mtm_packed_create(const mtm_volume *volume, int thread_count, const mtm_progress *progress,
                             mtm_packed *packed, mtm_error *error) {
    const mtm_voxel_type type = mtm_volume_type(volume);
    const int voxel_bytes = type <= MTM_VOXEL_UINT8 ? 4 : 8;
    const double base = type == MTM_VOXEL_INT8 ? -128 : type == MTM_VOXEL_UINT16 ? 32768 : 0;
    *packed = (mtm_packed){
        .voxel_bytes = voxel_bytes, .value_base = base, .gradient_bias = voxel_bytes == 4 ? 128 : 0};
    /* Packets fetch a row's first voxel and the next one, which a row of one voxel does not have. */
    packed->voxels = mtm_allocate_unset(mtm_volume_voxel_count(volume) + 1, (size_t)voxel_bytes);
    if (packed->voxels == NULL)
        return mtm_fail_memory(error, "voxels with gradients", mtm_packed_bytes(volume));
    pack_job job = {.volume = volume, .grid = mtm_volume_grid(volume), .packed = packed};
    memset((char *)packed->voxels + mtm_packed_bytes(volume), 0, (size_t)voxel_bytes);
    mtm_status status = choose_scale(&job, thread_count, progress, error);
    if (status == MTM_OK)
        status = mtm_parallel_for(thread_count, job.grid->size[2], pack_slice, &job, progress);
    if (status != MTM_OK) {
        mtm_packed_free(packed);
        return status == MTM_CANCELLED ? mtm_fail(error, status, "preparing the volume was cancelled")
                                       : status;
    }
    return MTM_OK;
}

void mtm_packed_free(mtm_packed *packed) {
    free(packed->voxels);
    *packed = (mtm_packed){0};
}
