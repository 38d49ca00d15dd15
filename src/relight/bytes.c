/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination (paper section 5) to 8-bit sRGB in one pass, bands of rows in parallel. */
#include "base/parallel.h"
#include "metamer/relight.h"
#include "relight/bytes_kernel.h"

enum { BAND_PIXELS = 8192 }; /* about: a task should outweigh its claim */

static const mtm_bytes_kernel *const kernels[] = MTM_ISA_LIST(mtm_bytes_kernel);

typedef struct band_job {
    const mtm_image *image;
    unsigned char *rgba;
    int band_rows;
    const mtm_bytes_kernel *kernel;
    mtm_bytes_pass pass;
} band_job;

/* A band's rows lie one behind the other, as pixels of one long row. */
static void relight_band(void *context, int band) {
    const band_job *job = context;
    const mtm_image *image = job->image;
    const int first_row = band * job->band_rows;
    const int rows = first_row + job->band_rows <= image->height ? job->band_rows : image->height - first_row;
    const size_t first = (size_t)first_row * (size_t)image->width;
    const size_t count = (size_t)rows * (size_t)image->width;
    job->kernel->relight_floats(&job->pass, image->pixels + first * (size_t)image->lanes, count,
                                job->rgba + first * 4);
}

static void prepare_pass(mtm_bytes_pass *pass) {
    mtm_srgb_levels_prepare(&pass->levels);
    memset(pass->empty, 0, sizeof pass->empty);
    if (!pass->relight.is_opaque) return;
    for (int i = 0; i < 3; i++)
        pass->empty[i] = (unsigned char)mtm_srgb_level(&pass->levels, pass->relight.background[i]);
    pass->empty[3] = 255;
}

void mtm_relight_bytes(const mtm_image *image, const double *matrix, const mtm_relight_options *options,
                       unsigned char *rgba) {
    const int band_rows = image->width < BAND_PIXELS ? BAND_PIXELS / image->width : 1;
    const int band_count = (image->height + band_rows - 1) / band_rows;
    band_job job = {.image = image,
                    .rgba = rgba,
                    .band_rows = band_rows,
                    .kernel = kernels[mtm_isa_chosen()],
                    .pass.relight = mtm_relight_pass_of(image->dimension, image->lanes, matrix, options)};
    prepare_pass(&job.pass);
    const mtm_status status = mtm_parallel_for(options->thread_count, band_count, relight_band, &job, NULL);
    (void)status; /* without a progress callback nothing can stop it */
}
