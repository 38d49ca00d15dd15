/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination (paper section 5): one 3×d matrix for every pixel, rows of pixels in parallel. */
#include "metamer/relight.h"

#include "base/parallel.h"
#include "relight/relight_kernel.h"

mtm_relight_options mtm_relight_defaults(void) {
    return (mtm_relight_options){.has_background = true}; /* a picture on black, as the paper's */
}

mtm_relight_pass mtm_relight_pass_of(int dimension, int lanes, const double *matrix,
                                     const mtm_relight_options *options) {
    mtm_relight_pass pass = {.dimension = dimension,
                             .lanes = lanes,
                             .is_opaque = options->has_background,
                             .background = {(float)options->background.r, (float)options->background.g,
                                            (float)options->background.b}};
    for (int row = 0; row < 3; row++)
        for (int i = 0; i < dimension; i++) pass.matrix[row][i] = (float)matrix[row * dimension + i];
    return pass;
}

typedef struct row_job {
    const mtm_image *image;
    mtm_picture *picture;
    mtm_relight_pass pass;
} row_job;

static void relight_row(void *context, int row) {
    const row_job *job = context;
    const size_t width = (size_t)job->image->width;
    mtm_relight_pixels(&job->pass, job->image->pixels + (size_t)row * width * (size_t)job->image->lanes,
                       width, job->picture->rgba + (size_t)row * width * 4);
}

mtm_status mtm_relight(const mtm_image *image, const double *matrix, const mtm_relight_options *options,
                       mtm_picture **picture, mtm_error *error) {
    mtm_status status = mtm_picture_create(image->width, image->height, picture, error);
    if (status != MTM_OK) return status;
    row_job job = {.image = image,
                   .picture = *picture,
                   .pass = mtm_relight_pass_of(image->dimension, image->lanes, matrix, options)};
    return mtm_parallel_for(options->thread_count, image->height, relight_row, &job, NULL);
}
