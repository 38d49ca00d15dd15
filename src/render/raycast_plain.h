/* SPDX-License-Identifier: BSD-3-Clause
 * The plain raycaster: one ray at a time, in double precision. */
#ifndef METAMER_RENDER_RAYCAST_PLAIN_H
#define METAMER_RENDER_RAYCAST_PLAIN_H

#include "render/raycast.h"

/* The 8 voxels around a cell (x fastest), and for the gradient the voxels before and after them along each axis,
 * edge by edge. Values are transfer positions. */
typedef struct mtm_cell {
    float corner[8];
    float before[3][4], after[3][4];
} mtm_cell;

void mtm_raycast_load_corners(const mtm_raycast *raycast, const int cell[3], mtm_cell *loaded);
void mtm_raycast_load_neighbors(const mtm_raycast *raycast, const int cell[3], mtm_cell *loaded);

/* Renders MTM_TILE_PIXELS² pixels of the lattice, the tile (across, down) of them. */
void mtm_raycast_plain_tile(const mtm_raycast *raycast, const mtm_lattice *lattice, int across, int down,
                            mtm_image *image);

#endif
