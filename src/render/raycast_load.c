/* SPDX-License-Identifier: BSD-3-Clause
 * Reading the voxels round a sample, in the volume's own type, as positions in the transfer function. */
#include <math.h>

#include "render/raycast_plain.h"

static double stored_value(const mtm_raycast *raycast, size_t offset) {
    switch (raycast->type) {
    case MTM_VOXEL_INT8: return ((const int8_t *)raycast->voxels)[offset];
    case MTM_VOXEL_UINT8: return ((const uint8_t *)raycast->voxels)[offset];
    case MTM_VOXEL_INT16: return ((const int16_t *)raycast->voxels)[offset];
    case MTM_VOXEL_UINT16: return ((const uint16_t *)raycast->voxels)[offset];
    case MTM_VOXEL_INT32: return ((const int32_t *)raycast->voxels)[offset];
    case MTM_VOXEL_UINT32: return ((const uint32_t *)raycast->voxels)[offset];
    case MTM_VOXEL_INT64: return (double)((const int64_t *)raycast->voxels)[offset];
    case MTM_VOXEL_UINT64: return (double)((const uint64_t *)raycast->voxels)[offset];
    case MTM_VOXEL_FLOAT32: return (double)((const float *)raycast->voxels)[offset];
    default: return ((const double *)raycast->voxels)[offset];
    }
}

/* Positions stay in a range that interpolation cannot overflow; what is no number is the smallest value. */
static float voxel_position(const mtm_raycast *raycast, size_t offset) {
    const double value = raycast->slope * stored_value(raycast, offset) + raycast->intercept;
    const float position = mtm_transfer_position(raycast->transfer, value);
    const float usable = fminf(fmaxf(position, -1e30f), 1e30f);
    return raycast->type < MTM_VOXEL_FLOAT32 || isfinite(value) ? usable : raycast->lowest_position;
}

static size_t cell_offset(const mtm_raycast *raycast, const int cell[3]) {
    const size_t row = (size_t)cell[2] * (size_t)raycast->size[1] + (size_t)cell[1];
    return row * (size_t)raycast->size[0] + (size_t)cell[0];
}

void mtm_raycast_load_corners(const mtm_raycast *raycast, const int cell[3], mtm_cell *loaded) {
    const size_t first = cell_offset(raycast, cell);
    for (int corner = 0; corner < 8; corner++) {
        const size_t x = corner & 1 ? raycast->stride[0] : 0;
        const size_t y = corner & 2 ? raycast->stride[1] : 0;
        const size_t z = corner & 4 ? raycast->stride[2] : 0;
        loaded->corner[corner] = voxel_position(raycast, first + x + y + z);
    }
}

/* Where a cell is at the volume's face, the voxel beyond is taken from the face itself. */
void mtm_raycast_load_neighbors(const mtm_raycast *raycast, const int cell[3], mtm_cell *loaded) {
    static const int across[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    const size_t first = cell_offset(raycast, cell);
    for (int axis = 0; axis < 3; axis++) {
        const size_t stride = raycast->stride[axis];
        const size_t before = cell[axis] > 0 ? first - stride : first;
        const size_t after = cell[axis] + 2 < raycast->size[axis] ? first + 2 * stride : first + stride;
        for (int edge = 0; edge < 4; edge++) {
            const size_t u = edge & 1 ? raycast->stride[across[axis][0]] : 0;
            const size_t v = edge & 2 ? raycast->stride[across[axis][1]] : 0;
            loaded->before[axis][edge] = voxel_position(raycast, before + u + v);
            loaded->after[axis][edge] = voxel_position(raycast, after + u + v);
        }
    }
}
