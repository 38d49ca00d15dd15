/* SPDX-License-Identifier: BSD-3-Clause
 * What is done to voxels by their type: conversion to double and byte order. */
#ifndef METAMER_VOLUME_VOXEL_TYPE_H
#define METAMER_VOLUME_VOXEL_TYPE_H

#include "metamer/volume.h"

/* values[n] = voxels[first + n] for n = 0 … count-1. 64-bit integers round to the nearest double. */
void mtm_voxels_to_double(mtm_voxel_type type, const void *voxels, size_t first, size_t count,
                          double *values);

/* Reverses the bytes of each of `count` voxels in place. */
void mtm_voxels_swap_bytes(mtm_voxel_type type, void *voxels, size_t count);

/* The same on all threads, for whole volumes. */
void mtm_voxels_swap_bytes_parallel(mtm_voxel_type type, void *voxels, size_t count);

/* Whether this machine stores the most significant byte first. */
bool mtm_is_big_endian(void);

#endif
