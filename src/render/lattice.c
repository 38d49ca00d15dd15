/* SPDX-License-Identifier: BSD-3-Clause
 * Counting and spreading the pixels of a lattice. */
#include "render/lattice.h"

#include <string.h>

static int smaller(int a, int b) {
    return a < b ? a : b;
}

int mtm_lattice_count(const mtm_lattice *lattice, int first, int size) {
    return size > first ? (size - first + lattice->stride - 1) / lattice->stride : 0;
}

/* Copies the pixel (x, y) over a square of which it is the upper left corner. */
static void spread_pixel(int x, int y, int side, mtm_image *image) {
    const size_t lanes = (size_t)image->lanes;
    const size_t row_lanes = (size_t)image->width * lanes;
    const size_t width = (size_t)smaller(side, image->width - x);
    const size_t height = (size_t)smaller(side, image->height - y);
    float *corner = image->pixels + (size_t)y * row_lanes + (size_t)x * lanes;
    for (size_t i = 1; i < width; i++) memcpy(corner + i * lanes, corner, lanes * sizeof *corner);
    for (size_t j = 1; j < height; j++)
        memcpy(corner + j * row_lanes, corner, width * lanes * sizeof *corner);
}

void mtm_lattice_spread(const mtm_lattice *lattice, int column, int row, int count, mtm_image *image) {
    const bool is_first = lattice->x == 0 && lattice->y == 0;
    const int side = is_first ? lattice->stride : lattice->stride / 2;
    if (side == 1) return;
    const int column_end = smaller(column + count, mtm_lattice_count(lattice, lattice->x, image->width));
    const int row_end = smaller(row + count, mtm_lattice_count(lattice, lattice->y, image->height));
    for (int j = row; j < row_end; j++)
        for (int i = column; i < column_end; i++)
            spread_pixel(lattice->x + i * lattice->stride, lattice->y + j * lattice->stride, side, image);
}
