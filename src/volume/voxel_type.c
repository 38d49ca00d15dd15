/* SPDX-License-Identifier: BSD-3-Clause
 * What is done to voxels by their type: conversion to double and byte order. */
#include "volume/voxel_type.h"

#include <assert.h>
#include <string.h>

#include "base/parallel.h"

enum { SWAP_TASK_BYTES = 1 << 22 };

typedef struct type_facts {
    size_t bytes;
    const char *name;
} type_facts;

static const type_facts facts[MTM_VOXEL_TYPE_COUNT] = {
    [MTM_VOXEL_INT8] = {1, "int8"},       [MTM_VOXEL_UINT8] = {1, "uint8"},
    [MTM_VOXEL_INT16] = {2, "int16"},     [MTM_VOXEL_UINT16] = {2, "uint16"},
    [MTM_VOXEL_INT32] = {4, "int32"},     [MTM_VOXEL_UINT32] = {4, "uint32"},
    [MTM_VOXEL_INT64] = {8, "int64"},     [MTM_VOXEL_UINT64] = {8, "uint64"},
    [MTM_VOXEL_FLOAT32] = {4, "float32"}, [MTM_VOXEL_FLOAT64] = {8, "float64"},
};

size_t mtm_voxel_type_bytes(mtm_voxel_type type) {
    assert(type < MTM_VOXEL_TYPE_COUNT);
    return facts[type].bytes;
}

const char *mtm_voxel_type_name(mtm_voxel_type type) {
    assert(type < MTM_VOXEL_TYPE_COUNT);
    return facts[type].name;
}

bool mtm_is_big_endian(void) {
    const uint16_t one = 1;
    unsigned char first_byte = 0;
    memcpy(&first_byte, &one, 1);
    return first_byte == 0;
}

static void convert_small(mtm_voxel_type type, const void *voxels, size_t first, size_t count,
                          double *values) {
    const int8_t *int8 = (const int8_t *)voxels + first;
    const uint8_t *uint8 = (const uint8_t *)voxels + first;
    const int16_t *int16 = (const int16_t *)voxels + first;
    const uint16_t *uint16 = (const uint16_t *)voxels + first;
    switch (type) {
    case MTM_VOXEL_INT8:
        for (size_t n = 0; n < count; n++) values[n] = int8[n];
        break;
    case MTM_VOXEL_UINT8:
        for (size_t n = 0; n < count; n++) values[n] = uint8[n];
        break;
    case MTM_VOXEL_INT16:
        for (size_t n = 0; n < count; n++) values[n] = int16[n];
        break;
    default:
        for (size_t n = 0; n < count; n++) values[n] = uint16[n];
        break;
    }
}

static void convert_integer(mtm_voxel_type type, const void *voxels, size_t first, size_t count,
                            double *values) {
    const int32_t *int32 = (const int32_t *)voxels + first;
    const uint32_t *uint32 = (const uint32_t *)voxels + first;
    const int64_t *int64 = (const int64_t *)voxels + first;
    const uint64_t *uint64 = (const uint64_t *)voxels + first;
    switch (type) {
    case MTM_VOXEL_INT32:
        for (size_t n = 0; n < count; n++) values[n] = int32[n];
        break;
    case MTM_VOXEL_UINT32:
        for (size_t n = 0; n < count; n++) values[n] = uint32[n];
        break;
    case MTM_VOXEL_INT64:
        for (size_t n = 0; n < count; n++) values[n] = (double)int64[n];
        break;
    default:
        for (size_t n = 0; n < count; n++) values[n] = (double)uint64[n];
        break;
    }
}

void mtm_voxels_to_double(mtm_voxel_type type, const void *voxels, size_t first, size_t count,
                          double *values) {
    assert(type < MTM_VOXEL_TYPE_COUNT);
    if (type <= MTM_VOXEL_UINT16) {
        convert_small(type, voxels, first, count, values);
    } else if (type <= MTM_VOXEL_UINT64) {
        convert_integer(type, voxels, first, count, values);
    } else if (type == MTM_VOXEL_FLOAT32) {
        const float *float32 = (const float *)voxels + first;
        for (size_t n = 0; n < count; n++) values[n] = float32[n];
    } else {
        memcpy(values, (const double *)voxels + first, count * sizeof *values);
    }
}

/* Through memcpy, so that the voxels keep the type they are read with afterwards; compilers see through it. */
static void swap_2(unsigned char *bytes, size_t count) {
    for (size_t n = 0; n < count; n++) {
        uint16_t value;
        memcpy(&value, bytes + 2 * n, sizeof value);
        value = __builtin_bswap16(value);
        memcpy(bytes + 2 * n, &value, sizeof value);
    }
}

static void swap_4(unsigned char *bytes, size_t count) {
    for (size_t n = 0; n < count; n++) {
        uint32_t value;
        memcpy(&value, bytes + 4 * n, sizeof value);
        value = __builtin_bswap32(value);
        memcpy(bytes + 4 * n, &value, sizeof value);
    }
}

static void swap_8(unsigned char *bytes, size_t count) {
    for (size_t n = 0; n < count; n++) {
        uint64_t value;
        memcpy(&value, bytes + 8 * n, sizeof value);
        value = __builtin_bswap64(value);
        memcpy(bytes + 8 * n, &value, sizeof value);
    }
}

void mtm_voxels_swap_bytes(mtm_voxel_type type, void *voxels, size_t count) {
    switch (mtm_voxel_type_bytes(type)) {
    case 2: swap_2(voxels, count); break;
    case 4: swap_4(voxels, count); break;
    case 8: swap_8(voxels, count); break;
    default: break;
    }
}

typedef struct swap_job {
    mtm_voxel_type type;
    unsigned char *bytes;
    size_t byte_count;
} swap_job;

static void swap_task(void *context, int task) {
    const swap_job *job = context;
    const size_t begin = (size_t)task * SWAP_TASK_BYTES;
    const size_t left = job->byte_count - begin;
    const size_t bytes = left < SWAP_TASK_BYTES ? left : SWAP_TASK_BYTES;
    mtm_voxels_swap_bytes(job->type, job->bytes + begin, bytes / mtm_voxel_type_bytes(job->type));
}

void mtm_voxels_swap_bytes_parallel(mtm_voxel_type type, void *voxels, size_t count) {
    if (mtm_voxel_type_bytes(type) == 1) return;
    swap_job job = {type, voxels, count * mtm_voxel_type_bytes(type)};
    const int task_count = (int)((job.byte_count + SWAP_TASK_BYTES - 1) / SWAP_TASK_BYTES);
    const mtm_status status = mtm_parallel_for(0, task_count, swap_task, &job, NULL);
    assert(status == MTM_OK); /* nobody can cancel it */
    (void)status;
}
