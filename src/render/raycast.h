/* SPDX-License-Identifier: BSD-3-Clause
 * What the raycaster's inner loops need, prepared once per picture. There are two: packets of neighboring rays in
 * vectors (raycast_kernel.c), and one ray at a time in plain double precision (raycast_plain.c), the reference. */
#ifndef METAMER_RENDER_RAYCAST_H
#define METAMER_RENDER_RAYCAST_H

#include "metamer/render.h"
#include "render/lattice.h"
#include "render/occupancy.h"
#include "transfer/rows.h"
#include "transfer/table.h"
#include "volume/packed.h"

enum { MTM_TILE_PIXELS = 16 };

/* Optical depth of a pre-integrated step beyond which it is taken as two halves, so that what lies in front hides what
 * lies behind. */
#define MTM_DEEP_STEP 0.3

typedef struct mtm_raycast {
    const void *voxels;
    mtm_voxel_type type;
    int size[3];
    size_t stride[3]; /* to the next voxel along an axis; 0 where there is only one */
    double slope, intercept;
    float lowest_position;       /* for voxels that are no numbers */
    double lowest_stored;        /* the same as a stored value */
    double inverse_range;        /* of stored values */
    float row_scale, row_offset; /* from values as packets read them to rows of the table */

    double inverse_axes[3][3]; /* world to voxel coordinates, and gradients back */
    double grid_origin[3];
    double box_low[3], box_high[3]; /* the clip box in voxel coordinates */
    bool is_clipped;                /* it is smaller than the volume */

    const struct mtm_transfer *transfer;
    const mtm_transfer_rows *rows;
    const mtm_occupancy *occupancy;
    const float *block_highest; /* highest physical value in a block */
    const mtm_packed *packed;   /* voxel_bytes 0: native voxels only */

    mtm_view view;
    mtm_render_options options;
    double step;                  /* world units */
    double gradient_scale;        /* |∇position| to fractions of the value range per smallest spacing */
    float fetched_gradient_scale; /* the same for gradients as packets read them */
    bool needs_gradient;
    double light[3]; /* unit vector toward the light, where it is no headlight */
} mtm_raycast;

/* A random number in 0 … 1 that depends on the pixel only (an integer hash, so the same on every machine). */
static inline double mtm_pixel_random(uint32_t x, uint32_t y) {
    uint32_t h = x * 0x9E3779B1u ^ (y + 0x7F4A7C15u) * 0x85EBCA77u;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return (double)(h ^ h >> 15) / 4294967296.0;
}

#endif
