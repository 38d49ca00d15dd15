/* SPDX-License-Identifier: BSD-3-Clause
 * What the raycaster's inner loop needs, prepared once per picture. */
#ifndef METAMER_RENDER_RAYCAST_KERNEL_H
#define METAMER_RENDER_RAYCAST_KERNEL_H

#include "metamer/render.h"
#include "transfer/table.h"

enum { MTM_TILE_PIXELS = 16 };

/* The 8 voxels around a cell (x fastest), and for the gradient the voxels before and after them along each axis,
 * edge by edge. Values are transfer positions. */
typedef struct mtm_cell {
    float corner[8];
    float before[3][4], after[3][4];
} mtm_cell;

typedef struct mtm_raycast {
    const void *voxels;
    mtm_voxel_type type;
    int size[3];
    size_t stride[3]; /* to the next voxel along an axis; 0 where there is only one */
    double slope, intercept;
    float lowest_position; /* for voxels that are no numbers */
    void (*load_corners)(const struct mtm_raycast *raycast, const int cell[3], mtm_cell *loaded);
    void (*load_neighbors)(const struct mtm_raycast *raycast, const int cell[3], mtm_cell *loaded);

    double inverse_axes[3][3]; /* world to voxel coordinates, and gradients back */
    double grid_origin[3];
    double box_low[3], box_high[3]; /* the clip box in voxel coordinates */

    const struct mtm_transfer *transfer;
    int block_size[3];
    const unsigned char *is_block_visible; /* composite and sum */
    const float *block_highest;            /* maximum: highest position in a block */

    mtm_view view;
    mtm_render_options options;
    double step;           /* world units */
    double gradient_scale; /* |∇position| to fractions of the value range per smallest spacing */
    bool needs_gradient;
    double light[3]; /* unit vector toward the light, where it is no headlight */
} mtm_raycast;

/* Sets load_corners and load_neighbors for the voxel type. */
void mtm_raycast_choose_loaders(mtm_raycast *raycast);

/* Renders the tile whose first pixel is (x, y). */
void mtm_raycast_tile(const mtm_raycast *raycast, int x, int y, mtm_image *image);

#endif
