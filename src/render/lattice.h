/* SPDX-License-Identifier: BSD-3-Clause
 * Lattices of pixels: how a picture comes coarse first, without a pixel being computed twice. */
#ifndef METAMER_RENDER_LATTICE_H
#define METAMER_RENDER_LATTICE_H

#include "metamer/image.h"

/* Every `stride`-th pixel across and down, from (x, y) on. The lattice (0, 0, s) comes first; (s/2, 0, s), (0, s/2, s) and
 * (s/2, s/2, s) then refine it to (0, 0, s/2). All pixels are (0, 0, 1). */
typedef struct mtm_lattice {
    int x, y, stride;
} mtm_lattice;

/* How many pixels of the lattice lie along an axis where it begins at `first` (x or y) and the image has `size`. */
int mtm_lattice_count(const mtm_lattice *lattice, int first, int size);

/* Copies the lattice's pixels column … column + count - 1 of its rows row … row + count - 1, as far as the image has them,
 * over the pixels right of and below each that neither this lattice nor those before it computed. Different pixels of
 * a lattice write to disjoint memory. */
void mtm_lattice_spread(const mtm_lattice *lattice, int column, int row, int count, mtm_image *image);

#endif
