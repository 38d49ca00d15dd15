/* SPDX-License-Identifier: BSD-3-Clause
 * Spectral images made without a renderer, to time what comes after one. */
#ifndef METAMER_CLI_BENCH_PIXELS_H
#define METAMER_CLI_BENCH_PIXELS_H

#include "metamer/metamer.h"

/* An image as floats and as halves, a light's matrix, and room for the relit picture. */
typedef struct bench_pixels {
    mtm_image *image;
    mtm_half_image *half;
    unsigned char *rgba;
    double matrix[3 * MTM_DIMENSION_MAX];
} bench_pixels;

/* Random coefficients and alphas, multiples of 2^-10 below 1, which halves hold exactly; the pixels that are not empty
 * are `fill` (0 … 1) of all, a band of rows in the middle. MTM_MEMORY. Release with free_pixels. */
mtm_status make_pixels(int width, int height, int dimension, double fill, bench_pixels *pixels,
                       mtm_error *error);
void free_pixels(bench_pixels *pixels);

/* Milliseconds of relighting, with the instruction set that is chosen. */
double time_pixels(bench_pixels *pixels, bool is_half, int thread_count);

/* Checks the bytes of small pixels of this dimension, from floats and from halves, with the instruction set of that name
 * and `thread_count` threads, against plain relighting. MTM_NUMERIC where one differs; MTM_MEMORY. */
mtm_status check_pixels(int dimension, const char *isa, int thread_count, mtm_error *error);

#endif
