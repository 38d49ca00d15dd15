/* SPDX-License-Identifier: BSD-3-Clause
 * Whether a grid can be used. */
#ifndef METAMER_VOLUME_GRID_H
#define METAMER_VOLUME_GRID_H

#include "metamer/volume.h"

/* What is wrong with the grid as the end of a sentence ("has linearly dependent axes"); NULL where it is usable:
 * sizes ≥ 1, finite origin, finite and linearly independent axes, unit ended by a 0. */
const char *mtm_grid_fault(const mtm_grid *grid);

#endif
