/* SPDX-License-Identifier: BSD-3-Clause
 * The inner loop of postillumination. */
#ifndef METAMER_RELIGHT_RELIGHT_KERNEL_H
#define METAMER_RELIGHT_RELIGHT_KERNEL_H

#include "metamer/relight.h"

typedef struct mtm_relight_pass {
    int dimension, lanes;
    bool is_opaque;
    float background[3];
    float matrix[3][MTM_DIMENSION_MAX + 1]; /* zero in the lanes behind the coefficients */
} mtm_relight_pass;

/* The pass for images of that dimension and number of lanes; `matrix` has 3 rows of the dimension. */
mtm_relight_pass mtm_relight_pass_of(int dimension, int lanes, const double *matrix,
                                     const mtm_relight_options *options);

/* `count` pixels of `lanes` floats to as many of red, green, blue, alpha. */
void mtm_relight_pixels(const mtm_relight_pass *pass, const float *pixels, size_t count, float *rgba);

#endif
