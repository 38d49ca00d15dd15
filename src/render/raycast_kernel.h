/* SPDX-License-Identifier: BSD-3-Clause
 * The raycaster's inner loop over packets of rays, per instruction set. */
#ifndef METAMER_RENDER_RAYCAST_KERNEL_H
#define METAMER_RENDER_RAYCAST_KERNEL_H

#include "base/isa.h"
#include "render/raycast.h"

/* Renders MTM_TILE_PIXELS² pixels of the lattice, the tile (across, down) of them. Composite and sum. */
typedef struct mtm_raycast_kernel {
    void (*render_tile)(const mtm_raycast *raycast, const mtm_lattice *lattice, int across, int down,
                        mtm_image *image);
} mtm_raycast_kernel;

MTM_ISA_DECLARE(mtm_raycast_kernel, mtm_raycast_kernel);

#endif
