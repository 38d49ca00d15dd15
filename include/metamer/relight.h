/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination: from a spectral image and a light to a picture, without a renderer (paper section 5, eq. 4). */
#ifndef METAMER_RELIGHT_H
#define METAMER_RELIGHT_H

#include "metamer/basis.h"
#include "metamer/image.h"
#include "metamer/palette.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mtm_relight_options {
    bool has_background; /* false: the picture keeps the image's alpha */
    mtm_rgb background;  /* linear sRGB, put behind as rgb + (1 - A) · background; default black */
    int thread_count;    /* 0: all processors */
} mtm_relight_options;

MTM_API mtm_relight_options mtm_relight_defaults(void);

/* Multiplies every pixel that is not empty with `matrix` (3 rows of the image's dimension, from mtm_basis_matrix).
 * Nothing is clipped. MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_relight(const mtm_image *image, const double *matrix,
                                         const mtm_relight_options *options, mtm_picture **picture,
                                         mtm_error *error);

/* The same as 8-bit sRGB, red, green, blue and alpha, into `rgba` of height × width × 4 bytes: exactly the bytes that
 * mtm_relight and mtm_picture_write_png make (straight alpha; 255 over a background), in one pass. */
MTM_API void mtm_relight_bytes(const mtm_image *image, const double *matrix,
                               const mtm_relight_options *options, unsigned char *rgba);
MTM_API void mtm_relight_half_bytes(const mtm_half_image *image, const double *matrix,
                                    const mtm_relight_options *options, unsigned char *rgba);

#ifdef __cplusplus
}
#endif
#endif
